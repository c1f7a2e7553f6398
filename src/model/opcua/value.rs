use std::fmt;

use chrono::{DateTime, Utc};

use super::{NodeId, QualifiedName};

/// A value of any built-in type (OPC 10000-6 §5.1.2).
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Value {
    /// No value.
    #[default]
    Null,
    /// True or false.
    Boolean(bool),
    /// Signed, 8 bits.
    SByte(i8),
    /// Unsigned, 8 bits.
    Byte(u8),
    /// Signed, 16 bits.
    Int16(i16),
    /// Unsigned, 16 bits.
    UInt16(u16),
    /// Signed, 32 bits.
    Int32(i32),
    /// Unsigned, 32 bits.
    UInt32(u32),
    /// Signed, 64 bits.
    Int64(i64),
    /// Unsigned, 64 bits.
    UInt64(u64),
    /// IEEE 754, 32 bits.
    Float(f32),
    /// IEEE 754, 64 bits.
    Double(f64),
    /// Text of the server; may hold control characters.
    String(String),
    /// `None`: the null time, which the encoding writes as the year 1601.
    DateTime(Option<DateTime<Utc>>),
    /// In its text form.
    Guid(String),
    /// Bytes without a meaning known here.
    ByteString(Vec<u8>),
    /// The name of the status, or its number in hexadecimal digits.
    StatusCode(String),
    /// The identifier of a node.
    NodeId(NodeId),
    /// A name with its namespace.
    QualifiedName(QualifiedName),
    /// A text in one language.
    LocalizedText {
        /// RFC 3066 name of the language; may be empty.
        locale: String,
        /// The text in that language.
        text: String,
    },
    /// `Range`, for example of `EURange` (OPC 10000-8 §5.6.2).
    Range {
        /// Least value.
        low: f64,
        /// Greatest value.
        high: f64,
    },
    /// `EUInformation` (OPC 10000-8 §5.6.3).
    EngineeringUnits {
        /// The code of UNECE Recommendation 20 as a number; -1: none.
        unit_id: i32,
        /// The symbol, for example `mm/s`.
        symbol: String,
    },
    /// An array of any number of dimensions, as one row.
    Array(Vec<Value>),
    /// A structure that is not decoded: its type, as far as it is known.
    Structure(String),
}

impl Value {
    /// The number, for a plot. Booleans are 0 and 1. `None` for what is no number.
    pub fn as_f64(&self) -> Option<f64> {
        Some(match *self {
            Self::Boolean(value) => f64::from(u8::from(value)),
            Self::SByte(value) => value.into(),
            Self::Byte(value) => value.into(),
            Self::Int16(value) => value.into(),
            Self::UInt16(value) => value.into(),
            Self::Int32(value) => value.into(),
            Self::UInt32(value) => value.into(),
            Self::Int64(value) => value as f64,
            Self::UInt64(value) => value as f64,
            Self::Float(value) => value.into(),
            Self::Double(value) => value,
            _ => return None,
        })
    }

    /// The text of a string or a localised text.
    pub fn as_text(&self) -> Option<&str> {
        match self {
            Self::String(text) | Self::LocalizedText { text, .. } => Some(text),
            _ => None,
        }
    }

    /// The name of its built-in type (OPC 10000-6 §5.1.2); of an array, that of its elements with `[]`.
    pub fn type_name(&self) -> String {
        let name = match self {
            Self::Null => "Null",
            Self::Boolean(_) => "Boolean",
            Self::SByte(_) => "SByte",
            Self::Byte(_) => "Byte",
            Self::Int16(_) => "Int16",
            Self::UInt16(_) => "UInt16",
            Self::Int32(_) => "Int32",
            Self::UInt32(_) => "UInt32",
            Self::Int64(_) => "Int64",
            Self::UInt64(_) => "UInt64",
            Self::Float(_) => "Float",
            Self::Double(_) => "Double",
            Self::String(_) => "String",
            Self::DateTime(_) => "DateTime",
            Self::Guid(_) => "Guid",
            Self::ByteString(_) => "ByteString",
            Self::StatusCode(_) => "StatusCode",
            Self::NodeId(_) => "NodeId",
            Self::QualifiedName(_) => "QualifiedName",
            Self::LocalizedText { .. } => "LocalizedText",
            Self::Range { .. } => "Range",
            Self::EngineeringUnits { .. } => "EUInformation",
            Self::Structure(name) => name,
            Self::Array(elements) => {
                return format!("{}[]", elements.first().map_or_else(|| "Null".to_owned(), Self::type_name));
            }
        };
        name.to_owned()
    }

    /// A value of the same type from a typed text; `None` if the text is none of that type, or if values of the type
    /// cannot be typed.
    pub fn parse_as(&self, text: &str) -> Option<Self> {
        let text = text.trim();
        Some(match self {
            Self::Boolean(_) => Self::Boolean(match text {
                "true" | "1" => true,
                "false" | "0" => false,
                _ => return None,
            }),
            Self::SByte(_) => Self::SByte(text.parse().ok()?),
            Self::Byte(_) => Self::Byte(text.parse().ok()?),
            Self::Int16(_) => Self::Int16(text.parse().ok()?),
            Self::UInt16(_) => Self::UInt16(text.parse().ok()?),
            Self::Int32(_) => Self::Int32(text.parse().ok()?),
            Self::UInt32(_) => Self::UInt32(text.parse().ok()?),
            Self::Int64(_) => Self::Int64(text.parse().ok()?),
            Self::UInt64(_) => Self::UInt64(text.parse().ok()?),
            Self::Float(_) => Self::Float(text.parse().ok()?),
            Self::Double(_) => Self::Double(text.parse().ok()?),
            Self::String(_) => Self::String(text.to_owned()),
            _ => return None,
        })
    }
}

/// The value without its type, on one line. Long byte strings and arrays are cut, with the number of their elements.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Null | Self::DateTime(None) => f.write_str("null"),
            Self::Boolean(value) => value.fmt(f),
            Self::SByte(value) => value.fmt(f),
            Self::Byte(value) => value.fmt(f),
            Self::Int16(value) => value.fmt(f),
            Self::UInt16(value) => value.fmt(f),
            Self::Int32(value) => value.fmt(f),
            Self::UInt32(value) => value.fmt(f),
            Self::Int64(value) => value.fmt(f),
            Self::UInt64(value) => value.fmt(f),
            Self::Float(value) => value.fmt(f),
            Self::Double(value) => value.fmt(f),
            Self::String(text) | Self::LocalizedText { text, .. } | Self::Guid(text) | Self::StatusCode(text) => {
                f.write_str(text)
            }
            Self::DateTime(Some(time)) => write!(f, "{}", time.format("%Y-%m-%d %H:%M:%S%.3f UTC")),
            Self::NodeId(node) => node.fmt(f),
            Self::QualifiedName(name) => name.fmt(f),
            Self::Range { low, high } => write!(f, "{low} … {high}"),
            Self::EngineeringUnits { symbol, .. } => f.write_str(symbol),
            Self::Structure(name) => write!(f, "({name})"),
            Self::ByteString(bytes) => {
                for byte in bytes.iter().take(MAX_SHOWN) {
                    write!(f, "{byte:02x} ")?;
                }
                match bytes.len() > MAX_SHOWN {
                    true => write!(f, "… ({} bytes)", bytes.len()),
                    false => write!(f, "({} bytes)", bytes.len()),
                }
            }
            Self::Array(elements) => {
                f.write_str("[")?;
                for (at, element) in elements.iter().take(MAX_SHOWN).enumerate() {
                    if at > 0 {
                        f.write_str(", ")?;
                    }
                    element.fmt(f)?;
                }
                match elements.len() > MAX_SHOWN {
                    true => write!(f, ", … ({})]", elements.len()),
                    false => f.write_str("]"),
                }
            }
        }
    }
}

/// Elements of an array or a byte string in its text form.
const MAX_SHOWN: usize = 32;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_plotted_and_texts_are_not() {
        assert_eq!(Value::Int16(-3).as_f64(), Some(-3.0));
        assert_eq!(Value::Boolean(true).as_f64(), Some(1.0));
        assert_eq!(Value::String("1".into()).as_f64(), None);
        assert_eq!(Value::Array(vec![Value::Byte(1)]).as_f64(), None);
    }

    #[test]
    fn a_typed_text_becomes_a_value_of_the_same_type_or_nothing() {
        assert_eq!(Value::UInt16(0).parse_as(" 200 "), Some(Value::UInt16(200)));
        assert_eq!(Value::UInt16(0).parse_as("70000"), None);
        assert_eq!(Value::Boolean(false).parse_as("true"), Some(Value::Boolean(true)));
        assert_eq!(Value::Boolean(false).parse_as("yes"), None);
        assert_eq!(Value::Null.parse_as("1"), None);
    }

    #[test]
    fn long_values_are_cut_and_say_how_long_they_are() {
        assert_eq!(Value::ByteString(vec![0xab, 1]).to_string(), "ab 01 (2 bytes)");
        let cut = Value::ByteString(vec![0; 1000]).to_string();
        assert!(cut.ends_with("00 … (1000 bytes)"), "{cut}");
        assert_eq!(Value::Array(vec![Value::Byte(1), Value::Byte(2)]).to_string(), "[1, 2]");
        assert!(Value::Array(vec![Value::Null; 33]).to_string().ends_with(", … (33)]"));
        assert_eq!(Value::Array(vec![Value::Float(1.0)]).type_name(), "Float[]");
    }
}
