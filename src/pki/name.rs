use x509_parser::asn1_rs::Tag;
use x509_parser::prelude::{AttributeTypeAndValue, X509Name};

/// The common name, or `None` if there is none.
pub(super) fn common_name(name: &X509Name<'_>) -> Option<String> {
    name.iter_common_name().next().map(text_of).filter(|text| !text.is_empty())
}

/// The common name, or the whole name if there is none.
pub(super) fn title(name: &X509Name<'_>) -> String {
    common_name(name).unwrap_or_else(|| printable(&name.to_string()))
}

/// Without control characters: the text comes from a file or a peer, and ends up in lists, logs and terminals.
pub(super) fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect()
}

/// Old certificates write names in UTF-16 or Latin-1.
fn text_of(attribute: &AttributeTypeAndValue<'_>) -> String {
    let value = attribute.attr_value();
    let text = match value.tag() {
        Tag::BmpString => {
            let units: Vec<u16> =
                value.data.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
            String::from_utf16_lossy(&units)
        }
        Tag::T61String => value.data.iter().copied().map(char::from).collect(),
        _ => String::from_utf8_lossy(value.data).into_owned(),
    };
    printable(&text)
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
        assert_eq!(title(&name), "\u{fffd}[2J\u{fffd}robot");
    }
}
