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
    /// Browse name of the target.
    pub browse_name: QualifiedName,
    /// The name for people, in the language that the server chose.
    pub display_name: String,
    /// Node class of the target.
    pub node_class: NodeClass,
    /// The node's type; `None` for what is no object and no variable.
    pub type_definition: Option<NodeId>,
}

/// What kind of node it is (OPC 10000-3 §8.29).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NodeClass {
    /// An object.
    Object,
    /// A variable; the only class with a value.
    Variable,
    /// A method, which a client can call.
    Method,
    /// A type of objects.
    ObjectType,
    /// A type of variables.
    VariableType,
    /// A type of references.
    ReferenceType,
    /// A type of values.
    DataType,
    /// A view: a part of the address space.
    View,
    /// A class that the standard does not know.
    Unspecified,
}
