use axum::http::StatusCode;
use thiserror::Error;
use tokio::task::JoinError;

use crate::model::{Cause, ErrorCode};
use crate::protocol;
use crate::virtual_controller::request_heads::RejectedHead;

/// Why a request is not understood, or not taken.
#[derive(Debug, Error)]
pub(super) enum RequestError {
    #[error("a request without a connection")]
    NoConnection,
    #[error("the request has no token of a session")]
    NoSession,
    #[error("no such path")]
    UnknownPath,
    #[error("this path does not take this method")]
    UnknownMethod,
    #[error("from=BYTE is all that can be asked for")]
    Query,
    #[error(transparent)]
    Head(#[from] RejectedHead),
    #[error("the request did not arrive in time")]
    Late,
    #[error("the request broke off")]
    BrokenOff(#[source] axum::Error),
    #[error("the body is larger than {} bytes", protocol::MAX_REQUEST_BYTES)]
    TooLarge,
    /// The body is not the message expected. The code says which that is.
    #[error("{cause}")]
    Malformed {
        code: ErrorCode,
        #[source]
        cause: Cause,
    },
    /// A worker thread panicked.
    #[error(transparent)]
    Worker(#[from] JoinError),
}

impl RequestError {
    /// The status where it is not [`protocol::status_of`] the error code.
    pub fn status(&self) -> Option<StatusCode> {
        match self {
            Self::UnknownPath => Some(StatusCode::NOT_FOUND),
            Self::UnknownMethod => Some(StatusCode::METHOD_NOT_ALLOWED),
            Self::Head(head) => Some(head.status()),
            _ => None,
        }
    }
}
