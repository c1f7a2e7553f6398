use std::fmt;

use opcua::types::{Error, StatusCode};

use super::watched_stream::StreamObservations;
use crate::model::untrusted_text::one_line;

/// How far a try came: what was being done when it failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ConnectStage {
    /// Opening the TCP connection.
    Connect,
    /// Hello, and opening the secure channel.
    Channel,
    /// Asking for the endpoints.
    Endpoints,
    /// The CreateSession request.
    CreateSession,
    /// ActivateSession: the user logs in.
    Login,
    /// The Read request.
    Read,
    /// Browsing, or finding a node by its path.
    Browse,
    /// The Write request.
    Write,
    /// Creating a subscription, or waiting for its notifications.
    Subscribe,
}

/// A try that did not succeed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConnectFailure {
    /// What was being done.
    pub stage: ConnectStage,
    /// Why it failed.
    pub cause: ConnectFailureCause,
}

/// Why it went no further.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ConnectFailureCause {
    /// No TCP connection came about; the operating system's words.
    NotReachable(String),
    /// No answer came within the limit.
    TimedOut,
    /// What answers is not an OPC UA server, or a broken one.
    NotOpcUa(String),
    /// The connection was closed without a word.
    Closed,
    /// The server's certificate is not the one it must be.
    OtherCertificate,
    /// The server, or this side's own checks, refused with an OPC UA status.
    Status {
        /// The status code of OPC 10000-6, annex A.
        code: u32,
        /// `BadSecurityChecksFailed` and the like.
        name: String,
        /// The server's own words, if it gave any.
        reason: String,
    },
    /// This side's fault.
    Internal(String),
}

impl ConnectFailure {
    pub(super) fn of(stage: ConnectStage, cause: ConnectFailureCause) -> Self {
        Self { stage, cause }
    }

    /// What the library says, put right by what was heard on the wire.
    pub(super) fn from_library(stage: ConnectStage, error: &Error, heard: &StreamObservations) -> Self {
        let cause = match (&heard.fault, &heard.last_word) {
            (Some(fault), _) => ConnectFailureCause::NotOpcUa(fault.clone()),
            (None, Some((code, reason))) => status(StatusCode::from(*code), reason),
            (None, None) => match error.status() {
                StatusCode::BadTimeout => ConnectFailureCause::TimedOut,
                StatusCode::BadDecodingError | StatusCode::BadEncodingLimitsExceeded => {
                    ConnectFailureCause::NotOpcUa("its answer cannot be read".to_owned())
                }
                StatusCode::BadCommunicationError | StatusCode::BadConnectionClosed => ConnectFailureCause::Closed,
                code => status(code, ""),
            },
        };
        Self { stage, cause }
    }

    /// The name of the OPC UA status, if it ended with one.
    pub fn status(&self) -> Option<&str> {
        match &self.cause {
            ConnectFailureCause::Status { name, .. } => Some(name),
            _ => None,
        }
    }

    /// Whether it reads as if the server does not take the certificate of this program.
    pub fn is_about_own_certificate(&self) -> bool {
        matches!(self.stage, ConnectStage::Channel | ConnectStage::CreateSession)
            && self.status().is_some_and(is_about_a_certificate)
    }

    /// Whether the server does not let this user in.
    pub fn is_about_the_login(&self) -> bool {
        self.stage == ConnectStage::Login && self.status().is_some_and(is_about_a_user)
    }
}

/// Whether a status says that a certificate is not accepted (OPC 10000-4 §6.1.3).
pub fn is_about_a_certificate(status: &str) -> bool {
    status == "BadSecurityChecksFailed" || status.starts_with("BadCertificate")
}

/// Whether a status says that a user may not log in (OPC 10000-4 §5.7.3).
pub fn is_about_a_user(status: &str) -> bool {
    ["BadUserAccessDenied", "BadIdentityTokenRejected", "BadIdentityTokenInvalid"].contains(&status)
}

pub(super) fn status(code: StatusCode, reason: &str) -> ConnectFailureCause {
    ConnectFailureCause::Status { code: code.bits(), name: code.sub_code().to_string(), reason: printable(reason) }
}

/// What a server wrote, as one line of at most 300 characters.
pub fn printable(text: &str) -> String {
    one_line(text.trim(), MAX_CHARS)
}

const MAX_CHARS: usize = 300;

impl fmt::Display for ConnectFailureCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotReachable(why) | Self::NotOpcUa(why) | Self::Internal(why) => f.write_str(why),
            Self::TimedOut => f.write_str("no answer in time"),
            Self::Closed => f.write_str("the connection was closed"),
            Self::OtherCertificate => f.write_str("the server shows another certificate"),
            Self::Status { name, reason, .. } if reason.is_empty() => f.write_str(name),
            Self::Status { name, reason, .. } => write!(f, "{name}: {reason}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_server_said_last_counts_more_than_that_the_connection_closed() {
        let error = Error::new(StatusCode::BadConnectionClosed, "closed");
        let heard = StreamObservations {
            last_word: Some((0x8013_0000, "\u{1b}[2Jno\r\n".into())),
            ..StreamObservations::default()
        };
        let failure = ConnectFailure::from_library(ConnectStage::Channel, &error, &heard);
        assert_eq!(failure.status(), Some("BadSecurityChecksFailed"));
        assert_eq!(failure.cause.to_string(), "BadSecurityChecksFailed: �[2Jno");
        assert_eq!(
            ConnectFailure::from_library(ConnectStage::Channel, &error, &StreamObservations::default()).cause,
            ConnectFailureCause::Closed
        );
        let heard = StreamObservations { fault: Some("a web server".into()), ..heard };
        assert_eq!(
            ConnectFailure::from_library(ConnectStage::Channel, &error, &heard).cause,
            ConnectFailureCause::NotOpcUa("a web server".into())
        );
    }
}
