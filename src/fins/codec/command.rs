//! Commands: a code of two bytes and parameters (W342 5-3).

use std::fmt;

use thiserror::Error;

use super::super::address::WireAddress;
use super::end_code::{EndCode, KnownEndCode};
use super::reader::Reader;

/// The code of a command: main and sub code (MRC and SRC).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct CommandCode(pub u16);

impl CommandCode {
    /// MEMORY AREA READ.
    pub const READ: Self = Self(0x0101);
    /// MEMORY AREA WRITE.
    pub const WRITE: Self = Self(0x0102);
    /// MEMORY AREA FILL.
    pub const FILL: Self = Self(0x0103);
    /// MULTIPLE MEMORY AREA READ.
    pub const READ_MULTIPLE: Self = Self(0x0104);
    /// MEMORY AREA TRANSFER.
    pub const TRANSFER: Self = Self(0x0105);
    /// CPU UNIT DATA READ.
    pub const CONTROLLER_DATA: Self = Self(0x0501);
    /// CPU UNIT STATUS READ.
    pub const STATUS: Self = Self(0x0601);
    /// CLOCK READ.
    pub const CLOCK: Self = Self(0x0701);
}

/// Four hexadecimal digits.
impl fmt::Display for CommandCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04X}", self.0)
    }
}

/// Which part of the controller data is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ControllerDataPart {
    /// Everything.
    All,
    /// 00: model, versions and sizes of the areas.
    CpuUnit,
    /// 01: CPU bus units, racks.
    CpuBusUnits,
}

/// A command with its parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Command {
    /// 0101: elements that follow each other.
    Read {
        /// The first element.
        start: WireAddress,
        /// How many.
        count: u16,
    },
    /// 0102: writes elements that follow each other.
    Write {
        /// The first element.
        start: WireAddress,
        /// How many.
        count: u16,
        /// Two bytes a word, one byte (0 or 1) a bit.
        data: Vec<u8>,
    },
    /// 0103: writes the same word to words that follow each other.
    Fill {
        /// The first word.
        start: WireAddress,
        /// How many.
        count: u16,
        /// The word.
        value: u16,
    },
    /// 0104: elements that need not follow each other.
    ReadMultiple(Vec<WireAddress>),
    /// 0105: copies words inside the PLC.
    Transfer {
        /// The first word to copy.
        from: WireAddress,
        /// Where the first word is copied to.
        to: WireAddress,
        /// How many words.
        count: u16,
    },
    /// 0501: model, version, sizes of the areas.
    ControllerData(ControllerDataPart),
    /// 0601: mode, errors, message.
    Status,
    /// 0701: the PLC's clock.
    Clock,
    /// Any other command.
    Other {
        /// Its code.
        code: CommandCode,
        /// Its parameters as they are.
        parameters: Vec<u8>,
    },
}

/// Why bytes are no command. The end code is what a PLC answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CommandError {
    /// The code or a parameter is missing.
    #[error("the command is too short")]
    TooShort,
    /// Bytes follow the parameters.
    #[error("the command is too long")]
    TooLong,
    /// The data has another length than the number of elements needs.
    #[error("the number of elements does not match the data")]
    CountMismatch,
    /// A parameter has a value that the command does not know.
    #[error("a parameter of the command is wrong")]
    BadParameter,
}

impl CommandError {
    /// What a PLC answers.
    pub fn end_code(self) -> EndCode {
        match self {
            Self::TooShort => KnownEndCode::CommandTooShort,
            Self::TooLong => KnownEndCode::CommandTooLong,
            Self::CountMismatch => KnownEndCode::ElementsAndDataDiffer,
            Self::BadParameter => KnownEndCode::ParameterError,
        }
        .into()
    }
}

impl Command {
    /// The code.
    pub const fn code(&self) -> CommandCode {
        match self {
            Self::Read { .. } => CommandCode::READ,
            Self::Write { .. } => CommandCode::WRITE,
            Self::Fill { .. } => CommandCode::FILL,
            Self::ReadMultiple(_) => CommandCode::READ_MULTIPLE,
            Self::Transfer { .. } => CommandCode::TRANSFER,
            Self::ControllerData(_) => CommandCode::CONTROLLER_DATA,
            Self::Status => CommandCode::STATUS,
            Self::Clock => CommandCode::CLOCK,
            Self::Other { code, .. } => *code,
        }
    }

    /// Whether a repetition changes something in the PLC. Commands that are not known count as such.
    pub const fn changes_memory(&self) -> bool {
        matches!(self, Self::Write { .. } | Self::Fill { .. } | Self::Transfer { .. } | Self::Other { .. })
    }

    /// Adds code and parameters to a message.
    pub fn encode_into(&self, message: &mut Vec<u8>) {
        message.extend(self.code().0.to_be_bytes());
        match self {
            Self::Read { start, count } => {
                start.encode_into(message);
                message.extend(count.to_be_bytes());
            }
            Self::Write { start, count, data } => {
                start.encode_into(message);
                message.extend(count.to_be_bytes());
                message.extend(data);
            }
            Self::Fill { start, count, value } => {
                start.encode_into(message);
                message.extend(count.to_be_bytes());
                message.extend(value.to_be_bytes());
            }
            Self::ReadMultiple(addresses) => addresses.iter().for_each(|address| address.encode_into(message)),
            Self::Transfer { from, to, count } => {
                from.encode_into(message);
                to.encode_into(message);
                message.extend(count.to_be_bytes());
            }
            Self::ControllerData(ControllerDataPart::CpuUnit) => message.push(0),
            Self::ControllerData(ControllerDataPart::CpuBusUnits) => message.push(1),
            Self::ControllerData(ControllerDataPart::All) | Self::Status | Self::Clock => {}
            Self::Other { parameters, .. } => message.extend(parameters),
        }
    }

    /// Reads code and parameters, which are all that follows a header.
    ///
    /// # Errors
    /// Parameters that the command cannot have. An area code that is not known is no error here.
    pub fn decode(bytes: &[u8]) -> Result<Self, CommandError> {
        let mut reader = Reader(bytes);
        let code = CommandCode(reader.u16().ok_or(CommandError::TooShort)?);
        let command = match code {
            CommandCode::READ => Self::Read { start: address(&mut reader)?, count: count(&mut reader)? },
            CommandCode::WRITE => {
                let (start, count) = (address(&mut reader)?, count(&mut reader)?);
                let data = std::mem::take(&mut reader.0).to_vec();
                // Whether an unknown area has bits or words cannot be judged here.
                let needed = start.element_size().map(|size| size * usize::from(count));
                if needed.is_some_and(|needed| needed != data.len()) {
                    return Err(CommandError::CountMismatch);
                }
                Self::Write { start, count, data }
            }
            CommandCode::FILL => {
                let (start, count) = (address(&mut reader)?, count(&mut reader)?);
                Self::Fill { start, count, value: reader.u16().ok_or(CommandError::TooShort)? }
            }
            CommandCode::READ_MULTIPLE => {
                let mut addresses = Vec::with_capacity(reader.0.len() / WIRE_ADDRESS_BYTES);
                while !reader.0.is_empty() {
                    addresses.push(address(&mut reader)?);
                }
                Self::ReadMultiple(addresses)
            }
            CommandCode::TRANSFER => {
                let (from, to) = (address(&mut reader)?, address(&mut reader)?);
                Self::Transfer { from, to, count: count(&mut reader)? }
            }
            CommandCode::CONTROLLER_DATA => Self::ControllerData(match reader.u8() {
                None => ControllerDataPart::All,
                Some(0) => ControllerDataPart::CpuUnit,
                Some(1) => ControllerDataPart::CpuBusUnits,
                Some(_) => return Err(CommandError::BadParameter),
            }),
            CommandCode::STATUS => Self::Status,
            CommandCode::CLOCK => Self::Clock,
            code => Self::Other { code, parameters: std::mem::take(&mut reader.0).to_vec() },
        };
        if reader.0.is_empty() { Ok(command) } else { Err(CommandError::TooLong) }
    }
}

/// Area code, word, bit.
pub const WIRE_ADDRESS_BYTES: usize = 4;

impl WireAddress {
    fn encode_into(self, message: &mut Vec<u8>) {
        message.push(self.code);
        message.extend(self.word.to_be_bytes());
        message.push(self.bit);
    }
}

fn address(reader: &mut Reader<'_>) -> Result<WireAddress, CommandError> {
    let mut read = || Some(WireAddress { code: reader.u8()?, word: reader.u16()?, bit: reader.u8()? });
    read().ok_or(CommandError::TooShort)
}

fn count(reader: &mut Reader<'_>) -> Result<u16, CommandError> {
    reader.u16().ok_or(CommandError::TooShort)
}
