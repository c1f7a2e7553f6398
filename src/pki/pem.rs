//! The text armour around DER (RFC 7468, RFC 1421).
//!
//! Certificates, requests and revocation lists in the strict form of RFC 7468 are read by `rustls-pemfile`. That crate
//! is archived (RUSTSEC-2025-0134: unmaintained, no known defect); it is a thin wrapper over the maintained parser in
//! `rustls-pki-types`, and should it ever have to go, only this file changes.
//!
//! Private keys, and files from practice that are indented, wrapped otherwise or on one line, are read by hand: parsers
//! for this format do not wipe what they read, follow the strict form, or pass over what they do not know.

use base64::Engine as _;
use base64::alphabet;
use base64::engine::DecodePaddingMode;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig, STANDARD};
use rustls_pemfile::Item;
use zeroize::Zeroizing;

use super::PkiError;

/// The largest file a certificate is looked for in. A certificate's printed form may stand around its PEM.
pub const MAX_CERTIFICATE_FILE_BYTES: usize = 256 * 1024;

/// Base64 with or without its padding.
pub(super) const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// Whether these bytes are PEM text rather than DER.
pub(super) fn is_pem(bytes: &[u8]) -> bool {
    // A certificate in DER starts with a SEQUENCE of more than 127 bytes, which no text can start with.
    !matches!(bytes, [0x30, 0x80..=0x84, ..]) && position(bytes, BEGIN).is_some()
}

/// One block of a PEM text.
pub(super) struct PemBlock {
    /// What stands after `BEGIN`.
    pub label: String,
    /// In the traditional way, outside of the DER (RFC 1421 §4.6.1.1).
    pub encrypted: bool,
    pub der: Zeroizing<Vec<u8>>,
}

/// Every block of a PEM text, of any kind. Text around the blocks is passed over.
///
/// Takes lines of any length and indentation, ended by LF, CRLF or CR, and a block on one line. A block that has no
/// end, or no base64 in it, is [`PkiError::BadPem`].
pub(super) fn blocks(text: &[u8]) -> Result<Vec<PemBlock>, PkiError> {
    match strict_blocks(text) {
        Some(blocks) => Ok(blocks),
        None => lenient_blocks(text),
    }
}

/// The blocks of a text that holds nothing but certificates, requests and revocation lists, in the strict form of
/// RFC 7468. `None` for every other text.
fn strict_blocks(text: &[u8]) -> Option<Vec<PemBlock>> {
    if !labels(text).all(|label| STRICT_LABELS.contains(&label.as_str())) {
        return None;
    }
    let mut blocks = Vec::new();
    let mut rest = text;
    while let Some((item, after)) = rustls_pemfile::read_one_from_slice(rest).ok()? {
        let (label, der) = match item {
            Item::X509Certificate(der) => (STRICT_LABELS[0], der.to_vec()),
            Item::Csr(der) => (STRICT_LABELS[1], der.to_vec()),
            Item::Crl(der) => (STRICT_LABELS[2], der.to_vec()),
            _ => return None,
        };
        blocks.push(PemBlock { label: label.to_owned(), encrypted: false, der: Zeroizing::new(der) });
        rest = after;
    }
    // The strict reader passes over what it does not take for a block.
    (blocks.len() == labels(text).count()).then_some(blocks)
}

fn lenient_blocks(text: &[u8]) -> Result<Vec<PemBlock>, PkiError> {
    let mut blocks = Vec::new();
    let mut rest = text;
    while let Some((label, body)) = next_begin(rest) {
        let end = format!("-----END {label}-----");
        let length = position(body, end.as_bytes()).ok_or(PkiError::BadPem)?;
        let (body, after) = body.split_at(length);
        if position(body, BEGIN).is_some() {
            return Err(PkiError::BadPem);
        }
        blocks.push(block(label, body)?);
        rest = &after[end.len()..];
    }
    Ok(blocks)
}

/// The label of the next `BEGIN` at the start of a line, and what follows it.
fn next_begin(mut text: &[u8]) -> Option<(String, &[u8])> {
    loop {
        let at = position(text, BEGIN)?;
        let (before, after) = (&text[..at], &text[at + BEGIN.len()..]);
        let starts_line = before.iter().rev().find(|byte| !matches!(byte, b' ' | b'\t'));
        let is_start = matches!(starts_line, None | Some(b'\n' | b'\r' | b'-' | 0xbf));
        let label_end = position(&after[..after.len().min(MAX_LABEL + DASHES.len())], DASHES);
        if let Some(label) = label_end.map(|end| &after[..end])
            && is_start
            && !label.iter().any(|byte| matches!(byte, b'\n' | b'\r'))
        {
            let label_text = String::from_utf8_lossy(label).into_owned();
            return Some((label_text, &after[label.len() + DASHES.len()..]));
        }
        text = after;
    }
}

fn block(label: String, body: &[u8]) -> Result<PemBlock, PkiError> {
    let mut encrypted = false;
    let mut digits = Zeroizing::new(Vec::with_capacity(body.len()));
    for line in body.split(|byte| matches!(byte, b'\n' | b'\r')) {
        if line.contains(&b':') {
            let line = line.trim_ascii();
            encrypted |= line.starts_with(b"Proc-Type:") && line.ends_with(b"ENCRYPTED");
        } else {
            digits.extend(line.iter().filter(|byte| !byte.is_ascii_whitespace()));
        }
    }
    // The error of the decoder quotes the text, which may be a key.
    let der = Zeroizing::new(BASE64.decode(&*digits).map_err(|_| PkiError::BadPem)?);
    Ok(PemBlock { label, encrypted, der })
}

/// What stands after each `BEGIN`, in order, whether the blocks are whole or not.
pub(super) fn labels(mut text: &[u8]) -> impl Iterator<Item = String> {
    std::iter::from_fn(move || {
        let (label, rest) = next_begin(text)?;
        text = rest;
        Some(label)
    })
}

fn position(bytes: &[u8], word: &[u8]) -> Option<usize> {
    // The first byte is found fast, which matters for large revocation lists.
    let mut from = 0;
    while let Some(at) = bytes[from..].iter().position(|byte| *byte == word[0]) {
        if bytes[from + at..].starts_with(word) {
            return Some(from + at);
        }
        from += at + 1;
    }
    None
}

/// The PEM form of a certificate.
pub(super) fn certificate(der: &[u8]) -> String {
    armour("CERTIFICATE", der)
}

/// The PEM form of a certificate signing request.
pub(super) fn csr(der: &[u8]) -> String {
    armour("CERTIFICATE REQUEST", der)
}

/// The PEM form of a CRL.
pub(super) fn crl(der: &[u8]) -> String {
    armour("X509 CRL", der)
}

/// The PEM form of an encrypted private key.
pub(super) fn encrypted_key(der: &[u8]) -> String {
    armour("ENCRYPTED PRIVATE KEY", der)
}

/// The PEM form of an unencrypted PKCS#8. A secret: the caller wipes it.
pub(super) fn private_key(der: &[u8]) -> String {
    armour("PRIVATE KEY", der)
}

/// DER under that label.
pub(super) fn armour(label: &str, der: &[u8]) -> String {
    // It may be a key.
    let body = Zeroizing::new(STANDARD.encode(der));
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

/// What `rustls-pemfile` knows and holds no secret.
const STRICT_LABELS: [&str; 3] = ["CERTIFICATE", "CERTIFICATE REQUEST", "X509 CRL"];

const BEGIN: &[u8] = b"-----BEGIN ";
const DASHES: &[u8] = b"-----";
/// No label in use is longer.
const MAX_LABEL: usize = 64;

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
            pem.replace('\n', "\r"),
            pem.replace('\n', "\n\n"),
            pem.lines().map(|line| format!("\t  {line}  \n")).collect(),
            pem.replace('\n', " "),
            pem.replace("=\n-", "\n-"),
            format!("Bag Attributes\n    friendlyName: Gr\u{f6}\u{df}e\nsubject=CN = robot\n{pem}"),
            format!("paste it from -----BEGIN to -----END\n{pem}"),
        ] {
            assert_eq!(Certificate::from_any(text.as_bytes()).as_ref(), Ok(samples::certificate()));
        }
    }

    #[test]
    fn exactly_one_certificate_is_taken() {
        let two = pem() + &pem();
        assert_eq!(Certificate::from_any(two.as_bytes()), Err(PkiError::SeveralCertificates(2)));
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
        let nested = pem.replacen("\nMII", &format!("\n{pem}MII"), 1);
        assert_eq!(Certificate::from_any(nested.as_bytes()), Err(PkiError::BadPem));
        let without_end = pem.split("-----END").next().unwrap();
        assert_eq!(Certificate::from_any(without_end.as_bytes()), Err(PkiError::BadPem));
        let not_base64 = pem.replacen("MII", "M*I", 1);
        assert_eq!(Certificate::from_any(not_base64.as_bytes()), Err(PkiError::BadPem));
    }
}
