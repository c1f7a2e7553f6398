//! The text armour around DER.
//!
//! The only place that reads PEM: certificates and requests with `rustls-pemfile`, private keys by hand. That crate is
//! archived (RUSTSEC-2025-0134: unmaintained, no known defect); it is a thin wrapper over the maintained parser in
//! `rustls-pki-types`, and should it ever have to go, only this file changes.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use rustls_pemfile::Item;
use zeroize::Zeroizing;

use super::PkiError;

/// The largest file a certificate is looked for in. A certificate's printed form may stand around its PEM.
pub const MAX_CERTIFICATE_FILE_BYTES: usize = 256 * 1024;

/// Whether these bytes are PEM text rather than DER.
pub(super) fn is_pem(bytes: &[u8]) -> bool {
    // A certificate in DER starts with a SEQUENCE of more than 127 bytes, which no text can start with.
    !matches!(bytes, [0x30, 0x80..=0x84, ..]) && bytes.windows(BEGIN.len()).any(|window| window == BEGIN)
}

/// The DER of the only certificate in a PEM text. Other text around it is passed over, a private key is not.
pub(super) fn single_certificate(text: &[u8]) -> Result<Vec<u8>, PkiError> {
    match certificates(text)?.as_slice() {
        [] => Err(PkiError::NoCertificate),
        [der] => Ok(der.to_vec()),
        several => Err(PkiError::SeveralCertificates(several.len())),
    }
}

/// The DER of every certificate in a PEM text, in order; otherwise as [`single_certificate`].
pub(super) fn certificates(text: &[u8]) -> Result<Vec<Vec<u8>>, PkiError> {
    let text = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text);
    if has_private_key(text) {
        return Err(PkiError::PrivateKeyInside);
    }
    let mut certificates = Vec::new();
    let mut rest = text;
    while let Some((item, after)) = rustls_pemfile::read_one_from_slice(rest).map_err(|_| PkiError::BadPem)? {
        if let Item::X509Certificate(der) = item {
            certificates.push(der.to_vec());
        }
        rest = after;
    }
    Ok(certificates)
}

/// The DER of the only certificate signing request in a PEM text.
pub(super) fn single_csr(text: &[u8]) -> Result<Vec<u8>, PkiError> {
    let mut requests = Vec::new();
    let mut rest = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text);
    while let Some((item, after)) = rustls_pemfile::read_one_from_slice(rest).map_err(|_| PkiError::BadPem)? {
        if let Item::Csr(der) = item {
            requests.push(der);
        }
        rest = after;
    }
    match requests.as_slice() {
        [] => Err(PkiError::NotACsr),
        [der] => Ok(der.to_vec()),
        several => Err(PkiError::SeveralCsrs(several.len())),
    }
}

/// One block of a PEM text.
pub(super) struct Block {
    /// What stands after `BEGIN`.
    pub label: String,
    /// In the traditional way, outside of the DER.
    pub encrypted: bool,
    pub der: Zeroizing<Vec<u8>>,
}

impl Block {
    pub fn is_private_key(&self) -> bool {
        self.label.ends_with("PRIVATE KEY")
    }
}

/// Every private key in a PEM text, of whatever kind. Other text and other blocks are passed over.
pub(super) fn private_keys(text: &[u8]) -> Result<Vec<Block>, PkiError> {
    blocks(text, |label| label.ends_with(PRIVATE_KEY))
}

/// Every block of a PEM text, of whatever kind. Only text between the blocks is passed over.
pub(super) fn all_blocks(text: &[u8]) -> Result<Vec<Block>, PkiError> {
    blocks(text, |_| true)
}

/// Written by hand, because the parser does not know encrypted keys, and passes over what it does not know.
fn blocks(text: &[u8], is_wanted: impl Fn(&[u8]) -> bool) -> Result<Vec<Block>, PkiError> {
    let mut blocks = Vec::new();
    let mut lines = text.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    while let Some(line) = lines.next() {
        let line = line.strip_prefix(BYTE_ORDER_MARK).unwrap_or(line);
        let Some(label) = line.strip_prefix(BEGIN).and_then(|rest| rest.strip_suffix(b"-----")) else { continue };
        if !is_wanted(label) {
            continue;
        }
        let label = String::from_utf8_lossy(label).into_owned();
        let end = format!("-----END {label}-----");
        let (mut encrypted, mut body) = (false, Zeroizing::new(Vec::new()));
        loop {
            let line = lines.next().ok_or(PkiError::BadPem)?;
            if line == end.as_bytes() {
                break;
            } else if line.contains(&b':') {
                encrypted |= line.starts_with(b"Proc-Type:") && line.ends_with(b"ENCRYPTED");
            } else {
                body.extend_from_slice(line);
            }
        }
        let der = Zeroizing::new(STANDARD.decode(&*body).map_err(|_| PkiError::BadPem)?);
        blocks.push(Block { label, encrypted, der });
    }
    Ok(blocks)
}

/// The PEM form of a certificate.
pub(super) fn certificate(der: &[u8]) -> String {
    armour("CERTIFICATE", der)
}

/// The PEM form of a certificate signing request.
pub(super) fn csr(der: &[u8]) -> String {
    armour("CERTIFICATE REQUEST", der)
}

/// DER under that label.
pub(super) fn armour(label: &str, der: &[u8]) -> String {
    let body = STANDARD.encode(der);
    let mut text = format!("-----BEGIN {label}-----\n");
    text.reserve(body.len() + body.len() / 64 + 64);
    let mut rest = body.as_str();
    while !rest.is_empty() {
        let (line, after) = rest.split_at(rest.len().min(64));
        text.push_str(line);
        text.push('\n');
        rest = after;
    }
    text.push_str(&format!("-----END {label}-----\n"));
    text
}

/// What stands after each `BEGIN`, in order.
pub(super) fn labels(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let text = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text);
    text.split(|byte| matches!(byte, b'\n' | b'\r'))
        .filter_map(|line| line.trim_ascii().strip_prefix(BEGIN)?.strip_suffix(b"-----"))
}

/// Of any kind, also those the parser does not know, such as encrypted ones.
fn has_private_key(text: &[u8]) -> bool {
    text.split(|byte| matches!(byte, b'\n' | b'\r'))
        .filter(|line| line.starts_with(BEGIN))
        .any(|line| line.windows(PRIVATE_KEY.len()).any(|window| window == PRIVATE_KEY))
}

const BEGIN: &[u8] = b"-----BEGIN ";
pub(super) const PRIVATE_KEY: &[u8] = b"PRIVATE KEY";
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pki::Certificate;
    use crate::pki::samples;

    fn pem() -> String {
        samples::certificate().to_pem()
    }

    #[test]
    fn what_is_written_is_read_back() {
        let text = pem();
        assert!(text.lines().all(|line| line.len() <= 64));
        assert_eq!(Certificate::from_any(text.as_bytes()).as_ref(), Ok(samples::certificate()));
    }

    #[test]
    fn text_around_the_certificate_does_not_matter() {
        let pem = pem();
        for text in [
            format!("Certificate:\n    Data:\n        Version: 3 (0x2)\n{pem}\nthe end"),
            format!("0 s:CN=robot\n{pem}"),
            format!("\u{feff}{pem}"),
            pem.replace('\n', "\r\n"),
        ] {
            assert_eq!(Certificate::from_any(text.as_bytes()).as_ref(), Ok(samples::certificate()));
        }
    }

    #[test]
    fn exactly_one_certificate_is_taken() {
        let two = pem() + &pem();
        assert_eq!(Certificate::from_any(two.as_bytes()), Err(PkiError::SeveralCertificates(2)));
        let request = pem().replace("CERTIFICATE", "CERTIFICATE REQUEST");
        assert_eq!(Certificate::from_any(request.as_bytes()), Err(PkiError::NoCertificate));
    }

    #[test]
    fn a_private_key_beside_the_certificate_is_refused() {
        for kind in ["PRIVATE KEY", "RSA PRIVATE KEY", "ENCRYPTED PRIVATE KEY", "OPENSSH PRIVATE KEY"] {
            let text = format!("{}-----BEGIN {kind}-----\nAAAA\n-----END {kind}-----\n", pem());
            assert_eq!(Certificate::from_any(text.as_bytes()), Err(PkiError::PrivateKeyInside), "{kind}");
        }
    }

    #[test]
    fn damaged_text_is_said_to_be_damaged() {
        let pem = pem();
        let without_end = pem.split("-----END").next().unwrap();
        assert_eq!(Certificate::from_any(without_end.as_bytes()), Err(PkiError::BadPem));
        let not_base64 = pem.replacen("MII", "M*I", 1);
        assert_eq!(Certificate::from_any(not_base64.as_bytes()), Err(PkiError::BadPem));
    }
}
