//! Responses: the code of the command, an end code and data (W342 5-3).

use thiserror::Error;

use super::super::address::WireAddress;
use super::command::CommandCode;
use super::end_code::EndCode;
use super::reader::Reader;

/// A response as it is, before its data is read as that of a certain command.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Response {
    /// The code of the command that is answered.
    pub code: CommandCode,
    /// How the command ended.
    pub end: EndCode,
    /// What follows the end code.
    pub data: Vec<u8>,
}

/// Why bytes are no response, or not the response to a certain command.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ResponseError {
    /// Command code or end code are missing.
    #[error("{0} bytes are too few for a FINS response")]
    TooShort(usize),
    /// The data has another length than the command needs.
    #[error("the response to {code} has {found} bytes of data instead of {expected}")]
    WrongLength {
        /// The command.
        code: CommandCode,
        /// Bytes that came.
        found: usize,
        /// Bytes that the command needs.
        expected: usize,
    },
    /// An element of a multiple read is of another area than was asked for.
    #[error("the response names the area {found:02X} hex instead of {expected:02X} hex")]
    OtherArea {
        /// The code that came.
        found: u8,
        /// The code that was asked for.
        expected: u8,
    },
    /// A value that cannot be, such as the month 13.
    #[error("the response has an impossible {0}")]
    BadValue(&'static str),
}

/// An element as it travels: a word, or a bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Element {
    /// A word, or the present value of a timer or counter.
    Word(u16),
    /// A bit, or a completion flag.
    Bit(bool),
}

impl Response {
    /// A response without data.
    pub const fn ended(code: CommandCode, end: EndCode) -> Self {
        Self { code, end, data: Vec::new() }
    }

    /// A response of a command that succeeded.
    pub const fn with_data(code: CommandCode, data: Vec<u8>) -> Self {
        Self { code, end: EndCode::NORMAL, data }
    }

    /// Adds command code, end code and data to a message.
    pub fn encode_into(&self, message: &mut Vec<u8>) {
        message.extend(self.code.0.to_be_bytes());
        message.extend(self.end.to_wire().to_be_bytes());
        message.extend(&self.data);
    }

    /// Reads all that follows a header.
    ///
    /// # Errors
    /// Fewer than four bytes.
    pub fn decode(bytes: &[u8]) -> Result<Self, ResponseError> {
        let mut reader = Reader(bytes);
        let (Some(code), Some(end)) = (reader.u16(), reader.u16()) else {
            return Err(ResponseError::TooShort(bytes.len()));
        };
        Ok(Self { code: CommandCode(code), end: EndCode::from_wire(end), data: reader.0.to_vec() })
    }

    /// The network and node where a relay error occurred (W342 5-1-3).
    pub fn relay_error_at(&self) -> Option<(u8, u8)> {
        let mut reader = Reader(&self.data);
        if self.end.is_relay_error { reader.u8().zip(reader.u8()) } else { None }
    }

    fn wrong_length(&self, expected: usize) -> ResponseError {
        ResponseError::WrongLength { code: self.code, found: self.data.len(), expected }
    }

    fn exactly(&self, expected: usize) -> Result<&[u8], ResponseError> {
        if self.data.len() == expected { Ok(&self.data) } else { Err(self.wrong_length(expected)) }
    }

    /// The words of a memory area read.
    ///
    /// # Errors
    /// Another number of words.
    pub fn words(&self, count: u16) -> Result<Vec<u16>, ResponseError> {
        let data = self.exactly(usize::from(count) * 2)?;
        Ok(data.chunks_exact(2).map(|word| u16::from_be_bytes([word[0], word[1]])).collect())
    }

    /// The bits or completion flags of a memory area read. Bit 0 of a byte is the state; the others show forced states.
    ///
    /// # Errors
    /// Another number of bits.
    pub fn bits(&self, count: u16) -> Result<Vec<bool>, ResponseError> {
        Ok(self.exactly(usize::from(count))?.iter().map(|byte| byte & 1 != 0).collect())
    }

    /// The elements of a multiple memory area read: an area code and the value, each.
    ///
    /// # Errors
    /// Other areas than those asked for, or another length.
    pub fn elements(&self, asked: &[WireAddress]) -> Result<Vec<Element>, ResponseError> {
        let size = |address: &WireAddress| address.element_size().unwrap_or(2);
        let expected = asked.iter().map(|address| 1 + size(address)).sum();
        let mut reader = Reader(self.exactly(expected)?);
        let mut elements = Vec::with_capacity(asked.len());
        for address in asked {
            let found = reader.u8().ok_or_else(|| self.wrong_length(expected))?;
            if found != address.code {
                return Err(ResponseError::OtherArea { found, expected: address.code });
            }
            let element = match size(address) {
                1 => reader.u8().map(|byte| Element::Bit(byte & 1 != 0)),
                _ => reader.u16().map(Element::Word),
            };
            elements.push(element.ok_or_else(|| self.wrong_length(expected))?);
        }
        Ok(elements)
    }
}
