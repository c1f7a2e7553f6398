//! How the errors of remote commands become a [`Problem`]. No other file of the module makes one.

use super::client::{RemoteError, TargetError};
use super::codec::{Command, RefusalCode};
use crate::model::{ErrorCode, Problem, with_sources};

impl From<RemoteError> for Problem {
    fn from(error: RemoteError) -> Self {
        let code = match &error {
            RemoteError::Unreachable { .. } | RemoteError::ConnectTimeout { .. } => ErrorCode::Unreachable,
            RemoteError::SerialPort { .. } => ErrorCode::SerialPortUnavailable,
            RemoteError::NoAnswer { .. } => ErrorCode::RemoteNoAnswer,
            // A controller talks to one client: it closes the connection of a second one.
            RemoteError::ConnectionLost { command: Command::Login, .. } => ErrorCode::RemoteOccupied,
            RemoteError::ConnectionLost { .. } => ErrorCode::ConnectionLost,
            RemoteError::BadAnswer { .. } => ErrorCode::RemoteAnswerUnreadable,
            RemoteError::Refused { code, .. } => refused(*code),
            RemoteError::NotReady { .. } => ErrorCode::RemoteNotReady,
            RemoteError::OutcomeUnknown { .. } => ErrorCode::RemoteOutcomeUnknown,
            RemoteError::NotSent { .. } => ErrorCode::RemoteRequestInvalid,
        };
        Self::with_detail(code, with_sources(&error))
    }
}

const fn refused(code: RefusalCode) -> ErrorCode {
    match code {
        RefusalCode::UnknownCommand => ErrorCode::RemoteCommandUnknown,
        RefusalCode::WrongPassword => ErrorCode::RemoteWrongPassword,
        RefusalCode::PasswordRequired => ErrorCode::RemotePasswordRequired,
        RefusalCode::NoSuchVariable => ErrorCode::RemoteVariableUnknown,
        RefusalCode::BadChecksum | RefusalCode::TimedOut => ErrorCode::RemoteLineDisturbed,
        RefusalCode::NotReady => ErrorCode::RemoteNotReady,
        RefusalCode::ExecuteRunning => ErrorCode::RemoteExecuteRunning,
        RefusalCode::SystemError => ErrorCode::RemoteSystemError,
        RefusalCode::BadStart | RefusalCode::BadFormat | RefusalCode::BadCount | RefusalCode::Other(_) => {
            ErrorCode::RemoteRequestRefused
        }
    }
}

impl From<TargetError> for Problem {
    fn from(error: TargetError) -> Self {
        Self::with_detail(ErrorCode::BadRemoteTarget, with_sources(&error))
    }
}
