use super::{NodeId, QualifiedName};

/// A reference from the node that was browsed to another one (OPC 10000-4 §7.30).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NodeReference {
    /// The type of the reference, for example HasComponent.
    pub reference_type: NodeId,
    /// Whether the browsed node is its source.
    pub is_forward: bool,
    /// The other node.
    pub node: NodeId,
    pub browse_name: QualifiedName,
    /// The name for people, in the language that the server chose.
    pub display_name: String,
    pub node_class: NodeClass,
    /// The node's type; `None` for what is no object and no variable.
    pub type_definition: Option<NodeId>,
}

/// What kind of node it is (OPC 10000-3 §8.29).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NodeClass {
    Object,
    Variable,
    Method,
    ObjectType,
    VariableType,
    ReferenceType,
    DataType,
    View,
    /// A class that the standard does not know.
    Unspecified,
}
