//! The text of a file or of standard input, saved as UTF-8 or UTF-16.

use std::borrow::Cow;

use thiserror::Error;

/// Why bytes are not the text of a file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum TextError {
    /// Older spreadsheets write the code page of the computer, such as Windows-1252 or GBK.
    #[error("line {line} is not UTF-8 text; save the file as UTF-8 (in Excel: \"CSV UTF-8\")")]
    NotUtf8 {
        /// Line of the first wrong byte, counted from 1.
        line: usize,
    },
    /// The byte order mark says UTF-16, but the bytes are not.
    #[error("line {line} is damaged UTF-16 text; save the file as UTF-8")]
    NotUtf16 {
        /// Line of the first wrong character, counted from 1.
        line: usize,
    },
    /// The text is UTF-32, which is not read.
    #[error("it is UTF-32 text; save the file as UTF-8")]
    Utf32,
}

/// Decodes UTF-8, or UTF-16 in either byte order; the byte order mark is not part of the text (Unicode §23.8).
///
/// UTF-16 is what PowerShell 5 writes with `>` and Excel as "Unicode text". It is known by its byte order mark, or by
/// the zero bytes of its first two characters. Only UTF-16 is copied; the copy is one allocation, so that wiping the
/// returned string wipes all of it.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, TextError> {
    match to_utf8(bytes)? {
        Cow::Borrowed(bytes) => std::str::from_utf8(bytes).map(Cow::Borrowed).map_err(|error| TextError::NotUtf8 {
            line: 1 + bytes.iter().take(error.valid_up_to()).filter(|byte| **byte == b'\n').count(),
        }),
        Cow::Owned(bytes) => String::from_utf8(bytes).map(Cow::Owned).map_err(|_| TextError::NotUtf16 { line: 1 }),
    }
}

/// Removes the encodings that have zero bytes, and the byte order mark, and checks nothing else: for formats such as
/// PEM, whose surrounding text may be in any code page. Otherwise as [`decode`].
pub fn to_utf8(bytes: &[u8]) -> Result<Cow<'_, [u8]>, TextError> {
    match bytes {
        [0xef, 0xbb, 0xbf, text @ ..] => Ok(Cow::Borrowed(text)),
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => Err(TextError::Utf32),
        [0xff, 0xfe, text @ ..] => from_utf16(text, u16::from_le_bytes),
        [0xfe, 0xff, text @ ..] => from_utf16(text, u16::from_be_bytes),
        [1..=0x7f, 0, 1..=0x7f, 0, ..] => from_utf16(bytes, u16::from_le_bytes),
        [0, 1..=0x7f, 0, 1..=0x7f, ..] => from_utf16(bytes, u16::from_be_bytes),
        text => Ok(Cow::Borrowed(text)),
    }
}

fn from_utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<Cow<'_, [u8]>, TextError> {
    let (units, rest) = bytes.as_chunks::<2>();
    // A unit becomes three bytes at most, so the buffer is never moved.
    let mut text = String::with_capacity(units.len() * 3);
    let damaged = |text: &str| TextError::NotUtf16 { line: 1 + text.matches('\n').count() };
    for character in char::decode_utf16(units.iter().map(|bytes| unit(*bytes))) {
        text.push(character.map_err(|_| damaged(&text))?);
    }
    if rest.is_empty() { Ok(Cow::Owned(text.into_bytes())) } else { Err(damaged(&text)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "Zelle 1\r\n装配线 🤖\r\n";

    fn utf16(text: &str, unit: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(unit).collect()
    }

    #[test]
    fn every_unicode_encoding_gives_the_same_text() {
        let with_mark = format!("\u{feff}{TEXT}");
        for bytes in [
            TEXT.as_bytes().to_vec(),
            with_mark.clone().into_bytes(),
            utf16(&with_mark, u16::to_le_bytes),
            utf16(&with_mark, u16::to_be_bytes),
            utf16(TEXT, u16::to_le_bytes),
            utf16(TEXT, u16::to_be_bytes),
        ] {
            assert_eq!(decode(&bytes).as_deref(), Ok(TEXT), "{bytes:02x?}");
        }
        assert_eq!(decode(b"").as_deref(), Ok(""));
        assert_eq!(decode(b"\xff\xfe").as_deref(), Ok(""), "a mark and nothing else");
    }

    #[test]
    fn what_is_not_text_is_named_with_its_line() {
        assert_eq!(decode(b"a\nb\nM\xfcller"), Err(TextError::NotUtf8 { line: 3 }));
        assert_eq!(decode(b"\xff\xfea\0\n\0b"), Err(TextError::NotUtf16 { line: 2 }), "half a unit");
        assert_eq!(decode(b"\xff\xfea\0\x00\xdcb\0"), Err(TextError::NotUtf16 { line: 1 }), "half a pair");
        assert_eq!(decode(b"\xff\xfe\0\0a\0\0\0"), Err(TextError::Utf32));
        assert_eq!(decode(b"\0\0\xfe\xff\0\0\0a"), Err(TextError::Utf32));
    }

    #[test]
    fn other_code_pages_are_left_as_they_are_where_only_the_mark_matters() {
        assert_eq!(to_utf8(b"\xef\xbb\xbfM\xfcller").as_deref(), Ok(&b"M\xfcller"[..]));
        assert_eq!(to_utf8(b"\x30\x82\x01\x00").as_deref(), Ok(&b"\x30\x82\x01\x00"[..]), "not UTF-16: DER");
    }
}
