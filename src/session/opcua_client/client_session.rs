use std::sync::Arc;
use std::time::Duration;

use opcua::client::UARequest;
use opcua::client::services::{Browse, BrowseNext, Read, TranslateBrowsePaths, Write};
use opcua::types::{
    AttributeId, BrowseDescription, BrowseDirection, BrowsePath, BrowsePathTarget, BrowseResult, BrowseResultMask,
    ByteString, QualifiedName as UaQualifiedName, ReadValueId, ReferenceDescription, ReferenceTypeId, RelativePath,
    RelativePathElement, StatusCode, TimestampsToReturn, WriteValue,
};

use super::convert::{data_value, quality, reference, ua_node_id, ua_variant};
use super::failure::{ConnectFailure, ConnectStage, status};
use super::open_session::OpenSession;
use super::session_channel::{MAX_OPERATIONS, SessionChannel, wrong_answer};
use super::subscription::{Subscription, SubscriptionIntervals};
use crate::model::opcua::{DataValue, NodeId, NodeReference, QualifiedName, Quality, Value};

/// A session with an OPC UA server that stays open until it is closed or dropped, or the connection ends.
///
/// Calls run side by side. Each waits at most 20 s for its answer. After a failure other than of the connection the
/// session can be used further; nothing is tried again by itself. The session timeout is 60 s: a session in which nothing
/// is asked and nothing is subscribed ends by then.
#[derive(Debug, Clone)]
pub struct ClientSession {
    channel: Arc<SessionChannel>,
}

impl ClientSession {
    pub(super) fn new(session: OpenSession) -> Self {
        Self { channel: Arc::new(SessionChannel::new(session)) }
    }

    /// Values of variables, in the order of `nodes`; at most 1,000 in one request, more in several. A node that cannot be
    /// read has a bad quality.
    pub async fn read(&self, nodes: &[NodeId]) -> Result<Vec<DataValue>, ConnectFailure> {
        self.read_attributes(nodes.iter().map(|node| (node, AttributeId::Value))).await
    }

    /// The value of one variable.
    pub async fn read_one(&self, node: &NodeId) -> Result<DataValue, ConnectFailure> {
        self.read(std::slice::from_ref(node)).await?.pop().ok_or_else(|| wrong_answer(ConnectStage::Read))
    }

    /// All attributes of a node that it has, by name (OPC 10000-3 §5).
    pub async fn attributes(&self, node: &NodeId) -> Result<Vec<(&'static str, DataValue)>, ConnectFailure> {
        self.attributes_where(node, |_| true).await
    }

    /// As [`ClientSession::attributes`], but without the value: reading it may have an effect.
    pub async fn attributes_but_value(&self, node: &NodeId) -> Result<Vec<(&'static str, DataValue)>, ConnectFailure> {
        self.attributes_where(node, |attribute| attribute != AttributeId::Value).await
    }

    async fn attributes_where(
        &self,
        node: &NodeId,
        wanted: impl Fn(AttributeId) -> bool,
    ) -> Result<Vec<(&'static str, DataValue)>, ConnectFailure> {
        let wanted: Vec<_> = ATTRIBUTES.iter().filter(|(attribute, _)| wanted(*attribute)).collect();
        let values = self.read_attributes(wanted.iter().map(|(attribute, _)| (node, *attribute))).await?;
        let named = wanted.iter().map(|(_, name)| *name).zip(values);
        Ok(named.filter(|(_, value)| value.quality.name() != "BadAttributeIdInvalid").collect())
    }

    async fn read_attributes(
        &self,
        attributes: impl Iterator<Item = (&NodeId, AttributeId)>,
    ) -> Result<Vec<DataValue>, ConnectFailure> {
        let attributes: Vec<ReadValueId> = attributes
            .map(|(node, attribute)| ReadValueId {
                node_id: ua_node_id(node),
                attribute_id: attribute as u32,
                ..Default::default()
            })
            .collect();
        let mut values = Vec::with_capacity(attributes.len());
        for some in attributes.chunks(MAX_OPERATIONS) {
            let request = self.channel.request(|channel, token, handle| {
                Read::new_manual(0, REQUEST, token, handle)
                    .timestamps_to_return(TimestampsToReturn::Both)
                    .nodes_to_read(some.to_vec())
                    .send(channel.secure())
            });
            let results = self.channel.answered(ConnectStage::Read, request).await?.results.unwrap_or_default();
            if results.len() != some.len() {
                return Err(wrong_answer(ConnectStage::Read));
            }
            values.extend(results.into_iter().map(data_value));
        }
        Ok(values)
    }

    /// Writes values, all in one request; what became of each, in the same order. A value is written as the type it has.
    pub async fn write(&self, values: &[(NodeId, Value)]) -> Result<Vec<Quality>, ConnectFailure> {
        let nodes_to_write: Option<Vec<WriteValue>> = values
            .iter()
            .map(|(node, value)| {
                Some(WriteValue {
                    node_id: ua_node_id(node),
                    attribute_id: AttributeId::Value as u32,
                    value: ua_variant(value)?.into(),
                    ..Default::default()
                })
            })
            .collect();
        let nodes_to_write = nodes_to_write
            .ok_or_else(|| ConnectFailure::of(ConnectStage::Write, status(StatusCode::BadTypeMismatch, "")))?;
        let request = self.channel.request(|channel, token, handle| {
            Write::new_manual(0, REQUEST, token, handle).nodes_to_write(nodes_to_write).send(channel.secure())
        });
        let results = self.channel.answered(ConnectStage::Write, request).await?.results.unwrap_or_default();
        if results.len() != values.len() {
            return Err(wrong_answer(ConnectStage::Write));
        }
        Ok(results.into_iter().map(quality).collect())
    }

    /// The nodes that a node refers to by hierarchical references: what a tree shows below it. At most 10,000.
    pub async fn children(&self, node: &NodeId) -> Result<Vec<NodeReference>, ConnectFailure> {
        self.browse(node, CHILDREN, BrowseDirection::Forward).await
    }

    /// The children of each node, as [`ClientSession::children`] gives them, in the order of `nodes`; at most 100 nodes in
    /// one request, more in several. A node that cannot be browsed has none.
    pub async fn children_of(&self, nodes: &[NodeId]) -> Result<Vec<Vec<NodeReference>>, ConnectFailure> {
        let mut children = Vec::with_capacity(nodes.len());
        for some in nodes.chunks(MAX_BROWSED) {
            let descriptions = some.iter().map(|node| description(node, CHILDREN, BrowseDirection::Forward)).collect();
            let results = self.browse_first(descriptions).await?;
            if results.len() != some.len() {
                return Err(wrong_answer(ConnectStage::Browse));
            }
            for (node, page) in some.iter().zip(results) {
                children.push(match page.status_code {
                    // The server keeps its place in only so many nodes at once.
                    StatusCode::BadNoContinuationPoints => self.children(node).await?,
                    code if code.is_bad() => Vec::new(),
                    _ => self.all_pages(page).await?,
                });
            }
        }
        Ok(children)
    }

    /// The BrowseName of each node, in the order of `nodes`; `None` where it cannot be read.
    pub async fn browse_names(&self, nodes: &[NodeId]) -> Result<Vec<Option<QualifiedName>>, ConnectFailure> {
        let names = self.read_attributes(nodes.iter().map(|node| (node, AttributeId::BrowseName))).await?;
        Ok(names
            .into_iter()
            .map(|name| match name.value {
                Value::QualifiedName(name) => Some(name),
                _ => None,
            })
            .collect())
    }

    /// All references of a node, in both directions. At most 10,000.
    pub async fn references(&self, node: &NodeId) -> Result<Vec<NodeReference>, ConnectFailure> {
        self.browse(node, ReferenceTypeId::References, BrowseDirection::Both).await
    }

    async fn browse(
        &self,
        node: &NodeId,
        references: ReferenceTypeId,
        direction: BrowseDirection,
    ) -> Result<Vec<NodeReference>, ConnectFailure> {
        let mut results = self.browse_first(vec![description(node, references, direction)]).await?;
        let page = results.pop().ok_or_else(|| wrong_answer(ConnectStage::Browse))?;
        self.all_pages(page).await
    }

    /// The first references of nodes.
    async fn browse_first(&self, nodes: Vec<BrowseDescription>) -> Result<Vec<BrowseResult>, ConnectFailure> {
        let request = self.channel.request(|channel, token, handle| {
            Browse::new_manual(0, REQUEST, token, handle)
                .max_references_per_node(MAX_OPERATIONS as u32)
                .nodes_to_browse(nodes)
                .send(channel.secure())
        });
        Ok(self.channel.answered(ConnectStage::Browse, request).await?.results.unwrap_or_default())
    }

    /// The references of the first page and of those after it.
    async fn all_pages(&self, mut page: BrowseResult) -> Result<Vec<NodeReference>, ConnectFailure> {
        let mut found: Vec<ReferenceDescription> = Vec::new();
        loop {
            if page.status_code.is_bad() {
                return Err(ConnectFailure::of(ConnectStage::Browse, status(page.status_code, "")));
            }
            found.extend(page.references.unwrap_or_default());
            let point = page.continuation_point;
            if point.is_null_or_empty() {
                break;
            }
            let is_full = found.len() >= MAX_REFERENCES;
            let next = self.browse_on(point, is_full).await?;
            if is_full {
                break;
            }
            page = next.and_then(|mut results| results.pop()).ok_or_else(|| wrong_answer(ConnectStage::Browse))?;
        }
        found.truncate(MAX_REFERENCES);
        Ok(found.into_iter().map(reference).collect())
    }

    /// The next references, or else the continuation point is released.
    async fn browse_on(&self, point: ByteString, release: bool) -> Result<Option<Vec<BrowseResult>>, ConnectFailure> {
        let request = self.channel.request(|channel, token, handle| {
            BrowseNext::new_manual(0, REQUEST, token, handle)
                .release_continuation_points(release)
                .continuation_point(point)
                .send(channel.secure())
        });
        Ok(self.channel.answered(ConnectStage::Browse, request).await?.results)
    }

    /// The node at the end of a path of browse names from `start`, along hierarchical references (OPC 10000-4 §5.9.4).
    /// `None` if there is none, or more than one.
    pub async fn node_at(&self, start: &NodeId, path: &[QualifiedName]) -> Result<Option<NodeId>, ConnectFailure> {
        let elements = path.iter().map(|name| RelativePathElement {
            reference_type_id: ReferenceTypeId::HierarchicalReferences.into(),
            is_inverse: false,
            include_subtypes: true,
            target_name: UaQualifiedName::new(name.namespace, name.name.as_str()),
        });
        let path = BrowsePath {
            starting_node: ua_node_id(start),
            relative_path: RelativePath { elements: Some(elements.collect()) },
        };
        let request = self.channel.request(|channel, token, handle| {
            TranslateBrowsePaths::new_manual(0, REQUEST, token, handle).browse_path(path).send(channel.secure())
        });
        let results = self.channel.answered(ConnectStage::Browse, request).await?.results.unwrap_or_default();
        let [result] = &results[..] else { return Err(wrong_answer(ConnectStage::Browse)) };
        match (result.status_code, result.targets.as_deref().unwrap_or_default()) {
            (StatusCode::BadNoMatch, _) => Ok(None),
            (code, _) if code.is_bad() => Err(ConnectFailure::of(ConnectStage::Browse, status(code, ""))),
            (_, [BrowsePathTarget { target_id, .. }]) => Ok(Some(super::convert::node_id(&target_id.node_id))),
            _ => Ok(None),
        }
    }

    /// The URIs of the server's namespaces: the index of each is the namespace of node ids (OPC 10000-5 §6.3.1).
    pub async fn namespaces(&self) -> Result<Vec<String>, ConnectFailure> {
        let array = self.read_one(&NodeId::numeric(0, NAMESPACE_ARRAY)).await?;
        let Value::Array(uris) = array.value else { return Err(wrong_answer(ConnectStage::Read)) };
        Ok(uris.iter().map(|uri| uri.as_text().unwrap_or_default().to_owned()).collect())
    }

    /// Values of variables as they change; the first of each at once.
    pub async fn subscribe(
        &self,
        nodes: &[NodeId],
        intervals: SubscriptionIntervals,
    ) -> Result<Subscription, ConnectFailure> {
        Subscription::create(self.channel.clone(), nodes, intervals).await
    }

    /// Returns when the connection has ended, with the reason.
    pub async fn ended(&self) -> ConnectFailure {
        self.channel.ended().await
    }

    /// Closes session and channel. A server that does not answer within 2 s is disconnected.
    pub async fn close(self) {
        self.channel.close().await;
    }
}

fn description(node: &NodeId, references: ReferenceTypeId, direction: BrowseDirection) -> BrowseDescription {
    BrowseDescription {
        node_id: ua_node_id(node),
        browse_direction: direction,
        reference_type_id: references.into(),
        include_subtypes: true,
        node_class_mask: 0,
        result_mask: BrowseResultMask::All as u32,
    }
}

/// The attributes of a node that are worth showing, and their names.
const ATTRIBUTES: [(AttributeId, &str); 18] = [
    (AttributeId::NodeId, "NodeId"),
    (AttributeId::NodeClass, "NodeClass"),
    (AttributeId::BrowseName, "BrowseName"),
    (AttributeId::DisplayName, "DisplayName"),
    (AttributeId::Description, "Description"),
    (AttributeId::Value, "Value"),
    (AttributeId::DataType, "DataType"),
    (AttributeId::ValueRank, "ValueRank"),
    (AttributeId::ArrayDimensions, "ArrayDimensions"),
    (AttributeId::AccessLevel, "AccessLevel"),
    (AttributeId::UserAccessLevel, "UserAccessLevel"),
    (AttributeId::MinimumSamplingInterval, "MinimumSamplingInterval"),
    (AttributeId::Historizing, "Historizing"),
    (AttributeId::EventNotifier, "EventNotifier"),
    (AttributeId::Executable, "Executable"),
    (AttributeId::UserExecutable, "UserExecutable"),
    (AttributeId::IsAbstract, "IsAbstract"),
    (AttributeId::InverseName, "InverseName"),
];
/// `Server_NamespaceArray` (OPC 10000-6 §A.3).
const NAMESPACE_ARRAY: u32 = 2255;
const REQUEST: Duration = Duration::from_secs(20);
const MAX_REFERENCES: usize = 10_000;
/// Nodes in one Browse request.
const MAX_BROWSED: usize = 100;
/// The references that lead to what a tree shows below a node.
const CHILDREN: ReferenceTypeId = ReferenceTypeId::HierarchicalReferences;
