//! The bundled virtual controller: a whole controller in software, for tests, demonstrations and training.
//!
//! Not a stub: it keeps its state on disk and survives a killed process, checks every rule and limit itself, runs a
//! real OPC UA server on a real port, and has switches for what goes wrong in the field.
//!
//! | file | contents |
//! |---|---|
//! | `state` | [`ControllerState`]: everything a controller remembers, and what follows from it |
//! | `remote` | [`remote::RemoteServer`]: remote commands, which act on the cell |
//! | `cell` | [`cell::CellHandle`]: the simulated robots, I/O and data behind the OPC UA server |
//! | `changes` | every change a controller accepts, as a function on a copy of its state |
//! | `certificate_changes` | changes of the server certificates |
//! | `trust_changes` | changes of client certificate lists and CRLs |
//! | `change_error` | why a change is refused |
//! | `rejected` | the clients that were refused, bounded, beside the state |
//! | `settings_transfer` | settings sealed for the PC, and put back |
//! | `store` | [`Store`]: the state on disk, replaced whole |
//! | `secret_bytes` | [`SecretBytes`]: key material that shows nowhere |
//! | `new_controller` | [`NewController`]: what a controller is when it is first switched on |
//! | `activation_keys` | [`demo_keys`]: the keys a virtual controller accepts |
//! | `faults` | [`Faults`]: the switches for what goes wrong |
//! | `switchboard` | [`Switchboard`]: the fault switches that another process can set |
//! | `plant` | [`ask_plant`]: commands to cells, given by another process |
//! | `controller` | state, store and OPC UA server together; changes whole or not at all |
//! | `switch_on` | [`VirtualController`]: a controller with its listener, switched on and off |
//! | `password` | the connection password: Argon2id once, then a memory of this process |
//! | `login` | wrong passwords by source, sessions by token |
//! | `api` | the requests of [`crate::protocol`], and bodies within bounds |
//! | `peer` | one connection of the management protocol, as `api` and `listener` know it |
//! | `connection_limits` | what peers may take of either listener before they have a session |
//! | `listener` | connections of the management protocol: accepted, bounded in number and time, encrypted |
//! | `request_heads` | the heads of requests, checked before the HTTP library reads them |
//! | `tls` | the management identity as a TLS server |
//! | `server_log` | the log of the OPC UA server, and what happens when it is full |
//! | `log_share` | the share of the server log that unauthenticated peers may fill |
//! | `opcua` | the OPC UA server |
//! | `memory` | what stopped servers leave free, given back |
//! | `project_file` | the file that declares SPEL variables |
//! | `ports` | free TCP ports |
//! | `file_limit` | room for a listener of each controller of a fleet |
//! | `fleet` | [`Fleet`]: hundreds of controllers in one process |
//! | `demo` | [`demo_fleet`]: controllers worth looking at |
//!
//! # Layers
//! Each uses only those before it: `state` and `store`; the functions of `changes`, `certificate_changes`,
//! `trust_changes` and `settings_transfer` on a state; `opcua`, which knows none of these; `controller`, which puts a
//! change in force; `api`, which answers requests; `listener`, which accepts their connections; `switch_on`; `fleet`
//! and `demo`.
//!
//! # The walk of a change
//! `listener` accepts and decrypts; `api` finds the session, reads the body, and hands a closure over `changes` to the
//! controller; there it takes its turn, runs on a copy of the state, and the copy is checked and written beside the
//! file in force. The OPC UA server, if it runs, is stopped and started with the copy. One rename makes the copy the
//! state; if anything fails before it, the server is put back as it was and the copy is thrown away. A process killed
//! at any moment comes back with the old state or the new one.
//!
//! # Decisions
//! - A running task or a connected teach pendant refuses changes, start and stop, while questions are answered.
//! - Client lists and CRLs take effect in the running server, which is not restarted for it; connections that would not
//!   be let in any more are ended once the change is on the disk.
//! - The rejected clients are in a file of their own, written at most every few seconds: strangers fill it. A
//!   certificate that a person puts into another list leaves it.
//! - A CRL that its authority, if held, did not sign is refused: it could only take the place of the right one.
//! - A CSR made in current firmware does not touch the certificate in use. Legacy firmware has room for one key of a
//!   CA-signed certificate only: a new CSR takes the old certificate away, and a server that used it stops.
//! - An error number describes the present: 7930 to 7933 and 582 are shown from the start that failed until their cause
//!   is mended, 580 until the next start or stop that succeeds.
//! - While the server log is on, the controller says so with 581 beside a status that is not Error: a notice, since
//!   everything works. When the log is full the server stops by itself with 582, and does not start again until the log
//!   is deleted or switched off.
//! - A running server refuses settings and certificates it could not run with (7932, 7933); a stopped one takes any
//!   settings that are complete, and says so when it is started.

mod activation_keys;
mod api;
pub mod cell;
mod certificate_changes;
mod change_error;
mod changes;
mod connection_limits;
mod controller;
mod demo;
mod faults;
mod file_limit;
mod fleet;
mod listener;
mod log_share;
mod login;
mod memory;
mod new_controller;
pub mod opcua;
mod password;
mod peer;
mod plant;
mod ports;
mod project_file;
mod rejected;
pub mod remote;
mod request_heads;
mod secret_bytes;
mod server_log;
mod settings_transfer;
mod state;
mod store;
mod switch_on;
mod switchboard;
#[cfg(test)]
mod tests;
mod tls;
mod trust_changes;

pub use activation_keys::demo_keys;
pub use controller::{ControllerSpec, SwitchOnError};
pub use demo::{DEMO_COUNT, DEMO_PASSWORD, DemoEntry, DemoFleet, demo_fleet};
pub use faults::{DropPoint, FaultSwitches, Faults};
pub use fleet::{Fleet, FleetConfig, FleetError, FleetFirmware, MAX_FLEET, ReadyLine};
pub use new_controller::{NewCertificate, NewController, USUAL_PORTS};
pub use opcua::AdmissionOptions;
pub use password::hash_connection_password;
pub use plant::{PlantAnswer, PlantError, ask_plant};
pub use project_file::usual_variables;
pub use secret_bytes::SecretBytes;
pub use server_log::LOG_LIMIT;
pub use state::{
    ControllerIdentity, ControllerState, KeyPair, OperatingContext, PendingCsr, TrustListCertificate, TrustListCrl,
    User,
};
pub use store::{StagedState, Store, StoreError};
pub use switch_on::VirtualController;
pub use switchboard::{OutsideSwitches, Switchboard};
