use crate::model::opcua::QualifiedName;

/// Whether each read of a node takes away what it returns: the `Data` of the force sensor and of the motion log
/// (manual 3.2.3.2, 3.2.3.4). Such a node belongs to the client that records; the live view neither reads nor subscribes
/// it. Judged by the BrowseName alone, so that it also holds for nodes that were not explored.
pub fn is_consumed_by_reading(browse_name: &QualifiedName) -> bool {
    browse_name.name == "Data"
}
