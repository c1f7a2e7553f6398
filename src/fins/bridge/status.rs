//! What a bridge says of itself.

use std::time::Duration;

use chrono::{DateTime, Utc};
use thiserror::Error;

use super::super::client::{ClientError, WriteError};
use super::super::data_type::{Value, ValueError};
use super::robot::RobotError;

/// Live values, counters and errors of a bridge.
#[derive(Debug, Clone, Default)]
pub struct BridgeStatus {
    /// Whether the bridge runs.
    pub is_running: bool,
    /// Cycles so far.
    pub cycles: u64,
    /// Cycles in which every row was copied.
    pub complete_cycles: u64,
    /// How long the last cycle took.
    pub last_cycle: Duration,
    /// How long the longest cycle took.
    pub longest_cycle: Duration,
    /// The connection to the PLC.
    pub plc: SideStatus,
    /// The connection to the robot.
    pub robot: SideStatus,
    /// The rows, in the order of the map.
    pub rows: Vec<RowStatus>,
}

/// The connection to one side.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SideStatus {
    /// Whether it stood at the beginning of the last cycle.
    pub is_connected: bool,
    /// Connections so far.
    pub connections: u64,
}

/// What was copied in one row.
#[derive(Debug, Clone, Default)]
pub struct RowStatus {
    /// The values that were read last.
    pub values: Vec<Value>,
    /// When they were copied the last time.
    pub copied_at: Option<DateTime<Utc>>,
    /// How often they were copied.
    pub copied: u64,
    /// How often they were not.
    pub failed: u64,
    /// How often it is not known whether they were: part of `failed`.
    pub unknown: u64,
    /// Why they were not copied in the last cycle.
    pub error: Option<RowError>,
}

/// Why a row was not copied.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RowError {
    /// The PLC cannot be reached or read.
    #[error("PLC")]
    Plc(#[source] ClientError),
    /// The PLC cannot be written.
    #[error("PLC")]
    PlcWrite(#[source] WriteError),
    /// The robot cannot be reached, read or written.
    #[error("robot")]
    Robot(#[source] RobotError),
    /// The values do not fit into the destination.
    #[error("value")]
    Value(#[source] ValueError),
    /// The connection to the destination was lost after the row was read.
    #[error("the connection to the destination was made anew; the next cycle reads first")]
    ConnectedAnew,
}

impl RowError {
    /// Whether the values may be written without a confirmation.
    pub const fn is_unknown(&self) -> bool {
        match self {
            Self::PlcWrite(error) => error.is_unknown(),
            Self::Robot(error) => matches!(error, RobotError::Unknown(_)),
            Self::Plc(_) | Self::Value(_) | Self::ConnectedAnew => false,
        }
    }
}

impl BridgeStatus {
    pub(super) fn new(rows: usize) -> Self {
        Self { rows: vec![RowStatus::default(); rows], ..Self::default() }
    }
}
