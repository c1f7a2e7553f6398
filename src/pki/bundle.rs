//! Files with certificates and revocation lists, however they were written.

use rsa::pkcs8::PrivateKeyInfo;

use super::certificate::check_size;
use super::{Certificate, Crl, MAX_CRL_BYTES, PkiError, crl, pem, tlv};

/// The largest file that is read for certificates and revocation lists: a revocation list of the largest size in PEM,
/// and its certificates.
pub const MAX_BUNDLE_BYTES: usize = MAX_CRL_BYTES / 3 * 4 + 1024 * 1024;

/// How many certificates and revocation lists one file may hold.
const MAX_ITEMS: usize = 1000;

/// What a file with public trust material holds, each in the order of the file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Bundle {
    pub certificates: Vec<Certificate>,
    pub crls: Vec<Crl>,
}

/// Reads any file with public trust material: certificates and revocation lists in DER, one behind the other as OPC UA
/// sends chains; in PEM, in any mixture; and PKCS#7 (`.p7b`, `.p7c`) in either, with the revocation lists in it.
///
/// At most [`MAX_BUNDLE_BYTES`]. A private key beside them is refused: trust material is handed around, keys are not.
/// Whatever cannot be read is an error; nothing is passed over but text between PEM blocks. The same certificate twice
/// is given once.
pub fn read_bundle(bytes: &[u8]) -> Result<Bundle, PkiError> {
    check_size(bytes, MAX_BUNDLE_BYTES)?;
    let mut bundle = Bundle::default();
    if pem::is_pem(bytes) {
        for block in pem::all_blocks(bytes)? {
            match block.label.as_str() {
                _ if block.is_private_key() => return Err(PkiError::PrivateKeyInside),
                "CERTIFICATE" | "X509 CERTIFICATE" => bundle.add_certificate(Certificate::from_der(&block.der)?)?,
                "X509 CRL" => bundle.add_crl(Crl::from_der(&block.der)?)?,
                "PKCS7" | "PKCS #7 SIGNED DATA" | "CMS" => bundle.add_pkcs7(&block.der)?,
                other => return Err(PkiError::UnexpectedBlock(super::name::printable(other))),
            }
        }
    } else {
        let mut rest = bytes;
        while !rest.is_empty() {
            let Some((_, after)) = tlv::first(rest) else {
                if is_pkcs7(rest) {
                    return bundle.add_pkcs7(rest).map(|()| bundle);
                }
                let is_first = rest.len() == bytes.len();
                return Err(if is_first { PkiError::NotTrustMaterial } else { PkiError::TrailingBytes(rest.len()) });
            };
            bundle.add_der(&rest[..rest.len() - after.len()])?;
            rest = after;
        }
    }
    if bundle == Bundle::default() {
        return Err(PkiError::NoCertificate);
    }
    Ok(bundle)
}

impl Bundle {
    fn add_der(&mut self, der: &[u8]) -> Result<(), PkiError> {
        if is_pkcs7(der) {
            return self.add_pkcs7(der);
        }
        if PrivateKeyInfo::try_from(der).is_ok() || rsa::pkcs1::RsaPrivateKey::try_from(der).is_ok() {
            return Err(PkiError::PrivateKeyInside);
        }
        match Certificate::from_der(der) {
            Ok(certificate) => self.add_certificate(certificate),
            Err(error @ (PkiError::NotACertificate | PkiError::TooLarge { .. })) => match Crl::from_der(der) {
                Ok(crl) => self.add_crl(crl),
                Err(PkiError::NotACrl(crl::UNREADABLE)) if error == PkiError::NotACertificate => {
                    Err(PkiError::NotTrustMaterial)
                }
                Err(PkiError::NotACrl(crl::UNREADABLE)) => Err(error),
                Err(error) => Err(error),
            },
            Err(error) => Err(error),
        }
    }

    /// The degenerate signed data of RFC 2315 §9 and RFC 5652 §5: nothing is signed, it only carries certificates.
    fn add_pkcs7(&mut self, der: &[u8]) -> Result<(), PkiError> {
        if matches!(der, [tlv::SEQUENCE, 0x80, ..]) {
            return Err(PkiError::NotPkcs7("it is in BER, not in DER"));
        }
        let damaged = || PkiError::NotPkcs7("it cannot be read");
        let whole = sole(der).ok_or_else(damaged)?;
        let parts = tlv::all(whole.content).ok_or_else(damaged)?;
        let [kind, content] = parts.as_slice() else { return Err(damaged()) };
        if kind.tag != OBJECT_IDENTIFIER || kind.content != SIGNED_DATA || content.tag != tlv::CONTEXT_0 {
            return Err(PkiError::NotPkcs7("it is of another kind than signed data"));
        }
        let signed = sole(content.content).filter(|signed| signed.tag == tlv::SEQUENCE).ok_or_else(damaged)?;
        let parts = tlv::all(signed.content).ok_or_else(damaged)?;
        for part in parts.get(3..).ok_or_else(damaged)? {
            match part.tag {
                tlv::CONTEXT_0 => {
                    for der in elements(part.content).ok_or_else(damaged)? {
                        self.add_certificate(Certificate::from_der(der)?)?;
                    }
                }
                CONTEXT_1 => {
                    for der in elements(part.content).ok_or_else(damaged)? {
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

/// The only element, with nothing behind it.
fn sole(bytes: &[u8]) -> Option<tlv::Tlv<'_>> {
    tlv::first(bytes).and_then(|(element, rest)| rest.is_empty().then_some(element))
}

/// The whole of every element, with its head.
fn elements(mut bytes: &[u8]) -> Option<Vec<&[u8]>> {
    let mut elements = Vec::new();
    while !bytes.is_empty() {
        let (_, rest) = tlv::first(bytes)?;
        elements.push(&bytes[..bytes.len() - rest.len()]);
        bytes = rest;
    }
    Some(elements)
}

fn is_pkcs7(der: &[u8]) -> bool {
    let content = match der {
        [tlv::SEQUENCE, 0x80, content @ ..] => Some(content),
        _ => tlv::first(der).map(|(whole, _)| whole.content),
    };
    let kind = content.and_then(tlv::first);
    kind.is_some_and(|(kind, _)| kind.tag == OBJECT_IDENTIFIER && kind.content.starts_with(PKCS7))
}

const OBJECT_IDENTIFIER: u8 = 0x06;
const SET: u8 = 0x31;
/// The implicit `[1]` around a set.
const CONTEXT_1: u8 = 0xa1;
/// 1.2.840.113549.1.7
const PKCS7: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7];
const SIGNED_DATA: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7, 2];

#[cfg(test)]
mod tests;
