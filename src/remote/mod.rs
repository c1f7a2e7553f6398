//! The remote commands that every controller of this vendor understands: over a serial line as frames, over Ethernet as
//! text (SPEL+ guide, remote RS232 and remote Ethernet).
//!
//! | part | content |
//! |---|---|
//! | [`codec`] | the commands, and both forms of them, for client and server: bytes in, messages out; no I/O |
//! | [`client`] | sends commands to one controller, over TCP or a serial port |
//! | `problem` | the errors of the client as a person reads them |

pub mod client;
pub mod codec;
mod problem;

pub use codec::*;
