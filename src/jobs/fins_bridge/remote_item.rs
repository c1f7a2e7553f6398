//! What of a robot controller a row of a bridge reads or writes, as text.

use std::str::FromStr;

use thiserror::Error;

use crate::fins::data_type::DataType;
use crate::model::SpelType;
use crate::remote::{Element, VariableName};

/// An item of a robot controller.
///
/// | text | read | written |
/// |---|---|---|
/// | `io bit 5` | input bits from 5 on | output bits from 5 on |
/// | `io byte 1`, `io word 0` | input ports | output ports |
/// | `mem bit 5`, `mem byte 1`, `mem word 0` | memory I/O | memory I/O |
/// | `var name`, `var name(0)`, `var name(1,2)` | a variable, or elements of an array from there on | the same |
///
/// A variable has the type of its declaration: that which belongs to the row's type, or what follows `as`, such as
/// `var name as Integer`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RemoteItem {
    /// Bits, bytes or words of I/O.
    Io {
        /// Memory I/O instead of inputs and outputs.
        is_memory: bool,
        /// Bits, bytes or words.
        unit: IoUnit,
        /// The first one.
        first: u16,
    },
    /// A variable.
    Variable {
        /// Its name.
        name: VariableName,
        /// The element of an array.
        element: Option<Element>,
        /// The type of its declaration, where the row's type does not say it.
        kind: Option<SpelType>,
    },
}

/// How much of I/O is read or written at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IoUnit {
    /// One bit.
    Bit,
    /// Eight bits.
    Byte,
    /// Sixteen bits.
    Word,
}

/// Why a text is no item of a robot controller.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum RemoteItemError {
    /// It begins with none of the known words.
    #[error(
        "\"{0}\" is no item of a robot; there are io bit N, io byte N, io word N, mem bit N, mem byte N, mem word N, var NAME"
    )]
    Unknown(String),
    /// The name of a variable, its index or its type is wrong.
    #[error("\"{0}\" is no variable; write var name, var name(0), var name(1,2) or var name as Integer")]
    Variable(String),
    /// The item has no values of the row's type.
    #[error("\"{item}\" has no values of the type {data_type}")]
    Type {
        /// The item.
        item: String,
        /// The row's type.
        data_type: DataType,
    },
    /// More elements of an array than one command reads, or several values of a single variable.
    #[error("\"{0}\" cannot have so many values")]
    Count(String),
}

impl FromStr for RemoteItem {
    type Err = RemoteItemError;

    fn from_str(text: &str) -> Result<Self, RemoteItemError> {
        let unknown = || RemoteItemError::Unknown(text.to_owned());
        let (kind, rest) = text.trim().split_once(char::is_whitespace).ok_or_else(unknown)?;
        let is_memory = match kind.to_ascii_lowercase().as_str() {
            "var" => return variable(rest.trim()).ok_or_else(|| RemoteItemError::Variable(text.to_owned())),
            "io" => false,
            "mem" => true,
            _ => return Err(unknown()),
        };
        let (unit, first) = rest.trim().split_once(char::is_whitespace).ok_or_else(unknown)?;
        let unit = match unit.to_ascii_lowercase().as_str() {
            "bit" => IoUnit::Bit,
            "byte" => IoUnit::Byte,
            "word" => IoUnit::Word,
            _ => return Err(unknown()),
        };
        let first = first.trim();
        let first = first.parse().ok().filter(|_| first.bytes().all(|byte| byte.is_ascii_digit()));
        Ok(Self::Io { is_memory, unit, first: first.ok_or_else(unknown)? })
    }
}

fn variable(text: &str) -> Option<RemoteItem> {
    let (text, kind) = match text.split_once(" as ") {
        Some((text, kind)) => (text.trim(), Some(SpelType::from_keyword(kind.trim())?)),
        None => (text, None),
    };
    let (name, element) = match text.split_once('(') {
        None => (text, None),
        Some((name, indices)) => {
            let indices = indices.strip_suffix(')')?.split(',').map(|index| index.trim().parse::<u16>().ok());
            (name, Some(Element::new(&indices.collect::<Option<Vec<u16>>>()?)?))
        }
    };
    Some(RemoteItem::Variable { name: name.trim().parse().ok()?, element, kind })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_are_read_from_their_text() {
        let io = |is_memory, unit, first| Ok(RemoteItem::Io { is_memory, unit, first });
        assert_eq!("io bit 5".parse(), io(false, IoUnit::Bit, 5));
        assert_eq!("IO  word 0".parse(), io(false, IoUnit::Word, 0));
        assert_eq!("mem byte 12".parse(), io(true, IoUnit::Byte, 12));
        let variable = |name: &str, element: Option<&[u16]>, kind| {
            let element = element.and_then(Element::new);
            Ok(RemoteItem::Variable { name: name.parse().unwrap(), element, kind })
        };
        assert_eq!("var product".parse(), variable("product", None, None));
        assert_eq!("var g_Name$".parse(), variable("g_Name$", None, None));
        assert_eq!("var values(0)".parse(), variable("values", Some(&[0]), None));
        assert_eq!("var grid(1, 2) as Integer".parse(), variable("grid", Some(&[1, 2]), Some(SpelType::Integer)));
        for wrong in ["", "product", "io 5", "io bit", "io bit x", "io bit +5", "io nibble 1", "port word 1"] {
            assert_eq!(wrong.parse::<RemoteItem>(), Err(RemoteItemError::Unknown(wrong.into())), "{wrong}");
        }
        for wrong in ["var 5x", "var x(", "var x()", "var x(1,2,3,4)", "var x as Word", "var a b"] {
            assert_eq!(wrong.parse::<RemoteItem>(), Err(RemoteItemError::Variable(wrong.into())), "{wrong}");
        }
    }
}
