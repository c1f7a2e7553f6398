//! The OPC UA server inside a virtual controller (manual chapters 3 and 4; OPC 10000 1.04).
//!
//! One [`OpcUaServer`] is one running server on one port. It is built from an [`OpcUaConfig`], and a change of the
//! configuration builds a new one; only trust in client certificates changes while it runs.
//!
//! | file | idea |
//! |---|---|
//! | `config` | what a server is made of, checked before anything is started |
//! | `server` | start, stop and state of the server |
//! | `start_error` | why a server could not be started |
//! | `admission` | the connections of the clients, and who is let in |
//! | `events` | what happens in a running server, for its log |
//! | `endpoints` | security policies and user tokens as OPC UA endpoints, and what a client may ask for |
//! | `users` | password hashes, logging in |
//! | `login_delays` | who guesses passwords waits |
//! | `certificate_store` | the private folder the crate reads certificates from |
//! | `address_space` | the nodes of the controller and of the information models they build on |

mod address_space;
mod admission;
mod certificate_store;
mod config;
mod endpoints;
mod events;
mod login_delays;
mod server;
mod start_error;
#[cfg(test)]
mod tests;
mod users;

pub use admission::{CertificateClock, DisconnectedConnection, RejectionRecorder};
pub use config::{AdmissionOptions, OpcUaConfig, OpcUaUser};
pub use events::{ServerEvent, ServerEvents};
pub use server::OpcUaServer;
pub use start_error::{InvalidParameter, StartError};
pub use users::{HashError, hash_password};
