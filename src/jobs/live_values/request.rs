use super::layout::LiveLayout;
use crate::model::Problem;
use crate::model::opcua::{DataValue, NodeId, NodeReference, QualifiedName, Quality, Value};

/// What a running watch is asked.
#[derive(Debug, Clone, PartialEq)]
pub enum LiveRequest {
    /// Report the values of these variables from now on, and of no others.
    Show(Vec<NodeId>),
    /// Report what is below a node.
    Children(NodeId),
    /// Report the attributes of a node.
    Inspect(NodeId),
    /// Write a value, as the type it has.
    Write {
        /// The variable.
        node: NodeId,
        /// The new value.
        value: Value,
    },
}

/// What a watch reports.
#[derive(Debug, Clone, PartialEq)]
pub enum LiveEvent {
    /// The session is open: at first, and after each reconnection. Node ids may have changed.
    Connected(Box<LiveLayout>),
    /// New values, in the order in which they came. A variable may occur several times.
    Values(Vec<(NodeId, DataValue)>),
    /// The connection is lost. It is opened again.
    Lost(Problem),
    /// Trying again would not help. The watch is over.
    Ended(Problem),
    /// What is below a node.
    Children {
        /// The node that was asked about.
        of: NodeId,
        /// Its children, or why they cannot be read.
        children: Result<Vec<NodeReference>, Problem>,
    },
    /// The attributes of a node.
    Inspected {
        /// The node that was asked about.
        node: NodeId,
        /// Its attributes, or why they cannot be read.
        details: Result<Box<NodeDetails>, Problem>,
    },
    /// What became of a write.
    Written {
        /// The variable.
        node: NodeId,
        /// The answer of the server, or why the write was not sent.
        quality: Result<Quality, Problem>,
    },
}

/// The attributes of a node (OPC 10000-3 §5).
#[derive(Debug, Clone, PartialEq)]
pub struct NodeDetails {
    /// Its BrowseName.
    pub browse_name: QualifiedName,
    /// All but the value, in the order of the standard: name and value of each.
    pub attributes: Vec<(&'static str, DataValue)>,
    /// Its value may be written by this user (OPC 10000-3 §8.57, UserAccessLevel).
    pub is_writable: bool,
    /// Each read takes away what it returns: it is not read here.
    pub is_consumed_by_reading: bool,
    /// BrowseName of the data type; `None` for what is no variable.
    pub data_type: Option<String>,
}
