//! The rooms that read bytes from outside, compiled for the fuzzer straight from their sources, and what they promise.
//!
//! Without the window and the OPC UA server, which are nine tenths of the program and read nothing here: with the
//! fuzzer's flags they would take the better part of an hour to compile.

#![allow(dead_code, unused_imports, reason = "the rest of the program uses it")]

extern crate self as opcua_configurator;

#[path = "../../../src/model/mod.rs"]
pub mod model;
#[path = "../../../src/pki/mod.rs"]
pub mod pki;
#[path = "../../../src/protocol/mod.rs"]
pub mod protocol;
pub mod readers;
#[path = "../../../src/records/mod.rs"]
pub mod records;
pub mod remote {
    #[path = "../../../../src/remote/codec/mod.rs"]
    pub mod codec;

    pub use codec::*;
}
pub mod virtual_controller;
#[path = "../../../src/workspace/mod.rs"]
pub mod workspace;
