use chrono::{DateTime, Utc};

use crate::model::Problem;
use crate::remote::client::{ControllerIdentity, Observed, RemoteError, RemoteTarget};
use crate::remote::{MessageLanguage, Password, RemoteStatus, Reply, Request};

/// Where a watch connects, and how it logs in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RemoteConnection {
    /// Host and port, or a serial line.
    pub target: RemoteTarget,
    /// Empty where the controller has none.
    pub password: Password,
    /// In which language the controller is asked for the text of its error.
    pub language: MessageLanguage,
}

/// What a running watch is asked.
#[derive(Debug, Clone, PartialEq)]
pub enum RemoteControlRequest {
    /// Send these reading commands in each cycle from now on, and no others but GetStatus.
    Show(Vec<Request>),
    /// Do a command now. It is done at once or not at all: while there is no connection it is refused.
    Do(Request),
}

/// What a watch reports.
#[derive(Debug, Clone, PartialEq)]
pub enum RemoteControlEvent {
    /// It is connected and logged in: at first, and after each reconnection.
    Connected,
    /// The connection is lost, or could not be made. It is tried again.
    Lost(Problem),
    /// Trying again would not help. The watch is over.
    Ended(Problem),
    /// What the controller says about itself; once after each connection.
    Identity(Box<ControllerIdentity>),
    /// The state of the controller, in each cycle.
    Status {
        /// States and error number.
        status: RemoteStatus,
        /// The text of the error or warning, where the firmware has it.
        message: Option<String>,
    },
    /// The answers to the commands of [`RemoteControlRequest::Show`], in their order.
    Values(Vec<(Request, Result<Reply, RemoteError>)>),
    /// What became of the command of a [`RemoteControlRequest::Do`].
    Done {
        /// The command.
        request: Request,
        /// Its answer, or why it was not done or is not known to be done.
        result: Result<Reply, RemoteError>,
    },
    /// What went over the line since the last report, in its order.
    Exchanged(Vec<LoggedExchange>),
}

/// A message that went over the line, for the log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoggedExchange {
    /// When, by the clock of this PC.
    pub at: DateTime<Utc>,
    /// It belongs to a cycle, not to a command that was asked for.
    pub is_polling: bool,
    /// Direction and bytes. A password is masked.
    pub message: Observed,
}
