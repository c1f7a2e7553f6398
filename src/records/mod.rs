//! The packets of the force sensor (manual 4.1.3) and the motion log (manual 4.3.3): layout, decode, encode, columns.
//! Bytes in, values out; no I/O.
//!
//! | level | for |
//! |---|---|
//! | views (`AllView`, [`motion::BlockView`], …) | reading single fields where they lie, without a copy |
//! | owned packets ([`force::ForceData`], [`motion::MotionBlock`], …) | making packets: `encode` gives their bytes |
//! | columns ([`force::ForceColumns`], [`motion::MotionColumns`]) | whole recordings, a vector a field |
//!
//! [`force::ForceRead::decode`] and [`motion::MotionRead::decode`] check the bytes of one read of a `Data` node. What is
//! no packet gives a [`RecordError`] with the field and its offset. Every number is little endian, nothing is padded.

pub mod columns;
mod error;
pub mod force;
mod layout;
pub mod motion;
mod signature;
mod text;
mod time;

pub use error::{Mistake, PacketKind, RecordError};
pub use layout::{Field, Wire};
pub use signature::{JOURNAL, begins_recording};
pub use text::Label;
pub use time::{ControllerTime, Ticks};

/// Bytes of one read at most: six thousand motion log blocks, where a controller sends 200.
pub const MAX_READ_BYTES: usize = 16 * 1024 * 1024;

#[cfg(test)]
mod tests;
