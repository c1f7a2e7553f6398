//! The OPC UA server inside a virtual controller (manual chapters 3 and 4; OPC 10000 1.04).
//!
//! One [`OpcUaServer`] is one running server on one port. It is built from an [`OpcUaConfig`], and a change of the
//! configuration builds a new one; only the trusted client certificates change while it runs.
//!
//! | file | idea |
//! |---|---|
//! | `config` | what a server is made of, checked before anything is started |
//! | `server` | start, stop, and whether it still runs |
//! | `relay` | the connections of the clients, passed on to the server |
//! | `events` | what happens in a running server, for its log |
//! | `endpoints` | security policies and user tokens as OPC UA endpoints, and what a client may ask for |
//! | `users` | password hashes, logging in, lock-out |
//! | `certificate_store` | the private folder with the certificates of server and clients |
//! | `address_space` | the nodes of the controller |
//! | `nodesets` | the bundled information models |

mod address_space;
mod certificate_store;
mod config;
mod endpoints;
mod events;
mod nodesets;
mod relay;
mod server;
#[cfg(test)]
mod tests;
mod users;

pub use config::{DeviceIdentity, OpcUaConfig, OpcUaUser};
pub use events::{Event, Events};
pub use server::{OpcUaServer, StartError};
pub use users::{HashError, hash_password};
