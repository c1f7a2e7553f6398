use std::fmt;

use chrono::{DateTime, Utc};
use rsa::pkcs8::PrivateKeyInfo;
use sha1::{Digest as _, Sha1};
use x509_parser::asn1_rs::oid;
use x509_parser::prelude::{ASN1Time, FromDer, GeneralName, X509Certificate};
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

    pub fn der(&self) -> &[u8] {
        &self.der
    }

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

    pub const fn not_before(&self) -> DateTime<Utc> {
        self.facts.not_before
    }

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
        let (key_bits, rsa_public_key) = public_key(parsed)?;
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

fn check_size(bytes: &[u8], max: usize) -> Result<(), PkiError> {
    match bytes.len() {
        0 => Err(PkiError::Empty),
        bytes if bytes > max => Err(PkiError::TooLarge { bytes, max }),
        _ => Ok(()),
    }
}

fn public_key(parsed: &X509Certificate<'_>) -> Result<(u16, Option<Vec<u8>>), PkiError> {
    let info = parsed.public_key();
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
