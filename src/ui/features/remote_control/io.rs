use std::collections::BTreeMap;

use crate::jobs::{IoKind, IoLabels, MAX_LABEL_FILE_BYTES};
use crate::remote::client::RemoteError;
use crate::remote::{BitNumber, PortNumber, Reply, Request};
use crate::texts::TextKey as T;
use crate::ui::model::FileForm;
use crate::ui::picker::FileKind;

/// How I/O is shown and set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IoView {
    /// Bit by bit.
    Bits,
    /// Eight bits as a number.
    Bytes,
    /// Sixteen bits as a number.
    Words,
}

impl IoView {
    /// In the order they are shown.
    pub const ALL: [Self; 3] = [Self::Bits, Self::Bytes, Self::Words];

    /// Bits of a line.
    pub const fn width(self) -> u16 {
        match self {
            Self::Bits => 1,
            Self::Bytes => 8,
            Self::Words => 16,
        }
    }
}

/// Four words of inputs, outputs or memory I/O.
#[derive(Debug)]
pub struct IoPanel {
    /// Which kind.
    pub kind: IoKind,
    /// As bits, bytes or words.
    pub view: IoView,
    /// The number of the first word that is shown, at most [`IoPanel::most_first`].
    pub first: u8,
    /// Names of bits.
    pub labels: IoLabels,
    /// The file with the names.
    pub labels_file: FileForm,
    /// What is typed for a byte or word, by its number.
    pub typed: BTreeMap<u8, String>,
    words: BTreeMap<(IoKind, u8), Result<u16, RemoteError>>,
    /// Output bits that this dialog has set: remote commands do not read outputs.
    outputs: BTreeMap<u16, bool>,
}

/// How many words are shown.
pub const WORDS_SHOWN: u8 = 4;
const WORD_BITS: u16 = 16;

impl Default for IoPanel {
    fn default() -> Self {
        Self {
            kind: IoKind::Input,
            view: IoView::Bits,
            first: 0,
            labels: IoLabels::default(),
            labels_file: FileForm::new(FileKind::Csv, MAX_LABEL_FILE_BYTES),
            typed: BTreeMap::new(),
            words: BTreeMap::new(),
            outputs: BTreeMap::new(),
        }
    }
}

impl IoPanel {
    /// The largest number of the first word. Bytes have numbers up to 255 as words have, so fewer of them can be set.
    pub const fn most_first(&self) -> u8 {
        match self.view {
            IoView::Bits | IoView::Words => u8::MAX - (WORDS_SHOWN - 1),
            IoView::Bytes => u8::MAX / 2 - (WORDS_SHOWN - 1),
        }
    }

    /// Another kind or view was chosen: what was typed belongs to the former one.
    pub fn changed(&mut self) {
        self.first = self.first.min(self.most_first());
        self.typed.clear();
    }

    /// The numbers of the words that are shown.
    pub fn words(&self) -> impl Iterator<Item = u8> + use<> {
        let first = self.first.min(self.most_first());
        first..=first + (WORDS_SHOWN - 1)
    }

    /// The numbers of the bits, bytes or words that are shown.
    pub fn numbers(&self) -> impl Iterator<Item = u16> + use<> {
        let in_word = WORD_BITS / self.view.width();
        self.words().flat_map(move |word| (0..in_word).map(move |part| u16::from(word) * in_word + part))
    }

    /// What is read in each cycle.
    pub fn reads(&self) -> Vec<Request> {
        let read = |word| self.kind.read_word(PortNumber::new(word)?);
        self.words().filter_map(read).collect()
    }

    /// Takes in what the controller answered to a command of [`IoPanel::reads`].
    pub fn take_in(&mut self, request: &Request, result: Result<Reply, RemoteError>) {
        let (kind, port) = match request {
            Request::GetIOWord { port } => (IoKind::Input, port),
            Request::GetMemIOWord { port } => (IoKind::Memory, port),
            _ => return,
        };
        match result {
            Ok(Reply::Word(word)) => drop(self.words.insert((kind, port.get()), Ok(word))),
            Ok(_) => {}
            Err(error) => drop(self.words.insert((kind, port.get()), Err(error))),
        }
    }

    /// Notes outputs that were set.
    pub fn was_set(&mut self, request: &Request) {
        let (first, count, value) = match request {
            Request::SetIO { bit, on } => (bit.get(), 1, u16::from(*on)),
            Request::SetIOByte { port, value } => (u16::from(port.get()) * 8, 8, u16::from(*value)),
            Request::SetIOWord { port, value } => (u16::from(port.get()) * WORD_BITS, WORD_BITS, *value),
            _ => return,
        };
        self.outputs.extend((0..count).map(|bit| (first + bit, value >> bit & 1 == 1)));
    }

    /// What is known may no longer be so.
    pub fn forget(&mut self) {
        self.words.clear();
        self.outputs.clear();
    }

    /// Whether a bit is on; `None`: that is not known.
    pub fn bit(&self, bit: u16) -> Option<bool> {
        match self.kind {
            IoKind::Output => self.outputs.get(&bit).copied(),
            kind => {
                let word = u8::try_from(bit / WORD_BITS).ok()?;
                let value = self.words.get(&(kind, word))?.as_ref().ok()?;
                Some(value >> (bit % WORD_BITS) & 1 == 1)
            }
        }
    }

    /// The bits of a byte or word; `None`: they are not all known.
    pub fn value(&self, number: u16) -> Option<u16> {
        let width = self.view.width();
        let bit = |offset: u16| self.bit(number * width + offset).map(|on| u16::from(on) << offset);
        (0..width).map(bit).sum()
    }

    /// Why the word with this bit could not be read.
    pub fn failure(&self, bit: u16) -> Option<&RemoteError> {
        self.words.get(&(self.kind, u8::try_from(bit / WORD_BITS).ok()?))?.as_ref().err()
    }

    /// The command that sets a bit.
    pub fn set_bit(&self, bit: u16, on: bool) -> Option<Request> {
        self.kind.set_bit(BitNumber::new(bit)?, on)
    }

    /// The command that sets a byte or word to what is typed for it, in hexadecimal; why there is none.
    pub fn set_typed(&self, number: u8) -> Result<Request, T> {
        let text = self.typed.get(&number).map(|text| text.trim()).unwrap_or_default();
        let digits = text.strip_prefix("0x").or(text.strip_prefix("&H")).unwrap_or(text);
        let is_hex = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
        let value = u16::from_str_radix(digits, 16).ok().filter(|_| is_hex);
        let request = |value: u16| {
            let port = PortNumber::new(number)?;
            match self.view {
                IoView::Bits => None,
                IoView::Bytes => self.kind.set_byte(port, u8::try_from(value).ok()?),
                IoView::Words => self.kind.set_word(port, value),
            }
        };
        value.and_then(request).ok_or(match self.view {
            IoView::Words => T::RemoteHexWordRule,
            IoView::Bits | IoView::Bytes => T::RemoteHexByteRule,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(panel: &mut IoPanel, kind: IoKind, port: u8, value: u16) {
        let request = kind.read_word(PortNumber::new(port).unwrap()).unwrap();
        panel.take_in(&request, Ok(Reply::Word(value)));
    }

    #[test]
    fn words_are_taken_apart() {
        let mut panel = IoPanel::default();
        word(&mut panel, IoKind::Input, 1, 0x80A5);
        word(&mut panel, IoKind::Memory, 1, 0);
        let on: Vec<u16> = panel.numbers().filter(|bit| panel.bit(*bit) == Some(true)).collect();
        assert_eq!(on, [16, 18, 21, 23, 31]);
        assert_eq!(panel.bit(0), None, "not read yet");
        panel.view = IoView::Bytes;
        assert_eq!(
            panel.numbers().map(|number| panel.value(number)).collect::<Vec<_>>()[..4],
            [None, None, Some(0xA5), Some(0x80)]
        );
        panel.view = IoView::Words;
        assert_eq!(panel.value(1), Some(0x80A5));
        panel.kind = IoKind::Memory;
        assert_eq!(panel.value(1), Some(0), "inputs and memory are independent");
    }

    #[test]
    fn of_outputs_only_what_was_set_here_is_known() {
        let mut panel = IoPanel { kind: IoKind::Output, ..IoPanel::default() };
        assert!(panel.reads().is_empty());
        panel.was_set(&panel.set_bit(3, true).unwrap());
        assert_eq!((panel.bit(3), panel.bit(4)), (Some(true), None));
        panel.view = IoView::Bytes;
        assert_eq!(panel.value(0), None);
        panel.typed.insert(0, "0x0F".into());
        let request = panel.set_typed(0).unwrap();
        assert_eq!(request, Request::SetIOByte { port: PortNumber::new(0).unwrap(), value: 0x0F });
        panel.was_set(&request);
        assert_eq!(panel.value(0), Some(0x0F));
    }

    #[test]
    fn a_number_that_is_typed_has_to_fit() {
        let mut panel = IoPanel { kind: IoKind::Memory, view: IoView::Bytes, ..IoPanel::default() };
        for wrong in ["", "1FF", "-1", "+1", "0G", "0x"] {
            panel.typed.insert(2, wrong.into());
            assert_eq!(panel.set_typed(2), Err(T::RemoteHexByteRule), "{wrong}");
        }
        panel.view = IoView::Words;
        panel.typed.insert(2, " 1ff ".into());
        assert_eq!(panel.set_typed(2), Ok(Request::SetMemIOWord { port: PortNumber::new(2).unwrap(), value: 0x1FF }));
        panel.kind = IoKind::Input;
        assert!(panel.set_typed(2).is_err() && panel.set_bit(1, true).is_none(), "inputs are only read");
    }

    #[test]
    fn the_last_words_can_be_shown() {
        let mut panel = IoPanel { first: 255, ..IoPanel::default() };
        panel.changed();
        assert_eq!(panel.words().collect::<Vec<_>>(), [252, 253, 254, 255]);
        panel.view = IoView::Bytes;
        panel.changed();
        assert_eq!(panel.numbers().last(), Some(255));
    }
}
