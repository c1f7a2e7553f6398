//! The address space of a controller (manual 3.2; OPC 10000-100; OPC 40010-1).
//!
//! | file | idea |
//! |---|---|
//! | `id` | numeric node ids, and the namespaces |
//! | `ids` | the ids of the controller's own nodes: literal, or derived from the path |
//! | `node` | one node and its attributes |
//! | `value` | where a variable's value comes from |
//! | `table` | nodes and references; types that all controllers share, and one controller's nodes |
//! | `nodesets` | Devices and Robotics Part 1, read from the bundled facts |
//! | `vendor_types` | the vendor's types |
//! | `types` | both together, built once for each firmware generation |
//! | `instances` | objects made after types, with their mandatory members |
//! | `system` | everything below DeviceSet |
//! | `robot` | robots, axes, power trains |
//! | `controller` | controller, software, tasks, force sensor, motion log, status |
//! | `io`, `spel`, `consumables` | I/O signals, SPEL variables, parts that wear |
//! | `format`, `units` | texts, engineering units and ranges |
//! | `reading`, `writing` | the services Read and Write on one node |
//! | `budget` | how long a response may be |
//! | `browsing` | the services Browse and TranslateBrowsePathsToNodeIds |
//! | `sampler` | values for subscriptions |
//! | `manager` | the address space as a node manager of the OPC UA crate |
//!
//! # How a value is read
//! A variable has a [`value::Source`]: a constant, or a function of the cell's snapshot. A request takes one snapshot
//! for all its values. Subscriptions are sampled every 100 ms at most; without subscriptions nothing runs. Nothing is
//! copied into the nodes.
//!
//! # Decisions
//! - Namespace 1 is the server's own, its URI the ApplicationUri (OPC 10000-5 §7.2).
//! - Robotics Part 1 is the NodeSet 1.01.2, the errata of the version 1.00 that the manual names.
//! - RobotStatus, AdditionalInfo, ConsumableStatus and RobotNumber are components of the object they describe; I/O,
//!   force sensor, motion log, SPEL project and ControllerStatus stand below the controller's Components.
//! - I/O ports with more than 64 bits are shown by bytes, the others by bits.
//! - A subscription to a node Data sees Null and takes nothing out of the queue.

mod browsing;
mod budget;
mod consumables;
mod controller;
mod format;
mod id;
mod ids;
mod instances;
mod io;
mod manager;
mod node;
mod nodesets;
mod reading;
mod robot;
mod sampler;
mod spel;
mod system;
mod table;
#[cfg(test)]
mod tests;
mod types;
mod units;
mod value;
mod vendor_types;
mod writing;

pub(super) use manager::ControllerNodes;
pub(super) use nodesets::is_model_namespace;
pub(super) use types::Types;
