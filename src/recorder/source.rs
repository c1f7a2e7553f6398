use async_trait::async_trait;
use thiserror::Error;

use super::settings::RecordSettings;
use crate::session::opcua_client::{ConnectFailure, ServerConnectError};

/// Value of an `ErrorStatus` node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ErrorStatus {
    /// Nothing is wrong.
    #[default]
    None,
    /// Samples were overwritten since the last read.
    Warning,
    /// The controller broke off.
    Error,
}

/// What the status nodes say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SourceStatus {
    /// MonitorStatus or LoggingStatus is `Run`.
    pub is_running: bool,
    /// DataExistsStatus is `Ready`.
    pub has_data: bool,
    /// ErrorStatus.
    pub error: ErrorStatus,
}

/// What one read brought.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Delivery {
    /// ErrorStatus before the read, which sets a `Warning` back.
    pub error: ErrorStatus,
    /// `None`: there was no data.
    pub packet: Option<Vec<u8>>,
    /// DataExistsStatus after the read.
    pub has_more: bool,
}

/// The data of one controller, over one connection.
#[async_trait]
pub trait PacketSource: Send {
    /// Writes the settings to the controller.
    async fn configure(&mut self, settings: &RecordSettings) -> Result<(), SourceError>;
    /// Reads the status nodes.
    async fn status(&mut self) -> Result<SourceStatus, SourceError>;
    /// Takes the next packet out of the controller's queue.
    async fn read(&mut self) -> Result<Delivery, SourceError>;
    /// Puts back what [`PacketSource::configure`] changed, as far as that is possible, and disconnects.
    async fn close(self: Box<Self>);
}

/// Connects to the data of one controller, at first and again after the connection was lost.
#[async_trait]
pub trait SourceConnector: Send + Sync {
    /// Opens a connection.
    async fn connect(&self) -> Result<Box<dyn PacketSource>, SourceError>;
}

/// Why there is no data from a controller.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SourceError {
    /// No session with the OPC UA server.
    #[error(transparent)]
    Connect(#[from] ServerConnectError),
    /// The session ended, or a request in it failed.
    #[error("{} at stage {:?}", .0.cause, .0.stage)]
    Session(ConnectFailure),
    /// The server has no nodes for this data.
    #[error("the server has no {0} data")]
    NoNodes(&'static str),
    /// The server refused a setting.
    #[error("{node} cannot be set: {status}")]
    SettingRefused {
        /// The name of the node.
        node: &'static str,
        /// The name of the OPC UA status.
        status: String,
    },
    /// A node has a value that it must not have.
    #[error("{node} has the value {value}")]
    OddValue {
        /// The name of the node.
        node: &'static str,
        /// The value, or its type.
        value: String,
    },
}

impl SourceError {
    /// Whether a later try may succeed without anybody doing anything.
    pub const fn may_pass(&self) -> bool {
        match self {
            Self::Session(_) => true,
            Self::Connect(error) => {
                matches!(error, ServerConnectError::NotRunning(_) | ServerConnectError::Failed(_))
            }
            Self::NoNodes(_) | Self::SettingRefused { .. } | Self::OddValue { .. } => false,
        }
    }
}
