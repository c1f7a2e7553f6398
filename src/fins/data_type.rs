//! Values in words: numbers of 16 and 32 bits, BCD, text.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// How words hold a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum DataType {
    /// One bit. The only type of bits and completion flags; never that of words.
    Bit,
    /// Unsigned, one word.
    #[default]
    U16,
    /// Two's complement, one word.
    I16,
    /// Unsigned, two words.
    U32,
    /// Two's complement, two words.
    I32,
    /// IEEE 754 single precision, two words.
    F32,
    /// Four decimal digits, one word: 0 to 9999.
    Bcd16,
    /// Eight decimal digits, two words: 0 to 99999999.
    Bcd32,
    /// Text, two bytes a word, the first one in the high byte; NUL ends it.
    Text,
}

/// Which word of two holds the low half of a 32-bit value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum WordOrder {
    /// The word with the lower address, as the PLC's own instructions have it.
    #[default]
    LowFirst,
    /// The word with the higher address.
    HighFirst,
}

/// A value as a person or another device knows it.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A bit.
    Bit(bool),
    /// A number without fraction.
    Integer(i64),
    /// A number of single precision.
    Float(f32),
    /// Text.
    Text(String),
}

/// Why a value does not fit into words, or words hold no value of a type.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ValueError {
    /// The number is outside the range of the type.
    #[error("{value} is outside {low} to {high} of {data_type}")]
    OutOfRange {
        /// The number.
        value: i64,
        /// The type.
        data_type: DataType,
        /// The least number of the type.
        low: i64,
        /// The greatest number of the type.
        high: i64,
    },
    /// A word of BCD has a digit above 9.
    #[error("{0:04X} hex is no BCD number")]
    NotBcd(u16),
    /// The text needs more words than it has.
    #[error("the text needs {needed} bytes and has room for {room}")]
    TextTooLong {
        /// Bytes of the text in UTF-8.
        needed: usize,
        /// Bytes of its words.
        room: usize,
    },
    /// The value is of another kind than the type.
    #[error("\"{0}\" is no value of {1}")]
    NotOfType(String, DataType),
    /// The number of words is no multiple of the words of a value.
    #[error("{words} words are not a whole number of {data_type} values")]
    OddWords {
        /// Words there are.
        words: usize,
        /// The type.
        data_type: DataType,
    },
    /// The name is none of the types.
    #[error("\"{0}\" is no type; known are bit, u16, i16, u32, i32, f32, bcd, bcd32, text")]
    UnknownType(String),
    /// The name is none of the word orders.
    #[error("\"{0}\" is no word order; known are low-first, high-first")]
    UnknownWordOrder(String),
}

const TYPE_NAMES: [(DataType, &str); 9] = [
    (DataType::Bit, "bit"),
    (DataType::U16, "u16"),
    (DataType::I16, "i16"),
    (DataType::U32, "u32"),
    (DataType::I32, "i32"),
    (DataType::F32, "f32"),
    (DataType::Bcd16, "bcd"),
    (DataType::Bcd32, "bcd32"),
    (DataType::Text, "text"),
];

impl DataType {
    /// Words of one value; of text, the unit in which its length is counted.
    pub const fn words(self) -> usize {
        match self {
            Self::Bit | Self::U16 | Self::I16 | Self::Bcd16 | Self::Text => 1,
            Self::U32 | Self::I32 | Self::F32 | Self::Bcd32 => 2,
        }
    }

    /// The least and the greatest number; `None` for what is no integer.
    pub const fn range(self) -> Option<(i64, i64)> {
        Some(match self {
            Self::U16 => (0, u16::MAX as i64),
            Self::I16 => (i16::MIN as i64, i16::MAX as i64),
            Self::U32 => (0, u32::MAX as i64),
            Self::I32 => (i32::MIN as i64, i32::MAX as i64),
            Self::Bcd16 => (0, 9_999),
            Self::Bcd32 => (0, 99_999_999),
            Self::Bit | Self::F32 | Self::Text => return None,
        })
    }

    /// The values that words hold; one value of all words for text.
    ///
    /// # Errors
    /// Words that are no BCD, or a number of words that does not fit. Text that is no UTF-8 has `�` in its place.
    pub fn decode(self, words: &[u16], order: WordOrder) -> Result<Vec<Value>, ValueError> {
        if self == Self::Text {
            let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_be_bytes()).collect();
            let text = bytes.split(|byte| *byte == 0).next().unwrap_or_default();
            return Ok(vec![Value::Text(String::from_utf8_lossy(text).into_owned())]);
        }
        if !words.len().is_multiple_of(self.words()) {
            return Err(ValueError::OddWords { words: words.len(), data_type: self });
        }
        words.chunks_exact(self.words()).map(|words| self.decode_one(words, order)).collect()
    }

    fn decode_one(self, words: &[u16], order: WordOrder) -> Result<Value, ValueError> {
        let long = match (words, order) {
            ([low, high], WordOrder::LowFirst) | ([high, low], WordOrder::HighFirst) => {
                u32::from(*high) << 16 | u32::from(*low)
            }
            _ => u32::from(words.first().copied().unwrap_or_default()),
        };
        let word = long as u16;
        Ok(match self {
            Self::Bit => Value::Bit(long != 0),
            Self::U16 | Self::U32 => Value::Integer(i64::from(long)),
            Self::I16 => Value::Integer(i64::from(word.cast_signed())),
            Self::I32 => Value::Integer(i64::from(long.cast_signed())),
            Self::F32 => Value::Float(f32::from_bits(long)),
            Self::Bcd16 => Value::Integer(from_bcd(word)?),
            Self::Bcd32 => Value::Integer(from_bcd((long >> 16) as u16)? * 10_000 + from_bcd(word)?),
            Self::Text => Value::Text(String::new()),
        })
    }

    /// The words of values. Text fills `words_of_text` words with NUL at its end; it is ignored for all other types.
    ///
    /// # Errors
    /// Values of another kind or outside the range, and text that does not fit.
    pub fn encode(self, values: &[Value], order: WordOrder, words_of_text: usize) -> Result<Vec<u16>, ValueError> {
        let mut words = Vec::with_capacity(values.len() * self.words());
        for value in values {
            let wrong = || ValueError::NotOfType(value.to_string(), self);
            match (self, value) {
                (Self::Text, Value::Text(text)) => words.extend(text_words(text, words_of_text)?),
                (Self::F32, Value::Float(number)) => push_long(&mut words, number.to_bits(), order),
                // Whole numbers up to 2^24 are exact; beyond, the nearest one is written.
                (Self::F32, Value::Integer(number)) => push_long(&mut words, (*number as f32).to_bits(), order),
                (Self::Bit, Value::Bit(state)) => words.push(u16::from(*state)),
                (_, Value::Bit(state)) if self.range().is_some() => {
                    self.push_integer(&mut words, i64::from(*state), order)?;
                }
                (_, Value::Integer(number)) if self.range().is_some() => {
                    self.push_integer(&mut words, *number, order)?;
                }
                // A float becomes an integer only where nothing is lost.
                (_, Value::Float(number)) if self.range().is_some() && number.fract() == 0.0 => {
                    self.push_integer(&mut words, *number as i64, order)?;
                }
                _ => return Err(wrong()),
            }
        }
        Ok(words)
    }

    fn push_integer(self, words: &mut Vec<u16>, value: i64, order: WordOrder) -> Result<(), ValueError> {
        let (low, high) = self.range().unwrap_or((0, 0));
        if !(low..=high).contains(&value) {
            return Err(ValueError::OutOfRange { value, data_type: self, low, high });
        }
        match self {
            Self::Bcd16 => words.push(to_bcd(value)),
            Self::Bcd32 => {
                push_long(words, u32::from(to_bcd(value / 10_000)) << 16 | u32::from(to_bcd(value % 10_000)), order);
            }
            _ if self.words() == 1 => words.push(value as u16),
            _ => push_long(words, value as u32, order),
        }
        Ok(())
    }

    /// The value that a person typed.
    ///
    /// Integers are decimal, or hexadecimal after `0x`, which gives the bits of a signed type as well.
    ///
    /// # Errors
    /// Text that is no value of the type, or a number outside its range.
    pub fn parse(self, text: &str) -> Result<Value, ValueError> {
        let wrong = || ValueError::NotOfType(text.to_owned(), self);
        match self {
            Self::Text => Ok(Value::Text(text.to_owned())),
            Self::F32 => text.parse().map(Value::Float).map_err(|_| wrong()),
            Self::Bit => match text.to_ascii_lowercase().as_str() {
                "1" | "on" | "true" => Ok(Value::Bit(true)),
                "0" | "off" | "false" => Ok(Value::Bit(false)),
                _ => Err(wrong()),
            },
            _ => {
                let value = match text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
                    Some(digits) => self.parse_hexadecimal(digits).ok_or_else(wrong)?,
                    None => text.parse().map_err(|_| wrong())?,
                };
                let (low, high) = self.range().ok_or_else(wrong)?;
                if (low..=high).contains(&value) {
                    Ok(Value::Integer(value))
                } else {
                    Err(ValueError::OutOfRange { value, data_type: self, low, high })
                }
            }
        }
    }

    fn parse_hexadecimal(self, digits: &str) -> Option<i64> {
        let bits = i64::from(u32::from_str_radix(digits, 16).ok().filter(|_| !digits.starts_with('+'))?);
        Some(match self {
            Self::I16 if bits <= 0xFFFF => i64::from((bits as u16).cast_signed()),
            Self::I32 => i64::from((bits as u32).cast_signed()),
            _ => bits,
        })
    }
}

fn push_long(words: &mut Vec<u16>, long: u32, order: WordOrder) {
    let (high, low) = ((long >> 16) as u16, long as u16);
    words.extend(match order {
        WordOrder::LowFirst => [low, high],
        WordOrder::HighFirst => [high, low],
    });
}

fn text_words(text: &str, words: usize) -> Result<Vec<u16>, ValueError> {
    let mut bytes = text.as_bytes().to_vec();
    let room = words * 2;
    if bytes.len() > room {
        return Err(ValueError::TextTooLong { needed: bytes.len(), room });
    }
    bytes.resize(room, 0);
    Ok(bytes.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect())
}

fn from_bcd(word: u16) -> Result<i64, ValueError> {
    let digits = [12, 8, 4, 0].map(|shift| i64::from(word >> shift & 0xF));
    if digits.iter().any(|digit| *digit > 9) {
        return Err(ValueError::NotBcd(word));
    }
    Ok(digits.iter().fold(0, |number, digit| number * 10 + digit))
}

fn to_bcd(number: i64) -> u16 {
    [1_000, 100, 10, 1].iter().fold(0, |word, place| word << 4 | (number / place % 10) as u16)
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bit(state) => f.write_str(if *state { "1" } else { "0" }),
            Self::Integer(number) => number.fmt(f),
            Self::Float(number) => number.fmt(f),
            Self::Text(text) => f.write_str(text),
        }
    }
}

impl fmt::Display for DataType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(TYPE_NAMES.iter().find(|(data_type, _)| data_type == self).map_or("", |(_, name)| name))
    }
}

impl FromStr for DataType {
    type Err = ValueError;

    fn from_str(text: &str) -> Result<Self, ValueError> {
        let known = TYPE_NAMES.iter().find(|(_, name)| *name == text.to_ascii_lowercase());
        known.map(|(data_type, _)| *data_type).ok_or_else(|| ValueError::UnknownType(text.to_owned()))
    }
}

impl FromStr for WordOrder {
    type Err = ValueError;

    fn from_str(text: &str) -> Result<Self, ValueError> {
        match text.to_ascii_lowercase().as_str() {
            "low-first" => Ok(Self::LowFirst),
            "high-first" => Ok(Self::HighFirst),
            _ => Err(ValueError::UnknownWordOrder(text.to_owned())),
        }
    }
}

impl fmt::Display for WordOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::LowFirst => "low-first",
            Self::HighFirst => "high-first",
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn each_type_has_its_words() {
        let low = WordOrder::LowFirst;
        for (data_type, text, words) in [
            (DataType::U16, "321", &[0x0141][..]),
            (DataType::U16, "0xABCD", &[0xABCD]),
            (DataType::I16, "-2", &[0xFFFE]),
            (DataType::I16, "0xFFFE", &[0xFFFE]),
            (DataType::U32, "305419896", &[0x5678, 0x1234]),
            (DataType::I32, "-1", &[0xFFFF, 0xFFFF]),
            (DataType::F32, "-12.5", &[0x0000, 0xC148]),
            (DataType::Bcd16, "9876", &[0x9876]),
            (DataType::Bcd32, "12345678", &[0x5678, 0x1234]),
        ] {
            let value = data_type.parse(text).unwrap();
            assert_eq!(data_type.encode(std::slice::from_ref(&value), low, 0).unwrap(), words, "{data_type} {text}");
            assert_eq!(data_type.decode(words, low).unwrap(), [value], "{data_type} {text}");
        }
        let value = [Value::Integer(0x1234_5678)];
        assert_eq!(DataType::U32.encode(&value, WordOrder::HighFirst, 0).unwrap(), [0x1234, 0x5678]);
        let text = [Value::Text("Weld".into())];
        assert_eq!(DataType::Text.encode(&text, low, 3).unwrap(), [0x5765, 0x6C64, 0]);
        assert_eq!(DataType::Text.decode(&[0x5765, 0x6C64, 0, 0x4141], low).unwrap(), text);
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let encode = |data_type: DataType, value| data_type.encode(&[value], WordOrder::LowFirst, 1).unwrap_err();
        assert!(matches!(encode(DataType::U16, Value::Integer(65_536)), ValueError::OutOfRange { high: 65_535, .. }));
        assert!(matches!(encode(DataType::U16, Value::Integer(-1)), ValueError::OutOfRange { .. }));
        assert!(matches!(encode(DataType::Bcd16, Value::Integer(10_000)), ValueError::OutOfRange { .. }));
        assert!(matches!(encode(DataType::U16, Value::Float(1.5)), ValueError::NotOfType(..)));
        assert!(matches!(encode(DataType::I32, Value::Float(f32::NAN)), ValueError::NotOfType(..)));
        assert!(matches!(encode(DataType::I32, Value::Float(1e20)), ValueError::OutOfRange { .. }));
        assert_eq!(encode(DataType::Text, Value::Text("abc".into())), ValueError::TextTooLong { needed: 3, room: 2 });
        assert_eq!(DataType::Bcd16.decode(&[0x12A4], WordOrder::LowFirst), Err(ValueError::NotBcd(0x12A4)));
        assert!(DataType::U32.decode(&[1, 2, 3], WordOrder::LowFirst).is_err());
        for (data_type, text) in [
            (DataType::U16, "70000"),
            (DataType::U16, "0x12345"),
            (DataType::U16, "abc"),
            (DataType::Bit, "2"),
            (DataType::F32, "x"),
            (DataType::U16, "0x+1"),
        ] {
            assert!(data_type.parse(text).is_err(), "{data_type} {text}");
        }
    }

    #[test]
    fn a_type_is_called_by_its_name() {
        for (data_type, name) in TYPE_NAMES {
            assert_eq!(name.parse::<DataType>(), Ok(data_type));
        }
        assert!("u64".parse::<DataType>().is_err());
    }

    proptest! {
        #[test]
        fn values_are_read_back(long: u32, number in 0_i64..100_000_000, high_first: bool) {
            let order = if high_first { WordOrder::HighFirst } else { WordOrder::LowFirst };
            for data_type in [DataType::U16, DataType::I16, DataType::U32, DataType::I32, DataType::F32] {
                let words = [long as u16, (long >> 16) as u16];
                let values = data_type.decode(&words, order).unwrap();
                prop_assert_eq!(data_type.encode(&values, order, 0).unwrap(), words);
            }
            let bcd = [Value::Integer(number)];
            let words = DataType::Bcd32.encode(&bcd, order, 0).unwrap();
            prop_assert_eq!(DataType::Bcd32.decode(&words, order).unwrap(), bcd);
        }

        #[test]
        fn text_is_read_back(text in "[^\\x00]{0,20}") {
            let value = [Value::Text(text)];
            let words = DataType::Text.encode(&value, WordOrder::LowFirst, 40).unwrap();
            prop_assert_eq!(DataType::Text.decode(&words, WordOrder::LowFirst).unwrap(), value);
        }
    }
}
