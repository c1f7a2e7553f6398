//! The remote commands as messages: bytes in, messages out, and the other way round, for both forms and for both sides. It
//! does no I/O.
//!
//! # Files
//! Each uses only those above it.
//!
//! | file | idea |
//! |---|---|
//! | `refusal` | [`RefusalCode`]: why a controller refuses |
//! | `decode_error` | [`DecodeError`], [`EncodeError`]: why a message cannot be read or written |
//! | `acceptance` | [`Condition`]: in which states a command is accepted |
//! | `status` | [`RemoteStatus`]: the answer to GetStatus |
//! | `received` | bytes that have come |
//! | `reader` | the fields of a message, front to back |
//! | `value` | values of variables |
//! | `field` | the parameters of commands |
//! | `variable` | which variable, which elements of an array |
//! | `reply_kind` | the form of a command's answer |
//! | `command` | the table of all commands: [`Command`] and [`Request`] |
//! | `reply` | [`Reply`] and [`Answer`] |
//! | [`mod@frame`] | frames: `STX command data ETX BCC` |
//! | [`mod@text`] | text: `$Command,…`, `#Command,…`, `!Command,code` |
//!
//! # Decisions
//! - GetStatus has eleven flags, Test first; the ten flags of old firmware are understood.
//! - Refusal codes in frames are two ASCII digits. The manual does not say so; all its other codes are.
//! - The value of SetMemIOWord has two bytes. A table of the manual says one, its example has two.
//! - A Boolean variable is 0 or 1; -1 is read as true. A String stands as it is, without quotes, in both forms: a text in
//!   quotes would be stored with them.
//! - Elements of arrays are read; SetVariable sets variables that are no arrays, as the manual describes it.

mod acceptance;
mod command;
mod decode_error;
mod field;
pub mod frame;
mod reader;
mod received;
mod refusal;
mod reply;
mod reply_kind;
mod status;
#[cfg(test)]
mod tests;
pub mod text;
mod value;
mod variable;

pub use acceptance::Condition;
pub use command::{Command, Effect, Request};
pub use decode_error::{DecodeError, EncodeError, Fault};
pub use field::{
    AlarmNumber, BitNumber, ErrorNumber, FunctionNumber, JointNumber, MAX_COMMAND_BYTES, MAX_PASSWORD_CHARS,
    MAX_RESULT_BYTES, MessageLanguage, PartNumber, Password, PortNumber, RobotNumber, SpelCommand,
};
pub use refusal::RefusalCode;
pub use reply::{Answer, Reply};
pub use status::RemoteStatus;
pub use value::{MAX_STRING_BYTES, value_from_text, value_text};
pub use variable::{Element, ElementRange, MAX_ELEMENTS, VariableName, VariableRead, VariableWrite};
