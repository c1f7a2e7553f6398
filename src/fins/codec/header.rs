//! The header of every command and response (W342 5-1-1).

use thiserror::Error;

use super::reader::Reader;

/// Bytes of a header.
pub const HEADER_BYTES: usize = 10;

/// Where a message comes from or goes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Endpoint {
    /// Network, 0 for the local one, to 127.
    pub network: u8,
    /// Node, 1 to 254; 0 for the node itself, 255 for all nodes.
    pub node: u8,
    /// Unit in the node: 0 for the CPU, 10 to 1F hex for CPU bus units.
    pub unit: u8,
}

impl Endpoint {
    /// The CPU of a node of the local network.
    pub const fn cpu(node: u8) -> Self {
        Self { network: 0, node, unit: 0 }
    }
}

/// Whether a message asks or answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MessageKind {
    /// A command that needs a response.
    Command,
    /// A command that must not be answered.
    CommandWithoutResponse,
    /// The response to a command.
    Response,
}

/// The ten bytes before a command or response.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Header {
    /// Whether the message asks or answers (bits 6 and 0 of ICF).
    pub kind: MessageKind,
    /// How many networks the message may still cross (GCT), 2 in a new message of CS and CJ, 7 of CJ2.
    pub gateways: u8,
    /// Where the message goes (DNA, DA1, DA2).
    pub destination: Endpoint,
    /// Where the message comes from (SNA, SA1, SA2).
    pub source: Endpoint,
    /// The number that a response repeats (SID).
    pub service_id: u8,
}

/// The bytes are too few for a header.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("{0} bytes are too few for a FINS header")]
pub struct ShortHeader(pub usize);

const ICF_USES_GATEWAY: u8 = 0x80;
const ICF_IS_RESPONSE: u8 = 0x40;
const ICF_NO_RESPONSE: u8 = 0x01;

/// The gateway count of new messages.
const GATEWAYS: u8 = 2;

impl Header {
    /// The header of a command that needs a response.
    pub const fn command(destination: Endpoint, source: Endpoint, service_id: u8) -> Self {
        Self { kind: MessageKind::Command, gateways: GATEWAYS, destination, source, service_id }
    }

    /// The header of the response to a command.
    pub const fn response_to(command: &Self) -> Self {
        Self {
            kind: MessageKind::Response,
            gateways: GATEWAYS,
            destination: command.source,
            source: command.destination,
            service_id: command.service_id,
        }
    }

    /// The ten bytes.
    pub const fn encode(&self) -> [u8; HEADER_BYTES] {
        let kind = match self.kind {
            MessageKind::Command => 0,
            MessageKind::CommandWithoutResponse => ICF_NO_RESPONSE,
            MessageKind::Response => ICF_IS_RESPONSE,
        };
        let Self { destination, source, .. } = self;
        [
            ICF_USES_GATEWAY | kind,
            0,
            self.gateways,
            destination.network,
            destination.node,
            destination.unit,
            source.network,
            source.node,
            source.unit,
            self.service_id,
        ]
    }

    /// The header at the beginning of a message, and what follows it. Reserved bits are ignored.
    ///
    /// # Errors
    /// Fewer than ten bytes.
    pub fn decode(message: &[u8]) -> Result<(Self, &[u8]), ShortHeader> {
        let mut reader = Reader(message);
        let bytes: [u8; HEADER_BYTES] = reader.array().ok_or(ShortHeader(message.len()))?;
        let [icf, _, gateways, dna, da1, da2, sna, sa1, sa2, service_id] = bytes;
        let kind = match (icf & ICF_IS_RESPONSE != 0, icf & ICF_NO_RESPONSE != 0) {
            (true, _) => MessageKind::Response,
            (false, true) => MessageKind::CommandWithoutResponse,
            (false, false) => MessageKind::Command,
        };
        let header = Self {
            kind,
            gateways,
            destination: Endpoint { network: dna, node: da1, unit: da2 },
            source: Endpoint { network: sna, node: sa1, unit: sa2 },
            service_id,
        };
        Ok((header, reader.0))
    }
}
