//! The controller's end of [`crate::protocol`].
//!
//! | file | contents |
//! |---|---|
//! | `mod` | the router; logging in and out |
//! | `caller` | [`ManagementApi`], and the sender of a request |
//! | `failed` | the answer to a request that fails: the error code and detail of every error |
//! | `request_error` | why a request is not understood |
//! | `routes` | a handler is registered under the type of the request that it answers |
//! | `handlers` | what the controller does for each request |
//! | `body` | request bodies, bounded in size and time |

mod body;
mod caller;
mod failed;
mod handlers;
mod request_error;
mod routes;

use std::sync::{Arc, LazyLock};
use std::time::{Duration, Instant};

use axum::Router;
use secrecy::ExposeSecret as _;

use super::login::LoginError;
use super::password::is_password;
use crate::model::ErrorCode;
use crate::protocol::{self, GetHello, Hello, Login, Logout, SESSION_IDLE_SECS, SessionStarted, WireSecret};
use body::MalformedBody;
use caller::Caller;
pub use caller::{ClientConnection, ManagementApi};
use failed::FailedRequest;
pub use failed::rejected;
use routes::Routes;

/// How long a wrong password waits for its answer.
const WRONG_PASSWORD_DELAY: Duration = Duration::from_millis(300);

/// One router for every controller of the process. The connection of a request, which names the controller, comes with
/// the request as an extension ([`ClientConnection`]).
pub static ROUTER: LazyLock<Router> = LazyLock::new(|| routes().router());

fn routes() -> Routes {
    let routes = Routes::default()
        .open::<GetHello, _, _>(hello)
        .open_with_body::<Login, _, _>(MalformedBody::secret(ErrorCode::Refused), login)
        .plain::<Logout, _, _>(logout);
    handlers::register(routes)
}

async fn hello() -> Result<Hello, FailedRequest> {
    Ok(Hello { product: protocol::PRODUCT.to_owned(), versions: vec![protocol::VERSION] })
}

async fn login(connection: ClientConnection, Login { password }: Login) -> Result<SessionStarted, FailedRequest> {
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
        return Err(LoginError::WrongPassword.into());
    }
    let token = api.sessions.lock().open(Instant::now())?;
    connection.peer.has_session();
    Ok(SessionStarted { token: WireSecret(token), idle_secs: SESSION_IDLE_SECS })
}

async fn logout(caller: Arc<Caller>) -> Result<(), FailedRequest> {
    caller.connection.api.sessions.lock().close(caller.token.0.expose_secret());
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// A request of the protocol's tables without a handler, or a path that the tables do not name, is a mistake.
    #[test]
    fn the_controller_answers_exactly_the_requests_of_the_protocol() {
        let documented = protocol::REQUESTS.into_iter().flatten().map(|row| (row.method, row.path));
        let registered = routes().registered;
        assert_eq!(registered.iter().copied().collect::<BTreeSet<_>>(), documented.collect::<BTreeSet<_>>());
    }
}
