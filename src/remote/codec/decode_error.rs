use thiserror::Error;

use super::refusal::RefusalCode;

/// Why a message cannot be read: what is wrong, in which field, and where.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("{fault} (field {field}, byte {offset})")]
pub struct DecodeError {
    /// What is wrong.
    pub fault: Fault,
    /// The field, by its name in the command table, or a part of the frame (`start`, `command`, `ETX`, `BCC`).
    pub field: &'static str,
    /// Where the field begins, in bytes from the first byte of the message.
    pub offset: usize,
}

/// What is wrong with a field of a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Fault {
    /// A text that does not begin with `$`, or an answer with neither `#` nor `!`.
    #[error("the message does not begin as it has to")]
    NoStart,
    /// No command has this letter or name.
    #[error("the command is unknown")]
    UnknownCommand,
    /// The answer is one to another command.
    #[error("the answer belongs to another command")]
    OtherCommand,
    /// The message ends before the field.
    #[error("the field is missing")]
    Missing,
    /// The field has a form or characters that it cannot have.
    #[error("the field has a wrong form")]
    Malformed,
    /// The number is too large or too small.
    #[error("the number is out of range")]
    OutOfRange,
    /// The message, or the text in it, is longer than allowed.
    #[error("the field is too long")]
    TooLong,
    /// Something follows the last field.
    #[error("something follows the last field")]
    Trailing,
    /// The count is omitted or not 1–100, or elements of a String array are asked for.
    #[error("the count is omitted, not 1 to 100, or of strings")]
    Count,
    /// The checksum is wrong.
    #[error("the checksum is {found:02X} and should be {expected:02X}")]
    Checksum {
        /// Calculated from the bytes that came.
        expected: u8,
        /// Came.
        found: u8,
    },
    /// The peer stopped sending in the middle of the message.
    #[error("the message is not complete")]
    Incomplete,
}

impl DecodeError {
    /// The code with which a controller refuses such a request.
    pub const fn refusal(&self) -> RefusalCode {
        match self.fault {
            Fault::NoStart => RefusalCode::BadStart,
            Fault::UnknownCommand | Fault::OtherCommand => RefusalCode::UnknownCommand,
            Fault::Missing | Fault::Malformed | Fault::OutOfRange | Fault::TooLong | Fault::Trailing => {
                RefusalCode::BadFormat
            }
            Fault::Count => RefusalCode::BadCount,
            Fault::Checksum { .. } => RefusalCode::BadChecksum,
            Fault::Incomplete => RefusalCode::TimedOut,
        }
    }

    pub(super) const fn new(fault: Fault, field: &'static str, offset: usize) -> Self {
        Self { fault, field, offset }
    }
}

/// Why a message cannot be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum EncodeError {
    /// The command exists in the text form only.
    #[error("{0} cannot be sent in frames, only as text over Ethernet")]
    TextOnly(&'static str),
    /// A text holds a control character, which would end the message.
    #[error("the text has a control character, which cannot be sent")]
    ControlCharacter,
    /// A text or list is longer than the message can hold.
    #[error("the text is too long to be sent")]
    TooLong,
}
