use std::net::{IpAddr, Ipv4Addr};

use opcua::crypto::{PrivateKey, X509};
use rcgen::{
    BasicConstraints, CertificateParams, CertificateRevocationListParams, DnType, ExtendedKeyUsagePurpose, IsCa,
    Issuer, KeyIdMethod, KeyPair, KeyUsagePurpose, PKCS_RSA_SHA256, RevokedCertParams, RsaKeySize, SanType,
    SerialNumber,
};
use time::OffsetDateTime;

use crate::pki::{Certificate, Crl, TrustLists};

/// An OPC UA application: its key and its certificate, which says `urn:<name>`.
pub(in super::super) struct TestApplication {
    pub name: String,
    pub der: Vec<u8>,
    pub key: KeyPair,
}

impl TestApplication {
    pub fn new(name: &str) -> Self {
        Self::made(name, RsaKeySize::_2048, None, |_| {})
    }

    /// Its certificate names no URI, only an address.
    pub fn without_uri(name: &str) -> Self {
        Self::made(name, RsaKeySize::_2048, None, |params| drop(params.subject_alt_names.remove(0)))
    }

    fn made(
        name: &str,
        size: RsaKeySize,
        authority: Option<&TestCa>,
        change: impl FnOnce(&mut CertificateParams),
    ) -> Self {
        let key = KeyPair::generate_rsa_for(&PKCS_RSA_SHA256, size).unwrap();
        let mut params = CertificateParams::default();
        params.distinguished_name.push(DnType::CommonName, name);
        params.subject_alt_names = vec![
            SanType::URI(format!("urn:{name}").try_into().unwrap()),
            SanType::IpAddress(IpAddr::V4(Ipv4Addr::LOCALHOST)),
        ];
        params.not_after = OffsetDateTime::now_utc() + time::Duration::days(365);
        params.key_usages = vec![
            KeyUsagePurpose::DigitalSignature,
            KeyUsagePurpose::ContentCommitment,
            KeyUsagePurpose::KeyEncipherment,
            KeyUsagePurpose::DataEncipherment,
        ];
        params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth, ExtendedKeyUsagePurpose::ClientAuth];
        change(&mut params);
        let made = match authority {
            Some(authority) => {
                params.use_authority_key_identifier_extension = true;
                params.signed_by(&key, &authority.issuer)
            }
            None => {
                params.key_usages.push(KeyUsagePurpose::KeyCertSign);
                params.self_signed(&key)
            }
        };
        Self { name: name.to_owned(), der: made.unwrap().der().to_vec(), key }
    }

    pub fn certificate(&self) -> Certificate {
        Certificate::from_der(&self.der).unwrap()
    }

    /// As the OPC UA crate takes them.
    pub fn wire(&self) -> (PrivateKey, X509) {
        (PrivateKey::from_pem(self.key.serialize_pem().as_bytes()).unwrap(), X509::from_der(&self.der).unwrap())
    }
}

/// A CA.
pub(in super::super) struct TestCa {
    pub certificate: Certificate,
    issuer: Issuer<'static, KeyPair>,
}

impl TestCa {
    pub fn new(name: &str) -> Self {
        let key = KeyPair::generate_rsa_for(&PKCS_RSA_SHA256, RsaKeySize::_2048).unwrap();
        let mut params = CertificateParams::default();
        params.distinguished_name.push(DnType::CommonName, name);
        params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        params.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
        let certificate = Certificate::from_der(params.self_signed(&key).unwrap().der()).unwrap();
        Self { certificate, issuer: Issuer::new(params, key) }
    }

    pub fn issue(&self, name: &str, size: RsaKeySize) -> TestApplication {
        TestApplication::made(name, size, Some(self), |_| {})
    }

    pub fn crl(&self, number: u64, revoked: &[&TestApplication]) -> Crl {
        let now = OffsetDateTime::now_utc();
        let revoked = revoked.iter().map(|identity| {
            let serial = hex::decode(identity.certificate().summary().serial_number).unwrap();
            RevokedCertParams {
                serial_number: SerialNumber::from(serial),
                revocation_time: now,
                reason_code: None,
                invalidity_date: None,
            }
        });
        let params = CertificateRevocationListParams {
            this_update: now - time::Duration::minutes(1),
            next_update: now + time::Duration::days(1),
            crl_number: SerialNumber::from(number),
            issuing_distribution_point: None,
            revoked_certs: revoked.collect(),
            key_identifier_method: KeyIdMethod::Sha256,
        };
        Crl::from_der(params.signed_by(&self.issuer).unwrap().der()).unwrap()
    }
}

/// Lists that trust these applications, each by itself.
pub(in super::super) fn trusting(identities: &[&TestApplication]) -> TrustLists {
    TrustLists::new(identities.iter().map(|identity| identity.certificate()).collect(), vec![], vec![])
}
