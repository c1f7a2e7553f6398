//! Which variable GetVariable and SetVariable are about.

use std::fmt;
use std::str::FromStr;

use super::decode_error::{DecodeError, EncodeError, Fault};
use super::field::Field;
use super::reader::Reader;
use super::value;
use crate::model::{SpelType, SpelValue};

/// The name of a variable: 1–40 letters, digits and underscores, the first no digit; a String's may end with `$`.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct VariableName(String);

/// The longest name, in bytes. SPEL+ allows 32 characters; room for newer firmware.
const MAX_NAME_BYTES: usize = 40;

impl VariableName {
    /// The name.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    fn from_bytes(bytes: &[u8]) -> Result<Self, Fault> {
        let (first, rest) = bytes.split_first().ok_or(Fault::Missing)?;
        if bytes.len() > MAX_NAME_BYTES {
            return Err(Fault::TooLong);
        }
        let rest = rest.strip_suffix(b"$").unwrap_or(rest);
        let is_word = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
        if !is_word(first) || first.is_ascii_digit() || !rest.iter().all(is_word) {
            return Err(Fault::Malformed);
        }
        Ok(Self(bytes.iter().copied().map(char::from).collect()))
    }
}

impl FromStr for VariableName {
    type Err = Fault;

    /// Errors: [`Fault::Missing`], [`Fault::Malformed`], [`Fault::TooLong`].
    fn from_str(name: &str) -> Result<Self, Fault> {
        Self::from_bytes(name.as_bytes())
    }
}

impl fmt::Display for VariableName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// An element of an array of one to three dimensions; every index begins with 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Element {
    indices: [u16; 3],
    dimensions: u8,
}

impl Element {
    /// `None` for no index and for more than three.
    pub fn new(indices: &[u16]) -> Option<Self> {
        let mut element = Self { indices: [0; 3], dimensions: u8::try_from(indices.len()).ok().filter(|d| *d > 0)? };
        element.indices.get_mut(..indices.len())?.copy_from_slice(indices);
        Some(element)
    }

    /// One index for each dimension.
    pub fn indices(&self) -> &[u16] {
        &self.indices[..usize::from(self.dimensions)]
    }
}

/// Elements of an array that one GetVariable asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ElementRange {
    /// The first element.
    pub first: Element,
    count: u8,
}

/// The most elements that one GetVariable asks for.
pub const MAX_ELEMENTS: u8 = 100;

impl ElementRange {
    /// `None` unless `count` is 1–100.
    pub fn new(first: Element, count: u16) -> Option<Self> {
        let count = u8::try_from(count).ok().filter(|count| (1..=MAX_ELEMENTS).contains(count))?;
        Some(Self { first, count })
    }

    /// How many, 1–100.
    pub const fn count(&self) -> u8 {
        self.count
    }
}

/// What GetVariable asks for. Only variables that are declared `Global Preserve` can be read and set.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VariableRead {
    /// The variable.
    pub name: VariableName,
    kind: SpelType,
    elements: Option<ElementRange>,
}

impl VariableRead {
    /// A variable that is no array. The type must be that of its declaration.
    pub const fn scalar(name: VariableName, kind: SpelType) -> Self {
        Self { name, kind, elements: None }
    }

    /// Elements of an array; `None` for an array of String, which cannot be read.
    pub fn elements(name: VariableName, kind: SpelType, elements: ElementRange) -> Option<Self> {
        (kind != SpelType::String).then_some(Self { name, kind, elements: Some(elements) })
    }

    /// The declared type.
    pub const fn kind(&self) -> SpelType {
        self.kind
    }

    /// Which elements of an array; `None` for a variable that is no array.
    pub const fn range(&self) -> Option<ElementRange> {
        self.elements
    }

    /// How many values the answer has.
    pub fn count(&self) -> usize {
        self.elements.map_or(1, |range| usize::from(range.count()))
    }

    fn checked(name: VariableName, kind: SpelType, first: Element, count: u64) -> Result<Self, Fault> {
        let range = u16::try_from(count).ok().and_then(|count| ElementRange::new(first, count));
        range.and_then(|range| Self::elements(name, kind, range)).ok_or(Fault::Count)
    }
}

impl Field for VariableRead {
    const WIDTH: Option<usize> = None;

    /// `name , type`, or `name , index , … type , count` with two bytes each for indices and count.
    fn put_frame(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        out.extend(self.name.as_str().as_bytes());
        out.push(b',');
        if let Some(range) = self.elements {
            for index in range.first.indices() {
                out.extend(index.to_be_bytes());
                out.push(b',');
            }
        }
        out.push(value::type_code(self.kind));
        if let Some(range) = self.elements {
            out.push(b',');
            out.extend(u16::from(range.count).to_be_bytes());
        }
        Ok(())
    }

    fn take_frame(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        let name = take_name(reader, b",")?;
        reader.expect(b',')?;
        reader.field("type");
        let at = reader.position();
        let rest = reader.rest();
        // Indices may hold any byte, commas too: the length decides how many there are.
        let dimensions = (1..=3).find(|dimensions| {
            let separators = (0..=*dimensions).map(|index| 3 * index + if index == *dimensions { 1 } else { 2 });
            rest.len() == 3 * dimensions + 4 && separators.into_iter().all(|at| rest[at] == b',')
        });
        let omitted = (1..=3).any(|dimensions| {
            rest.len() == 3 * dimensions + 1 && (0..dimensions).all(|index| rest[3 * index + 2] == b',')
        });
        let (code, code_at) = match (dimensions, rest) {
            (Some(dimensions), rest) => (rest[3 * dimensions], at + 3 * dimensions),
            (None, [code]) => (*code, at),
            (None, []) => return Err(reader.error_at(Fault::Missing, at)),
            (None, rest) if omitted => {
                reader.field("count");
                return Err(reader.error_at(Fault::Count, at + rest.len()));
            }
            (None, _) => return Err(reader.error_at(Fault::Malformed, at)),
        };
        let kind = value::type_from_code(code).ok_or_else(|| reader.error_at(Fault::OutOfRange, code_at))?;
        let Some(dimensions) = dimensions else { return Ok(Self::scalar(name, kind)) };
        let number = |at: usize| u16::from_be_bytes([rest[at], rest[at + 1]]);
        let indices: Vec<u16> = (0..dimensions).map(|index| number(3 * index)).collect();
        let first = Element::new(&indices).ok_or_else(|| reader.error_at(Fault::Malformed, at))?;
        let count_at = 3 * dimensions + 2;
        reader.field("count");
        Self::checked(name, kind, first, number(count_at).into()).map_err(|fault| reader.error_at(fault, at + count_at))
    }

    /// `name,Type`, or `name(index,…),Type,count`.
    fn put_text(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        out.push(b',');
        out.extend(self.name.as_str().as_bytes());
        if let Some(range) = self.elements {
            let indices: Vec<String> = range.first.indices().iter().map(ToString::to_string).collect();
            out.extend(format!("({})", indices.join(",")).into_bytes());
        }
        out.extend(format!(",{}", self.kind).into_bytes());
        if let Some(range) = self.elements {
            out.extend(format!(",{}", range.count).into_bytes());
        }
        Ok(())
    }

    fn take_text(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        reader.expect(b',')?;
        let name = take_name(reader, b",(")?;
        let first = take_element(reader)?;
        let kind = take_type(reader)?;
        let Some(first) = first else { return Ok(Self::scalar(name, kind)) };
        reader.field("count");
        if reader.is_at_end() {
            return Err(reader.error(Fault::Count));
        }
        let at = reader.position() + 1;
        let count = match reader.decimal() {
            // The manual counts a number that is left out behind the comma, and a negative one, as a wrong count.
            Err(DecodeError { fault: Fault::Missing | Fault::OutOfRange, .. }) => u64::MAX,
            other => other?,
        };
        Self::checked(name, kind, first, count).map_err(|fault| reader.error_at(fault, at))
    }
}

/// What SetVariable sets: a variable that is no array, and its new value.
#[derive(Debug, Clone, PartialEq)]
pub struct VariableWrite {
    /// The variable.
    pub name: VariableName,
    kind: SpelType,
    value: SpelValue,
}

impl VariableWrite {
    /// `None` if a variable of this type cannot hold such a value. The type must be that of the declaration.
    pub fn new(name: VariableName, kind: SpelType, value: SpelValue) -> Option<Self> {
        value::fits(kind, &value).then_some(Self { name, kind, value })
    }

    /// The declared type.
    pub const fn kind(&self) -> SpelType {
        self.kind
    }

    /// The new value.
    pub const fn value(&self) -> &SpelValue {
        &self.value
    }
}

impl Field for VariableWrite {
    const WIDTH: Option<usize> = None;

    /// `name , value , type`.
    fn put_frame(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        out.extend(self.name.as_str().as_bytes());
        out.push(b',');
        value::put_frame(&self.value, out)?;
        out.extend([b',', value::type_code(self.kind)]);
        Ok(())
    }

    fn take_frame(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        let name = take_name(reader, b",")?;
        reader.expect(b',')?;
        reader.field("value");
        let at = reader.position();
        // The value may hold any byte: the type behind it says how long it is.
        let rest = reader.rest();
        let [value @ .., b',', code] = rest else {
            let fault = if rest.is_empty() { Fault::Missing } else { Fault::Malformed };
            return Err(reader.error_at(fault, at));
        };
        let Some(kind) = value::type_from_code(*code) else {
            reader.field("type");
            return Err(reader.error_at(Fault::OutOfRange, at + rest.len() - 1));
        };
        let mut of_value = Reader::new(value, 0);
        let read = value::take_frame(kind, &mut of_value).and_then(|value| of_value.finish().map(|()| value));
        let value = read.map_err(|error| reader.error_at(error.fault, at + error.offset))?;
        Ok(Self { name, kind, value })
    }

    /// `name,value,Type`. A String stands without quotes, and may hold commas.
    fn put_text(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        out.extend(format!(",{},", self.name).into_bytes());
        value::put_text(&self.value, out)?;
        out.extend(format!(",{}", self.kind).into_bytes());
        Ok(())
    }

    fn take_text(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        reader.expect(b',')?;
        let name = take_name(reader, b",")?;
        reader.expect(b',')?;
        reader.field("value");
        let at = reader.position();
        let rest = reader.rest();
        let Some(comma) = rest.iter().rposition(|byte| *byte == b',') else {
            reader.field("type");
            return Err(reader.error(Fault::Missing));
        };
        let (text, keyword) = (&rest[..comma], &rest[comma + 1..]);
        let keyword = std::str::from_utf8(keyword).ok().and_then(SpelType::from_keyword);
        let Some(kind) = keyword else {
            reader.field("type");
            return Err(reader.error_at(Fault::Malformed, at + comma + 1));
        };
        let value = value::value_from_text(kind, &crate::model::controller_text(text));
        let value = value.map_err(|fault| reader.error_at(fault, at))?;
        Ok(Self { name, kind, value })
    }
}

fn take_name(reader: &mut Reader<'_>, ends: &[u8]) -> Result<VariableName, DecodeError> {
    reader.field("name");
    let at = reader.position();
    VariableName::from_bytes(reader.until(ends)).map_err(|fault| reader.error_at(fault, at))
}

/// `(i)`, `(i,j)` or `(i,j,k)`, or nothing.
fn take_element(reader: &mut Reader<'_>) -> Result<Option<Element>, DecodeError> {
    reader.field("element");
    let at = reader.position();
    if !reader.skip(b'(') {
        return Ok(None);
    }
    let text = reader.until(b")");
    reader.expect(b')')?;
    let index = |digits: &[u8]| {
        if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
            return Err(Fault::Malformed);
        }
        let digits: String = digits.iter().copied().map(char::from).collect();
        digits.parse::<u16>().map_err(|_| Fault::OutOfRange)
    };
    let indices: Result<Vec<u16>, Fault> = text.split(|byte| *byte == b',').map(index).collect();
    let element = indices.and_then(|indices| Element::new(&indices).ok_or(Fault::Malformed));
    element.map(Some).map_err(|fault| reader.error_at(fault, at))
}

fn take_type(reader: &mut Reader<'_>) -> Result<SpelType, DecodeError> {
    reader.field("type");
    let keyword = reader.parameter()?;
    let at = reader.position() - keyword.len();
    let kind = std::str::from_utf8(keyword).ok().and_then(SpelType::from_keyword);
    kind.ok_or_else(|| reader.error_at(Fault::Malformed, at))
}
