use std::fmt;

use chrono::{DateTime, Utc};
use rsa::pkcs8::PrivateKeyInfo;
use sha1::{Digest as _, Sha1};
use x509_parser::asn1_rs::oid;
use x509_parser::prelude::{ASN1Time, FromDer, GeneralName, SubjectPublicKeyInfo, X509Certificate};
use x509_parser::public_key::PublicKey;

use super::pem::{self, MAX_CERTIFICATE_FILE_BYTES};
use super::{Fingerprint, PkiError, name};
use crate::model::CertificateSummary;

/// The largest certificate that is read, in bytes of DER.
pub const MAX_CERTIFICATE_BYTES: usize = 16 * 1024;

/// One X.509 certificate, found whole: nothing missing, nothing after it, not larger than [`MAX_CERTIFICATE_BYTES`],
/// no extension twice, and one signature algorithm.
///
/// Nothing is said about who signed it or whether it may be trusted; nor is it restricted to what OPC UA takes, so that
/// such a certificate can be shown before it is refused.
#[derive(Clone, PartialEq, Eq)]
pub struct Certificate {
    der: Vec<u8>,
    facts: Facts,
}

/// What was read from the DER.
#[derive(Clone, PartialEq, Eq)]
struct Facts {
    common_name: Option<String>,
    issued_to: String,
    issued_by: String,
    names_equal: bool,
    serial_number: String,
    not_before: DateTime<Utc>,
    not_after: DateTime<Utc>,
    key_bits: u16,
    rsa_public_key: Option<Vec<u8>>,
    application_uri: Option<String>,
}

impl Certificate {
    /// From DER and nothing but DER.
    pub fn from_der(der: &[u8]) -> Result<Self, PkiError> {
        check_size(der, MAX_CERTIFICATE_BYTES)?;
        let (rest, parsed) = X509Certificate::from_der(der).map_err(|_| PkiError::NotACertificate)?;
        if !rest.is_empty() {
            return Err(PkiError::TrailingBytes(rest.len()));
        }
        Ok(Self { der: der.to_vec(), facts: Facts::of(&parsed)? })
    }

    /// From a file of at most [`MAX_CERTIFICATE_FILE_BYTES`] that holds exactly one certificate, in DER or PEM.
    ///
    /// In PEM, other text may stand around it. A file that also holds a private key is refused: certificates are handed
    /// around, keys are not.
    pub fn from_any(bytes: &[u8]) -> Result<Self, PkiError> {
        check_size(bytes, MAX_CERTIFICATE_FILE_BYTES)?;
        if pem::is_pem(bytes) {
            return Self::from_der(&pem::single_certificate(bytes)?);
        }
        if PrivateKeyInfo::try_from(bytes).is_ok() {
            return Err(PkiError::PrivateKeyInside);
        }
        Self::from_der(bytes)
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
        *Fingerprint::of(&self.der).as_bytes()
    }

    /// The subject's common name, without control characters.
    pub fn common_name(&self) -> Option<String> {
        self.facts.common_name.clone()
    }

    /// Valid from this second on.
    pub const fn not_before(&self) -> DateTime<Utc> {
        self.facts.not_before
    }

    /// Valid up to and with this second.
    pub const fn not_after(&self) -> DateTime<Utc> {
        self.facts.not_after
    }

    /// The length of the public key; 0 if its kind is not known.
    pub const fn key_bits(&self) -> u16 {
        self.facts.key_bits
    }

    /// The first URI of the subject alternative name, without control characters.
    pub fn application_uri(&self) -> Option<String> {
        self.facts.application_uri.clone()
    }

    /// Whether subject and issuer have the same name. The signature is not looked at.
    pub const fn is_self_signed(&self) -> bool {
        self.facts.names_equal
    }

    /// Whether the basic constraints say that it may sign other certificates.
    pub fn is_ca(&self) -> bool {
        X509Certificate::from_der(&self.der).is_ok_and(|(_, parsed)| parsed.is_ca())
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
            key_bits: self.facts.key_bits,
            application_uri: self.facts.application_uri.clone(),
        }
    }

    /// The RSA public key in PKCS#1, if it is an RSA key.
    pub(super) fn rsa_public_key(&self) -> Option<&[u8]> {
        self.facts.rsa_public_key.as_deref()
    }
}

impl fmt::Debug for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Certificate({:?}, {})", self.facts.issued_to, self.thumbprint_sha1())
    }
}

impl Facts {
    fn of(parsed: &X509Certificate<'_>) -> Result<Self, PkiError> {
        if parsed.signature_algorithm != parsed.tbs_certificate.signature {
            return Err(PkiError::SignatureAlgorithms);
        }
        parsed.extensions_map().map_err(|_| PkiError::RepeatedExtension)?;
        let (key_bits, rsa_public_key) = public_key(parsed.public_key())?;
        Ok(Self {
            common_name: name::common_name(parsed.subject()),
            issued_to: name::title(parsed.subject()),
            issued_by: name::title(parsed.issuer()),
            names_equal: parsed.subject().as_raw() == parsed.issuer().as_raw(),
            serial_number: serial_number(parsed.raw_serial()),
            not_before: date(parsed.validity().not_before)?,
            not_after: date(parsed.validity().not_after)?,
            key_bits,
            rsa_public_key,
            application_uri: application_uri(parsed),
        })
    }
}

pub(super) fn check_size(bytes: &[u8], max: usize) -> Result<(), PkiError> {
    match bytes.len() {
        0 => Err(PkiError::Empty),
        bytes if bytes > max => Err(PkiError::TooLarge { bytes, max }),
        _ => Ok(()),
    }
}

/// The length of a public key, 0 if its kind is not known; and in PKCS#1, if it is an RSA key.
pub(super) fn public_key(info: &SubjectPublicKeyInfo<'_>) -> Result<(u16, Option<Vec<u8>>), PkiError> {
    let key = info.parsed().map_err(|_| PkiError::NotACertificate)?;
    let bits = match &key {
        PublicKey::RSA(rsa) => bit_length(rsa.modulus),
        PublicKey::EC(point) => point.key_size(),
        _ => 0,
    };
    let is_rsa = info.algorithm.algorithm == oid!(1.2.840.113549.1.1.1);
    let rsa_public_key = is_rsa.then(|| info.subject_public_key.data.to_vec());
    Ok((u16::try_from(bits).unwrap_or(u16::MAX), rsa_public_key))
}

/// The bits of a big-endian number, however many zeros stand before it.
fn bit_length(number: &[u8]) -> usize {
    match number.iter().position(|byte| *byte != 0) {
        Some(first) => (number.len() - first) * 8 - number[first].leading_zeros() as usize,
        None => 0,
    }
}

fn serial_number(raw: &[u8]) -> String {
    match raw {
        // The zero that keeps a DER integer positive is not part of the number.
        [0, number @ ..] if !number.is_empty() => hex::encode_upper(number),
        number => hex::encode_upper(number),
    }
}

fn date(time: ASN1Time) -> Result<DateTime<Utc>, PkiError> {
    DateTime::from_timestamp(time.timestamp(), 0).ok_or(PkiError::NotACertificate)
}

fn application_uri(parsed: &X509Certificate<'_>) -> Option<String> {
    let names = parsed.subject_alternative_name().ok().flatten()?;
    names.value.general_names.iter().find_map(|general_name| match general_name {
        GeneralName::URI(uri) => Some(name::printable(uri)),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pki::samples;

    #[test]
    fn only_a_whole_certificate_and_nothing_else_is_taken() {
        let der = samples::certificate().der();
        assert_eq!(Certificate::from_der(der).as_ref(), Ok(samples::certificate()));
        assert_eq!(Certificate::from_any(der).as_ref(), Ok(samples::certificate()));

        assert_eq!(Certificate::from_der(b""), Err(PkiError::Empty));
        assert_eq!(Certificate::from_any(b""), Err(PkiError::Empty));
        assert_eq!(Certificate::from_der(&[der, b"\0\0"].concat()), Err(PkiError::TrailingBytes(2)));
        for end in [1, 4, der.len() / 2, der.len() - 1] {
            assert_eq!(Certificate::from_der(&der[..end]), Err(PkiError::NotACertificate), "first {end} bytes");
        }
        assert_eq!(Certificate::from_any(b"hello, robot"), Err(PkiError::NotACertificate));
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

    #[test]
    fn numbers_lose_the_zeros_before_them() {
        assert_eq!(bit_length(&[0, 0x80, 0]), 16);
        assert_eq!(bit_length(&[0x7f, 0xff]), 15);
        assert_eq!(bit_length(&[0, 0]), 0);
        assert_eq!(serial_number(&[0, 0x9a, 1]), "9A01");
        assert_eq!(serial_number(&[0]), "00");
    }
}
