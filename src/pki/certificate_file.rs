//! One certificate from a file in any encoding.

use super::parts::{FilePart, parts};
use super::pem::MAX_CERTIFICATE_FILE_BYTES;
use super::size::check_size;
use super::{Bundle, Certificate, FileContent, PkiError, Wanted};

impl Certificate {
    /// From a file of at most [`MAX_CERTIFICATE_FILE_BYTES`] that holds exactly one certificate: in DER, PEM, base64, or
    /// a PKCS#7.
    ///
    /// In PEM, other text may stand around it. A file that also holds a private key is refused: certificates are handed
    /// around, keys are not.
    pub fn from_any(bytes: &[u8]) -> Result<Self, PkiError> {
        check_size(bytes, MAX_CERTIFICATE_FILE_BYTES)?;
        let mut certificates = certificates_in(parts(bytes)?)?;
        match certificates.len() {
            1 => Ok(certificates.remove(0)),
            0 => Err(PkiError::NoCertificate),
            several => Err(PkiError::SeveralCertificates(several)),
        }
    }
}

/// Every certificate; other public things are passed over, unless there is nothing else.
fn certificates_in(parts: Vec<FilePart>) -> Result<Vec<Certificate>, PkiError> {
    let mut certificates = Vec::new();
    let mut other = None;
    for part in parts {
        match part.content {
            content if content.is_private_key() => return Err(PkiError::PrivateKeyInside),
            FileContent::Certificate => certificates.push(Certificate::from_der(&part.der)?),
            FileContent::Pkcs7 => certificates.extend(Bundle::of_pkcs7(&part.der)?.certificates),
            FileContent::Unknown => return Certificate::from_der(&part.der).map(|certificate| vec![certificate]),
            found => other = other.or(Some(found)),
        }
    }
    match other {
        Some(found) if certificates.is_empty() => Err(PkiError::OtherContent { found, wanted: Wanted::Certificate }),
        _ => Ok(certificates),
    }
}
