//! Finds the nodes of the force sensor and the motion log.
//!
//! Node ids change with the controller's hardware and firmware, so the nodes are looked for by their names below
//! `Objects/DeviceSet` (manual 3.2.3.2, 3.2.3.4). Where that leads to nothing, the ids that the manual's programs use
//! are tried (manual 4.1.2.3, 4.3.2).

use std::collections::{HashSet, VecDeque};

use async_trait::async_trait;

use super::settings::{RecordSettings, Source};
use super::source::SourceError;
use crate::model::opcua::{NodeClass, NodeId, NodeReference};
use crate::session::opcua_client::ClientSession;

/// The nodes of one channel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DataNodes {
    pub data_type: NodeId,
    pub data_num: NodeId,
    /// SamplingInterval of the motion log, or Port of the force sensor.
    pub third: NodeId,
    pub data: NodeId,
    /// LoggingStatus or MonitorStatus.
    pub running: NodeId,
    pub data_exists: NodeId,
    pub error: NodeId,
}

/// What a search needs of a server.
#[async_trait]
pub trait Browse: Sync {
    /// What a tree shows below a node.
    async fn children(&self, node: &NodeId) -> Result<Vec<NodeReference>, SourceError>;
}

#[async_trait]
impl Browse for ClientSession {
    async fn children(&self, node: &NodeId) -> Result<Vec<NodeReference>, SourceError> {
        Self::children(self, node).await.map_err(SourceError::Session)
    }
}

/// Objects that are looked into at most. A controller with two robots has some hundred.
const MAX_OBJECTS: usize = 2_000;

/// Looks for the nodes below `Objects/DeviceSet`.
pub async fn find(server: &dyn Browse, settings: &RecordSettings) -> Result<Option<DataNodes>, SourceError> {
    let objects = server.children(&NodeId::OBJECTS_FOLDER).await?;
    let Some(devices) = objects.into_iter().find(|child| child.browse_name.name == "DeviceSet") else {
        return Ok(None);
    };
    let mut seen = HashSet::from([devices.node.clone()]);
    let mut waiting = VecDeque::from([devices.node]);
    let mut looked = 0;
    while let Some(node) = waiting.pop_front() {
        looked += 1;
        if looked > MAX_OBJECTS {
            break;
        }
        let children = server.children(&node).await?;
        if let Some(nodes) = of_system(server, &children, settings).await? {
            return Ok(Some(nodes));
        }
        let objects = children.into_iter().filter(|child| child.node_class == NodeClass::Object);
        waiting.extend(objects.map(|child| child.node).filter(|node| seen.insert(node.clone())));
    }
    Ok(None)
}

/// The nodes, if these are the children of the system that is looked for.
async fn of_system(
    server: &dyn Browse,
    children: &[NodeReference],
    settings: &RecordSettings,
) -> Result<Option<DataNodes>, SourceError> {
    let (third, running, channel) = match settings.source() {
        Source::Force { monitor, .. } => ("Port", "MonitorStatus", usize::from(monitor) - 1),
        Source::Motion { .. } => ("SamplingInterval", "LoggingStatus", 0),
    };
    let system = (variable(children, "DataType"), variable(children, "DataNum"), variable(children, third));
    let (Some(data_type), Some(data_num), Some(third)) = system else { return Ok(None) };
    let mut objects: Vec<&NodeReference> =
        children.iter().filter(|child| child.node_class == NodeClass::Object).collect();
    objects.sort_by_key(|object| &object.browse_name.name);
    let mut channels = Vec::new();
    for object in objects {
        let members = server.children(&object.node).await?;
        let names = ["Data", running, "DataExistsStatus", "ErrorStatus"];
        if let [Some(data), Some(running), Some(data_exists), Some(error)] = names.map(|name| variable(&members, name))
        {
            let (data_type, data_num, third) = (data_type.clone(), data_num.clone(), third.clone());
            channels.push(DataNodes { data_type, data_num, third, data, running, data_exists, error });
        }
    }
    Ok((channel < channels.len()).then(|| channels.swap_remove(channel)))
}

fn variable(children: &[NodeReference], name: &str) -> Option<NodeId> {
    let found = children.iter().find(|child| child.node_class == NodeClass::Variable && child.browse_name.name == name);
    found.map(|child| child.node.clone())
}

/// The ids of the manual's programs, and those that follow from them.
pub fn of_manual(settings: &RecordSettings) -> DataNodes {
    let node = |identifier| NodeId::numeric(1, identifier);
    match settings.source() {
        Source::Force { monitor, .. } => {
            let channel = 196_865 + 256 * (u32::from(monitor) - 1);
            DataNodes {
                data_type: node(196_611),
                data_num: node(196_612),
                third: node(196_609),
                data: node(channel),
                running: node(channel + 1),
                data_exists: node(channel + 2),
                error: node(channel + 3),
            }
        }
        Source::Motion { .. } => DataNodes {
            data_type: node(20_312),
            data_num: node(20_313),
            third: node(20_314),
            data: node(20_316),
            running: node(20_317),
            data_exists: node(20_318),
            error: node(20_319),
        },
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::model::opcua::QualifiedName;

    /// Children by node; a name in lower case is an object.
    struct Tree(HashMap<NodeId, Vec<NodeReference>>);

    #[async_trait]
    impl Browse for Tree {
        async fn children(&self, node: &NodeId) -> Result<Vec<NodeReference>, SourceError> {
            Ok(self.0.get(node).cloned().unwrap_or_default())
        }
    }

    /// A node and its children, each with its number, name and class.
    type Row<'a> = (u32, &'a [(u32, &'a str, NodeClass)]);

    fn tree(rows: &[Row<'_>]) -> Tree {
        let id = |identifier| match identifier {
            85 => NodeId::OBJECTS_FOLDER,
            other => NodeId::numeric(4, other),
        };
        let reference = |(node, name, node_class): &(u32, &str, NodeClass)| NodeReference {
            reference_type: NodeId::numeric(0, 47),
            is_forward: true,
            node: id(*node),
            browse_name: QualifiedName::new(4, *name),
            display_name: (*name).to_owned(),
            node_class: *node_class,
            type_definition: None,
        };
        Tree(rows.iter().map(|(node, children)| (id(*node), children.iter().map(reference).collect())).collect())
    }

    #[tokio::test]
    async fn the_nodes_of_each_channel_are_found_by_their_names() {
        use NodeClass::{Object, Variable};
        let channel = |first: u32| {
            [(first, "Data"), (first + 1, "MonitorStatus"), (first + 2, "DataExistsStatus"), (first + 3, "ErrorStatus")]
                .map(|(node, name)| (node, name, Variable))
        };
        let tree = tree(&[
            (85, &[(1, "Server", Object), (2, "DeviceSet", Object)]),
            // The system refers back to its parent.
            (2, &[(3, "Cell", Object)]),
            (3, &[(4, "Motion", Object), (5, "Force", Object), (2, "DeviceSet", Object)]),
            (4, &[(40, "DataType", Variable), (41, "DataNum", Variable)]),
            (
                5,
                &[
                    (50, "Port", Variable),
                    (51, "DataType", Variable),
                    (52, "DataNum", Variable),
                    (7, "Monitor_2", Object),
                    (6, "Monitor_1", Object),
                ],
            ),
            (6, &channel(60)),
            (7, &channel(70)),
        ]);
        let node = |identifier| NodeId::numeric(4, identifier);
        let second = find(&tree, &RecordSettings::force(0, 2, 0).unwrap()).await.unwrap().unwrap();
        assert_eq!((second.data, second.third, second.error), (node(70), node(50), node(73)));
        let first = find(&tree, &RecordSettings::force(0, 1, 0).unwrap()).await.unwrap().unwrap();
        assert_eq!((first.data, first.running), (node(60), node(61)));
        assert_eq!(find(&tree, &RecordSettings::motion(0, 0).unwrap()).await.unwrap(), None);
    }

    #[test]
    fn the_ids_of_the_manual() {
        let force = of_manual(&RecordSettings::force(0, 1, 0).unwrap());
        assert_eq!(force.data_exists.to_string(), "ns=1;i=196867");
        let second = of_manual(&RecordSettings::force(0, 2, 0).unwrap());
        assert_eq!(second.data.to_string(), "ns=1;i=197121");
        let motion = of_manual(&RecordSettings::motion(0, 0).unwrap());
        assert_eq!(
            (motion.data.to_string().as_str(), motion.third.to_string().as_str()),
            ("ns=1;i=20316", "ns=1;i=20314")
        );
    }
}
