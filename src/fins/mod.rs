//! FINS, the protocol of Omron PLCs: reading and writing their memory over TCP and UDP (Omron manuals W227, W342, W421).
//!
//! | part | content |
//! |---|---|
//! | [`address`] | addresses as text and on the wire: `D300`, `CIO0.15`, `E1_200` |
//! | [`data_type`] | numbers and text in words |
//! | [`codec`] | frames, headers, commands, responses, end codes: bytes in, values out |
//! | [`client`] | a client of one PLC |
//! | [`plc`] | a simulated PLC |
//! | [`bridge`] | copies words and bits between a PLC and a robot, cycle after cycle |

pub mod address;
pub mod bridge;
pub mod client;
pub mod codec;
pub mod data_type;
pub mod plc;
mod problem;
