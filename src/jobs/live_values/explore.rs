use std::collections::HashMap;

use super::tree::{NodeIndex, NodeTree};
use crate::model::opcua::{NodeClass, NodeId, QualifiedName, Value};
use crate::session::opcua_client::{ClientSession, ConnectFailure};

/// Browses everything below DeviceSet, level by level, up to [`MAX_NODES`] nodes and [`MAX_DEPTH`] levels. A node that is
/// reached again is not browsed again. A server without DeviceSet gives an empty tree.
pub(super) async fn explore(session: &ClientSession) -> Result<NodeTree, ConnectFailure> {
    let objects = session.children(&NodeId::OBJECTS_FOLDER).await?;
    let device_set = objects.into_iter().find(|child| child.browse_name.name == "DeviceSet");
    let Some(device_set) = device_set else { return Ok(NodeTree::default()) };
    let mut tree = NodeTree::new(device_set.node);
    let mut level: Vec<NodeIndex> = vec![0];
    for _ in 0..MAX_DEPTH {
        if level.is_empty() {
            break;
        }
        let ids: Vec<NodeId> = level.iter().map(|index| tree.node(*index).id.clone()).collect();
        let mut next = Vec::new();
        for (parent, children) in level.iter().zip(session.children_of(&ids).await?) {
            for child in children {
                if tree.len() >= MAX_NODES {
                    tree.is_cut = true;
                    break;
                }
                let is_instance = matches!(child.node_class, NodeClass::Object | NodeClass::Variable);
                if is_instance && let Some(new) = tree.add(*parent, child) {
                    next.push(new);
                }
            }
        }
        level = next;
    }
    tree.is_cut |= !level.is_empty();
    let types = type_names(session, &tree).await?;
    tree.set_types(types);
    Ok(tree)
}

async fn type_names(session: &ClientSession, tree: &NodeTree) -> Result<HashMap<NodeId, String>, ConnectFailure> {
    let mut ids: Vec<NodeId> = tree.nodes().iter().filter_map(|node| node.type_definition.clone()).collect();
    ids.sort_unstable();
    ids.dedup();
    let names = session.browse_names(&ids).await?;
    let named = |(id, name): (NodeId, Option<QualifiedName>)| Some((id, name?.name));
    Ok(ids.into_iter().zip(names).filter_map(named).collect())
}

/// Units and ranges of variables, as their properties tell (OPC 10000-8 §5.3.2): of each property node its value.
pub(super) async fn properties(
    session: &ClientSession,
    tree: &NodeTree,
) -> Result<HashMap<NodeId, Value>, ConnectFailure> {
    let is_wanted = |name: &str| matches!(name, "EngineeringUnits" | "EURange");
    let nodes = tree.nodes().iter().filter(|node| is_wanted(&node.browse_name.name));
    let ids: Vec<NodeId> = nodes.map(|node| node.id.clone()).collect();
    let values = session.read(&ids).await?;
    Ok(ids.into_iter().zip(values).map(|(id, value)| (id, value.value)).collect())
}

const MAX_NODES: usize = 20_000;
const MAX_DEPTH: usize = 16;
