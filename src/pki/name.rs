use x509_parser::asn1_rs::Tag;
use x509_parser::objects::{oid_registry, oid2abbrev};
use x509_parser::prelude::{AttributeTypeAndValue, X509Name};

use crate::model::untrusted_text::one_line;

/// The common name, or `None` if there is none.
pub(super) fn common_name(name: &X509Name<'_>) -> Option<String> {
    name.iter_common_name().next().map(text_of).filter(|text| !text.is_empty())
}

/// The common name, or the whole name if there is none.
pub(super) fn title(name: &X509Name<'_>) -> String {
    common_name(name).unwrap_or_else(|| printable(&name.to_string()))
}

/// The whole name, its parts in the order of the certificate: `C=JP, O=Example + OU=Robots, CN=robot`.
pub(super) fn full(name: &X509Name<'_>) -> String {
    let part = |attribute: &AttributeTypeAndValue<'_>| {
        let oid = attribute.attr_type();
        let what = oid2abbrev(oid, oid_registry()).map_or_else(|_| oid.to_id_string(), str::to_owned);
        format!("{what}={}", text_of(attribute))
    };
    let parts: Vec<String> = name.iter_rdn().map(|rdn| rdn.iter().map(part).collect::<Vec<_>>().join(" + ")).collect();
    parts.join(", ")
}

/// The mailboxes in a name (RFC 2985 §5.2.1).
pub(super) fn emails(name: &X509Name<'_>) -> Vec<String> {
    name.iter_email().map(decoded).collect()
}

/// Equal for names that RFC 5280 §7.1 calls the same: string type, case and inner white space do not matter.
///
/// Every part stands behind its length, so that no text can pass for the seam between two parts.
pub(super) fn folded(name: &X509Name<'_>) -> Vec<u8> {
    let mut whole = Vec::new();
    for rdn in name.iter_rdn() {
        let mut parts: Vec<Vec<u8>> = rdn.iter().map(folded_part).collect();
        parts.sort();
        whole.extend((parts.len() as u32).to_be_bytes());
        for part in parts {
            whole.extend((part.len() as u32).to_be_bytes());
            whole.extend(part);
        }
    }
    whole
}

fn folded_part(attribute: &AttributeTypeAndValue<'_>) -> Vec<u8> {
    let mut part = attribute.attr_type().as_bytes().to_vec();
    part.push(0);
    if STRINGS.contains(&attribute.attr_value().tag()) {
        let words = decoded(attribute).split_whitespace().collect::<Vec<_>>().join(" ");
        part.extend(words.to_lowercase().into_bytes());
    } else {
        part.extend_from_slice(attribute.attr_value().data);
    }
    part
}

const STRINGS: [Tag; 8] = [
    Tag::Utf8String,
    Tag::PrintableString,
    Tag::Ia5String,
    Tag::T61String,
    Tag::BmpString,
    Tag::NumericString,
    Tag::VisibleString,
    Tag::UniversalString,
];

/// One line ([`one_line`]): the text comes from a file or a peer, and ends up in lists, logs and terminals.
pub(super) fn printable(text: &str) -> String {
    one_line(text, usize::MAX)
}

fn text_of(attribute: &AttributeTypeAndValue<'_>) -> String {
    printable(&decoded(attribute))
}

/// Old certificates write names in UTF-16 or Latin-1.
fn decoded(attribute: &AttributeTypeAndValue<'_>) -> String {
    let value = attribute.attr_value();
    match value.tag() {
        Tag::BmpString => {
            let units: Vec<u16> =
                value.data.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
            String::from_utf16_lossy(&units)
        }
        Tag::T61String => value.data.iter().copied().map(char::from).collect(),
        Tag::UniversalString => value
            .data
            .chunks_exact(4)
            .map(|four| u32::from_be_bytes([four[0], four[1], four[2], four[3]]))
            .map(|code| char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER))
            .collect(),
        _ => String::from_utf8_lossy(value.data).into_owned(),
    }
}

/// A text of a certificate or a peer, without control characters and cut to 200 characters, for a
/// [`CertificateFlaw`](super::CertificateFlaw).
pub(super) fn quoted(text: &str) -> String {
    const MOST: usize = 200;
    let mut quoted: String = printable(text).chars().take(MOST).collect();
    if quoted.len() < text.len() && text.chars().nth(MOST).is_some() {
        quoted.push('…');
    }
    quoted
}

#[cfg(test)]
mod tests {
    use super::*;
    use x509_parser::prelude::FromDer;

    /// `CN=<value>` with the string type of that tag.
    fn named(tag: u8, value: &[u8]) -> Vec<u8> {
        let mut attribute = vec![0x06, 3, 0x55, 4, 3, tag, value.len() as u8];
        attribute.extend_from_slice(value);
        [0x30, 0x31, 0x30].into_iter().fold(attribute, |inner, outer| {
            let mut whole = vec![outer, inner.len() as u8];
            whole.extend(inner);
            whole
        })
    }

    #[test]
    fn names_are_read_in_every_string_type() {
        for (tag, value, expected) in [
            (0x0c, "Größe".as_bytes(), "Größe"),
            (0x13, b"Plain".as_slice(), "Plain"),
            (0x1e, b"\x53\x17\x4e\xac".as_slice(), "北京"),
            (0x14, b"Gr\xf6\xdfe".as_slice(), "Größe"),
        ] {
            let der = named(tag, value);
            let (_, name) = X509Name::from_der(&der).unwrap();
            assert_eq!(common_name(&name).as_deref(), Some(expected));
        }
    }

    #[test]
    fn a_name_cannot_command_a_terminal() {
        let der = named(0x0c, b"\x1b[2J\nrobot");
        let (_, name) = X509Name::from_der(&der).unwrap();
        assert_eq!(title(&name), "\u{fffd}[2J robot");
    }

    #[test]
    fn names_are_the_same_whatever_their_string_type_case_and_spaces() {
        let folded_of = |tag, value: &[u8]| {
            let der = named(tag, value);
            folded(&X509Name::from_der(&der).unwrap().1)
        };
        let expected = folded_of(0x0c, "Größe 1".as_bytes());
        for (tag, value) in [
            (0x14, b"Gr\xf6\xdfe 1".as_slice()),
            (0x0c, "  grÖße   1 ".as_bytes()),
            (0x1e, b"\0G\0r\0\xf6\0\xdf\0e\0 \x001"),
            (0x1c, b"\0\0\0G\0\0\0r\0\0\0\xf6\0\0\0\xdf\0\0\0e\0\0\0 \0\0\x001"),
        ] {
            assert_eq!(folded_of(tag, value), expected, "{value:02x?}");
        }
        assert_ne!(folded_of(0x0c, b"Gr"), expected);
        assert_ne!(folded_of(0x04, "Größe 1".as_bytes()), expected, "no string");
    }

    #[test]
    fn a_whole_name_is_shown_in_its_order_and_commands_no_terminal() {
        let der = named(0x0c, b"\x1b[2Jrobot");
        assert_eq!(full(&X509Name::from_der(&der).unwrap().1), "CN=\u{fffd}[2Jrobot");
    }
}
