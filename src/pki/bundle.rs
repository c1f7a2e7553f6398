//! Files with certificates and revocation lists, however they were written.

use super::parts::{FilePart, parts};
use super::size::check_size;
use super::{Certificate, Crl, FileContent, MAX_CRL_BYTES, PkiError, Wanted, tlv};
use crate::model::Cause;

/// The largest file that is read for certificates and revocation lists: a revocation list of the largest size in PEM,
/// and its certificates.
pub const MAX_BUNDLE_BYTES: usize = MAX_CRL_BYTES / 3 * 4 + 1024 * 1024;

/// How many certificates and revocation lists one file may hold.
const MAX_ITEMS: usize = 1000;

/// What a file with public trust material holds, each in the order of the file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Bundle {
    /// The certificates.
    pub certificates: Vec<Certificate>,
    /// The revocation lists.
    pub crls: Vec<Crl>,
}

/// Reads any file with public trust material: certificates and revocation lists in DER, one behind the other as OPC UA
/// sends chains; in PEM, in any mixture; and PKCS#7 (`.p7b`, `.p7c`) in either, with the revocation lists in it.
///
/// At most [`MAX_BUNDLE_BYTES`]. A private key beside them is refused: trust material is handed around, keys are not.
/// Content that cannot be read is an error; only text between PEM blocks is passed over. The same certificate twice
/// is given once.
pub fn read_bundle(bytes: &[u8]) -> Result<Bundle, PkiError> {
    check_size(bytes, MAX_BUNDLE_BYTES)?;
    let parts = parts(bytes)?;
    if parts.iter().any(FilePart::is_private_key) {
        return Err(PkiError::PrivateKeyInside);
    }
    let mut bundle = Bundle::default();
    for part in parts {
        bundle.add(part)?;
    }
    if bundle == Bundle::default() {
        return Err(PkiError::NoCertificate);
    }
    Ok(bundle)
}

impl Bundle {
    /// What a PKCS#7 carries.
    pub(super) fn of_pkcs7(der: &[u8]) -> Result<Self, PkiError> {
        let mut bundle = Self::default();
        bundle.add_pkcs7(der)?;
        Ok(bundle)
    }

    /// Adds one public object of a file.
    pub(super) fn add(&mut self, part: FilePart) -> Result<(), PkiError> {
        match part.content {
            FileContent::Certificate => self.add_certificate(Certificate::from_der(&part.der)?),
            FileContent::Crl => self.add_crl(Crl::from_der(&part.der)?),
            FileContent::Pkcs7 => self.add_pkcs7(&part.der),
            FileContent::Unknown => Err(PkiError::NotTrustMaterial),
            found => Err(PkiError::OtherContent { found, wanted: Wanted::TrustMaterial }),
        }
    }

    /// The degenerate signed data of RFC 2315 §9 and RFC 5652 §5: nothing is signed, it only carries certificates.
    fn add_pkcs7(&mut self, der: &[u8]) -> Result<(), PkiError> {
        let damaged = || PkiError::NotPkcs7(Cause::finding("it cannot be read"));
        let whole = tlv::sole(der).ok_or_else(damaged)?;
        let parts = tlv::all(whole.content).ok_or_else(damaged)?;
        let [kind, content] = parts.as_slice() else { return Err(damaged()) };
        if kind.tag != OBJECT_IDENTIFIER || kind.content != SIGNED_DATA || content.tag != tlv::CONTEXT_0 {
            return Err(PkiError::NotPkcs7(Cause::finding("it is of another kind than signed data")));
        }
        let signed = tlv::sole(content.content).filter(|signed| signed.tag == tlv::SEQUENCE).ok_or_else(damaged)?;
        let parts = tlv::all(signed.content).ok_or_else(damaged)?;
        for part in parts.get(3..).ok_or_else(damaged)? {
            match part.tag {
                tlv::CONTEXT_0 => {
                    for der in tlv::elements(part.content).ok_or_else(damaged)? {
                        self.add_certificate(Certificate::from_der(der)?)?;
                    }
                }
                CONTEXT_1 => {
                    for der in tlv::elements(part.content).ok_or_else(damaged)? {
                        self.add_crl(Crl::from_der(der)?)?;
                    }
                }
                SET => {}
                _ => return Err(damaged()),
            }
        }
        Ok(())
    }

    fn add_certificate(&mut self, certificate: Certificate) -> Result<(), PkiError> {
        if !self.certificates.contains(&certificate) {
            self.certificates.push(certificate);
        }
        self.check_count()
    }

    fn add_crl(&mut self, crl: Crl) -> Result<(), PkiError> {
        if !self.crls.contains(&crl) {
            self.crls.push(crl);
        }
        self.check_count()
    }

    fn check_count(&self) -> Result<(), PkiError> {
        if self.certificates.len() + self.crls.len() > MAX_ITEMS { Err(PkiError::TooMany(MAX_ITEMS)) } else { Ok(()) }
    }
}

const OBJECT_IDENTIFIER: u8 = 0x06;
const SET: u8 = 0x31;
/// The implicit `[1]` around a set.
const CONTEXT_1: u8 = 0xa1;
/// 1.2.840.113549.1.7.2
const SIGNED_DATA: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7, 2];

#[cfg(test)]
mod tests;
