//! Just enough DER to see from outside what a file is.

use rsa::pkcs8::der::asn1::{AnyRef, Null};

pub(super) const SEQUENCE: u8 = 0x30;
pub(super) const OCTET_STRING: u8 = 0x04;
const BIT_STRING: u8 = 0x03;
/// The explicit `[0]`.
pub(super) const CONTEXT_0: u8 = 0xa0;

/// One element, with a short tag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Tlv<'a> {
    pub tag: u8,
    pub content: &'a [u8],
}

/// The first element, and what follows it; `None` if it is not whole or not in DER.
pub(super) fn first(bytes: &[u8]) -> Option<(Tlv<'_>, &[u8])> {
    // Longer than anything read here.
    if bytes.get(1).is_some_and(|length| *length > 0x83) { None } else { first_lax(bytes) }
}

/// As [`first`], with a length of up to four bytes that need not be the shortest form (X.690 §8.1.3.5).
pub(super) fn first_lax(bytes: &[u8]) -> Option<(Tlv<'_>, &[u8])> {
    let (&tag, rest) = bytes.split_first()?;
    let (&length, rest) = rest.split_first()?;
    let (length, rest) = match length {
        0..=0x7f => (usize::from(length), rest),
        0x81..=0x84 => {
            let (digits, rest) = rest.split_at_checked(usize::from(length & 0x7f))?;
            (digits.iter().fold(0, |number, digit| number << 8 | usize::from(*digit)), rest)
        }
        _ => return None,
    };
    let (content, rest) = rest.split_at_checked(length)?;
    Some((Tlv { tag, content }, rest))
}

/// The whole of every element, with its head, if they are whole to the last byte.
pub(super) fn elements(mut bytes: &[u8]) -> Option<Vec<&[u8]>> {
    let mut elements = Vec::new();
    while !bytes.is_empty() {
        let (_, rest) = first(bytes)?;
        elements.push(&bytes[..bytes.len() - rest.len()]);
        bytes = rest;
    }
    Some(elements)
}

/// The only element, with nothing behind it.
pub(super) fn sole(bytes: &[u8]) -> Option<Tlv<'_>> {
    first(bytes).and_then(|(element, rest)| rest.is_empty().then_some(element))
}

/// Every element, if they are whole to the last byte.
pub(super) fn all(mut bytes: &[u8]) -> Option<Vec<Tlv<'_>>> {
    let mut elements = Vec::new();
    while !bytes.is_empty() {
        let (element, rest) = first(bytes)?;
        elements.push(element);
        bytes = rest;
    }
    Some(elements)
}

/// Whether it has the outside of everything X.509 signs: what is signed, the same algorithm as inside, and a signature of
/// whole bytes. No signature covers this, and the parser is less exact here.
pub(super) fn is_signed_object(der: &[u8]) -> bool {
    let parts = match first(der) {
        Some((whole, [])) if whole.tag == SEQUENCE => all(whole.content),
        _ => None,
    };
    let Some([signed, algorithm, signature]) = parts.as_deref() else { return false };
    // Before the algorithm stand only numbers.
    let inside = all(signed.content).and_then(|parts| parts.into_iter().find(|part| part.tag == SEQUENCE));
    signed.tag == SEQUENCE
        && inside == Some(*algorithm)
        && signature.tag == BIT_STRING
        && signature.content.first() == Some(&0)
}

/// The element as DER.
pub(super) fn write(tag: u8, parts: &[&[u8]]) -> Vec<u8> {
    let mut der = Vec::new();
    write_to(&mut der, tag, &parts.concat());
    der
}

/// Appends the element as DER.
pub(super) fn write_to(der: &mut Vec<u8>, tag: u8, content: &[u8]) {
    let length = content.len().to_be_bytes();
    let digits = &length[length.iter().take_while(|digit| **digit == 0).count().min(length.len() - 1)..];
    der.push(tag);
    if content.len() >= 0x80 {
        der.push(0x80 | digits.len() as u8);
    }
    der.extend_from_slice(digits);
    der.extend_from_slice(content);
}

pub(super) fn null() -> AnyRef<'static> {
    Null.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        for length in [0, 1, 0x7f, 0x80, 0xff, 0x100, 0xffff, 0x1_0000] {
            let content = vec![7; length];
            let der = write(SEQUENCE, &[&content[..length / 2], &content[length / 2..]]);
            assert_eq!(all(&der), Some(vec![Tlv { tag: SEQUENCE, content: &content }]));
            assert_eq!(first(&[&der[..], b"rest"].concat()).unwrap().1, b"rest");
            assert_eq!(all(&der[..der.len() - 1]), None);
        }
        assert_eq!(all(&[0x30, 0x80, 0, 0]), None, "not DER");
        assert_eq!(all(&[0x30, 0x84, 0, 0, 0, 0]), None, "longer than anything read here");
    }
}
