//! The values of variables, in both forms.

use super::decode_error::{DecodeError, EncodeError, Fault};
use super::reader::Reader;
use crate::model::{SpelType, SpelValue, controller_text};

/// The longest text in a String variable, in bytes.
pub const MAX_STRING_BYTES: usize = 255;

/// The byte for a type in frames, in the order of the manual's table: 00 Boolean up to 0D UInt64.
const TYPE_CODES: [SpelType; 14] = [
    SpelType::Boolean,
    SpelType::Byte,
    SpelType::Double,
    SpelType::Integer,
    SpelType::Long,
    SpelType::Real,
    SpelType::String,
    SpelType::UByte,
    SpelType::Short,
    SpelType::UShort,
    SpelType::Int32,
    SpelType::UInt32,
    SpelType::Int64,
    SpelType::UInt64,
];

/// The byte for a type in frames.
pub(super) fn type_code(kind: SpelType) -> u8 {
    (0..).zip(TYPE_CODES).find(|(_, known)| *known == kind).map_or(0, |(code, _)| code)
}

/// The type of a byte.
pub(super) fn type_from_code(code: u8) -> Option<SpelType> {
    TYPE_CODES.get(usize::from(code)).copied()
}

/// The length of a value of this type in frames; `None` for a String.
pub(super) const fn width(kind: SpelType) -> Option<usize> {
    Some(match kind {
        SpelType::Boolean | SpelType::Byte | SpelType::UByte => 1,
        SpelType::Short | SpelType::Integer | SpelType::UShort => 2,
        SpelType::Long | SpelType::Int32 | SpelType::UInt32 | SpelType::Real => 4,
        SpelType::Int64 | SpelType::UInt64 | SpelType::Double => 8,
        SpelType::String => return None,
    })
}

/// Whether a variable of this type holds such a value.
pub(super) const fn fits(kind: SpelType, value: &SpelValue) -> bool {
    matches!(
        (kind, value),
        (SpelType::Boolean, SpelValue::Boolean(_))
            | (SpelType::Byte, SpelValue::Int8(_))
            | (SpelType::Short | SpelType::Integer, SpelValue::Int16(_))
            | (SpelType::Long | SpelType::Int32, SpelValue::Int32(_))
            | (SpelType::Int64, SpelValue::Int64(_))
            | (SpelType::UByte, SpelValue::UInt8(_))
            | (SpelType::UShort, SpelValue::UInt16(_))
            | (SpelType::UInt32, SpelValue::UInt32(_))
            | (SpelType::UInt64, SpelValue::UInt64(_))
            | (SpelType::Real, SpelValue::Float(_))
            | (SpelType::Double, SpelValue::Double(_))
            | (SpelType::String, SpelValue::String(_))
    )
}

/// Writes a value into a frame: numbers with the high byte first, a String as it is, without quotes.
pub(super) fn put_frame(value: &SpelValue, out: &mut Vec<u8>) -> Result<(), EncodeError> {
    match value {
        SpelValue::Boolean(on) => out.push(u8::from(*on)),
        SpelValue::Int8(value) => out.extend(value.to_be_bytes()),
        SpelValue::Int16(value) => out.extend(value.to_be_bytes()),
        SpelValue::Int32(value) => out.extend(value.to_be_bytes()),
        SpelValue::Int64(value) => out.extend(value.to_be_bytes()),
        SpelValue::UInt8(value) => out.extend(value.to_be_bytes()),
        SpelValue::UInt16(value) => out.extend(value.to_be_bytes()),
        SpelValue::UInt32(value) => out.extend(value.to_be_bytes()),
        SpelValue::UInt64(value) => out.extend(value.to_be_bytes()),
        SpelValue::Float(value) => out.extend(value.to_be_bytes()),
        SpelValue::Double(value) => out.extend(value.to_be_bytes()),
        SpelValue::String(text) => out.extend(checked(text)?.as_bytes()),
    }
    Ok(())
}

fn checked(text: &str) -> Result<&str, EncodeError> {
    if text.len() > MAX_STRING_BYTES {
        return Err(EncodeError::TooLong);
    }
    if text.contains(char::is_control) { Err(EncodeError::ControlCharacter) } else { Ok(text) }
}

/// Reads a value from a frame. A String takes everything up to the end.
pub(super) fn take_frame(kind: SpelType, reader: &mut Reader<'_>) -> Result<SpelValue, DecodeError> {
    let at = reader.position();
    Ok(match kind {
        // A true of SPEL+ is -1.
        SpelType::Boolean => match reader.array()? {
            [0] => SpelValue::Boolean(false),
            [1 | 0xFF] => SpelValue::Boolean(true),
            _ => return Err(reader.error_at(Fault::OutOfRange, at)),
        },
        SpelType::Byte => SpelValue::Int8(i8::from_be_bytes(reader.array()?)),
        SpelType::Short | SpelType::Integer => SpelValue::Int16(i16::from_be_bytes(reader.array()?)),
        SpelType::Long | SpelType::Int32 => SpelValue::Int32(i32::from_be_bytes(reader.array()?)),
        SpelType::Int64 => SpelValue::Int64(i64::from_be_bytes(reader.array()?)),
        SpelType::UByte => SpelValue::UInt8(u8::from_be_bytes(reader.array()?)),
        SpelType::UShort => SpelValue::UInt16(u16::from_be_bytes(reader.array()?)),
        SpelType::UInt32 => SpelValue::UInt32(u32::from_be_bytes(reader.array()?)),
        SpelType::UInt64 => SpelValue::UInt64(u64::from_be_bytes(reader.array()?)),
        SpelType::Real => SpelValue::Float(f32::from_be_bytes(reader.array()?)),
        SpelType::Double => SpelValue::Double(f64::from_be_bytes(reader.array()?)),
        SpelType::String => string(reader.rest()).map_err(|fault| reader.error_at(fault, at))?,
    })
}

fn string(bytes: &[u8]) -> Result<SpelValue, Fault> {
    if bytes.len() > MAX_STRING_BYTES {
        return Err(Fault::TooLong);
    }
    let text = controller_text(bytes);
    if text.contains(char::is_control) { Err(Fault::Malformed) } else { Ok(SpelValue::String(text)) }
}

/// The value as the text form writes it: numbers in decimal, true as 1, a String as it is, without quotes.
pub fn value_text(value: &SpelValue) -> String {
    match value {
        SpelValue::Boolean(on) => u8::from(*on).to_string(),
        SpelValue::Int8(value) => value.to_string(),
        SpelValue::Int16(value) => value.to_string(),
        SpelValue::Int32(value) => value.to_string(),
        SpelValue::Int64(value) => value.to_string(),
        SpelValue::UInt8(value) => value.to_string(),
        SpelValue::UInt16(value) => value.to_string(),
        SpelValue::UInt32(value) => value.to_string(),
        SpelValue::UInt64(value) => value.to_string(),
        SpelValue::Float(value) => real_text(f64::from(*value), value.to_string(), format!("{value:E}")),
        SpelValue::Double(value) => real_text(*value, value.to_string(), format!("{value:E}")),
        SpelValue::String(text) => text.clone(),
    }
}

/// The shortest digits that read back as the same number, with an exponent where there would be many zeros.
fn real_text(value: f64, plain: String, exponent: String) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() || (1e-5..1e15).contains(&size) { plain } else { exponent }
}

pub(super) fn put_text(value: &SpelValue, out: &mut Vec<u8>) -> Result<(), EncodeError> {
    if let SpelValue::String(text) = value {
        checked(text)?;
    }
    out.extend(value_text(value).into_bytes());
    Ok(())
}

/// Reads what [`value_text`] writes, and `True` and `False` for a Boolean; blanks around a number are allowed.
///
/// Errors: [`Fault::Missing`], [`Fault::Malformed`], [`Fault::OutOfRange`] for a number that the type cannot hold, and
/// [`Fault::TooLong`] for a String.
pub fn value_from_text(kind: SpelType, text: &str) -> Result<SpelValue, Fault> {
    if kind == SpelType::String {
        return string(text.as_bytes());
    }
    let number = text.trim_matches(' ');
    if number.is_empty() {
        return Err(Fault::Missing);
    }
    match kind {
        SpelType::Boolean => boolean(number).map(SpelValue::Boolean),
        SpelType::Byte => integer(number).map(SpelValue::Int8),
        SpelType::Short | SpelType::Integer => integer(number).map(SpelValue::Int16),
        SpelType::Long | SpelType::Int32 => integer(number).map(SpelValue::Int32),
        SpelType::Int64 => integer(number).map(SpelValue::Int64),
        SpelType::UByte => integer(number).map(SpelValue::UInt8),
        SpelType::UShort => integer(number).map(SpelValue::UInt16),
        SpelType::UInt32 => integer(number).map(SpelValue::UInt32),
        SpelType::UInt64 => integer(number).map(SpelValue::UInt64),
        SpelType::Real => number.parse().map(SpelValue::Float).map_err(|_| Fault::Malformed),
        SpelType::Double => number.parse().map(SpelValue::Double).map_err(|_| Fault::Malformed),
        SpelType::String => string(text.as_bytes()),
    }
}

fn boolean(text: &str) -> Result<bool, Fault> {
    match text {
        "0" => Ok(false),
        "1" | "-1" => Ok(true),
        _ if text.eq_ignore_ascii_case("true") => Ok(true),
        _ if text.eq_ignore_ascii_case("false") => Ok(false),
        _ => Err(Fault::Malformed),
    }
}

fn integer<T: TryFrom<i128>>(text: &str) -> Result<T, Fault> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(Fault::Malformed);
    }
    let number: i128 = text.parse().map_err(|_| Fault::OutOfRange)?;
    T::try_from(number).map_err(|_| Fault::OutOfRange)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_types_have_the_codes_of_the_manual() {
        for (kind, code) in [
            (SpelType::Boolean, 0x00),
            (SpelType::Byte, 0x01),
            (SpelType::Double, 0x02),
            (SpelType::Integer, 0x03),
            (SpelType::Long, 0x04),
            (SpelType::Real, 0x05),
            (SpelType::String, 0x06),
            (SpelType::UByte, 0x07),
            (SpelType::Short, 0x08),
            (SpelType::UShort, 0x09),
            (SpelType::Int32, 0x0A),
            (SpelType::UInt32, 0x0B),
            (SpelType::Int64, 0x0C),
            (SpelType::UInt64, 0x0D),
        ] {
            assert_eq!((type_code(kind), type_from_code(code)), (code, Some(kind)));
            assert!(fits(kind, &kind.zero()));
            let mut bytes = Vec::new();
            put_frame(&kind.zero(), &mut bytes).unwrap();
            assert_eq!(bytes.len(), width(kind).unwrap_or(0), "{kind}");
        }
        assert_eq!(type_from_code(0x0E), None);
    }

    #[test]
    fn numbers_of_a_text_are_checked_against_the_type() {
        let of = value_from_text;
        assert_eq!(of(SpelType::Boolean, "True"), Ok(SpelValue::Boolean(true)));
        assert_eq!(of(SpelType::Boolean, "-1"), Ok(SpelValue::Boolean(true)));
        assert_eq!(of(SpelType::Boolean, "2"), Err(Fault::Malformed));
        assert_eq!(of(SpelType::Byte, " -128 "), Ok(SpelValue::Int8(-128)));
        assert_eq!(of(SpelType::Byte, "128"), Err(Fault::OutOfRange));
        assert_eq!(of(SpelType::UInt64, "18446744073709551615"), Ok(SpelValue::UInt64(u64::MAX)));
        assert_eq!(of(SpelType::UInt64, &"9".repeat(60)), Err(Fault::OutOfRange));
        assert_eq!(of(SpelType::Integer, "1.5"), Err(Fault::Malformed));
        assert_eq!(of(SpelType::Integer, "+1"), Err(Fault::Malformed));
        assert_eq!(of(SpelType::Integer, ""), Err(Fault::Missing));
        assert_eq!(of(SpelType::Double, "-1.5E3"), Ok(SpelValue::Double(-1500.0)));
        assert_eq!(of(SpelType::Real, "1,5"), Err(Fault::Malformed));
        assert_eq!(of(SpelType::String, " a,b "), Ok(SpelValue::String(" a,b ".to_owned())));
        assert_eq!(of(SpelType::String, &"x".repeat(256)), Err(Fault::TooLong));
    }

    #[test]
    fn real_numbers_are_written_short_and_read_back() {
        for (value, text) in [(0.1, "0.1"), (-182.632, "-182.632"), (1e300, "1E300"), (1e-7, "1E-7"), (-0.0, "-0")] {
            assert_eq!(value_text(&SpelValue::Double(value)), text);
            assert_eq!(value_from_text(SpelType::Double, text), Ok(SpelValue::Double(value)));
        }
        assert_eq!(value_text(&SpelValue::Float(0.1)), "0.1");
    }
}
