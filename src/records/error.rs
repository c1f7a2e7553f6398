use std::fmt;

use thiserror::Error;

/// Which kind of packet the bytes were read as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PacketKind {
    /// The kind is not known yet: the tag says it.
    Force,
    /// The packet that begins a recording of a force sensor.
    ForceHeader,
    /// A packet with records of a force sensor.
    ForceData,
    /// The packet that ends a recording of a force sensor.
    ForceFooter,
    /// A block of the motion log.
    MotionBlock,
}

impl fmt::Display for PacketKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Force => "force sensor packet",
            Self::ForceHeader => "force sensor header",
            Self::ForceData => "force sensor data",
            Self::ForceFooter => "force sensor footer",
            Self::MotionBlock => "motion log block",
        })
    }
}

/// Why bytes are no packet: which field at which offset, and what is wrong there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("{packet} {record}, field {field} at byte {offset}: {mistake}")]
pub struct RecordError {
    /// What the bytes were read as.
    pub packet: PacketKind,
    /// Which packet of one read, counted from 0.
    pub record: usize,
    /// The name in the manual's table.
    pub field: &'static str,
    /// From the start of the read bytes.
    pub offset: usize,
    /// What is wrong with it.
    pub mistake: Mistake,
}

/// What is wrong with a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Mistake {
    /// The packet ends before the field does.
    #[error("the bytes end here, {missing} too early")]
    Truncated {
        /// Bytes that are missing.
        missing: usize,
    },
    /// Bytes follow the packet.
    #[error("{excess} bytes follow the end of the packet")]
    Oversized {
        /// How many.
        excess: usize,
    },
    /// More bytes came than one read may bring.
    #[error("{length} bytes are more than one read may bring ({max})")]
    TooLarge {
        /// Bytes that came.
        length: usize,
        /// Most bytes of one read.
        max: usize,
    },
    /// The field has a value that the layout does not know.
    #[error("the value is {found}; {expected}")]
    Value {
        /// The value.
        found: u64,
        /// The values that the layout knows, in English.
        expected: &'static str,
    },
}
