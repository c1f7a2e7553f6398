//! Sends remote commands to one controller: over TCP as text, over a serial port or a serial device server as frames.
//!
//! No call waits without a limit, and no acting command is sent twice.
//!
//! | file | idea |
//! |---|---|
//! | `target` | [`RemoteTarget`]: where the commands go, and in which form |
//! | `error` | [`RemoteError`] |
//! | `observer` | [`Observer`]: everything that goes over the line, for a log |
//! | `link` | a TCP connection or a serial port |
//! | `backoff` | how long to wait before the next attempt to connect |
//! | `exchange` | one request and its answer |
//! | `connection` | [`RemoteClient`] |
//! | `identity` | [`ControllerIdentity`]: what a controller says about itself |

mod backoff;
mod connection;
mod error;
mod exchange;
mod identity;
mod link;
mod observer;
mod target;
#[cfg(test)]
mod tests;

pub use connection::{RemoteClient, RemoteTimeouts};
pub use error::RemoteError;
pub use exchange::Interjections;
pub use identity::{ControllerIdentity, PartHealth, RobotIdentity, WearingPart};
pub use observer::{Direction, Observed, Observer};
pub use target::{BAUD_RATES, Parity, RemoteTarget, SerialLine, TargetError};
