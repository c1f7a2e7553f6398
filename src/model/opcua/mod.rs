//! Values of an OPC UA address space, as a client of any server reads them. No encoding, no connection.
//!
//! | file | contents |
//! |---|---|
//! | `node_id` | [`NodeId`], its text form; [`QualifiedName`] |
//! | `value` | [`Value`]: one value of any built-in type |
//! | `data_value` | [`DataValue`]: a value with [`Quality`] and timestamps |
//! | `reference` | [`NodeReference`]: what browsing a node gives |

mod data_value;
mod node_id;
mod reference;
mod value;

pub use data_value::{DataValue, Quality};
pub use node_id::{Identifier, NodeId, NodeIdError, QualifiedName};
pub use reference::{NodeClass, NodeReference};
pub use value::Value;
