use std::fmt;

use thiserror::Error;

/// Which kind of packet the bytes were read as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PacketKind {
    /// The kind is not known yet: the tag says it.
    Force,
    ForceHeader,
    ForceData,
    ForceFooter,
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
    pub mistake: Mistake,
}

/// What is wrong with a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Mistake {
    #[error("the bytes end here, {missing} too early")]
    Truncated { missing: usize },
    #[error("{excess} bytes follow the end of the packet")]
    Oversized { excess: usize },
    #[error("{length} bytes are more than one read may bring ({max})")]
    TooLarge { length: usize, max: usize },
    #[error("the value is {found}; {expected}")]
    Value { found: u64, expected: &'static str },
}
