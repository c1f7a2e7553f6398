//! Request bodies: bounded in size and time.

use std::future::poll_fn;
use std::pin::pin;
use std::time::Duration;

use axum::body::{Body, Bytes, HttpBody as _};
use serde::de::DeserializeOwned;
use zeroize::Zeroizing;

use super::request_error::RequestError;
use crate::model::{Cause, ErrorCode};
use crate::protocol::MAX_REQUEST_BYTES;

/// For the whole body of a request.
const BODY_TIMEOUT: Duration = Duration::from_secs(10);
/// The bytes of a body over its limit that are read and discarded, so that the client can read the answer.
const MAX_DRAINED_BYTES: usize = 8 * MAX_REQUEST_BYTES;

/// The answer to a body that is not the message expected.
#[derive(Debug, Clone, Copy)]
pub(super) struct MalformedBody {
    code: ErrorCode,
    /// serde quotes what it did not understand, which may be a secret in the wrong place.
    quoted: bool,
}

impl MalformedBody {
    /// For a message without secrets: the answer quotes what is wrong.
    pub(super) const fn plain(code: ErrorCode) -> Self {
        Self { code, quoted: true }
    }

    /// For a message with a secret: the answer only says where it is wrong.
    pub(super) const fn secret(code: ErrorCode) -> Self {
        Self { code, quoted: false }
    }

    fn error(self, error: serde_json::Error) -> RequestError {
        let cause = if self.quoted {
            Cause::new(error)
        } else {
            let (line, column) = (error.line(), error.column());
            Cause::told(format_args!("not the message expected, at line {line}, column {column}"))
        };
        RequestError::Malformed { code: self.code, cause }
    }
}

/// Reads a body of at most [`MAX_REQUEST_BYTES`] within 10 s, of any media type.
pub(super) async fn read<T: DeserializeOwned>(body: Body, malformed: MalformedBody) -> Result<T, RequestError> {
    let collected = tokio::time::timeout(BODY_TIMEOUT, collect(body)).await;
    let bytes = collected.unwrap_or(Err(RequestError::Late))?;
    serde_json::from_slice(&bytes).map_err(|error| malformed.error(error))
}

async fn collect(body: Body) -> Result<Zeroizing<Vec<u8>>, RequestError> {
    let announced = usize::try_from(body.size_hint().lower()).unwrap_or(usize::MAX);
    if announced > MAX_DRAINED_BYTES {
        return Err(RequestError::TooLarge);
    }
    let mut body = pin!(body);
    // Never grown beyond what is announced, so that no copy of a secret is left behind.
    let capacity = if announced <= MAX_REQUEST_BYTES { announced } else { 0 };
    let mut bytes = Zeroizing::new(Vec::with_capacity(capacity));
    let mut total = 0_usize;
    while let Some(frame) = poll_fn(|cx| body.as_mut().poll_frame(cx)).await {
        let frame = frame.map_err(RequestError::BrokenOff)?;
        let data: Bytes = frame.into_data().unwrap_or_default();
        total = total.saturating_add(data.len());
        if total <= MAX_REQUEST_BYTES {
            bytes.extend_from_slice(&data);
        } else if total > MAX_DRAINED_BYTES {
            break;
        }
    }
    if total > MAX_REQUEST_BYTES { Err(RequestError::TooLarge) } else { Ok(bytes) }
}
