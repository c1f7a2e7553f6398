//! The real program against peers of other projects: asyncua, node-opcua, OpenSSL, pandas, fins-driver, omron-fins and
//! tshark.
//!
//! A peer that is not installed skips its story and says so. With `OPCUA_INTEROP_REQUIRED=1` a missing peer is a
//! failure. `OPCUA_INTEROP_PYTHON` names a Python with asyncua, pandas and pyarrow (default `python3`),
//! `OPCUA_INTEROP_NODE_MODULES` the `node_modules` folder with node-opcua-client and node-opcua-nodesets.

mod address_space;
mod authority;
mod cell;
mod connections;
mod fins;
mod open_server;
pub mod peers;
mod recordings;
mod sample_programs;
mod trust;
mod trust_peers;
