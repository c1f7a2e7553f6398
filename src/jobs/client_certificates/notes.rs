use std::collections::BTreeMap;

use chrono::{DateTime, Utc};

use super::TrustSnapshot;
use super::target_list::TargetList;
use crate::model::ClientList;
use crate::pki::{Certificate, CertificateFlaw, is_authority, never_accepted, validity_flaw};

/// What a person may want to think about before something goes into a list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TrustNote {
    /// An authority in the trusted list: every client is let in that has a certificate from it.
    TrustsAllItIssues,
    /// An authority that came with an application's certificate goes into the issuers list, not into the one asked for.
    OnlyCompletesAChain,
    /// No client is ever let in with this certificate, or, of an authority, with a certificate from it.
    NeverAccepted {
        /// Whether it is the certificate of a CA.
        authority: bool,
        /// Why it is refused with any list.
        flaw: CertificateFlaw,
    },
    /// A CRL among certificates goes to the CRLs.
    CrlAmongCertificates,
    /// It takes the place of the older CRL of the same issuer.
    ReplacesOlder,
    /// It is newer than another CRL of the same issuer, but its number is lower: numbers go up (RFC 5280 §5.2.3) unless the
    /// authority was set up anew.
    NumberStartsAgain {
        /// Number of the new CRL.
        number: String,
        /// Issue date of the new CRL.
        date: DateTime<Utc>,
        /// Number of the CRL it replaces.
        before: String,
        /// Issue date of the CRL it replaces.
        date_before: DateTime<Utc>,
    },
    /// Its validity is over, or a newer CRL should have come.
    Expired,
    /// Its validity has not begun.
    NotYetValid,
}

/// What there is to think about before the certificate goes into the trusted or the issuers list.
pub(super) fn of_certificate(
    certificate: &Certificate,
    authority: bool,
    to: TargetList,
    now: DateTime<Utc>,
) -> Vec<TrustNote> {
    let mut notes = Vec::new();
    let never = never_accepted(certificate, authority);
    // One that is for an application, but of no use as one, still counts as the issuer of others.
    if to == TargetList::Trusted && (authority || certificate.is_ca() && never.is_some()) {
        notes.push(TrustNote::TrustsAllItIssues);
    }
    notes.extend(never.map(|flaw| TrustNote::NeverAccepted { authority, flaw }));
    notes.extend(validity_flaw(certificate, now).map(|flaw| match flaw {
        CertificateFlaw::NotYetValid { .. } => TrustNote::NotYetValid,
        _ => TrustNote::Expired,
    }));
    notes
}

impl TrustSnapshot {
    /// What there is to think about before these certificates are moved from a list into another, by thumbprint; those
    /// without a note are left out. Nothing for a move to the rejected list.
    pub fn notes_of_move(&self, to: ClientList, thumbprints: &[String]) -> BTreeMap<String, Vec<TrustNote>> {
        let target = match to {
            ClientList::Trusted => TargetList::Trusted,
            ClientList::Issuers => TargetList::Issuers,
            ClientList::Rejected => return BTreeMap::new(),
        };
        let at_hand: Vec<Certificate> = self.certificates().collect();
        let mut all = BTreeMap::new();
        for certificate in &at_hand {
            let thumbprint = certificate.thumbprint_sha1();
            if thumbprints.contains(&thumbprint) && !all.contains_key(&thumbprint) {
                let authority = is_authority(certificate, &at_hand);
                let notes = of_certificate(certificate, authority, target, self.clock);
                all.insert(thumbprint, notes);
            }
        }
        all.retain(|_, notes| !notes.is_empty());
        all
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::{application, authority, rejected, snapshot};
    use super::*;
    use crate::model::FirmwareGeneration;

    /// Made by OpenSSL; valid in 2026 and 2027.
    fn never() -> [(Certificate, CertificateFlaw); 4] {
        let read = |der: &[u8]| Certificate::from_der(der).unwrap();
        [
            (read(include_bytes!("../../../tests/cases/15-never-admitted/self-ec.der")), CertificateFlaw::KeyNotRsa),
            (
                read(include_bytes!("../../../tests/cases/15-never-admitted/self-k1024.der")),
                CertificateFlaw::KeyTooShort { bits: 1024, least: 2048 },
            ),
            (
                read(include_bytes!("../../../tests/cases/15-never-admitted/self-no-ku.der")),
                CertificateFlaw::KeyUsageMissing,
            ),
            (
                read(include_bytes!("../../../tests/cases/15-never-admitted/self-eku-server-only.der")),
                CertificateFlaw::NotForRole { role: crate::pki::PeerRole::Client },
            ),
        ]
    }

    #[test]
    fn what_no_client_is_let_in_with_is_noted() {
        let now = "2026-12-01T00:00:00Z".parse().unwrap();
        for (certificate, flaw) in never() {
            let note = TrustNote::NeverAccepted { authority: false, flaw };
            assert_eq!(of_certificate(&certificate, false, TargetList::Trusted, now), std::slice::from_ref(&note));
            let later = "2028-12-01T00:00:00Z".parse().unwrap();
            assert_eq!(of_certificate(&certificate, false, TargetList::Trusted, later), [note, TrustNote::Expired]);
        }
    }

    #[test]
    fn a_move_into_the_trusted_list_is_noted_like_an_addition() {
        let mut held = snapshot(FirmwareGeneration::Current);
        let (fine, ca) = (application("fine"), authority("Plant CA").certificate);
        let [(elliptic, flaw), ..] = never();
        held.rejected = [&fine, &ca, &elliptic].map(rejected).to_vec();
        held.clock = "2030-01-01T12:00:00Z".parse().unwrap();
        let all: Vec<String> = held.rejected.iter().map(|client| client.summary.thumbprint.clone()).collect();
        let never = TrustNote::NeverAccepted { authority: false, flaw };
        let expected = BTreeMap::from([
            (ca.thumbprint_sha1(), vec![TrustNote::TrustsAllItIssues]),
            (elliptic.thumbprint_sha1(), vec![never, TrustNote::Expired]),
        ]);
        assert_eq!(held.notes_of_move(ClientList::Trusted, &all), expected);
        assert_eq!(held.notes_of_move(ClientList::Trusted, &all[..1]), BTreeMap::new());
        assert_eq!(held.notes_of_move(ClientList::Rejected, &all), BTreeMap::new());
        assert!(!held.notes_of_move(ClientList::Issuers, &all).contains_key(&ca.thumbprint_sha1()));
    }
}
