//! An OPC UA client: finds out whether a server lets a client in, and if not, why; and reads, writes, browses and
//! subscribes in a session that stays open.
//!
//! | file | contents |
//! |---|---|
//! | `server_location`, `user_login` | where a server is, and who logs in |
//! | `endpoint` | [`Endpoint`]: what a server offers, as far as it is understood |
//! | `watched_stream` | what a server sends, bounded, and its last word noted |
//! | `connection` | TCP and the secure channel |
//! | `open_session` | creating and activating a session |
//! | `attempt` | one try from the secure channel to a value that was read |
//! | `session_channel` | the channel of a session, and requests on it |
//! | `subscription` | [`Subscription`]: values as they change |
//! | `client_session` | [`ClientSession`]: a session that stays open |
//! | `client` | [`OpcUaClient`]: endpoints, tries and sessions under one certificate |
//! | `controller_server` | [`ControllerServer`]: the server of a managed controller, and a session with it |
//! | `convert` | the library's values as [`Value`](crate::model::opcua::Value)s, and back |
//! | `failure` | [`ConnectFailure`]: the step that failed, and why |
//!
//! A try is one connection, bounded in time and in what it takes in. A session is bounded in time for each request, and
//! in the size of each message. Nothing is tried again by itself. All that the peer sends gives a result: the
//! protocol's library runs in a task of its own.
//!
//! The server's certificate is not judged here. The caller compares it with the expected one, before a
//! secure channel is opened to it: [`OpcUaClient::attempt`] takes the certificate it must be.

mod attempt;
mod client;
mod client_session;
mod connection;
mod controller_server;
mod convert;
mod endpoint;
mod failure;
mod open_session;
mod server_location;
mod session_channel;
mod subscription;
#[cfg(test)]
mod tests;
mod user_login;
mod watched_stream;

pub use attempt::ReadServerState;
pub use client::{ConnectTimeouts, OpcUaClient};
pub use client_session::ClientSession;
pub use controller_server::{ControllerServer, ServerConnectError};
pub use endpoint::{Endpoint, MessageSecurity, OfferedToken, TokenKind};
pub use failure::{
    ConnectFailure, ConnectFailureCause, ConnectStage, is_about_a_certificate, is_about_a_user, printable,
};
pub use server_location::{ServerLocation, is_reachable};
pub use subscription::{Changes, Subscription, SubscriptionIntervals};
pub use user_login::UserLogin;
