use std::sync::{Arc, OnceLock};

use opcua::nodes::DefaultTypeTree;

use super::node::Class;
use super::nodesets::{self, NodeSetError};
use super::table::Table;
use super::vendor_types;
use crate::model::FirmwareGeneration;

/// Devices, Robotics and the vendor's types.
#[derive(Debug, Clone)]
pub(in super::super) struct Types(pub(super) Arc<Table>);

impl Types {
    /// The types that controllers of a firmware generation have; `words`: with the word nodes of virtual I/O.
    ///
    /// All controllers of the process share them. The first call reads the bundled facts, which takes some milliseconds.
    pub(in super::super) fn of(generation: FirmwareGeneration, words: bool) -> Result<Self, NodeSetError> {
        static TABLES: [[OnceLock<Arc<Table>>; 2]; 2] = [const { [const { OnceLock::new() }; 2] }; 2];
        let shared = &TABLES[usize::from(generation == FirmwareGeneration::Current)][usize::from(words)];
        if let Some(table) = shared.get() {
            return Ok(Self(Arc::clone(table)));
        }
        let mut table = Table::default();
        nodesets::load(&mut table)?;
        vendor_types::add(&mut table, generation, words);
        table.shrink();
        Ok(Self(Arc::clone(shared.get_or_init(|| Arc::new(table)))))
    }
}

/// Tells the server which types there are: it needs them to filter references by their type.
pub(super) fn register(table: &Table, tree: &mut DefaultTypeTree) {
    for (id, node) in table.nodes() {
        let is_type = matches!(
            node.class,
            Class::ObjectType { .. }
                | Class::VariableType { .. }
                | Class::ReferenceType { .. }
                | Class::DataType { .. }
        );
        if is_type && let Some(supertype) = table.supertype(id) {
            tree.add_type_node(&id.into(), &supertype.into(), node.node_class());
        }
    }
}
