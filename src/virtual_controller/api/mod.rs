//! The controller's end of [`crate::protocol`].
//!
//! | file | its one idea |
//! |---|---|
//! | `mod` | [`Api`]: sessions, and how a request that fails is answered |
//! | `routes` | a handler is registered under the type of the request that it answers |
//! | `handlers` | what the controller does for each request |
//! | `body` | request bodies, bounded in size and time |

mod body;
mod handlers;
mod routes;

use std::future::pending;
use std::net::IpAddr;
use std::sync::{Arc, LazyLock};
use std::time::{Duration, Instant};

use axum::extract::FromRequestParts;
use axum::http::request::Parts;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::{Json, Router};
use parking_lot::Mutex;
use secrecy::ExposeSecret as _;
use tokio::sync::Mutex as AsyncMutex;
use tokio_util::sync::CancellationToken;

use super::controller::{Controller, Outcome};
use super::login::{Sessions, Throttle};
use super::password::is_password;
use super::peer::Peer;
use super::request_heads::RejectedHead;
use crate::model::{ErrorCode, Problem};
use crate::protocol::{self, Failure, GetHello, Hello, Login, Logout, SESSION_IDLE_SECS, Session, WireSecret};
use body::Malformed;
use routes::Routes;

/// How long a wrong password waits for its answer.
const WRONG_PASSWORD_DELAY: Duration = Duration::from_millis(300);

/// One router for every controller of the process. The connection of a request, which names the controller, comes with the
/// request as an extension ([`ClientConnection`]).
pub static ROUTER: LazyLock<Router> = LazyLock::new(|| routes().router());

fn routes() -> Routes {
    let routes = Routes::default()
        .open::<GetHello, _, _>(hello)
        .open_with_body::<Login, _, _>(Malformed::secret(ErrorCode::Refused), login)
        .plain::<Logout, _, _>(logout);
    handlers::register(routes)
}

/// The management protocol of one controller.
#[derive(Debug)]
pub struct Api {
    controller: Arc<Controller>,
    /// Locked while a password is compared, so that two guesses at the same time are both counted.
    throttle: AsyncMutex<Throttle>,
    sessions: Mutex<Sessions>,
}

/// The connection that a request arrived on.
#[derive(Debug, Clone)]
pub struct ClientConnection {
    pub api: Arc<Api>,
    pub peer: Arc<Peer>,
    /// The controller's address the client used.
    pub local: IpAddr,
    /// Cuts the connection without an answer.
    pub cut: CancellationToken,
}

impl Api {
    pub fn new(controller: Arc<Controller>) -> Self {
        Self { controller, throttle: AsyncMutex::default(), sessions: Mutex::default() }
    }

    pub fn latency(&self) -> Duration {
        self.controller.faults().get().latency
    }
}

/// The sender of a request that carries the token of a session.
struct Caller {
    connection: ClientConnection,
    token: WireSecret,
}

/// A failed request. The status is [`protocol::status_of`] the code unless it is about the path or the head.
struct Failed {
    status: StatusCode,
    problem: Problem,
}

impl Caller {
    fn controller(&self) -> &Arc<Controller> {
        &self.connection.api.controller
    }

    /// The controller's address that the client used.
    fn local_address(&self) -> IpAddr {
        self.connection.local
    }

    /// The result of a change. If a fault switch asks for the connection to be lost here, it is cut and this never returns.
    async fn settle<T>(&self, outcome: Result<T, Outcome>) -> Result<T, Failed> {
        match outcome {
            Ok(value) => Ok(value),
            Err(Outcome::Problem(problem)) => Err(problem.into()),
            Err(Outcome::Dropped) => {
                self.connection.cut.cancel();
                pending().await
            }
        }
    }
}

impl<S: Send + Sync> FromRequestParts<S> for Caller {
    type Rejection = Failed;

    async fn from_request_parts(parts: &mut Parts, _state: &S) -> Result<Self, Failed> {
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

impl From<Problem> for Failed {
    fn from(problem: Problem) -> Self {
        let status = StatusCode::from_u16(protocol::status_of(problem.code));
        Self { status: status.unwrap_or(StatusCode::INTERNAL_SERVER_ERROR), problem }
    }
}

/// The answer to a request whose head was refused.
pub fn rejected(head: RejectedHead) -> Response {
    Failed { status: head.status, problem: head.problem }.into_response()
}

impl IntoResponse for Failed {
    fn into_response(self) -> Response {
        (self.status, Json(Failure::from(self.problem))).into_response()
    }
}

async fn hello() -> Result<Hello, Failed> {
    Ok(Hello { product: protocol::PRODUCT.to_owned(), versions: vec![protocol::VERSION] })
}

async fn login(connection: ClientConnection, Login { password }: Login) -> Result<Session, Failed> {
    let api = &connection.api;
    let right = {
        let mut throttle = api.throttle.lock().await;
        throttle.admit(connection.peer.address(), Instant::now())?;
        let hash = api.controller.state().connection_password_hash.clone();
        let right = is_password(&hash, &password.0).await;
        if right {
            throttle.right(connection.peer.address());
        } else {
            throttle.wrong(connection.peer.address(), Instant::now());
        }
        right
    };
    if !right {
        tokio::time::sleep(WRONG_PASSWORD_DELAY).await;
        return Err(Problem::new(ErrorCode::WrongPassword).into());
    }
    let token = api.sessions.lock().open(Instant::now())?;
    connection.peer.has_session();
    Ok(Session { token: WireSecret(token), idle_secs: SESSION_IDLE_SECS })
}

async fn logout(caller: Arc<Caller>) -> Result<(), Failed> {
    caller.connection.api.sessions.lock().close(caller.token.0.expose_secret());
    Ok(())
}

async fn unknown_path() -> Failed {
    not_found()
}

async fn unknown_method() -> Failed {
    Failed {
        status: StatusCode::METHOD_NOT_ALLOWED,
        problem: Problem::with_detail(ErrorCode::Refused, "this path does not take this method"),
    }
}

fn not_found() -> Failed {
    Failed { status: StatusCode::NOT_FOUND, problem: Problem::with_detail(ErrorCode::Refused, "no such path") }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// A request of the protocol's tables that nobody answers, or a path that the tables do not name, is a mistake.
    #[test]
    fn the_controller_answers_exactly_the_requests_of_the_protocol() {
        let documented = protocol::REQUESTS.into_iter().flatten().map(|row| (row.method, row.path));
        let registered = routes().registered;
        assert_eq!(registered.iter().copied().collect::<BTreeSet<_>>(), documented.collect::<BTreeSet<_>>());
    }
}
