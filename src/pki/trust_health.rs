use chrono::{DateTime, Utc};
use serde::Serialize;

use super::signature::SignatureCheck;
use super::{Certificate, Crl, CrlFlaw, TrustLists, crl_date_flaw, is_authority, rules};

/// What is wrong with CRLs and the authorities they are for, before a client is refused because of it.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct TrustHealth {
    /// One for each CRL, in their order.
    pub crls: Vec<CrlHealth>,
    /// Thumbprints of the authorities that no usable CRL is held of: whether a certificate from them was revoked is not
    /// known, so clients with one are refused.
    pub without_crl: Vec<String>,
}

/// Whether one CRL can be used.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CrlHealth {
    /// Whose CRL it is.
    pub issuer: CrlIssuer,
    /// Whether its dates fit the controller's clock.
    pub dates: CrlDates,
}

/// Whose CRL it is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CrlIssuer {
    /// An authority in the trusted or issuers list signed it.
    Held {
        /// SHA-1 of the authority's certificate.
        thumbprint: String,
    },
    /// It carries the name of this authority, but is signed with another key: it is of no use.
    NotSignedBy {
        /// SHA-1 of the authority's certificate.
        thumbprint: String,
    },
    /// This authority signed it, but its certificate does not allow it to: it is of no use.
    MayNotSign {
        /// SHA-1 of the authority's certificate.
        thumbprint: String,
    },
    /// No authority of that name is held: it is of no use until one is.
    Missing,
}

/// How the dates of a CRL compare with the clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CrlDates {
    /// The CRL is in force.
    Current,
    /// A newer one should have come: certificates of its issuer are refused until it does.
    Expired,
    /// The CRL is from the future.
    NotYetValid,
    /// It does not say until when it is valid: it is of no use.
    NoEnd,
}

impl CrlHealth {
    /// Why nothing can be checked with that list, if its issuer is held: what [`TrustLists::validate`] says as well.
    /// `held`: certificates with the name of its issuer and others.
    pub fn flaw(&self, crl: &Crl, mut held: impl Iterator<Item = Certificate>, now: DateTime<Utc>) -> Option<CrlFlaw> {
        let of_signature = match &self.issuer {
            CrlIssuer::NotSignedBy { .. } if held.any(|authority| crl.is_of(&authority)) => Some(CrlFlaw::NotSigned),
            CrlIssuer::NotSignedBy { .. } => Some(CrlFlaw::KeyNotHeld),
            CrlIssuer::MayNotSign { .. } => Some(CrlFlaw::MayNotSign),
            CrlIssuer::Held { .. } | CrlIssuer::Missing => None,
        };
        let of_content = || crl.unusable().map(|because| CrlFlaw::Unusable { because });
        let of_dates = || crl_date_flaw(crl, now);
        of_signature.or_else(of_content).or_else(of_dates)
    }

    /// Whether certificates can be checked with it.
    pub fn is_usable(&self) -> bool {
        matches!(self.issuer, CrlIssuer::Held { .. }) && self.dates == CrlDates::Current
    }
}

impl TrustHealth {
    /// Says the same as [`TrustLists::validate`] by default. Checks signatures of every CRL: blocks for large ones.
    pub fn of(lists: &TrustLists, now: DateTime<Utc>) -> Self {
        let crls: Vec<CrlHealth> = lists
            .crls()
            .iter()
            .enumerate()
            .map(|(index, crl)| CrlHealth { issuer: issuer(lists, index), dates: dates(crl, now) })
            .collect();
        let held = || lists.trusted().iter().chain(lists.issuers());
        let has_a_crl = |authority: &Certificate| {
            let name = &authority.facts().subject_folded;
            let issues_authorities = || {
                let mut issued = held().filter(|below| below.facts().issuer_folded == *name && *below != authority);
                issued.any(|below| is_authority(below, held()))
            };
            let usable = lists.crls_of(authority).filter(|(index, crl)| {
                crls[*index].is_usable()
                    && crl.unusable().is_none()
                    && (!crl.is_only_about_authorities() || issues_authorities())
            });
            usable.map(|(index, _)| index).any(|index| {
                is_signed_by(lists, index, authority) == Some(true)
                    || lists.with_subject(name).iter().any(|other| {
                        other != authority
                            && is_signed_by(lists, index, other) == Some(true)
                            && lists.signs_lists_for(other, authority, now)
                    })
            })
        };
        let mut without_crl: Vec<String> = held()
            .filter(|authority| is_authority(authority, held()) && !has_a_crl(authority))
            .map(Certificate::thumbprint_sha1)
            .collect();
        let mut seen = std::collections::HashSet::new();
        without_crl.retain(|thumbprint| seen.insert(thumbprint.clone()));
        Self { crls, without_crl }
    }
}

/// The held certificate whose key signed the list and may do so; or what is wrong with the one that comes nearest.
fn issuer(lists: &TrustLists, index: usize) -> CrlIssuer {
    let mut found = CrlIssuer::Missing;
    for authority in lists.with_subject(lists.crls()[index].issuer_folded()) {
        let thumbprint = authority.thumbprint_sha1();
        match is_signed_by(lists, index, authority) {
            Some(true) => return CrlIssuer::Held { thumbprint },
            Some(false) => found = CrlIssuer::MayNotSign { thumbprint },
            None if found == CrlIssuer::Missing => found = CrlIssuer::NotSignedBy { thumbprint },
            None => {}
        }
    }
    found
}

/// Whether the certificate's key signed the list, and if so, whether it may.
fn is_signed_by(lists: &TrustLists, index: usize, signer: &Certificate) -> Option<bool> {
    let is_signed = lists.crls()[index].is_of(signer) && lists.crl_signature(index, signer) == SignatureCheck::Valid;
    is_signed.then(|| rules::may_sign_lists(signer))
}

fn dates(crl: &Crl, now: DateTime<Utc>) -> CrlDates {
    match crl_date_flaw(crl, now) {
        None => CrlDates::Current,
        Some(CrlFlaw::NotYetValid { .. }) => CrlDates::NotYetValid,
        Some(CrlFlaw::NoEnd) => CrlDates::NoEnd,
        Some(_) => CrlDates::Expired,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pki::samples::{self, TestCa};
    use rcgen::{
        BasicConstraints, CertificateParams, CertificateRevocationListParams, CertifiedIssuer, DnType, IsCa,
        KeyIdMethod, KeyPair, KeyUsagePurpose, SerialNumber,
    };

    fn authority(name: &str, usages: &[KeyUsagePurpose]) -> (CertifiedIssuer<'static, KeyPair>, Certificate) {
        let mut params = CertificateParams::default();
        params.distinguished_name.push(DnType::CommonName, name);
        params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        params.key_usages = usages.to_vec();
        let issuer = CertifiedIssuer::self_signed(params, KeyPair::generate().unwrap()).unwrap();
        let certificate = Certificate::from_der(issuer.der()).unwrap();
        (issuer, certificate)
    }

    fn crl(issuer: &CertifiedIssuer<'static, KeyPair>, from: i64, to: i64) -> Crl {
        let date = |days: i64| rcgen::date_time_ymd(2030, 1, 1) + time::Duration::days(days);
        let params = CertificateRevocationListParams {
            this_update: date(from),
            next_update: date(to),
            crl_number: SerialNumber::from(1_u64),
            issuing_distribution_point: None,
            revoked_certs: Vec::new(),
            key_identifier_method: KeyIdMethod::Sha256,
        };
        Crl::from_der(params.signed_by(issuer).unwrap().der()).unwrap()
    }

    fn now() -> DateTime<Utc> {
        "2030-01-01T12:00:00Z".parse().unwrap()
    }

    const SIGNS_CRLS: [KeyUsagePurpose; 2] = [KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];

    #[test]
    fn a_crl_is_usable_when_its_authority_is_held_and_the_day_is_right() {
        let (signer, held) = authority("Plant CA", &SIGNS_CRLS);
        let (_, other) = authority("Other CA", &SIGNS_CRLS);
        let crls = [crl(&signer, 0, 30), crl(&signer, -30, 0), crl(&signer, 1, 30)];
        let lists = |crls: &[Crl], held: &[&Certificate]| {
            TrustLists::new(held.iter().map(|one| (*one).clone()).collect(), vec![], crls.to_vec())
        };
        let health = TrustHealth::of(&lists(&crls, &[&held, &other]), now());
        let dates: Vec<CrlDates> = health.crls.iter().map(|crl| crl.dates).collect();
        assert_eq!(dates, [CrlDates::Current, CrlDates::Expired, CrlDates::NotYetValid]);
        assert!(health.crls.iter().all(|crl| crl.issuer == CrlIssuer::Held { thumbprint: held.thumbprint_sha1() }));
        assert_eq!(health.without_crl, [other.thumbprint_sha1()]);
        assert_eq!(TrustHealth::of(&lists(&crls[1..], &[&held]), now()).without_crl, [held.thumbprint_sha1()]);
    }

    #[test]
    fn a_crl_of_nobody_or_of_a_namesake_is_found_out() {
        let (signer, _) = authority("Plant CA", &SIGNS_CRLS);
        let (_, namesake) = authority("Plant CA", &SIGNS_CRLS);
        let (_, other) = authority("Other CA", &SIGNS_CRLS);
        let crls = [crl(&signer, 0, 30)];
        let lists = |held: &Certificate| TrustLists::new(vec![held.clone()], vec![], crls.to_vec());
        assert_eq!(TrustHealth::of(&lists(&other), now()).crls[0].issuer, CrlIssuer::Missing);
        let health = TrustHealth::of(&lists(&namesake), now());
        assert_eq!(health.crls[0].issuer, CrlIssuer::NotSignedBy { thumbprint: namesake.thumbprint_sha1() });
        assert_eq!(health.without_crl, [namesake.thumbprint_sha1()]);
    }

    #[test]
    fn a_crl_of_a_new_key_is_usable_when_the_old_key_certified_it_and_it_is_trusted() {
        let (old, new) = (TestCa::new("Plant CA"), TestCa::new("Plant CA"));
        let link = old.certify(&new);
        let crl = Crl::from_der(&new.crl(1, [])).unwrap();
        let health = |trusted: &[&Certificate], issuers: &[&Certificate]| {
            let all = |held: &[&Certificate]| held.iter().map(|one| (*one).clone()).collect();
            TrustHealth::of(&TrustLists::new(all(trusted), all(issuers), vec![crl.clone()]), samples::now())
        };
        let both = health(&[&old.certificate, &link], &[]);
        assert_eq!(both.crls[0].issuer, CrlIssuer::Held { thumbprint: link.thumbprint_sha1() });
        assert_eq!(both.without_crl, [""; 0]);
        let untrusted = health(&[&old.certificate], &[&link]);
        assert_eq!(untrusted.without_crl, [old.certificate.thumbprint_sha1()], "it only vouches for itself");
        let namesakes = health(&[&old.certificate, &new.certificate], &[]);
        assert_eq!(namesakes.without_crl, [old.certificate.thumbprint_sha1()], "another authority of the same name");
    }

    #[test]
    fn an_application_needs_no_crl() {
        let application = crate::pki::samples::certificate();
        assert_eq!(
            TrustHealth::of(&TrustLists::new(vec![application.clone()], vec![], vec![]), now()),
            TrustHealth::default()
        );
    }
}
