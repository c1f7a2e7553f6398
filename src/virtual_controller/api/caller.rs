//! The sender of a request.

use std::future::pending;
use std::net::IpAddr;
use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::extract::FromRequestParts;
use axum::http::header;
use axum::http::request::Parts;
use parking_lot::Mutex;
use tokio::sync::Mutex as AsyncMutex;
use tokio_util::sync::CancellationToken;

use super::failed::FailedRequest;
use super::request_error::RequestError;
use crate::protocol::WireSecret;
use crate::virtual_controller::controller::{ChangeFailure, Controller};
use crate::virtual_controller::login::{LoginThrottle, ManagementSessions};
use crate::virtual_controller::peer::PeerConnection;

/// The management protocol of one controller.
#[derive(Debug)]
pub struct ManagementApi {
    pub(super) controller: Arc<Controller>,
    /// Locked while a password is compared, so that two guesses at the same time are both counted.
    pub(super) throttle: AsyncMutex<LoginThrottle>,
    pub(super) sessions: Mutex<ManagementSessions>,
}

/// The connection that a request arrived on.
#[derive(Debug, Clone)]
pub struct ClientConnection {
    pub api: Arc<ManagementApi>,
    pub peer: Arc<PeerConnection>,
    /// The controller's address the client used.
    pub local: IpAddr,
    /// Cuts the connection without an answer.
    pub cut: CancellationToken,
}

impl ManagementApi {
    pub fn new(controller: Arc<Controller>) -> Self {
        Self { controller, throttle: AsyncMutex::default(), sessions: Mutex::default() }
    }

    pub fn latency(&self) -> Duration {
        self.controller.faults().get().latency
    }
}

/// The sender of a request that carries the token of a session.
pub(super) struct Caller {
    pub(super) connection: ClientConnection,
    pub(super) token: WireSecret,
}

impl Caller {
    pub(super) fn controller(&self) -> &Arc<Controller> {
        &self.connection.api.controller
    }

    /// The controller's address that the client used.
    pub(super) fn local_address(&self) -> IpAddr {
        self.connection.local
    }

    /// The result of a change. If a fault switch asks for the connection to be lost here, it is cut and this never returns.
    pub(super) async fn settle<T>(&self, outcome: Result<T, ChangeFailure>) -> Result<T, FailedRequest> {
        match outcome {
            Ok(value) => Ok(value),
            Err(ChangeFailure::Error(error)) => Err(error.into()),
            Err(ChangeFailure::Dropped) => {
                self.connection.cut.cancel();
                pending().await
            }
        }
    }
}

impl<S: Send + Sync> FromRequestParts<S> for Caller {
    type Rejection = FailedRequest;

    async fn from_request_parts(parts: &mut Parts, _state: &S) -> Result<Self, FailedRequest> {
        let connection = parts.extensions.get::<ClientConnection>().cloned().ok_or(RequestError::NoConnection)?;
        let token = parts
            .headers
            .get(header::AUTHORIZATION)
            .and_then(|value| value.to_str().ok())
            .and_then(|value| value.strip_prefix("Bearer "))
            .ok_or(RequestError::NoSession)?;
        if !connection.api.sessions.lock().touch(token, Instant::now()) {
            return Err(RequestError::NoSession.into());
        }
        connection.peer.has_session();
        let token = WireSecret(token.into());
        Ok(Self { connection, token })
    }
}

pub(super) async fn unknown_path() -> FailedRequest {
    RequestError::UnknownPath.into()
}

pub(super) async fn unknown_method() -> FailedRequest {
    RequestError::UnknownMethod.into()
}
