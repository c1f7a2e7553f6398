use std::collections::HashMap;
use std::sync::Arc;

use super::id::{Id, standard};
use super::node::Node;

/// Nodes and the references between them.
#[derive(Debug, Default)]
pub(super) struct Table {
    entries: HashMap<Id, Entry>,
}

/// A node, or a node of another table, with the references of this table from and to it.
#[derive(Debug, Default)]
struct Entry {
    node: Option<Node>,
    references: Vec<Reference>,
}

/// One end of a reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Reference {
    pub(super) kind: Id,
    pub(super) other: Id,
    pub(super) is_forward: bool,
}

impl Table {
    /// Adds a node, or replaces the one with this id.
    pub(super) fn insert(&mut self, id: Id, node: Node) {
        self.entries.entry(id).or_default().node = Some(node);
    }

    /// Adds a reference. References to types and modelling rules are kept in the forward direction only (OPC 10000-3
    /// §7.4: servers need not offer the inverse).
    pub(super) fn refer(&mut self, from: Id, kind: Id, to: Id) {
        let mut add = |id, reference| self.entries.entry(id).or_default().references.push(reference);
        add(from, Reference { kind, other: to, is_forward: true });
        if kind != standard::HAS_TYPE_DEFINITION && kind != standard::HAS_MODELLING_RULE {
            add(to, Reference { kind, other: from, is_forward: false });
        }
    }

    pub(super) fn contains(&self, id: Id) -> bool {
        self.node(id).is_some()
    }

    pub(super) fn node(&self, id: Id) -> Option<&Node> {
        self.entries.get(&id)?.node.as_ref()
    }

    pub(super) fn node_mut(&mut self, id: Id) -> Option<&mut Node> {
        self.entries.get_mut(&id)?.node.as_mut()
    }

    pub(super) fn references(&self, id: Id) -> &[Reference] {
        self.entries.get(&id).map_or(&[], |entry| &entry.references)
    }

    /// The nodes a node refers to by references of exactly this type.
    pub(super) fn targets(&self, id: Id, kind: Id) -> impl Iterator<Item = Id> {
        self.references(id).iter().filter(move |r| r.is_forward && r.kind == kind).map(|r| r.other)
    }

    /// The supertype, if a table of types names it.
    pub(super) fn supertype(&self, id: Id) -> Option<Id> {
        let is_super = |r: &&Reference| !r.is_forward && r.kind == standard::HAS_SUBTYPE;
        self.references(id).iter().find(is_super).map(|r| r.other)
    }

    /// Every node, in no order.
    pub(super) fn nodes(&self) -> impl Iterator<Item = (Id, &Node)> {
        self.entries.iter().filter_map(|(id, entry)| Some((*id, entry.node.as_ref()?)))
    }

    pub(super) fn shrink(&mut self) {
        self.entries.shrink_to_fit();
        for entry in self.entries.values_mut() {
            entry.references.shrink_to_fit();
        }
    }
}

/// The address space of one controller but for OPC UA's own nodes: types, which all controllers of a firmware generation
/// share, and this controller's nodes.
#[derive(Debug)]
pub(super) struct Space {
    pub(super) types: Arc<Table>,
    pub(super) instances: Table,
}

impl Space {
    pub(super) fn node(&self, id: Id) -> Option<&Node> {
        self.instances.node(id).or_else(|| self.types.node(id))
    }

    pub(super) fn references(&self, id: Id) -> impl Iterator<Item = &Reference> {
        self.types.references(id).iter().chain(self.instances.references(id))
    }

    pub(super) fn type_definition(&self, id: Id) -> Option<Id> {
        let defines = |r: &&Reference| r.is_forward && r.kind == standard::HAS_TYPE_DEFINITION;
        self.references(id).find(defines).map(|r| r.other)
    }
}
