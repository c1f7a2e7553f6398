//! BER, the looser encoding of ASN.1 (X.690 §8), made into DER (§10).
//!
//! PKCS#7 and PKCS#12 may be written in it (RFC 2315 §6, RFC 7292 §3), and Windows, Java and OpenSSL's `-stream` do: lengths
//! that are left open, and texts in several pieces. The order of sets and the values of booleans stay as they are.

use zeroize::Zeroizing;

use super::tlv;

/// The first element as DER, and what follows it. `None` if it is not whole, nested deeper than [`MAX_DEPTH`], or has a
/// tag number above 30, which no format read here has.
///
/// Each level copies what is in it, so the work is at most [`MAX_DEPTH`] times the length. The copy may hold a key and
/// is wiped.
pub(super) fn first_as_der(bytes: &[u8]) -> Option<(Zeroizing<Vec<u8>>, &[u8])> {
    let mut der = Zeroizing::new(Vec::with_capacity(bytes.len()));
    let rest = element(bytes, MAX_DEPTH, &mut der)?;
    Some((der, rest))
}

/// Whether an open length, a text in several pieces, or something that is not whole is in these elements. Signed objects
/// in DER are left exactly as they are.
pub(super) fn is_needed(elements: &[u8]) -> bool {
    fn is_der(elements: &[u8], depth: usize) -> bool {
        let is_der_inside = |element: &tlv::Tlv<'_>| {
            element.tag & CONSTRUCTED == 0
                || (!IN_PIECES.contains(&(element.tag & !CONSTRUCTED))
                    && depth > 0
                    && is_der(element.content, depth - 1))
        };
        tlv::all(elements).is_some_and(|elements| elements.iter().all(is_der_inside))
    }
    !is_der(elements, MAX_DEPTH)
}

/// Writes the first element to `der` and gives what follows it.
fn element<'a>(bytes: &'a [u8], depth: usize, der: &mut Vec<u8>) -> Option<&'a [u8]> {
    let depth = depth.checked_sub(1)?;
    let (&tag, rest) = bytes.split_first()?;
    if tag & NUMBER == NUMBER {
        return None;
    }
    if tag & CONSTRUCTED == 0 {
        let (element, rest) = tlv::first_lax(bytes)?;
        append(der, tag, element.content);
        return Some(rest);
    }
    let mut content = Zeroizing::new(Vec::new());
    let rest = if let Some(mut inside) = rest.strip_prefix(&[OPEN]) {
        loop {
            if let Some(rest) = inside.strip_prefix(END_OF_CONTENTS) {
                break rest;
            }
            inside = element(inside, depth, &mut content)?;
        }
    } else {
        let (whole, rest) = tlv::first_lax(bytes)?;
        let mut inside = whole.content;
        content.reserve_exact(inside.len());
        while !inside.is_empty() {
            inside = element(inside, depth, &mut content)?;
        }
        rest
    };
    if IN_PIECES.contains(&(tag & !CONSTRUCTED)) {
        append(der, tag & !CONSTRUCTED, &joined(tag & !CONSTRUCTED, &content)?);
    } else {
        append(der, tag, &content);
    }
    Some(rest)
}

/// The content of a string whose pieces were written one behind the other, as DER.
pub(super) fn joined(tag: u8, pieces: &[u8]) -> Option<Zeroizing<Vec<u8>>> {
    let mut content = Zeroizing::new(Vec::with_capacity(pieces.len()));
    if tag == BIT_STRING {
        content.push(0);
    }
    for piece in tlv::all(pieces)? {
        if piece.tag != tag {
            return None;
        }
        if tag == BIT_STRING {
            // How many bits of the last byte are unused, which is so in the last piece only.
            let (unused, bits) = piece.content.split_first()?;
            content[0] = *unused;
            content.extend_from_slice(bits);
        } else {
            content.extend_from_slice(piece.content);
        }
    }
    Some(content)
}

fn append(der: &mut Vec<u8>, tag: u8, content: &[u8]) {
    der.reserve(content.len() + 6);
    tlv::write_to(der, tag, content);
}

/// Deeper than any certificate, PKCS#7 or PKCS#12.
const MAX_DEPTH: usize = 32;
const NUMBER: u8 = 0x1f;
const CONSTRUCTED: u8 = 0x20;
/// The length that is left open (X.690 §8.1.3.6).
const OPEN: u8 = 0x80;
const END_OF_CONTENTS: &[u8] = &[0, 0];
const BIT_STRING: u8 = 0x03;
/// Bit and octet strings and the strings of characters of the universal class, which may be in pieces.
const IN_PIECES: [u8; 11] = [BIT_STRING, tlv::OCTET_STRING, 0x0c, 0x12, 0x13, 0x14, 0x16, 0x17, 0x18, 0x1c, 0x1e];

#[cfg(test)]
mod tests {
    use super::*;

    fn der(ber: &[u8]) -> Option<Vec<u8>> {
        let (der, rest) = first_as_der(ber)?;
        rest.is_empty().then(|| der.to_vec())
    }

    #[test]
    fn open_lengths_pieces_and_long_lengths_become_der() {
        for (ber, expected) in [
            (&b"\x30\x80\x02\x01\x03\x00\x00"[..], &b"\x30\x03\x02\x01\x03"[..]),
            (b"\x30\x80\xa0\x80\x04\x01\x07\x00\x00\x00\x00", b"\x30\x05\xa0\x03\x04\x01\x07"),
            (b"\x30\x81\x03\x02\x01\x03", b"\x30\x03\x02\x01\x03"),
            (b"\x30\x84\x00\x00\x00\x03\x02\x01\x03", b"\x30\x03\x02\x01\x03"),
            (b"\x24\x80\x04\x01a\x24\x05\x04\x01b\x04\x00\x00\x00", b"\x04\x02ab"),
            (b"\x23\x08\x03\x02\x00\xff\x03\x02\x04\xf0", b"\x03\x03\x04\xff\xf0"),
            (b"\x30\x00", b"\x30\x00"),
            (b"\x05\x00", b"\x05\x00"),
        ] {
            assert_eq!(der(ber).as_deref(), Some(expected), "{ber:02x?}");
        }
        let certificate = crate::pki::samples::certificate().der();
        assert_eq!(der(certificate).as_deref(), Some(certificate), "DER stays as it is");
        assert!(!is_needed(certificate) && is_needed(b"\x30\x80\x00\x00") && is_needed(b"\x30\x05\x24\x03\x04\x01a"));
        assert_eq!(first_as_der(b"\x30\x80\x00\x00\x0d\x0a").unwrap().1, b"\r\n");
    }

    #[test]
    fn what_is_not_whole_or_too_deep_is_refused() {
        for ber in [
            &b"\x30\x80\x02\x01\x03"[..],
            b"\x30\x80\x02\x01\x03\x00",
            b"\x30\x05\x02\x01\x03",
            b"\x04\x80\x00\x00",
            b"\x24\x03\x02\x01\x03",
            b"\x1f\x81\x01\x00",
            b"\x30",
            b"",
        ] {
            assert_eq!(der(ber), None, "{ber:02x?}");
        }
        assert_eq!(der(&[0x30, 0x80].repeat(100_000)), None);
        let deep = (0..MAX_DEPTH).fold(vec![5, 0], |inner, _| tlv::write(tlv::SEQUENCE, &[&inner]));
        assert_eq!(der(&deep), None);
        assert_eq!(der(&deep[2..]).as_deref(), Some(&deep[2..]));
    }
}
