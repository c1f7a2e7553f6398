use std::time::Duration;

use thiserror::Error;

use crate::model::Cause;
use crate::remote::codec::{Command, Condition, DecodeError, EncodeError, RefusalCode, RemoteStatus};

/// Why a remote command failed. Unless it is [`RemoteError::OutcomeUnknown`], an acting command that failed was not done.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum RemoteError {
    /// There is no connection, and there was none for this command.
    #[error("{target} cannot be reached")]
    Unreachable {
        /// The target as text.
        target: String,
        /// Of the network.
        #[source]
        cause: Cause,
    },
    /// The connection was not made in time.
    #[error("{target} did not take the connection within {} s", after.as_secs_f32())]
    ConnectTimeout {
        /// The target as text.
        target: String,
        /// The limit.
        after: Duration,
    },
    /// The serial port cannot be opened: it does not exist, is in use, or this user may not open it.
    #[error("the serial port {device} cannot be opened")]
    SerialPort {
        /// Its name.
        device: String,
        /// Of the operating system.
        #[source]
        cause: Cause,
    },
    /// No complete answer came in time.
    #[error("no answer to {command} within {} s", after.as_secs_f32())]
    NoAnswer {
        /// The command.
        command: Command,
        /// The limit.
        after: Duration,
    },
    /// The connection ended before the answer was complete.
    #[error("the connection ended before the answer to {command}")]
    ConnectionLost {
        /// The command.
        command: Command,
        /// Of the operating system.
        #[source]
        cause: Cause,
    },
    /// What came is no answer.
    #[error("the answer to {command} cannot be read")]
    BadAnswer {
        /// The command.
        command: Command,
        /// What is wrong with it.
        #[source]
        error: DecodeError,
    },
    /// The controller refused, but for [`RemoteError::NotReady`].
    #[error("{command} was refused with code {code}")]
    Refused {
        /// The command.
        command: Command,
        /// Why.
        code: RefusalCode,
    },
    /// The controller refused with code 20: it is in a state in which the command is not accepted.
    #[error("{command} was refused: {}", unmet_text(unmet, *status))]
    NotReady {
        /// The command.
        command: Command,
        /// The conditions that the state after the refusal does not meet; empty if that state meets all of them.
        unmet: Vec<Condition>,
        /// The state after the refusal, if it could be read.
        status: Option<RemoteStatus>,
    },
    /// An acting command was sent, and whether it was done is unknown. It was not sent again.
    #[error("{command} was sent, and it is not known whether it was done")]
    OutcomeUnknown {
        /// The command.
        command: Command,
        /// What became of the answer.
        #[source]
        cause: Box<RemoteError>,
    },
    /// The request cannot be sent in this form. Nothing was sent.
    #[error("{command} cannot be sent")]
    NotSent {
        /// The command.
        command: Command,
        /// Why.
        #[source]
        error: EncodeError,
    },
}

fn unmet_text(unmet: &[Condition], status: Option<RemoteStatus>) -> String {
    match (status, unmet) {
        (None, _) => "the state could not be read afterwards".to_owned(),
        (Some(_), []) => "the state has changed since and meets all conditions now".to_owned(),
        (Some(_), unmet) => {
            let wanted: Vec<String> = unmet.iter().map(ToString::to_string).collect();
            format!("it needs {}", wanted.join(", "))
        }
    }
}
