//! Certificates and CRLs for the tests of this module.

use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use chrono::{DateTime, TimeDelta, Utc};
use rcgen::{
    BasicConstraints, CertificateParams, CertificateRevocationListParams, CertifiedIssuer, DnType, IsCa, KeyIdMethod,
    KeyPair, KeyUsagePurpose, PKCS_RSA_SHA256, RsaKeySize, SanType, SerialNumber,
};

use super::TrustSnapshot;
use crate::model::{
    Base64Bytes, Capabilities, Feature, FirmwareGeneration, ListLimits, ListedCertificate, ListedCrl, MissingReason,
    RevisionToken,
};
use crate::pki::{Certificate, Crl, RejectedClient, TrustHealth};

pub fn now() -> DateTime<Utc> {
    "2030-01-01T12:00:00Z".parse().unwrap()
}

pub struct SampleCa {
    issuer: CertifiedIssuer<'static, KeyPair>,
    pub certificate: Certificate,
}

pub fn authority(name: &str) -> SampleCa {
    let mut params = params(name);
    params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
    params.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
    made(params, KeyPair::generate().unwrap())
}

/// A self-signed application that says it may sign others, as those of some stacks do.
pub fn application(name: &str) -> Certificate {
    issuing_application(name).certificate
}

/// The same, with the key it may sign others with.
pub fn issuing_application(name: &str) -> SampleCa {
    let mut params = params(name);
    params.subject_alt_names = vec![SanType::URI(format!("urn:{name}").try_into().unwrap())];
    params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
    params.key_usages = APPLICATION_USAGES.to_vec();
    params.key_usages.push(KeyUsagePurpose::KeyCertSign);
    made(params, rsa_key())
}

fn made(params: CertificateParams, key: KeyPair) -> SampleCa {
    let issuer = CertifiedIssuer::self_signed(params, key).unwrap();
    let certificate = Certificate::from_der(issuer.der()).unwrap();
    SampleCa { issuer, certificate }
}

const APPLICATION_USAGES: [KeyUsagePurpose; 4] = [
    KeyUsagePurpose::DigitalSignature,
    KeyUsagePurpose::ContentCommitment,
    KeyUsagePurpose::KeyEncipherment,
    KeyUsagePurpose::DataEncipherment,
];

/// Keys are slow to make: one after the other of a few.
fn rsa_key() -> KeyPair {
    static KEYS: LazyLock<[Vec<u8>; 4]> = LazyLock::new(|| {
        [(); 4].map(|()| KeyPair::generate_rsa_for(&PKCS_RSA_SHA256, RsaKeySize::_2048).unwrap().serialize_der())
    });
    static NEXT: AtomicUsize = AtomicUsize::new(0);
    KeyPair::try_from(KEYS[NEXT.fetch_add(1, Ordering::Relaxed) % KEYS.len()].as_slice()).unwrap()
}

fn params(name: &str) -> CertificateParams {
    let mut params = CertificateParams::default();
    params.distinguished_name = rcgen::DistinguishedName::new();
    params.distinguished_name.push(DnType::CommonName, name);
    params.not_before = rcgen::date_time_ymd(2029, 1, 1);
    params.not_after = rcgen::date_time_ymd(2031, 1, 1);
    params
}

impl SampleCa {
    /// An application with a certificate from it.
    pub fn client(&self, name: &str) -> Certificate {
        let mut params = params(name);
        params.subject_alt_names = vec![SanType::URI(format!("urn:{name}").try_into().unwrap())];
        params.key_usages = APPLICATION_USAGES.to_vec();
        // Not one of the shared keys: with the key of its issuer it would be a renewed certificate.
        let key = KeyPair::generate_rsa_for(&PKCS_RSA_SHA256, RsaKeySize::_2048).unwrap();
        Certificate::from_der(params.signed_by(&key, &self.issuer).unwrap().der()).unwrap()
    }

    pub fn crl(&self, number: u64) -> Crl {
        let params = CertificateRevocationListParams {
            this_update: rcgen::date_time_ymd(2029, 12, 1),
            next_update: rcgen::date_time_ymd(2030, 2, 1),
            crl_number: SerialNumber::from(number),
            issuing_distribution_point: None,
            revoked_certs: Vec::new(),
            key_identifier_method: KeyIdMethod::Sha256,
        };
        Crl::from_der(params.signed_by(&self.issuer).unwrap().der()).unwrap()
    }
}

pub fn snapshot(generation: FirmwareGeneration) -> TrustSnapshot {
    TrustSnapshot {
        revision: RevisionToken::new(1),
        capabilities: match generation {
            FirmwareGeneration::Legacy => {
                Capabilities::all().without(&[Feature::IssuersList], MissingReason::FirmwareTooOld)
            }
            FirmwareGeneration::Current => Capabilities::all(),
        },
        limits: ListLimits::of(generation),
        clock: now(),
        trusted: Vec::new(),
        rejected: Vec::new(),
        issuers: Vec::new(),
        crls: Vec::new(),
        health: TrustHealth::default(),
    }
}

pub fn listed(certificate: &Certificate) -> ListedCertificate {
    ListedCertificate {
        file_name: format!("{}.der", certificate.summary().issued_to),
        certificate: Base64Bytes(certificate.der().to_vec()),
        summary: certificate.summary(),
        added: now() - TimeDelta::days(1),
    }
}

pub fn rejected(certificate: &Certificate) -> RejectedClient {
    RejectedClient {
        certificate: Base64Bytes(certificate.der().to_vec()),
        chain: Vec::new(),
        summary: certificate.summary(),
        status: crate::model::CertificateStatus::Untrusted,
        cause: None,
        reason: "nobody trusts it".to_owned(),
        address: "10.0.0.9".to_owned(),
        first_seen: now(),
        last_seen: now(),
        count: 1,
    }
}

pub fn listed_crl(crl: &Crl) -> ListedCrl {
    ListedCrl {
        file_name: "plant.crl".to_owned(),
        crl: Some(Base64Bytes(crl.der().to_vec())),
        summary: crl.summary(),
        added: now(),
    }
}
