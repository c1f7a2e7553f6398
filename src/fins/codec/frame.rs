//! The frames of FINS/TCP (W421 7-4): `FINS`, length, command, error code, body.

use std::fmt;

use thiserror::Error;

use super::MAX_MESSAGE_BYTES;
use super::reader::Reader;

/// Bytes before the body: `FINS`, length, command, error code, four bytes each.
pub const FRAME_HEADER_BYTES: usize = 16;

/// Most bytes of a frame.
pub const MAX_FRAME_BYTES: usize = FRAME_HEADER_BYTES + MAX_MESSAGE_BYTES;

const MAGIC: [u8; 4] = *b"FINS";
/// The length counts from the command on.
const COUNTED_HEADER_BYTES: usize = 8;

/// A frame of FINS/TCP.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TcpFrame {
    /// Command 0, the first frame of a client: its node, or 0 to be given one.
    ClientNode {
        /// 1 to 254, or 0.
        node: u32,
    },
    /// Command 1, the answer of the server: the nodes of both.
    ServerNode {
        /// Why the connection is refused.
        error: Option<TcpRefusal>,
        /// The node of the client.
        client: u32,
        /// The node of the server.
        server: u32,
    },
    /// Command 2: a FINS message.
    Message(Vec<u8>),
    /// Command 3: a frame was refused; the sender closes the connection.
    Refused(TcpRefusal),
    /// Command 6, from a server: another client asks for the same node. To be ignored by the client.
    Confirmation,
}

/// The error codes of FINS/TCP (W421 7-4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TcpRefusal {
    /// The header is not `FINS`.
    NotFins,
    /// The length is too long.
    TooLong,
    /// The command is not supported here.
    UnsupportedCommand,
    /// All connections of the server are in use.
    AllConnectionsInUse,
    /// The node of the client is connected already.
    NodeConnected,
    /// The client's IP address is not one of those that the server admits.
    ProtectedNode,
    /// The node of the client is not 1 to 254.
    NodeOutOfRange,
    /// Client and server have the same node.
    SameNode,
    /// No node is left to be given to the client.
    NoNodeLeft,
    /// A code that the manual does not have.
    Other(u32),
}

impl TcpRefusal {
    /// Every code of the manual.
    pub const ALL: [Self; 9] = [
        Self::NotFins,
        Self::TooLong,
        Self::UnsupportedCommand,
        Self::AllConnectionsInUse,
        Self::NodeConnected,
        Self::ProtectedNode,
        Self::NodeOutOfRange,
        Self::SameNode,
        Self::NoNodeLeft,
    ];

    /// The code on the wire.
    pub const fn code(self) -> u32 {
        match self {
            Self::NotFins => 0x01,
            Self::TooLong => 0x02,
            Self::UnsupportedCommand => 0x03,
            Self::AllConnectionsInUse => 0x20,
            Self::NodeConnected => 0x21,
            Self::ProtectedNode => 0x22,
            Self::NodeOutOfRange => 0x23,
            Self::SameNode => 0x24,
            Self::NoNodeLeft => 0x25,
            Self::Other(code) => code,
        }
    }

    /// `None` for 0, which is no refusal.
    pub fn from_code(code: u32) -> Option<Self> {
        (code != 0).then(|| Self::ALL.into_iter().find(|one| one.code() == code).unwrap_or(Self::Other(code)))
    }
}

impl fmt::Display for TcpRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let what = match self {
            Self::NotFins => "the header is not FINS",
            Self::TooLong => "the length is too long",
            Self::UnsupportedCommand => "the command is not supported",
            Self::AllConnectionsInUse => "all connections are in use",
            Self::NodeConnected => "the node is connected already",
            Self::ProtectedNode => "this IP address is not admitted",
            Self::NodeOutOfRange => "the client's node is out of range",
            Self::SameNode => "client and server have the same node",
            Self::NoNodeLeft => "no node is left for the client",
            Self::Other(_) => "unknown",
        };
        write!(f, "FINS/TCP error {:02X} hex: {what}", self.code())
    }
}

/// Why bytes are no frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FrameError {
    /// The bytes do not begin with `FINS`.
    #[error("the bytes do not begin with FINS")]
    NotFins,
    /// The length is more than a FINS message needs.
    #[error("a frame of {0} bytes is longer than FINS/TCP allows")]
    TooLong(u32),
    /// The length is less than the command of the frame needs.
    #[error("a frame of {length} bytes is too short for its command {command}")]
    TooShort {
        /// The length as received.
        length: u32,
        /// The command as received.
        command: u32,
    },
    /// The command is not known.
    #[error("the command {0} of FINS/TCP is not known")]
    UnknownCommand(u32),
}

impl FrameError {
    /// What a server answers.
    pub const fn refusal(self) -> TcpRefusal {
        match self {
            Self::NotFins => TcpRefusal::NotFins,
            Self::TooLong(_) => TcpRefusal::TooLong,
            Self::TooShort { .. } | Self::UnknownCommand(_) => TcpRefusal::UnsupportedCommand,
        }
    }
}

impl TcpFrame {
    /// The bytes of the frame.
    pub fn encode(&self) -> Vec<u8> {
        let (command, error, body) = match self {
            Self::ClientNode { node } => (0_u32, 0, node.to_be_bytes().to_vec()),
            Self::ServerNode { error, client, server } => {
                let nodes = [client.to_be_bytes(), server.to_be_bytes()].concat();
                (1, error.map_or(0, TcpRefusal::code), nodes)
            }
            Self::Message(message) => return Self::encode_message(message),
            Self::Refused(refusal) => (3, refusal.code(), Vec::new()),
            Self::Confirmation => (6, 0, Vec::new()),
        };
        frame(command, error, &body)
    }

    /// The bytes of a frame with a message.
    pub fn encode_message(message: &[u8]) -> Vec<u8> {
        frame(2, 0, message)
    }

    fn decode(command: u32, error: u32, body: &[u8]) -> Option<Self> {
        let mut reader = Reader(body);
        let mut number = || reader.array().map(u32::from_be_bytes);
        Some(match command {
            0 => Self::ClientNode { node: number()? },
            1 => Self::ServerNode { error: TcpRefusal::from_code(error), client: number()?, server: number()? },
            2 => Self::Message(body.to_vec()),
            3 => Self::Refused(TcpRefusal::from_code(error).unwrap_or(TcpRefusal::Other(0))),
            6 => Self::Confirmation,
            _ => return None,
        })
    }
}

fn frame(command: u32, error: u32, body: &[u8]) -> Vec<u8> {
    let length = u32::try_from(COUNTED_HEADER_BYTES + body.len()).unwrap_or(u32::MAX);
    let mut bytes = Vec::with_capacity(FRAME_HEADER_BYTES + body.len());
    bytes.extend(MAGIC);
    for number in [length, command, error] {
        bytes.extend(number.to_be_bytes());
    }
    bytes.extend(body);
    bytes
}

/// Makes frames of bytes as they arrive.
///
/// Holds at most the bytes that were fed and not yet taken as frames: take all frames after each [`FrameDecoder::feed`],
/// then it never holds more than one incomplete frame. After an error the stream cannot be read on.
#[derive(Debug, Default)]
pub struct FrameDecoder {
    buffer: Vec<u8>,
}

impl FrameDecoder {
    /// Adds bytes that arrived.
    pub fn feed(&mut self, bytes: &[u8]) {
        self.buffer.extend_from_slice(bytes);
    }

    /// The next whole frame; `None` if more bytes are needed. A wrong beginning or length is reported as soon as it is
    /// received.
    ///
    /// # Errors
    /// The bytes are no frame.
    pub fn next_frame(&mut self) -> Result<Option<TcpFrame>, FrameError> {
        let begins = self.buffer.len().min(MAGIC.len());
        if self.buffer[..begins] != MAGIC[..begins] {
            return Err(FrameError::NotFins);
        }
        let mut reader = Reader(&self.buffer[begins..]);
        let mut number = || reader.array().map(u32::from_be_bytes);
        let Some(length) = number() else { return Ok(None) };
        let too_long = FrameError::TooLong(length);
        let counted = usize::try_from(length).map_err(|_| too_long)?;
        if counted > COUNTED_HEADER_BYTES + MAX_MESSAGE_BYTES {
            return Err(too_long);
        }
        let (Some(command), Some(error)) = (number(), number()) else { return Ok(None) };
        let too_short = FrameError::TooShort { length, command };
        let body_bytes = counted.checked_sub(COUNTED_HEADER_BYTES).ok_or(too_short)?;
        let Some(body) = reader.take(body_bytes) else { return Ok(None) };
        let frame = match command {
            0..=3 | 6 => TcpFrame::decode(command, error, body).ok_or(too_short)?,
            _ => return Err(FrameError::UnknownCommand(command)),
        };
        self.buffer.drain(..FRAME_HEADER_BYTES + body_bytes);
        Ok(Some(frame))
    }

    /// Whether a frame has begun and not ended.
    pub fn is_inside_frame(&self) -> bool {
        !self.buffer.is_empty()
    }
}
