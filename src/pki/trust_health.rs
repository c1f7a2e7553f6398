use chrono::{DateTime, Utc};
use serde::Serialize;

use super::{Certificate, Crl, KeyUsage, is_authority};

/// What is wrong with CRLs and the authorities they are for, before a client is refused because of it.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct TrustHealth {
    /// One for each CRL, in their order.
    pub crls: Vec<CrlHealth>,
    /// Thumbprints of the authorities that no usable CRL is held of: whether a certificate from them was revoked is not
    /// known, so clients with one are refused.
    pub without_crl: Vec<String>,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CrlHealth {
    pub issuer: CrlIssuer,
    pub dates: CrlDates,
}

/// Whose CRL it is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CrlIssuer {
    /// An authority in the trusted or issuers list signed it.
    Held { thumbprint: String },
    /// It carries the name of this authority, but is signed with another key: it is of no use.
    NotSignedBy { thumbprint: String },
    /// This authority signed it, but its certificate does not allow it to: it is of no use.
    MayNotSign { thumbprint: String },
    /// No authority of that name is held: it is of no use until one is.
    Missing,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CrlDates {
    Current,
    /// A newer one should have come: certificates of its issuer are refused until it does.
    Expired,
    NotYetValid,
    /// It does not say until when it is valid: it is of no use.
    NoEnd,
}

impl CrlHealth {
    /// Whether certificates can be checked with it.
    pub fn is_usable(&self) -> bool {
        matches!(self.issuer, CrlIssuer::Held { .. }) && self.dates == CrlDates::Current
    }
}

impl TrustHealth {
    /// Says the same as [`TrustLists`](super::TrustLists) by default. Reads every CRL: blocks for large ones.
    ///
    /// `authorities`: those in the trusted and issuers lists; other certificates among them are passed over.
    pub fn of<'a>(crls: impl IntoIterator<Item = &'a Crl>, authorities: &[&Certificate], now: DateTime<Utc>) -> Self {
        let crls: Vec<CrlHealth> = crls
            .into_iter()
            .map(|crl| CrlHealth { issuer: issuer(crl, authorities), dates: dates(crl, now) })
            .collect();
        let without_crl = authorities
            .iter()
            .filter(|authority| is_authority(authority, authorities.iter().copied()))
            .map(|authority| authority.thumbprint_sha1())
            .filter(|own| {
                !crls.iter().any(|crl| {
                    crl.is_usable() && matches!(&crl.issuer, CrlIssuer::Held { thumbprint } if thumbprint == own)
                })
            })
            .collect();
        Self { crls, without_crl }
    }
}

fn issuer(crl: &Crl, authorities: &[&Certificate]) -> CrlIssuer {
    let mut found = CrlIssuer::Missing;
    let same_name = |authority: &&&Certificate| crl.issuer_folded() == authority.facts().subject_folded;
    for authority in authorities.iter().filter(same_name) {
        let thumbprint = authority.thumbprint_sha1();
        if !crl.verify_signed_by(authority) {
            found = CrlIssuer::NotSignedBy { thumbprint };
        } else if authority.key_usages().is_some_and(|usages| !usages.contains(&KeyUsage::CrlSign)) {
            found = CrlIssuer::MayNotSign { thumbprint };
        } else {
            return CrlIssuer::Held { thumbprint };
        }
    }
    found
}

fn dates(crl: &Crl, now: DateTime<Utc>) -> CrlDates {
    match crl.next_update() {
        _ if crl.this_update() > now => CrlDates::NotYetValid,
        None => CrlDates::NoEnd,
        Some(next) if next.timestamp() < now.timestamp() => CrlDates::Expired,
        Some(_) => CrlDates::Current,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let health = TrustHealth::of(&crls, &[&held, &other], now());
        let dates: Vec<CrlDates> = health.crls.iter().map(|crl| crl.dates).collect();
        assert_eq!(dates, [CrlDates::Current, CrlDates::Expired, CrlDates::NotYetValid]);
        assert!(health.crls.iter().all(|crl| crl.issuer == CrlIssuer::Held { thumbprint: held.thumbprint_sha1() }));
        assert_eq!(health.without_crl, [other.thumbprint_sha1()]);
        assert_eq!(TrustHealth::of(&crls[1..], &[&held], now()).without_crl, [held.thumbprint_sha1()]);
    }

    #[test]
    fn a_crl_of_nobody_or_of_a_namesake_is_found_out() {
        let (signer, _) = authority("Plant CA", &SIGNS_CRLS);
        let (_, namesake) = authority("Plant CA", &SIGNS_CRLS);
        let (_, other) = authority("Other CA", &SIGNS_CRLS);
        let crls = [crl(&signer, 0, 30)];
        assert_eq!(TrustHealth::of(&crls, &[&other], now()).crls[0].issuer, CrlIssuer::Missing);
        let health = TrustHealth::of(&crls, &[&namesake], now());
        assert_eq!(health.crls[0].issuer, CrlIssuer::NotSignedBy { thumbprint: namesake.thumbprint_sha1() });
        assert_eq!(health.without_crl, [namesake.thumbprint_sha1()]);
    }

    #[test]
    fn an_application_needs_no_crl() {
        let application = crate::pki::samples::certificate();
        assert_eq!(TrustHealth::of(&[], &[application], now()), TrustHealth::default());
    }
}
