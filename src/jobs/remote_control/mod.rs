//! Watching and controlling one controller with remote commands.
//!
//! | file | contents |
//! |---|---|
//! | `io` | [`IoKind`]: inputs, outputs and memory I/O, and the commands for each |
//! | `labels` | [`IoLabels`]: names of I/O bits, from a file |
//! | `request` | [`RemoteControlRequest`] and [`RemoteControlEvent`]: what the watch is asked, and what it reports |
//! | `tap` | collects what goes over the line |
//! | `watch` | [`control_remotely`]: connects, polls, does commands, connects again |

mod io;
mod labels;
mod request;
mod tap;
#[cfg(test)]
mod tests;
mod watch;

pub use io::IoKind;
pub use labels::{IoLabels, MAX_LABEL_FILE_BYTES};
pub use request::{LoggedExchange, RemoteConnection, RemoteControlEvent, RemoteControlRequest};
pub use watch::control_remotely;
