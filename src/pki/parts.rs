//! The objects in a file with keys or certificates, recognised by content; labels and encoding do not matter.
//!
//! Every reader of this module's parent starts here, so that a file which one of them understands is understood by all.

use std::borrow::Cow;

use base64::Engine as _;
use zeroize::Zeroizing;

use super::tlv::{self, CONTEXT_0, OCTET_STRING, SEQUENCE, Tlv};
use super::{FileContent, PkiError, ber, pem};
use crate::model::text;

/// One object of a file.
pub(super) struct FilePart {
    pub content: FileContent,
    /// In DER, as far as it is ASN.1. May be a key, and is wiped.
    pub der: Zeroizing<Vec<u8>>,
}

impl FilePart {
    pub fn is_private_key(&self) -> bool {
        self.content.is_private_key()
    }
}

/// The objects of a file, in their order. Never empty: what is not understood is one part, [`FileContent::Unknown`].
///
/// Takes DER, one object behind the other as OPC UA sends chains; BER; PEM with any text around it; base64 without
/// `BEGIN` and `END`; text in UTF-16. Line ends and zero bytes after the end of DER are padding and carry nothing.
/// Whether the objects are whole is for their readers to say.
pub(super) fn parts(bytes: &[u8]) -> Result<Vec<FilePart>, PkiError> {
    if bytes.is_empty() {
        return Err(PkiError::Empty);
    }
    let text = match text::to_utf8(bytes)? {
        Cow::Borrowed(text) => return in_bytes(text),
        // It may hold a key.
        Cow::Owned(text) => Zeroizing::new(text),
    };
    in_bytes(&text)
}

fn in_bytes(bytes: &[u8]) -> Result<Vec<FilePart>, PkiError> {
    if pem::is_pem(bytes) {
        return in_pem(bytes);
    }
    if let Some(parts) = in_der(bytes) {
        return parts;
    }
    if let Some(decoded) = bare_base64(bytes) {
        if pem::is_pem(&decoded) {
            return in_pem(&decoded);
        }
        if let Some(parts) = in_der(&decoded) {
            return parts;
        }
    }
    let content = FileContent::foreign(bytes).unwrap_or(FileContent::Unknown);
    Ok(vec![FilePart { content, der: Zeroizing::new(bytes.to_vec()) }])
}

fn in_pem(text: &[u8]) -> Result<Vec<FilePart>, PkiError> {
    let mut parts = Vec::new();
    for block in pem::blocks(text)? {
        // OpenSSL writes the parameters of a key before it.
        if block.label.ends_with(" PARAMETERS") {
            continue;
        }
        if block.encrypted {
            parts.push(FilePart { content: FileContent::TraditionalKey, der: block.der });
            continue;
        }
        // OpenSSL's trusted certificates have their settings behind them.
        match in_der(&block.der) {
            Some(Ok(of_block)) if of_block.iter().all(|part| part.content != FileContent::Unknown) => {
                parts.extend(of_block)
            }
            Some(Ok(of_block)) if block.label == "TRUSTED CERTIFICATE" => parts.extend(of_block.into_iter().take(1)),
            _ => parts.push(FilePart { content: FileContent::labelled(&block.label), der: block.der }),
        }
    }
    if parts.is_empty() {
        parts.push(FilePart { content: FileContent::Unknown, der: Zeroizing::new(text.to_vec()) });
    }
    Ok(parts)
}

/// `None` if the bytes do not begin with something in DER or BER that is known.
fn in_der(bytes: &[u8]) -> Option<Result<Vec<FilePart>, PkiError>> {
    let mut parts = Vec::new();
    let mut rest = bytes;
    while !is_padding(rest) {
        let Some((part, after)) = first(rest) else {
            return if parts.is_empty() { None } else { Some(Err(PkiError::TrailingBytes(rest.len()))) };
        };
        let is_known = part.content != FileContent::Unknown;
        if parts.is_empty() && !is_known {
            return None;
        }
        parts.push(part);
        if !is_known {
            break;
        }
        rest = after;
    }
    // Padding and nothing else is not an object.
    (!parts.is_empty()).then_some(Ok(parts))
}

/// The first object, which is a SEQUENCE.
fn first(bytes: &[u8]) -> Option<(FilePart, &[u8])> {
    if bytes.first() != Some(&SEQUENCE) {
        return None;
    }
    let as_it_stands = tlv::first(bytes).map(|(whole, rest)| (whole.content, &bytes[..bytes.len() - rest.len()], rest));
    let content = as_it_stands.and_then(|(content, ..)| of_der(content));
    if let (Some(content), Some((_, der, rest))) = (&content, as_it_stands)
        && !(content.may_be_ber() && ber::is_needed(der))
    {
        return Some((FilePart { content: content.clone(), der: Zeroizing::new(der.to_vec()) }, rest));
    }
    if let Some((der, rest)) = ber::first_as_der(bytes)
        && let Some(content) = tlv::sole(&der).and_then(|whole| of_der(whole.content))
    {
        return Some((FilePart { content, der }, rest));
    }
    let (_, der, rest) = as_it_stands?;
    Some((FilePart { content: content.unwrap_or(FileContent::Unknown), der: Zeroizing::new(der.to_vec()) }, rest))
}

/// Base64 without `BEGIN` and `END`, as mail programs and Windows leave it.
fn bare_base64(text: &[u8]) -> Option<Zeroizing<Vec<u8>>> {
    let mut digits = Zeroizing::new(Vec::with_capacity(text.len()));
    digits.extend(text.iter().filter(|byte| !byte.is_ascii_whitespace()));
    if digits.len() < MIN_BASE64 {
        return None;
    }
    pem::BASE64.decode(&*digits).ok().map(Zeroizing::new)
}

/// What was signed, or the outside of a key: told by the tags of the parts (RFC 5280 §4.1, §5.1; RFC 2986 §4.2; RFC
/// 5652 §3; RFC 7292 §4; RFC 5958 §2, §3; RFC 8017 A.1.2; RFC 5915 §3).
fn of_der(content: &[u8]) -> Option<FileContent> {
    let parts = tlv::all(content)?;
    let tags: Vec<u8> = parts.iter().map(|part| part.tag).collect();
    match tags[..] {
        [INTEGER, SEQUENCE, ..] if content.starts_with(VERSION_3) && is_content_info(&parts[1]) => {
            Some(FileContent::Pkcs12)
        }
        [OBJECT_IDENTIFIER, CONTEXT_0] if parts[0].content.starts_with(PKCS7) => Some(FileContent::Pkcs7),
        [SEQUENCE, SEQUENCE, BIT_STRING] => signed(&tlv::all(parts[0].content)?),
        [INTEGER, SEQUENCE, OCTET_STRING, ..] | [INTEGER, OCTET_STRING, ..] => Some(FileContent::PrivateKey),
        [INTEGER, INTEGER, ..] if tags.len() >= 9 => Some(FileContent::PrivateKey),
        [SEQUENCE, OCTET_STRING] => Some(FileContent::EncryptedKey),
        [SEQUENCE, BIT_STRING] => Some(FileContent::PublicKey),
        _ => None,
    }
}

fn is_content_info(part: &Tlv<'_>) -> bool {
    tlv::first_lax(part.content)
        .is_some_and(|(kind, _)| kind.tag == OBJECT_IDENTIFIER && kind.content.starts_with(PKCS7))
}

fn signed(parts: &[Tlv<'_>]) -> Option<FileContent> {
    let tags: Vec<u8> = parts.iter().map(|part| part.tag).collect();
    match tags[..] {
        [CONTEXT_0, INTEGER, SEQUENCE, SEQUENCE, SEQUENCE, SEQUENCE, SEQUENCE, ..]
        | [INTEGER, SEQUENCE, SEQUENCE, SEQUENCE, SEQUENCE, SEQUENCE, ..] => Some(FileContent::Certificate),
        [INTEGER, SEQUENCE, SEQUENCE, UTC_TIME | GENERALIZED_TIME, ..]
        | [SEQUENCE, SEQUENCE, UTC_TIME | GENERALIZED_TIME, ..] => Some(FileContent::Crl),
        [INTEGER, SEQUENCE, SEQUENCE, CONTEXT_0] | [INTEGER, SEQUENCE, SEQUENCE] => Some(FileContent::Csr),
        _ => None,
    }
}

fn is_padding(rest: &[u8]) -> bool {
    rest.iter().all(|byte| matches!(byte, 0 | b'\r' | b'\n'))
}

const INTEGER: u8 = 0x02;
const BIT_STRING: u8 = 0x03;
const OBJECT_IDENTIFIER: u8 = 0x06;
const UTC_TIME: u8 = 0x17;
const GENERALIZED_TIME: u8 = 0x18;
/// A PKCS#12 starts with its version (RFC 7292 §4).
const VERSION_3: &[u8] = &[INTEGER, 1, 3];
/// 1.2.840.113549.1.7
const PKCS7: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7];
/// Nothing that is read here is shorter in base64.
const MIN_BASE64: usize = 64;

#[cfg(test)]
mod tests;
