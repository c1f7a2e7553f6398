//! # OPC UA Configurator
//!
//! The modules. Each may use only those above it:
//!
//! | module | contents |
//! |---|---|
//! | [`platform`] | what differs between operating systems: private files, replacing files, console, display |
//! | [`model`] | what a controller is and may have: plain types, rules, limits, errors |
//! | [`pki`] | keys, certificates, PKCS#12, PEM: bytes in, bytes out |
//! | [`records`] | packets of force sensor and motion log: decode, encode, columns |
//! | [`protocol`] | the controller-management protocol's messages and error codes |
//! | [`remote`] | the remote RS232 and Ethernet commands of controllers: codec, client |
//! | [`fins`] | FINS, the protocol of Omron PLCs: codec, client, simulated PLC, bridge to a robot |
//! | [`workspace`] | the folder on the PC: configuration, per-serial folders, secrets; atomic writes |
//! | [`session`] | one session with one controller, over HTTPS |
//! | [`recorder`] | force sensor and motion log data of a controller: acquisition, files, values for plots |
//! | [`jobs`] | what an engineer does to many controllers: plan, run side by side, report |
//! | [`licences`] | the licences of everything linked in, for window and command line |
//! | [`texts`] | every sentence for a person, in every language |
//! | [`ui`] | the window: a model without egui, a reducer, views and dialogs |
//! | [`cli`] | the same jobs from the command line |
//! | [`virtual_controller`] | the bundled mock controller with its real OPC UA server; uses `model`, `pki`, `records`, `protocol`, `remote` |
//!
//! `ui` and `cli` never reach past [`jobs`], [`recorder`], [`workspace`] and [`session`]; only `main` and [`cli`] know both the
//! configurator and the virtual controller, because the demo needs both.
//!
//! ## How one change is made
//! A dialog's form or a command line's arguments become an operation of [`jobs`]; the runner opens a
//! [`session`] to each controller, up to sixteen side by side; a request of [`protocol`] reaches the controller, which
//! checks it, stages it and applies it whole or not at all; events report progress and result to the row, the progress
//! dialog and the summary.

#![warn(missing_debug_implementations, missing_docs, clippy::unwrap_used, clippy::dbg_macro)]
#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod cli;
pub mod fins;
pub mod jobs;
pub mod licences;
pub mod model;
pub mod pki;
pub mod platform;
pub mod protocol;
pub mod recorder;
pub mod records;
pub mod remote;
pub mod session;
pub mod texts;
pub mod ui;
pub mod virtual_controller;
pub mod workspace;
