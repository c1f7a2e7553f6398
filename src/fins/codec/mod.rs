//! FINS on the wire. Bytes in, values out; no I/O.
//!
//! | file | content |
//! |---|---|
//! | [`frame`] | the frames of FINS/TCP (W421 7-4), and a decoder for bytes as they arrive |
//! | [`header`] | the ten bytes before every command and response (W342 5-1-1) |
//! | [`command`] | commands and their parameters (W342 5-3) |
//! | [`response`] | responses: end code and data |
//! | [`end_code`] | end codes (W342 5-1-3) |
//! | [`cpu`] | what the commands 0501, 0601 and 0701 answer |
//!
//! A message is a header followed by a command or a response. Over UDP a datagram is a message; over TCP a message stands
//! in a frame. All numbers are big endian.

pub mod command;
pub mod cpu;
pub mod end_code;
pub mod frame;
pub mod header;
mod reader;
pub mod response;

#[cfg(test)]
mod tests;

/// Most bytes of a message: ten of header, two of command code, 2,000 of parameters and data (W421 7-2).
pub const MAX_MESSAGE_BYTES: usize = 2_012;
