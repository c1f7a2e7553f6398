//! A certification authority, and OPC UA applications with certificates from it or from themselves.

use std::net::{IpAddr, Ipv4Addr};

use opcua_configurator::pki::Certificate;
use rcgen::{
    BasicConstraints, CertificateParams, CertificateRevocationListParams, DnType, ExtendedKeyUsagePurpose, IsCa,
    Issuer, KeyIdMethod, KeyPair, KeyUsagePurpose, PKCS_RSA_SHA256, RevokedCertParams, RsaKeySize, SanType,
    SerialNumber,
};
use time::{Duration, OffsetDateTime};

/// An OPC UA application: its key, and its certificate, which says `urn:<name>`.
pub struct Application {
    pub name: String,
    pub der: Vec<u8>,
    pub key: KeyPair,
}

impl Application {
    /// With a certificate it signed itself.
    pub fn new(name: &str) -> Self {
        Self::made(name, None)
    }

    fn made(name: &str, authority: Option<&Authority>) -> Self {
        let key = rsa_key();
        let mut params = named(name);
        params.subject_alt_names =
            vec![SanType::URI(uri(name).try_into().unwrap()), SanType::IpAddress(IpAddr::V4(Ipv4Addr::LOCALHOST))];
        params.key_usages = vec![
            KeyUsagePurpose::DigitalSignature,
            KeyUsagePurpose::ContentCommitment,
            KeyUsagePurpose::KeyEncipherment,
            KeyUsagePurpose::DataEncipherment,
        ];
        params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth, ExtendedKeyUsagePurpose::ClientAuth];
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

    pub fn application_uri(&self) -> String {
        uri(&self.name)
    }
}

/// A CA.
pub struct Authority {
    pub der: Vec<u8>,
    issuer: Issuer<'static, KeyPair>,
}

impl Authority {
    pub fn root(name: &str) -> Self {
        let (params, key) = (authority(name), rsa_key());
        let der = params.self_signed(&key).unwrap().der().to_vec();
        Self { der, issuer: Issuer::new(params, key) }
    }

    /// Another authority below it.
    pub fn authority(&self, name: &str) -> Self {
        let (mut params, key) = (authority(name), rsa_key());
        params.use_authority_key_identifier_extension = true;
        let der = params.signed_by(&key, &self.issuer).unwrap().der().to_vec();
        Self { der, issuer: Issuer::new(params, key) }
    }

    pub fn application(&self, name: &str) -> Application {
        Application::made(name, Some(self))
    }

    /// DER of a CRL that revokes these; valid from a minute before `now` for a day.
    pub fn crl(&self, number: u64, revoked: &[&Application], now: OffsetDateTime) -> Vec<u8> {
        let revoked = revoked.iter().map(|application| {
            let serial = Certificate::from_der(&application.der).unwrap().summary().serial_number;
            RevokedCertParams {
                serial_number: SerialNumber::from(hex::decode(serial).unwrap()),
                revocation_time: now,
                reason_code: None,
                invalidity_date: None,
            }
        });
        let params = CertificateRevocationListParams {
            this_update: now - Duration::minutes(1),
            next_update: now + Duration::days(1),
            crl_number: SerialNumber::from(number),
            issuing_distribution_point: None,
            revoked_certs: revoked.collect(),
            key_identifier_method: KeyIdMethod::Sha256,
        };
        params.signed_by(&self.issuer).unwrap().der().to_vec()
    }
}

/// A URI is ASCII.
fn uri(name: &str) -> String {
    let part = |c: char| match c {
        ' ' => ":".to_owned(),
        c if c.is_ascii() => c.to_string(),
        c => format!("{:x}", u32::from(c)),
    };
    format!("urn:{}", name.chars().map(part).collect::<String>())
}

fn rsa_key() -> KeyPair {
    KeyPair::generate_rsa_for(&PKCS_RSA_SHA256, RsaKeySize::_2048).unwrap()
}

fn named(name: &str) -> CertificateParams {
    let mut params = CertificateParams::default();
    params.distinguished_name.push(DnType::CommonName, name);
    params.not_before = OffsetDateTime::from_unix_timestamp(1_735_689_600).unwrap();
    params.not_after = params.not_before + Duration::days(3650);
    params
}

fn authority(name: &str) -> CertificateParams {
    let mut params = named(name);
    params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
    params.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
    params
}

/// A P7B: signed data that signs nothing and only carries certificates (RFC 2315 §9).
pub fn p7b(certificates: &[&[u8]]) -> Vec<u8> {
    const SIGNED_DATA: &[u8] = &[6, 9, 0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7, 2];
    const DATA: &[u8] = &[6, 9, 0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7, 1];
    let signed =
        tlv(0x30, &[&[2, 1, 1], &tlv(0x31, &[]), &tlv(0x30, &[DATA]), &tlv(0xa0, certificates), &tlv(0x31, &[])]);
    tlv(0x30, &[SIGNED_DATA, &tlv(0xa0, &[&signed])])
}

fn tlv(tag: u8, parts: &[&[u8]]) -> Vec<u8> {
    let content = parts.concat();
    let length = content.len().to_be_bytes();
    let length = &length[length.iter().position(|byte| *byte != 0).unwrap_or(length.len() - 1)..];
    let mut der = vec![tag];
    if content.len() >= 0x80 {
        der.push(0x80 | length.len() as u8);
    }
    der.extend(length);
    der.extend(content);
    der
}
