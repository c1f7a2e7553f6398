use std::fmt;
use std::net::IpAddr;
use std::sync::Arc;

use chrono::{DateTime, Utc};
use sha1::{Digest as _, Sha1};
use x509_parser::prelude::{FromDer, X509Certificate};

use super::certificate_fields::{AlternativeName, BasicConstraints, CertificateFields, ExtendedKeyUsage};
use super::key_usage::KeyUsage;
use super::pem;
use super::signature::{PublicKey, SignatureCheck};
use super::size::check_size;
use super::{PkiError, tlv};
use crate::model::{Cause, CertificateSummary, with_cause};

/// The largest certificate that is read, in bytes of DER.
pub const MAX_CERTIFICATE_BYTES: usize = 16 * 1024;

/// One X.509 certificate, found whole: nothing missing, nothing after it, not larger than [`MAX_CERTIFICATE_BYTES`],
/// no extension twice, and one signature algorithm.
///
/// Nothing is said about who signed it or whether it may be trusted; nor is it restricted to what OPC UA takes, so that
/// such a certificate can be shown before it is refused.
#[derive(Clone, PartialEq, Eq)]
pub struct Certificate {
    der: Arc<[u8]>,
    facts: Arc<CertificateFields>,
}

impl Certificate {
    /// From DER and nothing but DER.
    pub fn from_der(der: &[u8]) -> Result<Self, PkiError> {
        check_size(der, MAX_CERTIFICATE_BYTES)?;
        let (rest, parsed) = X509Certificate::from_der(der).map_err(with_cause(PkiError::NotACertificate))?;
        if !rest.is_empty() {
            return Err(PkiError::TrailingBytes(rest.len()));
        }
        let facts = Arc::new(CertificateFields::of(der, &parsed)?);
        if tlv::is_signed_object(der) {
            Ok(Self { der: der.into(), facts })
        } else {
            Err(PkiError::NotACertificate(Cause::finding("its parts are not those of a signed object")))
        }
    }

    /// The certificate itself, as it was read.
    pub fn der(&self) -> &[u8] {
        &self.der
    }

    /// As PEM, ending with a line feed.
    pub fn to_pem(&self) -> String {
        pem::certificate(&self.der)
    }

    /// SHA-1 of the DER in upper-case hexadecimal: the name OPC UA gives a certificate.
    pub fn thumbprint_sha1(&self) -> String {
        hex::encode_upper(Sha1::digest(&self.der))
    }

    /// SHA-256 of the DER.
    pub fn sha256(&self) -> [u8; 32] {
        self.facts.sha256
    }

    /// The subject's common name, without control characters.
    pub fn common_name(&self) -> Option<String> {
        self.facts.common_name.clone()
    }

    /// Valid from this second on.
    pub fn not_before(&self) -> DateTime<Utc> {
        self.facts.not_before
    }

    /// Valid up to and with this second.
    pub fn not_after(&self) -> DateTime<Utc> {
        self.facts.not_after
    }

    /// The length of the public key; 0 if its kind is not known.
    pub fn key_bits(&self) -> u16 {
        self.facts.public_key.bits()
    }

    /// The first URI of the subject alternative name, without control characters.
    pub fn application_uri(&self) -> Option<String> {
        self.facts.extensions.application_uri().map(str::to_owned)
    }

    /// Whether subject and issuer have the same name, compared as RFC 5280 §7.1 says. The signature is not verified.
    pub fn is_self_signed(&self) -> bool {
        self.facts.subject_folded == self.facts.issuer_folded
    }

    /// The subject's whole name, without control characters.
    pub fn subject(&self) -> &str {
        &self.facts.subject
    }

    /// The issuer's whole name, without control characters.
    pub fn issuer(&self) -> &str {
        &self.facts.issuer
    }

    /// 1 or 3; OPC UA wants 3.
    pub fn version(&self) -> u32 {
        self.facts.version
    }

    /// Whether it says of itself that it is the certificate of a CA, and does not say that its key signs none.
    pub fn is_ca(&self) -> bool {
        self.facts.version == 3
            && self.facts.extensions.basic_constraints.is_some_and(|constraints| constraints.ca)
            && self.facts.extensions.key_usages.as_ref().is_none_or(|usages| usages.contains(&KeyUsage::KeyCertSign))
    }

    /// What its basic constraints say, if there are any.
    pub fn basic_constraints(&self) -> Option<BasicConstraints> {
        self.facts.extensions.basic_constraints
    }

    /// What its key may be used for; `None` if it does not say.
    pub fn key_usages(&self) -> Option<&[KeyUsage]> {
        self.facts.extensions.key_usages.as_deref()
    }

    /// What the certificate is for; `None` if it does not say.
    pub fn extended_key_usages(&self) -> Option<&[ExtendedKeyUsage]> {
        self.facts.extensions.extended_key_usages.as_deref()
    }

    /// The subject alternative name, in its order.
    pub fn alternative_names(&self) -> &[AlternativeName] {
        &self.facts.extensions.alternative_names
    }

    /// Whether one of the addresses or DNS names of the subject alternative name is this one. Case, a dot at the end,
    /// and the many ways to write an IPv6 address do not matter; there are no wildcards in OPC UA. An address is named by
    /// an iPAddress only, never by a dNSName that looks like one (RFC 9525 §6.2).
    pub fn names_host(&self, host: &str) -> bool {
        let plain = host.strip_suffix('.').unwrap_or(host);
        let address = plain.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>().ok();
        self.facts.extensions.alternative_names.iter().any(|name| match name {
            AlternativeName::Ip(named) => address == Some(*named),
            AlternativeName::Dns(named) if address.is_none() => {
                named.strip_suffix('.').unwrap_or(named).eq_ignore_ascii_case(plain)
            }
            _ => false,
        })
    }

    /// The subject key identifier, if there is one.
    pub fn subject_key_id(&self) -> Option<&[u8]> {
        self.facts.extensions.subject_key_id.as_deref()
    }

    /// The key identifier of its issuer, if there is one.
    pub fn authority_key_id(&self) -> Option<&[u8]> {
        self.facts.extensions.authority_key_id.as_deref()
    }

    /// Whether its signature was made with the key of `issuer`. Names, dates and usages are not looked at.
    pub fn verify_signed_by(&self, issuer: &Self) -> bool {
        self.signature_by(issuer) == SignatureCheck::Valid
    }

    /// As [`Certificate::verify_signed_by`], and why nothing can be said about a signature.
    pub(super) fn signature_by(&self, issuer: &Self) -> SignatureCheck {
        let facts = &self.facts;
        facts.signature_algorithm.verify(&issuer.facts.public_key, &self.der[facts.signed.clone()], &facts.signature)
    }

    /// What was read from it.
    pub(super) fn facts(&self) -> &CertificateFields {
        &self.facts
    }

    /// What a list shows of it. A name is its common name, or the whole name where there is none.
    pub fn summary(&self) -> CertificateSummary {
        CertificateSummary {
            issued_to: self.facts.issued_to.clone(),
            issued_by: self.facts.issued_by.clone(),
            serial_number: self.facts.serial_number.clone(),
            not_before: self.facts.not_before,
            not_after: self.facts.not_after,
            thumbprint: self.thumbprint_sha1(),
            key_bits: self.facts.public_key.bits(),
            application_uri: self.facts.extensions.application_uri().map(str::to_owned),
        }
    }

    /// The RSA public key in PKCS#1, if it is an RSA key.
    pub(super) fn rsa_public_key(&self) -> Option<&[u8]> {
        match &self.facts.public_key {
            PublicKey::Rsa { pkcs1, .. } => Some(pkcs1),
            _ => None,
        }
    }
}

impl fmt::Debug for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Certificate({:?}, {})", self.facts.issued_to, self.thumbprint_sha1())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pki::MAX_CERTIFICATE_FILE_BYTES;
    use crate::pki::{Fingerprint, samples};

    #[test]
    fn only_a_whole_certificate_and_nothing_else_is_taken() {
        let der = samples::certificate().der();
        assert_eq!(Certificate::from_der(der).as_ref(), Ok(samples::certificate()));
        assert_eq!(Certificate::from_any(der).as_ref(), Ok(samples::certificate()));

        assert_eq!(Certificate::from_der(b""), Err(PkiError::Empty));
        assert_eq!(Certificate::from_any(b""), Err(PkiError::Empty));
        assert_eq!(Certificate::from_der(&[der, b"\0\0"].concat()), Err(PkiError::TrailingBytes(2)));
        for end in [1, 4, der.len() / 2, der.len() - 1] {
            assert_eq!(
                Certificate::from_der(&der[..end]),
                Err(PkiError::NotACertificate(Cause::any())),
                "first {end} bytes"
            );
        }
        assert_eq!(Certificate::from_any(b"hello, robot"), Err(PkiError::NotACertificate(Cause::any())));
    }

    #[test]
    fn too_large_is_refused_before_it_is_parsed() {
        let der = vec![0x30; MAX_CERTIFICATE_BYTES + 1];
        let too_large = PkiError::TooLarge { bytes: MAX_CERTIFICATE_BYTES + 1, max: MAX_CERTIFICATE_BYTES };
        assert_eq!(Certificate::from_der(&der), Err(too_large.clone()));
        assert_eq!(Certificate::from_any(&der), Err(too_large));
        let text = vec![b' '; MAX_CERTIFICATE_FILE_BYTES + 1];
        assert!(matches!(Certificate::from_any(&text), Err(PkiError::TooLarge { .. })));
    }

    /// Nothing that is read of a certificate can be changed, and nothing changed can be read, with its signature right.
    #[test]
    fn every_missing_end_and_every_damaged_byte_is_noticed() {
        let identity = crate::pki::tls_identity("robot", samples::now()).unwrap();
        let elliptic = Certificate::from_der(&identity.certificate_der).unwrap();
        for whole in [samples::certificate(), &elliptic] {
            assert!(whole.verify_signed_by(whole));
            for at in 0..whole.der().len() {
                assert!(Certificate::from_der(&whole.der()[..at]).is_err(), "first {at} bytes");
                for bit in 0..8 {
                    let mut damaged = whole.der().to_vec();
                    damaged[at] ^= 1 << bit;
                    if let Ok(read) = Certificate::from_der(&damaged) {
                        assert!(!read.verify_signed_by(whole), "byte {at} bit {bit}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_private_key_in_der_is_named_as_such() {
        let key = samples::key().to_pkcs8_der().unwrap();
        assert_eq!(Certificate::from_any(&key), Err(PkiError::PrivateKeyInside));
    }

    #[test]
    fn contradictions_are_refused() {
        // sha256WithRSAEncryption, whose second occurrence lies outside of what is signed
        let algorithm = b"\x2a\x86\x48\x86\xf7\x0d\x01\x01\x0b";
        let mut der = samples::certificate().der().to_vec();
        let last = der.windows(algorithm.len()).rposition(|window| window == algorithm).unwrap();
        der[last + algorithm.len() - 1] = 0x05;
        assert_eq!(Certificate::from_der(&der), Err(PkiError::SignatureAlgorithms));

        let mut params = rcgen::CertificateParams::default();
        let comment = rcgen::CustomExtension::from_oid_content(&[2, 16, 840, 1, 113_730, 1, 13], vec![0x0c, 0]);
        params.custom_extensions = vec![comment.clone(), comment];
        let repeated = params.self_signed(samples::key()).unwrap();
        assert_eq!(Certificate::from_der(repeated.der()), Err(PkiError::RepeatedExtension));
    }

    #[test]
    fn the_summary_says_what_the_certificate_says() {
        let certificate = samples::certificate();
        let summary = certificate.summary();
        assert_eq!(summary.issued_to, "EpsonRC.SN0000123.192.168.010.001");
        assert_eq!(summary.issued_by, summary.issued_to);
        assert_eq!(summary.serial_number.len(), 32);
        assert_eq!(summary.thumbprint, hex::encode_upper(Sha1::digest(certificate.der())));
        assert_eq!((summary.not_before, summary.not_after), (certificate.not_before(), certificate.not_after()));
        assert_eq!(summary.key_bits, 2048);
        assert_eq!(summary.application_uri.as_deref(), Some("urn:EpsonRC:SN0000123"));
        assert_eq!(certificate.sha256(), *Fingerprint::of(certificate.der()).as_bytes());
    }

    #[test]
    fn other_keys_than_rsa_can_be_shown() {
        let identity = crate::pki::tls_identity("robot", samples::now()).unwrap();
        let certificate = Certificate::from_der(&identity.certificate_der).unwrap();
        assert_eq!(certificate.key_bits(), 256);
        assert_eq!(certificate.application_uri(), None);
        assert!(!samples::key().matches(&certificate));
    }

    #[test]
    fn a_certificate_without_a_common_name_is_shown_by_its_whole_name() {
        let mut params = rcgen::CertificateParams::default();
        params.distinguished_name = rcgen::DistinguishedName::new();
        params.distinguished_name.push(rcgen::DnType::OrganizationName, "Example");
        let made = params.self_signed(samples::key()).unwrap();
        let certificate = Certificate::from_der(made.der()).unwrap();
        assert_eq!(certificate.common_name(), None);
        assert_eq!(certificate.summary().issued_to, "O=Example");
    }
}
