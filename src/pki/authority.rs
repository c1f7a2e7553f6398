//! Whether a certificate is that of an authority or that of an application.

use super::{Certificate, KeyUsage};

/// How many signatures are checked to find out whether a certificate issued another.
const MAX_CHECKED: usize = 16;

/// Whether a certificate is that of an authority, which issues others; otherwise it is that of an application.
///
/// An authority may issue certificates: CA:TRUE, and keyCertSign if the key usage is restricted (RFC 5280 §4.2.1.9,
/// §4.2.1.3). A certificate without basic constraints counts as one only where it did issue another.
///
/// Some OPC UA stacks write CA:TRUE and keyCertSign into self-signed certificates of applications. Such a certificate
/// has an application URI and a key that may encrypt (OPC 10000-6 §6.2.2), which an authority (OPC 10000-6 §6.2.4) does
/// not need; it stays an application unless it issued one of the certificates `at_hand`. The URI alone does not make an
/// application: some tools write one into authorities.
///
/// Checks at most 16 signatures; where more certificates carry its name as their issuer, it counts as an authority.
pub fn is_authority<'a>(certificate: &Certificate, at_hand: impl IntoIterator<Item = &'a Certificate>) -> bool {
    if certificate.is_ca() {
        !is_for_an_application(certificate) || has_issued(certificate, at_hand)
    } else {
        certificate.basic_constraints().is_none()
            && certificate.key_usages().is_none_or(|usages| usages.contains(&KeyUsage::KeyCertSign))
            && has_issued(certificate, at_hand)
    }
}

/// Self-signed, with an application URI and a key that may encrypt.
fn is_for_an_application(certificate: &Certificate) -> bool {
    let facts = certificate.facts();
    let encrypts = [KeyUsage::KeyEncipherment, KeyUsage::DataEncipherment, KeyUsage::KeyAgreement];
    facts.subject_folded == facts.issuer_folded
        && facts.extensions.application_uri().is_some()
        && certificate.key_usages().is_some_and(|usages| encrypts.iter().any(|usage| usages.contains(usage)))
}

/// A renewed certificate with the same key is signed with the key of the old one, but not issued by it.
fn has_issued<'a>(certificate: &Certificate, at_hand: impl IntoIterator<Item = &'a Certificate>) -> bool {
    let facts = certificate.facts();
    let named = at_hand.into_iter().filter(|other| {
        other.facts().issuer_folded == facts.subject_folded && other.facts().public_key != facts.public_key
    });
    for (checked, other) in named.enumerate() {
        if checked == MAX_CHECKED || other.verify_signed_by(certificate) {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use rcgen::{
        BasicConstraints, CertificateParams, DnType, IsCa, Issuer, KeyPair, KeyUsagePurpose as Purpose, SanType,
    };

    use super::*;
    use crate::pki::samples;

    const CA: [Purpose; 2] = [Purpose::KeyCertSign, Purpose::CrlSign];
    const APPLICATION: [Purpose; 5] = [
        Purpose::DigitalSignature,
        Purpose::ContentCommitment,
        Purpose::KeyEncipherment,
        Purpose::DataEncipherment,
        Purpose::KeyCertSign,
    ];

    fn params(name: &str, usages: &[Purpose], uri: bool) -> CertificateParams {
        let mut params = CertificateParams::default();
        params.distinguished_name.push(DnType::CommonName, name);
        params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        params.key_usages = usages.to_vec();
        if uri {
            params.subject_alt_names = vec![SanType::URI("urn:plant:ca".try_into().unwrap())];
        }
        params
    }

    fn self_signed(params: &CertificateParams, key: &KeyPair) -> Certificate {
        Certificate::from_der(params.self_signed(key).unwrap().der()).unwrap()
    }

    fn made(usages: &[Purpose], uri: bool) -> Certificate {
        self_signed(&params("Plant", usages, uri), &KeyPair::generate().unwrap())
    }

    #[test]
    fn a_uri_does_not_make_an_application_of_an_authority() {
        let signs_too = [&CA[..], &[Purpose::DigitalSignature, Purpose::ContentCommitment]].concat();
        for (usages, uri, expected) in [
            (&CA[..], true, true),
            (&CA, false, true),
            (&signs_too, true, true),
            (&[], true, true),
            (&APPLICATION, false, true),
            (&APPLICATION, true, false),
            (&[Purpose::DigitalSignature, Purpose::KeyAgreement, Purpose::KeyCertSign], true, false),
            // It may not sign certificates.
            (&APPLICATION[..4], true, false),
            (&[Purpose::CrlSign], false, false),
        ] {
            assert_eq!(is_authority(&made(usages, uri), []), expected, "{usages:?}, with a URI: {uri}");
        }
        assert!(!is_authority(samples::certificate(), []));
    }

    #[test]
    fn files_of_other_tools_are_judged_alike() {
        for der in [
            &include_bytes!("../../tests/cases/01-ca-with-san-uri/node-opcua-pki-ca.der")[..],
            include_bytes!("../../tests/cases/01-ca-with-san-uri/san-uri-dns.der"),
        ] {
            assert!(is_authority(&Certificate::from_der(der).unwrap(), []));
        }
    }

    #[test]
    fn what_issued_another_certificate_at_hand_is_an_authority() {
        let key = KeyPair::generate().unwrap();
        let params = params("Plant", &APPLICATION, true);
        let application = self_signed(&params, &key);
        let mut renewed = params.clone();
        renewed.serial_number = Some(77_u64.into());
        let renewed = self_signed(&renewed, &key);
        let namesake = self_signed(&params, &KeyPair::generate().unwrap());
        assert!(!is_authority(&application, [&application, &renewed, &namesake, samples::certificate()]));

        let issuer = Issuer::new(params, key);
        let mut below = CertificateParams::default();
        below.distinguished_name.push(DnType::CommonName, "client");
        let below = below.signed_by(&KeyPair::generate().unwrap(), &issuer).unwrap();
        let below = Certificate::from_der(below.der()).unwrap();
        assert!(is_authority(&application, [samples::certificate(), &below]));
        assert!(!is_authority(&namesake, [&below]), "another key signed it");
        assert!(!is_authority(&below, [&application, &below]));
    }

    #[test]
    fn an_old_root_without_basic_constraints_counts_once_it_issued_something() {
        let key = KeyPair::generate().unwrap();
        let mut old = params("Old root", &[], false);
        old.is_ca = IsCa::NoCa;
        let root = self_signed(&old, &key);
        assert!(!is_authority(&root, []));
        let below = CertificateParams::default().signed_by(&KeyPair::generate().unwrap(), &Issuer::new(old, key));
        let below = Certificate::from_der(below.unwrap().der()).unwrap();
        assert!(is_authority(&root, [&below]));
    }

    #[test]
    fn many_namesakes_are_not_worked_on_for_long() {
        let application = made(&APPLICATION, true);
        let namesakes: Vec<Certificate> = (0..20).map(|_| made(&APPLICATION, true)).collect();
        assert!(!is_authority(&application, &namesakes[..MAX_CHECKED]));
        assert!(is_authority(&application, &namesakes), "nothing is known of the last ones");
    }
}
