//! Made-up address spaces for tests.

use std::collections::HashMap;

use super::arrange::arrange;
use super::layout::LiveLayout;
use super::tree::{NodeIndex, NodeTree};
use crate::model::opcua::{NodeClass, NodeId, NodeReference, QualifiedName, Value};

/// Nodes that are made as they are named by their path from DeviceSet.
pub struct Space {
    tree: NodeTree,
    by_path: HashMap<String, NodeIndex>,
    types: HashMap<NodeId, String>,
    properties: HashMap<NodeId, Value>,
    next: u32,
}

impl Space {
    pub fn new() -> Self {
        let tree = NodeTree::new(NodeId::numeric(1, 999));
        let by_path = HashMap::from([("DeviceSet".to_owned(), 0)]);
        Self { tree, by_path, types: HashMap::new(), properties: HashMap::new(), next: 1000 }
    }

    /// An object; folders above it that are missing are made.
    pub fn object(&mut self, path: &str, type_name: &str) -> NodeIndex {
        self.node(path, NodeClass::Object, type_name)
    }

    /// As [`Space::object`], a variable.
    pub fn variable(&mut self, path: &str, type_name: &str) -> NodeIndex {
        self.node(path, NodeClass::Variable, type_name)
    }

    /// Gives a variable a unit and a range.
    pub fn unit(&mut self, path: &str, symbol: &str, (low, high): (f64, f64)) {
        let unit = Value::EngineeringUnits { unit_id: 0, symbol: symbol.to_owned() };
        for (name, value) in [("EngineeringUnits", unit), ("EURange", Value::Range { low, high })] {
            let property = self.variable(&format!("{path}/{name}"), "PropertyType");
            self.properties.insert(self.id_of(property), value);
        }
    }

    /// Adds a reference from one node to another.
    pub fn refer(&mut self, from: NodeIndex, to: NodeIndex) {
        let node = self.tree.node(to);
        let reference = NodeReference {
            reference_type: NodeId::numeric(3, 1),
            is_forward: true,
            node: node.id.clone(),
            browse_name: node.browse_name.clone(),
            display_name: node.display_name.clone(),
            node_class: node.class,
            type_definition: node.type_definition.clone(),
        };
        assert_eq!(self.tree.add(from, reference), None, "known before");
    }

    pub fn id_of(&self, index: NodeIndex) -> NodeId {
        self.tree.node(index).id.clone()
    }

    pub fn id(&self, path: &str) -> NodeId {
        self.id_of(self.by_path[path])
    }

    pub fn arranged(&mut self) -> LiveLayout {
        self.tree.set_types(self.types.clone());
        arrange(&self.tree, &self.properties)
    }

    fn node(&mut self, path: &str, class: NodeClass, type_name: &str) -> NodeIndex {
        if let Some(known) = self.by_path.get(path) {
            return *known;
        }
        let (parent, name) = path.rsplit_once('/').unwrap();
        let parent = self.node(parent, NodeClass::Object, "FolderType");
        // Ids as they are asked for first: a parent is made before its child.
        let node = NodeId::numeric(1, self.next);
        self.next += 1;
        let known_types = self.types.len() as u32;
        let known = self.types.iter().find(|(_, name)| *name == type_name).map(|(id, _)| id.clone());
        let type_definition = known.unwrap_or(NodeId::numeric(4, known_types));
        self.types.insert(type_definition.clone(), type_name.to_owned());
        let reference = NodeReference {
            reference_type: NodeId::numeric(0, 47),
            is_forward: true,
            node,
            browse_name: QualifiedName::new(2, name),
            display_name: String::new(),
            node_class: class,
            type_definition: Some(type_definition),
        };
        let index = self.tree.add(parent, reference).unwrap();
        self.by_path.insert(path.to_owned(), index);
        index
    }
}
