use std::sync::Arc;
use std::time::Duration;

use opcua::client::services::{Browse, BrowseNext, Read, TranslateBrowsePaths, Write};
use opcua::client::transport::TransportPollResult;
use opcua::client::{AsyncSecureChannel, UARequest};
use opcua::core::handle::AtomicHandle;
use opcua::types::{
    AttributeId, BrowseDescription, BrowseDirection, BrowsePath, BrowsePathTarget, BrowseResult, BrowseResultMask,
    ByteString, Error, NodeId as UaNodeId, QualifiedName as UaQualifiedName, ReadValueId, ReferenceDescription,
    ReferenceTypeId, RelativePath, RelativePathElement, StatusCode, TimestampsToReturn, WriteValue,
};
use parking_lot::Mutex;
use tokio::task::AbortHandle;
use tokio_util::sync::CancellationToken;

use super::connection::{ChannelEvents, ClientChannel};
use super::convert::{data_value, quality, reference, ua_node_id, ua_variant};
use super::failure::{ConnectFailure, ConnectFailureCause, ConnectStage, status};
use super::open_session::{CLOSE, OpenSession};
use super::subscription::{Subscription, SubscriptionIntervals};
use super::watched_stream::StreamObservations;
use crate::model::opcua::{DataValue, NodeId, NodeReference, QualifiedName, Quality, Value};

/// A session with an OPC UA server that stays open until it is closed or dropped, or the connection ends.
///
/// Calls run side by side. Each waits at most 20 s for its answer. After a failure other than of the connection the
/// session can be used further; nothing is tried again by itself. The session timeout is 60 s: a session in which nothing
/// is asked and nothing is subscribed ends by then.
#[derive(Debug, Clone)]
pub struct ClientSession {
    shared: Arc<Shared>,
}

/// What the session and its subscriptions have in common.
pub(super) struct Shared {
    secure: AsyncSecureChannel,
    token: UaNodeId,
    heard: Arc<Mutex<StreamObservations>>,
    /// Cancelled when the connection has ended.
    ended: CancellationToken,
    end_status: Arc<Mutex<Option<StatusCode>>>,
    /// Serves the connection.
    events: AbortHandle,
    pub(super) monitored_items: AtomicHandle,
}

impl std::fmt::Debug for Shared {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Shared").field("ended", &self.ended.is_cancelled()).finish_non_exhaustive()
    }
}

/// Disconnects. A session that was not closed expires in the server.
impl Drop for Shared {
    fn drop(&mut self) {
        self.events.abort();
    }
}

impl ClientSession {
    pub(super) fn new(session: OpenSession) -> Self {
        let OpenSession { channel, token } = session;
        let ClientChannel { secure, events, heard, .. } = channel;
        let ended = CancellationToken::new();
        let end_status = Arc::new(Mutex::new(None));
        // The guard also reports the end if the library panics over what the server sent.
        let task = tokio::spawn(serve(events, end_status.clone(), ended.clone().drop_guard()));
        Self {
            shared: Arc::new(Shared {
                secure,
                token,
                heard,
                ended,
                end_status,
                events: task.abort_handle(),
                monitored_items: AtomicHandle::new(1),
            }),
        }
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
            let request = self.shared.header(|shared, token, handle| {
                Read::new_manual(0, REQUEST, token, handle)
                    .timestamps_to_return(TimestampsToReturn::Both)
                    .nodes_to_read(some.to_vec())
                    .send(&shared.secure)
            });
            let results = self.shared.answered(ConnectStage::Read, request).await?.results.unwrap_or_default();
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
        let request = self.shared.header(|shared, token, handle| {
            Write::new_manual(0, REQUEST, token, handle).nodes_to_write(nodes_to_write).send(&shared.secure)
        });
        let results = self.shared.answered(ConnectStage::Write, request).await?.results.unwrap_or_default();
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
        let request = self.shared.header(|shared, token, handle| {
            Browse::new_manual(0, REQUEST, token, handle)
                .max_references_per_node(MAX_OPERATIONS as u32)
                .nodes_to_browse(nodes)
                .send(&shared.secure)
        });
        Ok(self.shared.answered(ConnectStage::Browse, request).await?.results.unwrap_or_default())
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
        let request = self.shared.header(|shared, token, handle| {
            BrowseNext::new_manual(0, REQUEST, token, handle)
                .release_continuation_points(release)
                .continuation_point(point)
                .send(&shared.secure)
        });
        Ok(self.shared.answered(ConnectStage::Browse, request).await?.results)
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
        let request = self.shared.header(|shared, token, handle| {
            TranslateBrowsePaths::new_manual(0, REQUEST, token, handle).browse_path(path).send(&shared.secure)
        });
        let results = self.shared.answered(ConnectStage::Browse, request).await?.results.unwrap_or_default();
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
        Subscription::create(self.shared.clone(), nodes, intervals).await
    }

    /// Returns when the connection has ended, with the reason.
    pub async fn ended(&self) -> ConnectFailure {
        self.shared.ended.cancelled().await;
        self.shared.end(ConnectStage::Read)
    }

    /// Closes session and channel. A server that does not answer within 2 s is disconnected.
    pub async fn close(self) {
        let request = self.shared.header(|shared, token, handle| {
            opcua::client::services::CloseSession::new_manual(0, CLOSE, token, handle)
                .delete_subscriptions(true)
                .send(&shared.secure)
        });
        let closed = async {
            if let Err(failure) = self.shared.answered(ConnectStage::CreateSession, request).await {
                tracing::debug!(cause = %failure.cause, "session not closed");
            }
            self.shared.secure.close_channel().await;
            self.shared.ended.cancelled().await;
        };
        let _late = tokio::time::timeout(CLOSE, closed).await;
    }
}

impl Shared {
    /// A request of this session.
    pub(super) fn header<'a, R>(&'a self, request: impl FnOnce(&'a Self, UaNodeId, u32) -> R) -> R {
        request(self, self.token.clone(), self.secure.request_handle())
    }

    pub(super) fn channel(&self) -> &AsyncSecureChannel {
        &self.secure
    }

    /// The answer to a request, unless the connection ends first.
    pub(super) async fn answered<R>(
        &self,
        stage: ConnectStage,
        request: impl Future<Output = Result<R, Error>>,
    ) -> Result<R, ConnectFailure> {
        tokio::select! {
            biased;
            answer = request => answer.map_err(|error| ConnectFailure::from_library(stage, &error, &self.heard.lock())),
            () = self.ended.cancelled() => Err(self.end(stage)),
        }
    }

    fn end(&self, stage: ConnectStage) -> ConnectFailure {
        let code = self.end_status.lock().unwrap_or(StatusCode::BadConnectionClosed);
        ConnectFailure::from_library(stage, &Error::new(code, "closed"), &self.heard.lock())
    }
}

/// Serves the connection until it ends.
async fn serve(
    mut events: ChannelEvents,
    end_status: Arc<Mutex<Option<StatusCode>>>,
    _ended: tokio_util::sync::DropGuard,
) {
    loop {
        if let TransportPollResult::Closed(status) = events.poll().await {
            *end_status.lock() = Some(status);
            return;
        }
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

pub(super) fn wrong_answer(stage: ConnectStage) -> ConnectFailure {
    ConnectFailure::of(stage, ConnectFailureCause::NotOpcUa("its answer is not what was asked for".to_owned()))
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
pub(super) const SESSION_TIMEOUT_MS: f64 = 60_000.0;
/// Values or references in one request.
pub(super) const MAX_OPERATIONS: usize = 1_000;
const MAX_REFERENCES: usize = 10_000;
/// Nodes in one Browse request.
const MAX_BROWSED: usize = 100;
/// The references that lead to what a tree shows below a node.
const CHILDREN: ReferenceTypeId = ReferenceTypeId::HierarchicalReferences;
