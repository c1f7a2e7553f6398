//! How an error of the virtual controllers becomes a [`Problem`] of the commands that start them.

use crate::model::{ErrorCode, Problem, with_sources};
use crate::virtual_controller::{FleetError, SwitchOnError};

impl From<FleetError> for Problem {
    fn from(error: FleetError) -> Self {
        let code = match &error {
            FleetError::TooMany { .. }
            | FleetError::Ports { .. }
            | FleetError::SharedDevice { .. }
            | FleetError::Port(_) => ErrorCode::BadSettings,
            FleetError::Busy { .. } => ErrorCode::WorkspaceBusy,
            FleetError::Data { .. } => ErrorCode::WorkspaceReadOnly,
            FleetError::NoFreePort(_)
            | FleetError::Controller { source: SwitchOnError::Listen { .. } | SwitchOnError::Remote(_), .. } => {
                ErrorCode::CannotListen
            }
            FleetError::Address(_) => ErrorCode::BadAddress,
            FleetError::Controller { .. } | FleetError::Password(_) | FleetError::Name(_) | FleetError::Worker(_) => {
                ErrorCode::Internal
            }
        };
        Self::with_detail(code, with_sources(&error))
    }
}
