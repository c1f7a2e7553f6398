//! The form over a serial line, and over TCP to a serial device server: `STX command data ETX BCC` (SPEL+ guide, remote
//! RS232).
//!
//! | message | bytes |
//! |---|---|
//! | opens the remote function | `04` |
//! | request | `02`, letter, data, `03`, BCC |
//! | good answer | `06`, letter, data, `03`, BCC |
//! | refusal | `15`, letter, two digits, `03`, BCC |
//!
//! BCC is the exclusive or of every byte from the letter up to `03`. Data may hold any byte, `03` too: where a message ends
//! follows from its command. Requests with a text or a value of unknown length end at the first `03` that is followed by the
//! right BCC and makes a whole message. Where more may follow and the BCC is wrong, only silence on the line tells that
//! nothing does: both decoders are told of it, see [`LINE_SILENCE`].

mod answer;
mod message;
mod request;

use std::time::Duration;

pub use answer::{AnswerDecoder, encode_refusal, encode_reply};
pub use message::OPEN;
pub use request::{RequestDecoder, RequestEvent, encode_request};

/// How long no byte may come until a decoder is told that the peer has stopped sending. Twenty bytes at 9600 bit/s take
/// 21 ms; serial device servers wait some milliseconds before they send what came.
pub const LINE_SILENCE: Duration = Duration::from_millis(100);
