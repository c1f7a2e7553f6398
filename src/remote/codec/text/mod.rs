//! The form over Ethernet: lines of text on a TCP connection (SPEL+ guide, remote Ethernet).
//!
//! | message | text |
//! |---|---|
//! | request | `$Command`, then each parameter after a comma |
//! | good answer | `#Command`, then each value after a comma; `,0` where there is none |
//! | refusal | `!Command,code` |
//!
//! A line ends with CR, LF or CR LF. Names may be written in any case; an answer repeats the name as it was sent. Numbers are
//! decimal, bytes and words of I/O hexadecimal with two and four digits. Values of String variables stand as they are,
//! without quotes; only the text and the result of Execute are quoted.

mod answer;
mod line;
mod request;

pub use answer::{AnswerDecoder, encode_refusal, encode_reply};
pub use line::Terminator;
pub use request::{RequestDecoder, Spelling, TextRequest, encode_request};

/// The TCP port of the text form that a controller uses unless it is set to another one.
pub const DEFAULT_PORT: u16 = 5000;
