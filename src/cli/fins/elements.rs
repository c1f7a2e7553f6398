use clap::Args;

use crate::fins::address::{Address, AddressRange, Area};
use crate::fins::data_type::{DataType, ValueError, WordOrder};
use crate::model::{ErrorCode, Problem};

/// How values stand in words.
#[derive(Debug, Args)]
pub struct TypeArgs {
    /// Type of the values: u16, i16, u32, i32, f32, bcd, bcd32, text; bits have none
    #[arg(long = "type", value_name = "TYPE", default_value = "u16")]
    data_type: String,

    /// Word with the low half of a value of two words: low-first, high-first
    #[arg(long, value_name = "ORDER", default_value = "low-first")]
    word_order: String,
}

/// The type of values and the order of their words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Form {
    pub data_type: DataType,
    pub order: WordOrder,
}

impl TypeArgs {
    /// The form of values that begin at an address.
    pub fn form(&self, start: Address) -> Result<Form, Problem> {
        let data_type: DataType = self.data_type.parse()?;
        let order = self.word_order.parse()?;
        let data_type = match (start.is_bit(), data_type) {
            (true, _) => DataType::Bit,
            (false, DataType::Bit) => return Err(ValueError::NotOfType(start.to_string(), DataType::Bit).into()),
            (false, data_type) => data_type,
        };
        Ok(Form { data_type, order })
    }
}

/// What stands first of the arguments: `D300`, `D300-304`, `DM 300`. And the rest of the arguments.
pub fn first_elements(arguments: &[String]) -> Result<(AddressRange, &[String]), Problem> {
    let (first, rest) = arguments.split_first().ok_or_else(|| Problem::new(ErrorCode::BadPlcAddress))?;
    let (Some(_), Some((number, after))) = (Area::from_name(first), rest.split_first()) else {
        return Ok((first.parse()?, rest));
    };
    // `E1` with `200` is E1_200.
    let separator = if first.starts_with(['E', 'e']) { "_" } else { "" };
    Ok((format!("{first}{separator}{number}").parse()?, after))
}

/// The elements of `count` values, where a range names none, or only the first of them.
pub fn with_count(range: AddressRange, count: Option<usize>, form: Form) -> Result<AddressRange, Problem> {
    let elements = match count {
        Some(count) => count.saturating_mul(form.data_type.words()),
        None if range.count == 1 => form.data_type.words(),
        None => range.count.into(),
    };
    if !elements.is_multiple_of(form.data_type.words()) {
        return Err(ValueError::OddWords { words: elements, data_type: form.data_type }.into());
    }
    Ok(AddressRange::new(range.start, elements)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(arguments: &[&str]) -> Result<(String, usize), ErrorCode> {
        let arguments: Vec<String> = arguments.iter().map(ToString::to_string).collect();
        let (range, rest) = first_elements(&arguments).map_err(|problem| problem.code)?;
        Ok((range.to_string(), rest.len()))
    }

    #[test]
    fn area_and_address_are_one_argument_or_two() {
        for (arguments, range, rest) in [
            (&["D300"][..], "D300", 0),
            (&["DM", "300"], "D300", 0),
            (&["DM", "300.04", "5"], "D300.04", 1),
            (&["D300-304"], "D300-D304", 0),
            (&["E1", "200", "3"], "E1_200", 1),
            (&["em1_200"], "E1_200", 0),
            (&["CIO", "0.15"], "CIO0.15", 0),
            (&["10", "5"], "CIO10", 1),
            (&["W", "10-12", "1", "2", "3"], "W10-W12", 3),
        ] {
            assert_eq!(read(arguments), Ok((range.to_owned(), rest)), "{arguments:?}");
        }
        for wrong in [&["X5"][..], &["DM"], &["W", "512"]] {
            assert_eq!(read(wrong), Err(ErrorCode::BadPlcAddress), "{wrong:?}");
        }
    }

    #[test]
    fn a_count_is_one_of_values() {
        let form = |data_type| Form { data_type, order: WordOrder::LowFirst };
        let range = |text: &str, count, data_type| {
            with_count(text.parse().unwrap(), count, form(data_type)).map(|range| range.count).map_err(|p| p.code)
        };
        assert_eq!(range("D0", Some(3), DataType::F32), Ok(6));
        assert_eq!(range("D0", None, DataType::U32), Ok(2));
        assert_eq!(range("D0-5", None, DataType::U32), Ok(6));
        assert_eq!(range("D0-4", None, DataType::U32), Err(ErrorCode::BadPlcValue));
        assert_eq!(range("D32767", Some(2), DataType::U16), Err(ErrorCode::BadPlcAddress));
        assert_eq!(range("D0", Some(0), DataType::U16), Err(ErrorCode::BadPlcAddress));
    }
}
