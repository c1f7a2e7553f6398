//! Who is let in: the gate between the clients and the OPC UA crate's server.
//!
//! The crate asks one question about a client's certificate: does this very file lie in its folder? It looks at no
//! issuer, no revocation list and no ApplicationUri, bounds nothing, and offers no place to do so. So its server, as it
//! is, listens on a loopback port, and the gate on the public one.
//!
//! | file | idea |
//! |---|---|
//! | `gate` | every connection from its first byte to its last, and who is let in |
//! | `judge` | the trust lists in force, and what a peer is told of its rejection |
//! | `upward` | from the client to the server: no byte passes before its chunk was looked at |
//! | `downward` | from the server to the client, and last words |
//! | `passage` | bytes of one direction, chunk by chunk |
//! | `frame` | the parts of OPC UA's chunks that are not encrypted |
//! | `plain` | what is objected to where nothing is encrypted: passwords in clear, and sessions not offered |
//! | `rewrap` | clients that send their issuers along, which the crate cannot read |
//! | `channel_keys` | the same in CreateSession |
//! | `guard` | sessions that do not belong to their secure channel |
//! | `connections` | the connections there are, in the places of `connection_limits` |
//! | `limits` | how many, how long, how large |
//! | `report` | who is told of a refusal |
//! | `fault` | why a peer is turned away, in the words it is told |
//!
//! # The walk of a connection
//! Hello; then OpenSecureChannel, whose policy and certificates travel in clear: they are judged, and the request passes
//! or the peer gets an error. Only the server can tell whether the client has the certificate's key; a thief gets no
//! further than its check. From then on bytes pass, while renewals are compared with the first request and judged again.
//! At the activation of a session the guard compares it with its channel. A change of the trust lists judges everybody
//! again, and ends in milliseconds the connections that would not be let in now.
//!
//! # What a peer is told
//! `BadSecurityChecksFailed` whatever is wrong with its certificate; the true reason is in the log and with the rejected
//! clients. A controller can be told to give the true one.
//!
//! # Limits of the OPC UA crate that remain
//! Issuers sent in CreateSession are left out only before the first session of a channel, and only of a client that
//! sent them in OpenSecureChannel too. TransferSubscriptions and Publish reach no node, so that only the activation
//! guards them. A password in clear is taken out where nothing is signed; a client that signs but neither encrypts its
//! channel nor its password, although told to, shows it to whoever listens.

mod channel_keys;
mod connections;
mod downward;
mod fault;
mod frame;
mod gate;
mod guard;
mod judge;
mod limits;
mod passage;
mod plain;
#[cfg(test)]
mod properties;
mod report;
mod rewrap;
mod upward;

pub use gate::CutConnection;
pub(super) use gate::{Gate, Settings};
pub(super) use guard::Guarded;
pub use judge::Clock;
pub(super) use judge::Judge;
pub use report::Refusals;
pub(super) use report::Reporter;
pub(super) use rewrap::Own;

/// For the tests of the server, which have to forge what a client would not send.
#[cfg(test)]
pub(super) mod wire {
    pub(in super::super) use super::channel_keys::ChannelKeys;
    pub(in super::super) use super::frame::tests;
    pub(in super::super) use super::frame::{Kind, Open};
    pub(in super::super) use super::passage::Passage;
    pub(in super::super) use super::rewrap::{Envelope, unseal};
}
