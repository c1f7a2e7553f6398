use std::fmt;

/// A data type of SPEL+ (manual 3.2.3.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SpelType {
    /// True or false; OPC UA Boolean.
    Boolean,
    /// 8 bits with sign; OPC UA SByte.
    Byte,
    /// 16 bits with sign; OPC UA Int16.
    Short,
    /// 16 bits with sign; OPC UA Int16.
    Integer,
    /// 32 bits with sign; OPC UA Int32.
    Long,
    /// 32 bits with sign; OPC UA Int32.
    Int32,
    /// 64 bits with sign; OPC UA Int64.
    Int64,
    /// 8 bits without sign; OPC UA Byte.
    UByte,
    /// 16 bits without sign; OPC UA UInt16.
    UShort,
    /// 32 bits without sign; OPC UA UInt32.
    UInt32,
    /// 64 bits without sign; OPC UA UInt64.
    UInt64,
    /// Single precision; OPC UA Float.
    Real,
    /// Double precision; OPC UA Double.
    Double,
    /// At most 255 characters; OPC UA String.
    String,
}

impl SpelType {
    /// Every type, in the order of the manual's table.
    pub const ALL: [Self; 14] = [
        Self::Boolean,
        Self::Byte,
        Self::Short,
        Self::Integer,
        Self::Long,
        Self::Int32,
        Self::Int64,
        Self::UByte,
        Self::UShort,
        Self::UInt32,
        Self::UInt64,
        Self::Real,
        Self::Double,
        Self::String,
    ];

    /// The keyword of SPEL+.
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::Boolean => "Boolean",
            Self::Byte => "Byte",
            Self::Short => "Short",
            Self::Integer => "Integer",
            Self::Long => "Long",
            Self::Int32 => "Int32",
            Self::Int64 => "Int64",
            Self::UByte => "UByte",
            Self::UShort => "UShort",
            Self::UInt32 => "UInt32",
            Self::UInt64 => "UInt64",
            Self::Real => "Real",
            Self::Double => "Double",
            Self::String => "String",
        }
    }

    /// The type with this keyword; SPEL+ does not distinguish case.
    pub fn from_keyword(keyword: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.keyword().eq_ignore_ascii_case(keyword))
    }

    /// The value of a variable that nothing was assigned to.
    pub const fn zero(self) -> SpelValue {
        match self {
            Self::Boolean => SpelValue::Boolean(false),
            Self::Byte => SpelValue::Int8(0),
            Self::Short | Self::Integer => SpelValue::Int16(0),
            Self::Long | Self::Int32 => SpelValue::Int32(0),
            Self::Int64 => SpelValue::Int64(0),
            Self::UByte => SpelValue::UInt8(0),
            Self::UShort => SpelValue::UInt16(0),
            Self::UInt32 => SpelValue::UInt32(0),
            Self::UInt64 => SpelValue::UInt64(0),
            Self::Real => SpelValue::Float(0.0),
            Self::Double => SpelValue::Double(0.0),
            Self::String => SpelValue::String(String::new()),
        }
    }

    /// The value `number` as a variable of this type holds it: rounded and limited to the type's range; a string shows it
    /// in decimal.
    pub fn of_number(self, number: f64) -> SpelValue {
        // `as` limits to the range of the integer.
        match self {
            Self::Boolean => SpelValue::Boolean(number != 0.0),
            Self::Byte => SpelValue::Int8(number.round() as i8),
            Self::Short | Self::Integer => SpelValue::Int16(number.round() as i16),
            Self::Long | Self::Int32 => SpelValue::Int32(number.round() as i32),
            Self::Int64 => SpelValue::Int64(number.round() as i64),
            Self::UByte => SpelValue::UInt8(number.round() as u8),
            Self::UShort => SpelValue::UInt16(number.round() as u16),
            Self::UInt32 => SpelValue::UInt32(number.round() as u32),
            Self::UInt64 => SpelValue::UInt64(number.round() as u64),
            Self::Real => SpelValue::Float(number as f32),
            Self::Double => SpelValue::Double(number),
            Self::String => SpelValue::String(number.to_string()),
        }
    }
}

impl fmt::Display for SpelType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.keyword())
    }
}

/// The value of a SPEL variable, by the OPC UA type that shows it (manual 3.2.3.3).
#[derive(Debug, Clone, PartialEq)]
pub enum SpelValue {
    /// OPC UA Boolean.
    Boolean(bool),
    /// OPC UA SByte.
    Int8(i8),
    /// OPC UA Int16.
    Int16(i16),
    /// OPC UA Int32.
    Int32(i32),
    /// OPC UA Int64.
    Int64(i64),
    /// OPC UA Byte.
    UInt8(u8),
    /// OPC UA UInt16.
    UInt16(u16),
    /// OPC UA UInt32.
    UInt32(u32),
    /// OPC UA UInt64.
    UInt64(u64),
    /// OPC UA Float.
    Float(f32),
    /// OPC UA Double.
    Double(f64),
    /// OPC UA String.
    String(String),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_has_a_keyword_and_its_own_zero() {
        for kind in SpelType::ALL {
            assert_eq!(SpelType::from_keyword(&kind.keyword().to_uppercase()), Some(kind));
            let numeric = kind != SpelType::String;
            assert_eq!(kind.of_number(0.0) == kind.zero(), numeric, "{kind}");
        }
        assert_eq!(SpelType::from_keyword("Variant"), None);
    }

    #[test]
    fn numbers_are_limited_to_the_range_of_the_type() {
        assert_eq!(SpelType::Byte.of_number(300.0), SpelValue::Int8(127));
        assert_eq!(SpelType::UShort.of_number(-1.0), SpelValue::UInt16(0));
        assert_eq!(SpelType::UInt32.of_number(4.6), SpelValue::UInt32(5));
        assert_eq!(SpelType::String.of_number(1.5), SpelValue::String("1.5".to_owned()));
    }
}
