use std::fmt;

use crate::model::{controller_text, untrusted_text};

use super::layout::Wire;

/// A text of a packet: a length, and room for `N` bytes (manual 4.1.3).
///
/// The controller writes names in UTF-8, or in Shift-JIS where they come from projects of a Japanese Windows. `Display`
/// shows them as one line without control characters.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Label<const N: usize> {
    /// In bytes. A packet with more than `N` is refused by the decoder.
    pub length: u8,
    /// The text, then zeros.
    pub bytes: [u8; N],
}

impl<const N: usize> Label<N> {
    /// The text in UTF-8, cut between two characters where it has more than `N` bytes.
    pub fn new(text: &str) -> Self {
        let mut end = text.len().min(N).min(usize::from(u8::MAX));
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        Self::from_bytes(&text.as_bytes()[..end])
    }

    /// At most `N` bytes in any encoding; more are cut off.
    pub fn from_bytes(text: &[u8]) -> Self {
        let length = text.len().min(N).min(usize::from(u8::MAX));
        let mut bytes = [0; N];
        bytes[..length].copy_from_slice(&text[..length]);
        Self { length: length as u8, bytes }
    }

    /// The bytes of the text: as many as the length says, without zeros at the end.
    pub fn as_bytes(&self) -> &[u8] {
        let text = &self.bytes[..usize::from(self.length).min(N)];
        let end = text.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1);
        &text[..end]
    }

    /// Whether there is no text.
    pub fn is_empty(&self) -> bool {
        self.as_bytes().is_empty()
    }
}

impl<const N: usize> Default for Label<N> {
    fn default() -> Self {
        Self { length: 0, bytes: [0; N] }
    }
}

impl<const N: usize> fmt::Display for Label<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&untrusted_text::one_line(&controller_text(self.as_bytes()), N))
    }
}

impl<const N: usize> fmt::Debug for Label<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Label({:?}, {} of {:02x?})", self.to_string(), self.length, self.bytes)
    }
}

impl<const N: usize> Wire for Label<N> {
    const SIZE: usize = 1 + N;

    fn read(bytes: &[u8], at: usize) -> Self {
        Self { length: bytes[at], bytes: <[u8; N]>::read(bytes, at + 1) }
    }

    fn write(self, bytes: &mut [u8], at: usize) {
        bytes[at] = self.length;
        self.bytes.write(bytes, at + 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(bytes: &[u8]) -> String {
        Label::<16>::from_bytes(bytes).to_string()
    }

    #[test]
    fn utf_8_and_shift_jis_are_told_apart() {
        assert_eq!(shown("溶接 1".as_bytes()), "溶接 1");
        // "Force sensing" in Shift-JIS.
        assert_eq!(shown(&[0x97, 0xcd, 0x8a, 0x6f]), "力\u{899a}");
        // A character cut in the middle belongs to neither.
        assert_eq!(shown(&[0x41, 0xff, 0x97]), "A��");
    }

    #[test]
    fn control_characters_are_made_visible() {
        assert_eq!(shown(b"a\x1b[2Jb"), "a�[2Jb");
        assert_eq!(shown(b"a\0b\0\0"), "a�b");
        assert_eq!(shown(b""), "");
    }

    #[test]
    fn a_text_is_cut_between_two_characters() {
        let label = Label::<4>::new("力\u{899a}");
        assert_eq!((label.length, label.to_string().as_str()), (3, "力"));
    }
}
