use std::collections::HashMap;

use crate::model::opcua::{NodeClass, NodeId, NodeReference, QualifiedName};

/// Nodes of a server and how they hang together. A node that several others refer to is in it once.
#[derive(Debug, Default)]
pub(super) struct NodeTree {
    nodes: Vec<TreeNode>,
    by_id: HashMap<NodeId, NodeIndex>,
    /// BrowseNames of type definitions.
    types: HashMap<NodeId, String>,
    /// Not every node was browsed.
    pub is_cut: bool,
}

/// Position of a node in its [`NodeTree`]. The root is 0.
pub(super) type NodeIndex = usize;

/// A node as its parent's references describe it.
#[derive(Debug)]
pub(super) struct TreeNode {
    pub id: NodeId,
    pub browse_name: QualifiedName,
    pub display_name: String,
    pub class: NodeClass,
    pub type_definition: Option<NodeId>,
    /// In the server's order; also nodes that another parent has as well.
    pub children: Vec<NodeIndex>,
}

impl NodeTree {
    /// A tree of the root alone.
    pub fn new(root: NodeId) -> Self {
        let mut tree = Self::default();
        tree.by_id.insert(root.clone(), 0);
        tree.nodes.push(TreeNode {
            id: root,
            browse_name: QualifiedName::new(0, ""),
            display_name: String::new(),
            class: NodeClass::Object,
            type_definition: None,
            children: Vec::new(),
        });
        tree
    }

    /// Adds what a node refers to. Returns the index of the node if it was not in the tree.
    pub fn add(&mut self, parent: NodeIndex, reference: NodeReference) -> Option<NodeIndex> {
        let known = self.by_id.get(&reference.node).copied();
        let index = known.unwrap_or(self.nodes.len());
        if known.is_none() {
            self.by_id.insert(reference.node.clone(), index);
            self.nodes.push(TreeNode {
                id: reference.node,
                browse_name: reference.browse_name,
                display_name: reference.display_name,
                class: reference.node_class,
                type_definition: reference.type_definition,
                children: Vec::new(),
            });
        }
        let children = &mut self.nodes[parent].children;
        if !children.contains(&index) {
            children.push(index);
        }
        known.is_none().then_some(index)
    }

    pub fn set_types(&mut self, types: HashMap<NodeId, String>) {
        self.types = types;
    }

    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    pub fn node(&self, index: NodeIndex) -> &TreeNode {
        &self.nodes[index]
    }

    pub fn nodes(&self) -> &[TreeNode] {
        &self.nodes
    }

    /// The BrowseName of the type definition; empty if it is not known.
    pub fn type_name(&self, index: NodeIndex) -> &str {
        let of = self.nodes[index].type_definition.as_ref().and_then(|id| self.types.get(id));
        of.map_or("", String::as_str)
    }

    pub fn children(&self, index: NodeIndex) -> impl Iterator<Item = NodeIndex> {
        self.nodes[index].children.iter().copied()
    }

    /// The objects among the children.
    pub fn objects(&self, index: NodeIndex) -> impl Iterator<Item = NodeIndex> {
        self.children(index).filter(|child| self.nodes[*child].class == NodeClass::Object)
    }

    /// The variables among the children.
    pub fn variables(&self, index: NodeIndex) -> impl Iterator<Item = NodeIndex> {
        self.children(index).filter(|child| self.nodes[*child].class == NodeClass::Variable)
    }

    /// The child with this BrowseName, in any namespace.
    pub fn child(&self, index: NodeIndex, name: &str) -> Option<NodeIndex> {
        self.children(index).find(|child| self.nodes[*child].browse_name.name == name)
    }

    /// The children of the child with this BrowseName that are objects: the instances in a folder.
    pub fn instances(&self, index: NodeIndex, folder: &str) -> Vec<NodeIndex> {
        self.child(index, folder).map(|folder| self.objects(folder).collect()).unwrap_or_default()
    }

    /// The variable with this BrowseName: a child, or in the ParameterSet, where DI keeps what changes
    /// (OPC 10000-100 §5.2).
    pub fn variable(&self, index: NodeIndex, name: &str) -> Option<NodeIndex> {
        let direct = self.child(index, name);
        let found = direct.or_else(|| self.child(self.child(index, "ParameterSet")?, name))?;
        (self.nodes[found].class == NodeClass::Variable).then_some(found)
    }

    pub fn name(&self, index: NodeIndex) -> &str {
        let node = &self.nodes[index];
        if node.display_name.is_empty() { &node.browse_name.name } else { &node.display_name }
    }
}
