use std::io;

use thiserror::Error;
use tokio::task::JoinError;

use crate::model::{ErrorCode, RevisionToken};
use crate::pki::PkiError;
use crate::virtual_controller::change_error::{
    ActivationError, CertificateChangeError, SettingsChangeError, TransferError, TrustError, UserChangeError,
};
use crate::virtual_controller::faults::FaultRefusal;
use crate::virtual_controller::opcua::StartError;
use crate::virtual_controller::state::{StartRefusal, StateError};
use crate::virtual_controller::store::StoreError;

/// Why a controller does not do what it is asked for.
#[derive(Debug, Error)]
pub(in super::super) enum ControllerError {
    #[error("the controller is switched off")]
    SwitchedOff,
    #[error(transparent)]
    Fault(#[from] FaultRefusal),
    /// The change is based on another revision of the configuration than the present one.
    #[error("revision {base}, now {now}")]
    ChangedMeanwhile { base: RevisionToken, now: RevisionToken },
    #[error(transparent)]
    Settings(#[from] SettingsChangeError),
    #[error(transparent)]
    User(#[from] UserChangeError),
    #[error(transparent)]
    Activation(#[from] ActivationError),
    #[error(transparent)]
    Certificate(#[from] CertificateChangeError),
    #[error(transparent)]
    Transfer(#[from] TransferError),
    #[error(transparent)]
    Trust(#[from] TrustError),
    /// The change would break what holds in every state.
    #[error(transparent)]
    State(#[from] StateError),
    /// A certificate or a CRL of the client lists cannot be read.
    #[error(transparent)]
    TrustLists(PkiError),
    #[error(transparent)]
    Store(#[from] StoreError),
    #[error(transparent)]
    Start(#[from] ServerStartError),
    #[error(transparent)]
    Log(io::Error),
    /// A worker thread panicked.
    #[error(transparent)]
    Worker(#[from] JoinError),
}

/// Why the OPC UA server does not start.
#[derive(Debug, Error)]
pub(in super::super) enum ServerStartError {
    #[error(transparent)]
    Refused(#[from] StartRefusal),
    /// A certificate or a CRL of the client lists cannot be read.
    #[error(transparent)]
    TrustLists(PkiError),
    #[error("the server log is full")]
    LogFull,
    #[error("a fault switch is on")]
    FaultSwitch,
    #[error(transparent)]
    Server(#[from] StartError),
    /// A worker thread panicked.
    #[error(transparent)]
    Worker(#[from] JoinError),
}

impl ServerStartError {
    /// The error number that the controller shows from then on (manual 6.1).
    pub fn code(&self) -> ErrorCode {
        match self {
            Self::Refused(refusal) => refusal.code(),
            Self::TrustLists(error) => error.code(),
            Self::LogFull => ErrorCode::ServerLogFull,
            Self::FaultSwitch | Self::Server(StartError::Failed(_)) => ErrorCode::ServerError,
            Self::Server(StartError::PortInUse(_)) => ErrorCode::PortConflict,
            Self::Server(StartError::InvalidParameter(_)) => ErrorCode::InvalidParameter,
            Self::Worker(_) => ErrorCode::Internal,
        }
    }
}
