use tokio::sync::mpsc::UnboundedReceiver;

use super::arrange::arrange;
use super::consumed::is_consumed_by_reading;
use super::explore::{explore, properties};
use super::layout::LiveLayout;
use super::request::{LiveEvent, LiveRequest, NodeDetails};
use crate::model::Problem;
use crate::model::opcua::{DataValue, NodeId, QualifiedName, Quality, Value};
use crate::session::opcua_client::{
    ClientSession, ConnectFailure, ConnectFailureCause, ServerConnectError, Subscription, SubscriptionIntervals,
};

/// Requests, and what outlives a connection of them.
pub(super) struct Requests {
    receiver: UnboundedReceiver<LiveRequest>,
    /// What is to be shown, to be subscribed again after a reconnection.
    shown: Vec<NodeId>,
}

impl Requests {
    pub fn new(receiver: UnboundedReceiver<LiveRequest>) -> Self {
        Self { receiver, shown: Vec::new() }
    }

    /// The next one. Cancel safe. Never returns after the last sender is gone: the watch is cancelled then.
    async fn next(&mut self) -> LiveRequest {
        match self.receiver.recv().await {
            Some(request) => request,
            None => std::future::pending().await,
        }
    }
}

/// Explores the server, then answers requests and reports values until the connection ends.
pub(super) async fn serve(
    session: &ClientSession,
    requests: &mut Requests,
    on_event: &(impl Fn(LiveEvent) + Send + Sync),
) -> ConnectFailure {
    match run(session, requests, on_event).await {
        Ok(never) => match never {},
        Err(failure) => failure,
    }
}

async fn run(
    session: &ClientSession,
    requests: &mut Requests,
    on_event: &(impl Fn(LiveEvent) + Send + Sync),
) -> Result<std::convert::Infallible, ConnectFailure> {
    on_event(LiveEvent::Connected(Box::new(layout(session).await?)));
    let mut subscription = session.subscribe(&[], INTERVALS).await?;
    let mut watched = watch(session, &mut subscription, &requests.shown, on_event).await?;
    loop {
        tokio::select! {
            biased;
            request = requests.next() => match request {
                LiveRequest::Show(nodes) => {
                    requests.shown = nodes;
                    watched = watch(session, &mut subscription, &requests.shown, on_event).await?;
                }
                request => on_event(answer(session, request).await?),
            },
            changes = subscription.next() => {
                let changes = changes?;
                if !changes.is_empty() {
                    let of = |index: usize| watched.get(index).cloned();
                    let values = changes.into_iter().filter_map(|(index, value)| Some((of(index)?, value)));
                    on_event(LiveEvent::Values(values.collect()));
                }
            }
        }
    }
}

async fn layout(session: &ClientSession) -> Result<LiveLayout, ConnectFailure> {
    let tree = explore(session).await?;
    let properties = properties(session, &tree).await?;
    Ok(arrange(&tree, &properties))
}

/// Watches these variables instead of the former ones. Returns those that are watched, in the order of the subscription;
/// of the others the reason is reported.
async fn watch(
    session: &ClientSession,
    subscription: &mut Subscription,
    nodes: &[NodeId],
    on_event: &(impl Fn(LiveEvent) + Send + Sync),
) -> Result<Vec<NodeId>, ConnectFailure> {
    let names = session.browse_names(nodes).await?;
    let is_allowed = |name: &Option<QualifiedName>| !name.as_ref().is_some_and(is_consumed_by_reading);
    let named = nodes.iter().zip(names);
    let allowed: Vec<NodeId> = named.filter(|(_, name)| is_allowed(name)).map(|(node, _)| node.clone()).collect();
    subscription.replace(&allowed).await?;
    let refused = allowed.iter().zip(subscription.accepted()).filter(|(_, quality)| quality.is_bad());
    let refused =
        refused.map(|(node, quality)| (node.clone(), DataValue { quality: quality.clone(), ..DataValue::default() }));
    let refused: Vec<_> = refused.collect();
    if !refused.is_empty() {
        on_event(LiveEvent::Values(refused));
    }
    Ok(allowed)
}

/// Answers a request other than [`LiveRequest::Show`]. A failure of the connection is an error; one of the request alone
/// is part of the answer.
async fn answer(session: &ClientSession, request: LiveRequest) -> Result<LiveEvent, ConnectFailure> {
    Ok(match request {
        LiveRequest::Show(_) => LiveEvent::Values(Vec::new()),
        LiveRequest::Children(of) => {
            let children = told(session.children(&of).await)?;
            LiveEvent::Children { of, children }
        }
        LiveRequest::Inspect(node) => {
            let details = told(inspect(session, &node).await)?;
            LiveEvent::Inspected { node, details: details.map(Box::new) }
        }
        LiveRequest::Write { node, value } => {
            let quality = told(write(session, &node, value).await)?;
            LiveEvent::Written { node, quality }
        }
    })
}

/// A status of the server concerns the request; everything else concerns the connection.
fn told<T>(result: Result<T, ConnectFailure>) -> Result<Result<T, Problem>, ConnectFailure> {
    match result {
        Ok(value) => Ok(Ok(value)),
        Err(failure) if matches!(failure.cause, ConnectFailureCause::Status { .. }) && !ends_session(&failure) => {
            Ok(Err(ServerConnectError::Failed(failure).into()))
        }
        Err(failure) => Err(failure),
    }
}

/// Whether the server no longer knows the session or its channel.
fn ends_session(failure: &ConnectFailure) -> bool {
    let ends = ["BadSession", "BadSecureChannel", "BadShutdown", "BadServerHalted"];
    failure.status().is_some_and(|status| ends.iter().any(|name| status.starts_with(name)))
}

async fn write(session: &ClientSession, node: &NodeId, value: Value) -> Result<Quality, ConnectFailure> {
    let written = session.write(&[(node.clone(), value)]).await?;
    Ok(written.into_iter().next().unwrap_or_default())
}

async fn inspect(session: &ClientSession, node: &NodeId) -> Result<NodeDetails, ConnectFailure> {
    let attributes = session.attributes_but_value(node).await?;
    let found = |name: &str| attributes.iter().find(|(known, _)| *known == name).map(|(_, value)| &value.value);
    let browse_name = match found("BrowseName") {
        Some(Value::QualifiedName(name)) => name.clone(),
        _ => QualifiedName::new(0, ""),
    };
    let access = found("UserAccessLevel").or_else(|| found("AccessLevel")).and_then(Value::as_f64);
    let is_writable = access.is_some_and(|bits| bits as u8 & CURRENT_WRITE != 0);
    let data_type = match found("DataType") {
        Some(Value::NodeId(id)) => session.browse_names(std::slice::from_ref(id)).await?.pop().flatten(),
        _ => None,
    };
    let is_consumed_by_reading = is_consumed_by_reading(&browse_name);
    let data_type = data_type.map(|name| name.name);
    Ok(NodeDetails { browse_name, is_writable, is_consumed_by_reading, data_type, attributes })
}

/// All changes of a variable at the shortest publishing interval of these controllers or slower (manual 3.1).
const INTERVALS: SubscriptionIntervals = SubscriptionIntervals {
    publishing: std::time::Duration::from_millis(200),
    sampling: std::time::Duration::from_millis(100),
    queue: 4,
};
/// IoBit CurrentWrite of an access level (OPC 10000-3 §8.57).
const CURRENT_WRITE: u8 = 2;
