//! The sender of a request, and the answer to a request that fails.

use std::future::pending;
use std::net::IpAddr;
use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::Json;
use axum::extract::FromRequestParts;
use axum::http::request::Parts;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use parking_lot::Mutex;
use tokio::sync::Mutex as AsyncMutex;
use tokio_util::sync::CancellationToken;

use crate::model::{ErrorCode, Problem};
use crate::protocol::{self, FailureBody, WireSecret};
use crate::virtual_controller::controller::{ChangeFailure, Controller};
use crate::virtual_controller::login::{LoginThrottle, ManagementSessions};
use crate::virtual_controller::peer::PeerConnection;
use crate::virtual_controller::request_heads::RejectedHead;

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

/// A failed request. The status is [`protocol::status_of`] the code unless it is about the path or the head.
pub(super) struct FailedRequest {
    status: StatusCode,
    problem: Problem,
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
            Err(ChangeFailure::Problem(problem)) => Err(problem.into()),
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
        let connection = parts
            .extensions
            .get::<ClientConnection>()
            .cloned()
            .ok_or_else(|| Problem::with_detail(ErrorCode::Internal, "a request without a connection"))?;
        let token = parts
            .headers
            .get(header::AUTHORIZATION)
            .and_then(|value| value.to_str().ok())
            .and_then(|value| value.strip_prefix("Bearer "))
            .ok_or(Problem::new(ErrorCode::SessionExpired))?;
        if !connection.api.sessions.lock().touch(token, Instant::now()) {
            return Err(Problem::new(ErrorCode::SessionExpired).into());
        }
        connection.peer.has_session();
        let token = WireSecret(token.into());
        Ok(Self { connection, token })
    }
}

impl From<Problem> for FailedRequest {
    fn from(problem: Problem) -> Self {
        let status = StatusCode::from_u16(protocol::status_of(problem.code));
        Self { status: status.unwrap_or(StatusCode::INTERNAL_SERVER_ERROR), problem }
    }
}

/// The answer to a request whose head was refused.
pub fn rejected(head: RejectedHead) -> Response {
    FailedRequest { status: head.status, problem: head.problem }.into_response()
}

impl IntoResponse for FailedRequest {
    fn into_response(self) -> Response {
        (self.status, Json(FailureBody::from(self.problem))).into_response()
    }
}

pub(super) async fn unknown_path() -> FailedRequest {
    not_found()
}

pub(super) async fn unknown_method() -> FailedRequest {
    FailedRequest {
        status: StatusCode::METHOD_NOT_ALLOWED,
        problem: Problem::with_detail(ErrorCode::Refused, "this path does not take this method"),
    }
}

pub(super) fn not_found() -> FailedRequest {
    FailedRequest { status: StatusCode::NOT_FOUND, problem: Problem::with_detail(ErrorCode::Refused, "no such path") }
}
