//! Who is let in: the gate between the clients and the OPC UA crate's server.
//!
//! The crate asks one question about a client's certificate: does this very file lie in its folder? It looks at no
//! issuer, no revocation list and no ApplicationUri, bounds nothing, and offers no place to do so. So its server, as it
//! is, has no port at all: it calls the gate, which listens on the public one.
//!
//! | file | idea |
//! |---|---|
//! | `gate` | [`Gate`]: which clients are accepted |
//! | `service` | accepts connections, and serves each from its first byte to its last |
//! | `verifier` | the trust lists in force, and what a peer is told of its rejection |
//! | `inner_server` | how the gate, and nothing else, reaches the crate's server |
//! | `client_to_server` | whole chunks only, and requests for sessions and logins looked at |
//! | `server_to_client` | the server's messages to a client, and the error that ends a connection |
//! | `chunk_buffer` | bytes of one direction, chunk by chunk |
//! | `frame` | the parts of OPC UA's chunks that are not encrypted |
//! | `rewrap` | OpenSecureChannel opened and sealed again, so that the gate has the keys of the channel |
//! | `channel_keys` | the keys of a secure channel: decrypts, encrypts and signs messages |
//! | `channel` | what is known of one channel: its keys, its last message, what it has asked for |
//! | `sessions` | how many sessions there may be, and which one makes room |
//! | `logins` | which connection a user logs in by |
//! | `guard` | sessions that do not belong to their secure channel |
//! | `connections` | the connections there are, in the places of `connection_limits` |
//! | `limits` | how many, how long, how large |
//! | `report` | refusals in the log and in the rejected list |
//! | `fault` | the error message that a refused peer gets |
//!
//! # Layers
//! `service` uses `client_to_server` and `server_to_client`; these, `guard` and `logins` use `gate`; `gate` uses
//! `client_verifier`,
//! `connections`, `sessions`, `report` and `inner_server`; these use what is left. Nothing uses a layer above its own.
//!
//! # The walk of a connection
//! Hello; then OpenSecureChannel, whose policy and certificates travel in clear: they are judged, and the request
//! passes or the peer gets an error; so does one that has not the key of its certificate. From then on chunks pass,
//! while renewals are compared with the first request and judged again. CreateSession takes a place among the sessions,
//! and a user's name in ActivateSession is marked with its connection. When the connection ends, the gate closes the
//! sessions that cannot be used any more. At the activation of a session the guard compares it with its channel. A
//! change of the trust lists checks every client again, and ends in milliseconds the connections that would not be let
//! in now.
//!
//! # What a peer is told
//! `BadSecurityChecksFailed` for every flaw of its certificate; the true reason is in the log and with the rejected
//! clients. A controller can be told to give the true one.
//!
//! # Limits of the OPC UA crate that remain
//! TransferSubscriptions and Publish reach no node, so that only the activation guards them. A password in clear is
//! taken out where nothing is signed; a client that signs but neither encrypts its channel nor its password, although
//! told to, shows it to who listens.

mod channel;
mod channel_keys;
mod chunk_buffer;
mod client_to_server;
mod client_verifier;
mod connections;
mod fault;
mod frame;
mod gate;
mod guard;
mod inner_server;
mod limits;
mod logins;
#[cfg(test)]
mod properties;
mod report;
mod rewrap;
mod server_to_client;
mod service;
mod sessions;
#[cfg(test)]
mod tests;

pub use client_verifier::CertificateClock;
pub(super) use client_verifier::ClientVerifier;
pub use gate::DisconnectedConnection;
pub(super) use gate::{Attached, Gate, GateSettings};
pub(super) use guard::GuardedNodeManager;
pub(super) use inner_server::{InnerServer, deaf_listener};
pub(super) use logins::PasswordLogin;
pub(super) use report::AdmissionReporter;
pub use report::RejectionRecorder;
pub(super) use rewrap::ServerKeyPair;

/// Sessions the crate's server takes: those of all clients, and those that are being closed.
pub(super) const SESSIONS_BEHIND_THE_GATE: usize = 10 * sessions::MAX_SESSIONS;

/// For the tests of the server, which have to forge what a client would not send.
#[cfg(test)]
pub(super) mod wire {
    pub(in super::super) use super::channel_keys::{ChannelKeys, Sender};
    pub(in super::super) use super::chunk_buffer::ChunkBuffer;
    pub(in super::super) use super::frame::tests;
    pub(in super::super) use super::frame::{MessageKind, OpenChannelHeader};
    pub(in super::super) use super::rewrap::{ChunkEnvelope, unseal};
}
