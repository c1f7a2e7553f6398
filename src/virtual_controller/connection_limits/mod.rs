//! What peers may take of a listener before, and without, proving who they are.
//!
//! Both listeners of a controller use it: the gate in front of the OPC UA server, and the management protocol.
//!
//! | file | idea |
//! |---|---|
//! | `source_network` | [`SourceNetwork`]: which addresses count as one peer |
//! | `activity` | [`Activity`]: how far one connection has come, and when it was last used |
//! | `slots` | [`ConnectionSlots`]: how many connections there may be, and which one makes room |
//! | `line_limiter` | [`LineLimiter`]: the rate of log lines about one source |
//!
//! # Which connection makes room
//! A listener always accepts. When a source, or the listener as a whole, has too many connections, one of those with
//! the lowest [`ConnectionStage`] ends; among them one of the source that has most; among them the oldest. A connection
//! with a session never makes room while it is used (OPC 10000-4 §5.5.2.1 asks the same for secure channels).

mod activity;
mod line_limiter;
mod slots;
mod source_network;

pub(super) use activity::{Activity, ConnectionStage};
pub(super) use line_limiter::{LineDecision, LineLimiter, RefusalDecision};
pub(super) use slots::{ConnectionLimits, ConnectionSlot, ConnectionSlots, LimitedConnection};
pub(super) use source_network::SourceNetwork;
