//! Keys and certificates for the tests of this room, made once: keys are slow.

use std::sync::LazyLock;

use chrono::{DateTime, TimeZone as _, Utc};
use rcgen::{
    BasicConstraints, CertificateParams, CertificateRevocationListParams, DnType, IsCa, Issuer, KeyIdMethod, KeyPair,
    KeyUsagePurpose, RevocationReason, RevokedCertParams,
};
use time::{Duration, OffsetDateTime};

use super::{Certificate, PrivateKey, ServerNames, self_signed};
use crate::model::{KeyLength, SelfSignedRequest, Subject, Validity};

pub(super) fn key() -> &'static PrivateKey {
    static KEY: LazyLock<PrivateKey> = LazyLock::new(|| PrivateKey::generate(KeyLength::Rsa2048).unwrap());
    &KEY
}

pub(super) fn other_key() -> &'static PrivateKey {
    static KEY: LazyLock<PrivateKey> = LazyLock::new(|| PrivateKey::generate(KeyLength::Rsa2048).unwrap());
    &KEY
}

pub(super) fn legacy_key() -> &'static PrivateKey {
    static KEY: LazyLock<PrivateKey> = LazyLock::new(|| PrivateKey::generate(KeyLength::Rsa1024).unwrap());
    &KEY
}

pub(super) fn certificate() -> &'static Certificate {
    static CERTIFICATE: LazyLock<Certificate> = LazyLock::new(|| certificate_for(key()));
    &CERTIFICATE
}

pub(super) fn certificate_for(key: &PrivateKey) -> Certificate {
    let length = KeyLength::try_from(key.bits()).unwrap();
    self_signed(&request(length), &names(), key, now()).unwrap()
}

pub(super) fn request(key_length: KeyLength) -> SelfSignedRequest {
    let subject = Subject {
        common_name: "EpsonRC.SN0000123.192.168.010.001".into(),
        country: "JP".into(),
        state: "Nagano".into(),
        locality: "Suwa".into(),
        organisation: "Example & Sons".into(),
    };
    SelfSignedRequest { subject, key_length, validity: Validity::try_from(5).unwrap() }
}

pub(super) fn names() -> ServerNames {
    ServerNames {
        application_uri: "urn:EpsonRC:SN0000123".into(),
        ips: vec!["192.168.10.1".parse().unwrap(), "fe80::1".parse().unwrap()],
        dns: vec!["robot-7.plant.example".into()],
    }
}

pub(super) fn now() -> DateTime<Utc> {
    Utc.with_ymd_and_hms(2030, 6, 15, 12, 0, 0).unwrap()
}

/// A CA that signs certificates and revocation lists, all valid at [`now`].
pub(super) struct TestCa {
    params: CertificateParams,
    issuer: Issuer<'static, KeyPair>,
    pub certificate: Certificate,
}

impl TestCa {
    pub fn new(common_name: &str) -> Self {
        let mut params = CertificateParams::default();
        params.distinguished_name.push(DnType::CommonName, common_name);
        params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        params.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
        let key = KeyPair::generate().unwrap();
        let certificate = Certificate::from_der(params.self_signed(&key).unwrap().der()).unwrap();
        Self { issuer: Issuer::new(params.clone(), key), params, certificate }
    }

    /// The other CA's certificate, signed by this one.
    pub fn certify(&self, other: &Self) -> Certificate {
        Certificate::from_der(other.params.signed_by(other.issuer.key(), &self.issuer).unwrap().der()).unwrap()
    }

    pub fn application(&self, serial: &[u8]) -> Certificate {
        let mut params = CertificateParams::default();
        params.serial_number = Some(serial.to_vec().into());
        params.use_authority_key_identifier_extension = true;
        params.key_usages = vec![
            KeyUsagePurpose::DigitalSignature,
            KeyUsagePurpose::ContentCommitment,
            KeyUsagePurpose::KeyEncipherment,
            KeyUsagePurpose::DataEncipherment,
        ];
        Certificate::from_der(params.signed_by(key(), &self.issuer).unwrap().der()).unwrap()
    }

    /// A revocation list of yesterday for a month, in DER.
    pub fn crl(&self, number: u64, revoked: impl IntoIterator<Item = Vec<u8>>) -> Vec<u8> {
        let now = OffsetDateTime::from_unix_timestamp(now().timestamp()).unwrap();
        let revoked_certs = revoked
            .into_iter()
            .map(|serial| RevokedCertParams {
                serial_number: serial.into(),
                revocation_time: now - Duration::days(2),
                reason_code: Some(RevocationReason::KeyCompromise),
                invalidity_date: None,
            })
            .collect();
        let params = CertificateRevocationListParams {
            this_update: now - Duration::days(1),
            next_update: now + Duration::days(30),
            crl_number: number.into(),
            issuing_distribution_point: None,
            revoked_certs,
            key_identifier_method: KeyIdMethod::PreSpecified(self.certificate.subject_key_id().unwrap().to_vec()),
        };
        params.signed_by(&self.issuer).unwrap().der().to_vec()
    }
}
