//! Addresses in the memory of a PLC: areas, words, bits and completion flags, as text and on the wire.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// A memory area of a CPU of the series CS, CJ, CP and NSJ (W342 5-2-2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Area {
    /// CIO: inputs, outputs, links. Written `CIO`, or without a name.
    Cio,
    /// Work area, `W`.
    Work,
    /// Holding area, `H`. Words from 512 on belong to function blocks.
    Holding,
    /// Auxiliary area, `A`. Words 0 to 447 are read-only.
    Auxiliary,
    /// Data memory, `D`.
    DataMemory,
    /// Timers, `T`: the present value as a word, the completion flag as a bit.
    Timer,
    /// Counters, `C`: the present value as a word, the completion flag as a bit.
    Counter,
    /// A bank of the extended data memory, `E0_` to `E18_`.
    ExtendedMemory(EmBank),
}

/// The number of a bank of the extended data memory: 0 to 24, written in hexadecimal as 0 to 18.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct EmBank(u8);

impl EmBank {
    /// The bank with the highest number, hexadecimal 18.
    pub const LAST: Self = Self(0x18);

    /// `None` above [`EmBank::LAST`].
    pub const fn new(number: u8) -> Option<Self> {
        if number <= Self::LAST.0 { Some(Self(number)) } else { None }
    }

    /// The number.
    pub const fn number(self) -> u8 {
        self.0
    }
}

/// What of an area an address names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Part {
    /// A word, or the present value of a timer or counter.
    Word,
    /// A bit of a word, 0 to 15.
    Bit(u8),
    /// The completion flag of a timer or counter.
    Flag,
}

/// One element of the memory of a PLC.
///
/// Text: `D300`, `DM300`, `D300.04`, `CIO0.15`, `0.15`, `W10`, `H5`, `A448`, `E1_200`, `T7` (present value), `T7.F`
/// (completion flag). Letters may be small; a bank's number is hexadecimal, all other numbers are decimal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Address {
    area: Area,
    number: u16,
    part: Part,
}

/// Elements that follow each other: `D300-304`, `D300-D304`, `CIO0.00-0.15`, or one address.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct AddressRange {
    /// The first element.
    pub start: Address,
    /// How many, at least 1.
    pub count: u16,
}

/// An address as a command carries it: area code, word and bit (W342 5-2-1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct WireAddress {
    /// The memory area code.
    pub code: u8,
    /// The word; counters begin at 8000 hex.
    pub word: u16,
    /// The bit; 0 for words and completion flags.
    pub bit: u8,
}

/// Why a text or the bytes of a command are no address.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum AddressError {
    /// The text does not begin with the name of an area.
    #[error("\"{0}\" names no memory area; known are CIO, W, H, A, D, T, C, E0_ to E18_")]
    UnknownArea(String),
    /// The text has no number, or something that is no number.
    #[error("\"{0}\" has no number, such as in D300")]
    NoNumber(String),
    /// The number is beyond the end of the area.
    #[error("{area} ends at {last}, and {number} is beyond it")]
    OutOfArea {
        /// The area.
        area: Area,
        /// What was asked for.
        number: u32,
        /// The last number of the area.
        last: u16,
    },
    /// The bit is not 0 to 15.
    #[error("\"{0}\" is no bit; bits are 00 to 15")]
    BadBit(String),
    /// A bit of a timer or counter was named.
    #[error("{0} has no bits; its completion flag is {0}.F")]
    NoBits(Address),
    /// A completion flag of another area was named.
    #[error("{0} has no completion flag; timers and counters have one")]
    NoFlag(Area),
    /// The range ends before it begins, in another area, or in elements of another kind.
    #[error("\"{0}\" does not end after its beginning, in the same area")]
    BadRange(String),
    /// The range has more elements than the area.
    #[error("{count} elements from {start} on reach beyond the end of {}", start.area)]
    TooMany {
        /// Where the range begins.
        start: Address,
        /// How many elements it has.
        count: usize,
    },
    /// The memory area code of a command is not known.
    #[error("the memory area code {0:02X} hex is not known")]
    UnknownCode(u8),
}

const COUNTERS_FROM: u16 = 0x8000;

impl Area {
    /// The last number of the area in the largest CPU of the series (CJ2H, W472 section 4).
    pub const fn last(self) -> u16 {
        match self {
            Self::Cio => 6_143,
            Self::Work => 511,
            Self::Holding => 1_535,
            Self::Auxiliary => 11_535,
            Self::DataMemory | Self::ExtendedMemory(_) => 32_767,
            Self::Timer | Self::Counter => 4_095,
        }
    }

    /// Whether its elements are timers or counters.
    pub const fn is_timer_or_counter(self) -> bool {
        matches!(self, Self::Timer | Self::Counter)
    }

    /// The code of its words or present values.
    const fn word_code(self) -> u8 {
        match self {
            Self::Cio => 0xB0,
            Self::Work => 0xB1,
            Self::Holding => 0xB2,
            Self::Auxiliary => 0xB3,
            Self::DataMemory => 0x82,
            Self::Timer | Self::Counter => 0x89,
            Self::ExtendedMemory(EmBank(bank @ 0..=0x0F)) => 0xA0 + bank,
            Self::ExtendedMemory(EmBank(bank)) => 0x60 + (bank - 0x10),
        }
    }

    /// The code of its bits or completion flags.
    const fn bit_code(self) -> u8 {
        match self {
            Self::Cio => 0x30,
            Self::Work => 0x31,
            Self::Holding => 0x32,
            Self::Auxiliary => 0x33,
            Self::DataMemory => 0x02,
            Self::Timer | Self::Counter => 0x09,
            Self::ExtendedMemory(EmBank(bank @ 0..=0x0F)) => 0x20 + bank,
            Self::ExtendedMemory(EmBank(bank)) => 0xE0 + (bank - 0x10),
        }
    }

    /// The area of a code, and whether the code is that of bits or completion flags.
    fn of_code(code: u8, word: u16) -> Option<(Self, bool)> {
        let timer_or_counter = if word < COUNTERS_FROM { Self::Timer } else { Self::Counter };
        Some(match code {
            0xB0 => (Self::Cio, false),
            0xB1 => (Self::Work, false),
            0xB2 => (Self::Holding, false),
            0xB3 => (Self::Auxiliary, false),
            0x82 => (Self::DataMemory, false),
            0x89 => (timer_or_counter, false),
            0xA0..=0xAF => (Self::ExtendedMemory(EmBank(code - 0xA0)), false),
            0x60..=0x68 => (Self::ExtendedMemory(EmBank(code - 0x60 + 0x10)), false),
            0x30 => (Self::Cio, true),
            0x31 => (Self::Work, true),
            0x32 => (Self::Holding, true),
            0x33 => (Self::Auxiliary, true),
            0x02 => (Self::DataMemory, true),
            0x09 => (timer_or_counter, true),
            0x20..=0x2F => (Self::ExtendedMemory(EmBank(code - 0x20)), true),
            0xE0..=0xE8 => (Self::ExtendedMemory(EmBank(code - 0xE0 + 0x10)), true),
            _ => return None,
        })
    }

    /// The area that a text begins with, and the rest of the text.
    fn prefix_of(text: &str) -> Option<(Self, &str)> {
        let upper = text.to_ascii_uppercase();
        let digits = text.len() - upper.trim_start_matches(|c: char| c.is_ascii_alphabetic()).len();
        let bank = upper.strip_prefix("EM").or_else(|| upper.strip_prefix('E')).and_then(|rest| {
            let (bank, _) = rest.split_once('_')?;
            let number = u8::from_str_radix(bank, 16).ok().filter(|_| !bank.starts_with('+'))?;
            Some((Self::ExtendedMemory(EmBank::new(number)?), text.split_once('_')?.1))
        });
        if bank.is_some() {
            return bank;
        }
        let area = match &upper[..digits] {
            "" | "CIO" => Self::Cio,
            "W" | "WR" => Self::Work,
            "H" | "HR" => Self::Holding,
            "A" | "AR" => Self::Auxiliary,
            "D" | "DM" => Self::DataMemory,
            "T" | "TIM" => Self::Timer,
            "C" | "CNT" => Self::Counter,
            _ => return None,
        };
        Some((area, &text[digits..]))
    }

    /// The area that a text names alone, such as `DM` or `E1`.
    pub fn from_name(name: &str) -> Option<Self> {
        let whole = if name.starts_with(['E', 'e']) { format!("{name}_") } else { name.to_owned() };
        Self::prefix_of(&whole).filter(|(_, rest)| rest.is_empty() && !name.is_empty()).map(|(area, _)| area)
    }
}

/// As an address begins: `D`, `CIO`, `E1_`.
impl fmt::Display for Area {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cio => f.write_str("CIO"),
            Self::Work => f.write_str("W"),
            Self::Holding => f.write_str("H"),
            Self::Auxiliary => f.write_str("A"),
            Self::DataMemory => f.write_str("D"),
            Self::Timer => f.write_str("T"),
            Self::Counter => f.write_str("C"),
            Self::ExtendedMemory(EmBank(bank)) => write!(f, "E{bank:X}_"),
        }
    }
}

impl Address {
    /// A word, or the present value of a timer or counter.
    pub fn word(area: Area, number: u16) -> Result<Self, AddressError> {
        Self::new(area, u32::from(number), Part::Word)
    }

    /// An address of any part.
    pub fn new(area: Area, number: u32, part: Part) -> Result<Self, AddressError> {
        let last = area.last();
        let in_area = u16::try_from(number).ok().filter(|number| *number <= last);
        let number = in_area.ok_or(AddressError::OutOfArea { area, number, last })?;
        let address = Self { area, number, part };
        match part {
            Part::Bit(bit) if bit > 15 => Err(AddressError::BadBit(bit.to_string())),
            Part::Bit(_) if area.is_timer_or_counter() => {
                Err(AddressError::NoBits(Self { part: Part::Word, ..address }))
            }
            Part::Flag if !area.is_timer_or_counter() => Err(AddressError::NoFlag(area)),
            _ => Ok(address),
        }
    }

    /// The area.
    pub const fn area(self) -> Area {
        self.area
    }

    /// The number of the word, timer or counter.
    pub const fn number(self) -> u16 {
        self.number
    }

    /// Word, bit or flag.
    pub const fn part(self) -> Part {
        self.part
    }

    /// Whether the element is one bit: a bit or a completion flag.
    pub const fn is_bit(self) -> bool {
        !matches!(self.part, Part::Word)
    }

    /// The element that is so many elements further on. Bits go on with the next word.
    pub fn plus(self, elements: usize) -> Result<Self, AddressError> {
        let beyond = || AddressError::TooMany { start: self, count: elements.saturating_add(1) };
        let elements = u32::try_from(elements).map_err(|_| beyond())?;
        let (words, part) = match self.part {
            Part::Bit(bit) => {
                let bits = u32::from(bit).checked_add(elements).ok_or_else(beyond)?;
                (bits / 16, Part::Bit((bits % 16) as u8))
            }
            part => (elements, part),
        };
        let number = u32::from(self.number).checked_add(words).ok_or_else(beyond)?;
        Self::new(self.area, number, part).map_err(|_| beyond())
    }

    /// As a command carries it.
    pub const fn to_wire(self) -> WireAddress {
        let word = if matches!(self.area, Area::Counter) { self.number + COUNTERS_FROM } else { self.number };
        match self.part {
            Part::Word => WireAddress { code: self.area.word_code(), word, bit: 0 },
            Part::Bit(bit) => WireAddress { code: self.area.bit_code(), word, bit },
            Part::Flag => WireAddress { code: self.area.bit_code(), word, bit: 0 },
        }
    }
}

impl WireAddress {
    /// The element that is meant.
    ///
    /// # Errors
    /// An unknown code, a number beyond the area, or a bit where there is none.
    pub fn address(self) -> Result<Address, AddressError> {
        let (area, is_bit) = Area::of_code(self.code, self.word).ok_or(AddressError::UnknownCode(self.code))?;
        let number = if area == Area::Counter { self.word - COUNTERS_FROM } else { self.word };
        let part = match (is_bit, area.is_timer_or_counter()) {
            (true, true) => Part::Flag,
            (true, false) => Part::Bit(self.bit),
            (false, _) => Part::Word,
        };
        if !matches!(part, Part::Bit(_)) && self.bit != 0 {
            return Err(AddressError::BadBit(self.bit.to_string()));
        }
        Address::new(area, u32::from(number), part)
    }

    /// Bytes that one element has in a command or an answer.
    pub fn element_size(self) -> Option<usize> {
        Area::of_code(self.code, self.word).map(|(_, is_bit)| if is_bit { 1 } else { 2 })
    }
}

/// `D300`, `D300.04`, `T7.F`.
impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.area, self.number)?;
        match self.part {
            Part::Word => Ok(()),
            Part::Bit(bit) => write!(f, ".{bit:02}"),
            Part::Flag => f.write_str(".F"),
        }
    }
}

impl FromStr for Address {
    type Err = AddressError;

    fn from_str(text: &str) -> Result<Self, AddressError> {
        let text = text.trim();
        let (area, rest) = Area::prefix_of(text).ok_or_else(|| AddressError::UnknownArea(text.to_owned()))?;
        element(area, rest, text)
    }
}

/// A number with an optional bit or flag. `whole` is what an error shows.
fn element(area: Area, text: &str, whole: &str) -> Result<Address, AddressError> {
    let (number, part) = text.split_once('.').map_or((text, None), |(number, part)| (number, Some(part)));
    let number = decimal(number).ok_or_else(|| AddressError::NoNumber(whole.to_owned()))?;
    let part = match part {
        None => Part::Word,
        Some("F" | "f") => Part::Flag,
        Some(bit) => {
            let number = decimal(bit).filter(|_| bit.len() <= 2).and_then(|bit| u8::try_from(bit).ok());
            Part::Bit(number.filter(|bit| *bit <= 15).ok_or_else(|| AddressError::BadBit(bit.to_owned()))?)
        }
    };
    Address::new(area, number, part)
}

/// Digits alone; `parse` would take a sign.
fn decimal(text: &str) -> Option<u32> {
    text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse().ok()).flatten()
}

impl AddressRange {
    /// So many elements from `start` on.
    ///
    /// # Errors
    /// No element at all, or elements beyond the end of the area.
    pub fn new(start: Address, count: usize) -> Result<Self, AddressError> {
        let error = AddressError::TooMany { start, count };
        let in_area = u16::try_from(count).ok().filter(|count| *count > 0);
        let Some(short) = in_area else { return Err(error) };
        start.plus(count - 1).map_err(|_| error)?;
        Ok(Self { start, count: short })
    }

    /// The last element.
    pub fn last(self) -> Address {
        self.start.plus(usize::from(self.count) - 1).unwrap_or(self.start)
    }
}

impl From<Address> for AddressRange {
    fn from(start: Address) -> Self {
        Self { start, count: 1 }
    }
}

/// `D300` or `D300-D304`.
impl fmt::Display for AddressRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.count {
            1 => self.start.fmt(f),
            _ => write!(f, "{}-{}", self.start, self.last()),
        }
    }
}

impl FromStr for AddressRange {
    type Err = AddressError;

    fn from_str(text: &str) -> Result<Self, AddressError> {
        let Some((first, last)) = text.split_once('-') else { return Ok(text.parse::<Address>()?.into()) };
        let bad = || AddressError::BadRange(text.to_owned());
        let start: Address = first.parse()?;
        let last = last.trim();
        // Without an area the number stands alone; that of CIO has no name of its own.
        let last = match last.starts_with(|c: char| c.is_ascii_digit()) {
            true => element(start.area, last, text)?,
            false => last.parse()?,
        };
        let position = |address: Address| match address.part {
            Part::Bit(bit) => u32::from(address.number) * 16 + u32::from(bit),
            _ => u32::from(address.number),
        };
        let same_kind =
            start.area == last.area && std::mem::discriminant(&start.part) == std::mem::discriminant(&last.part);
        if !same_kind || position(last) < position(start) {
            return Err(bad());
        }
        Self::new(start, (position(last) - position(start)) as usize + 1)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Text, area code, word, bit (W342 5-2-2).
    const TABLE: [(&str, u8, u16, u8); 20] = [
        ("CIO0.15", 0x30, 0, 15),
        ("CIO10.13", 0x30, 0x000A, 0x0D),
        ("CIO6143", 0xB0, 0x17FF, 0),
        ("W511.00", 0x31, 0x01FF, 0),
        ("W5", 0xB1, 5, 0),
        ("H511", 0xB2, 0x01FF, 0),
        ("H0.07", 0x32, 0, 7),
        ("A959", 0xB3, 0x03BF, 0),
        ("A448.01", 0x33, 0x01C0, 1),
        ("D300", 0x82, 0x012C, 0),
        ("D300.04", 0x02, 0x012C, 4),
        ("D32767", 0x82, 0x7FFF, 0),
        ("T5", 0x89, 5, 0),
        ("T5.F", 0x09, 5, 0),
        ("C12", 0x89, 0x800C, 0),
        ("C4095.F", 0x09, 0x8FFF, 0),
        ("E0_0", 0xA0, 0, 0),
        ("E1_200", 0xA1, 200, 0),
        ("EF_1.02", 0x2F, 1, 2),
        ("E18_32767", 0x68, 0x7FFF, 0),
    ];

    #[test]
    fn every_area_has_the_codes_of_the_manual() {
        for (text, code, word, bit) in TABLE {
            let address: Address = text.parse().unwrap();
            let wire = WireAddress { code, word, bit };
            assert_eq!(address.to_wire(), wire, "{text}");
            assert_eq!(wire.address(), Ok(address), "{text}");
            assert_eq!(address.to_string(), text);
        }
        assert_eq!("E10_3.01".parse::<Address>().unwrap().to_wire().code, 0xE0);
    }

    #[test]
    fn other_spellings_are_understood() {
        for (text, same) in [
            ("DM300", "D300"),
            ("d300.4", "D300.04"),
            ("0.15", "CIO0.15"),
            ("wr10", "W10"),
            ("HR5", "H5"),
            ("AR448", "A448"),
            ("TIM7", "T7"),
            ("CNT7.f", "C7.F"),
            ("em1_200", "E1_200"),
            ("D00300", "D300"),
        ] {
            assert_eq!(text.parse::<Address>().unwrap().to_string(), same, "{text}");
        }
        assert_eq!(Area::from_name("DM"), Some(Area::DataMemory));
        assert_eq!(Area::from_name("e1"), EmBank::new(1).map(Area::ExtendedMemory));
        assert_eq!(Area::from_name("EM18"), EmBank::new(0x18).map(Area::ExtendedMemory));
        for none in ["", "D3", "X", "E19", "E", "300"] {
            assert_eq!(Area::from_name(none), None, "{none}");
        }
    }

    #[test]
    fn what_is_no_address_is_refused_with_the_reason() {
        let error = |text: &str| text.parse::<Address>().unwrap_err();
        assert_eq!(error("X5"), AddressError::UnknownArea("X5".into()));
        assert_eq!(error("E19_0"), AddressError::UnknownArea("E19_0".into()));
        assert_eq!(error("D"), AddressError::NoNumber("D".into()));
        assert_eq!(error("D-5"), AddressError::NoNumber("D-5".into()));
        assert_eq!(error("D+5"), AddressError::NoNumber("D+5".into()));
        assert_eq!(error("W512"), AddressError::OutOfArea { area: Area::Work, number: 512, last: 511 });
        assert_eq!(error("D300.16"), AddressError::BadBit("16".into()));
        assert_eq!(error("D300.004"), AddressError::BadBit("004".into()));
        assert_eq!(error("T5.03").to_string(), "T5 has no bits; its completion flag is T5.F");
        assert_eq!(error("D5.F"), AddressError::NoFlag(Area::DataMemory));
        assert_eq!(WireAddress { code: 0x99, word: 0, bit: 0 }.address(), Err(AddressError::UnknownCode(0x99)));
        assert_eq!(WireAddress { code: 0x82, word: 0, bit: 3 }.address(), Err(AddressError::BadBit("3".into())));
        assert!(WireAddress { code: 0x09, word: 0xFFFF, bit: 0 }.address().is_err());
    }

    #[test]
    fn a_range_has_a_first_and_a_last_element() {
        let range = |text: &str| text.parse::<AddressRange>();
        for (text, shown, count) in [
            ("D300-304", "D300-D304", 5),
            ("D300-D304", "D300-D304", 5),
            ("D300", "D300", 1),
            ("CIO0.14-1.01", "CIO0.14-CIO1.01", 4),
            ("T0.F-2.F", "T0.F-T2.F", 3),
            ("E1_0-E1_9", "E1_0-E1_9", 10),
        ] {
            let range = range(text).unwrap();
            assert_eq!((range.to_string().as_str(), range.count), (shown, count), "{text}");
        }
        for bad in ["D304-300", "D300-W304", "D300-304.01", "E1_0-E2_9"] {
            assert_eq!(range(bad), Err(AddressError::BadRange(bad.into())), "{bad}");
        }
        assert!(AddressRange::new("W510".parse().unwrap(), 3).is_err());
        assert!(AddressRange::new("W510".parse().unwrap(), 0).is_err());
    }

    proptest! {
        #[test]
        fn an_address_is_read_back_from_its_text_and_from_the_wire(code: u8, word: u16, bit in 0_u8..16) {
            if let Ok(address) = (WireAddress { code, word, bit }).address() {
                prop_assert_eq!(address.to_string().parse::<Address>(), Ok(address));
                prop_assert_eq!(address.to_wire(), WireAddress { code, word, bit });
            }
        }

        #[test]
        fn no_text_makes_the_reader_panic(text in "\\PC{0,12}") {
            let _ = text.parse::<AddressRange>();
        }
    }
}
