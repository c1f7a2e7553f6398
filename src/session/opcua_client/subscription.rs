use std::sync::Arc;
use std::time::Duration;

use opcua::client::UARequest;
use opcua::client::services::{CreateMonitoredItems, CreateSubscription, Publish};
use opcua::types::{
    AttributeId, DataChangeNotification, ExtensionObject, MonitoredItemCreateRequest, MonitoringMode,
    MonitoringParameters, NotificationMessage, ReadValueId, StatusChangeNotification, StatusCode, TimestampsToReturn,
};
use tokio::sync::mpsc;
use tokio_util::sync::{CancellationToken, DropGuard};

use super::client_session::{MAX_OPERATIONS, Shared, wrong_answer};
use super::convert::{data_value, quality, ua_node_id};
use super::failure::{ConnectFailure, ConnectStage, status};
use crate::model::opcua::{DataValue, NodeId, Quality};

/// How often a server looks at variables, and how often it tells what has changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SubscriptionIntervals {
    /// Between two notifications. The server may make it longer; these controllers publish at most every 100 ms
    /// (manual 3.1).
    pub publishing: Duration,
    /// Between two looks at a variable. The server may make it longer.
    pub sampling: Duration,
    /// Values of one variable that the server keeps between two notifications; older ones are dropped.
    pub queue: u32,
}

/// Every 200 ms, the last value of each variable.
impl Default for SubscriptionIntervals {
    fn default() -> Self {
        Self { publishing: Duration::from_millis(200), sampling: Duration::from_millis(200), queue: 1 }
    }
}

/// New values, each with the index of its node among those that were subscribed.
pub type Changes = Vec<(usize, DataValue)>;

/// Variables that a server watches. Ends when it is dropped; the subscription in the server ends with the session, or
/// when its lifetime is over.
#[derive(Debug)]
pub struct Subscription {
    changes: mpsc::Receiver<Result<Changes, ConnectFailure>>,
    /// In the order of the nodes: whether the server watches each.
    accepted: Vec<Quality>,
    _stop: DropGuard,
}

impl Subscription {
    pub(super) async fn create(
        shared: Arc<Shared>,
        nodes: &[NodeId],
        intervals: SubscriptionIntervals,
    ) -> Result<Self, ConnectFailure> {
        let request = shared.header(|shared, token, handle| {
            CreateSubscription::new_manual(0, REQUEST, token, handle)
                .publishing_interval(intervals.publishing)
                .max_keep_alive_count(KEEP_ALIVE_COUNT)
                .max_lifetime_count(KEEP_ALIVE_COUNT * 10)
                .max_notifications_per_publish(MAX_NOTIFICATIONS)
                .send(shared.channel())
        });
        let created = shared.answered(ConnectStage::Subscribe, request).await?;
        let subscription = created.subscription_id;
        let mut accepted = Vec::with_capacity(nodes.len());
        for (page, some) in nodes.chunks(MAX_OPERATIONS).enumerate() {
            accepted.extend(watch(&shared, subscription, page * MAX_OPERATIONS, some, intervals).await?);
        }
        let stop = CancellationToken::new();
        let (sender, changes) = mpsc::channel(WAITING_NOTIFICATIONS);
        // A server that has nothing to tell sends a keep-alive after so long.
        let silence = Duration::from_secs_f64(created.revised_publishing_interval.clamp(0.0, MAX_INTERVAL_MS) / 1000.0)
            * created.revised_max_keep_alive_count.clamp(1, 1_000);
        let publishing =
            Publishing { shared, subscription, timeout: silence + REQUEST, nodes: nodes.len(), changes: sender };
        let stopped = stop.clone();
        tokio::spawn(async move {
            tokio::select! {
                () = publishing.run() => {}
                () = stopped.cancelled() => {}
            }
        });
        Ok(Self { changes, accepted, _stop: stop.drop_guard() })
    }

    /// Whether the server watches each node, in the order of the nodes; a bad quality says why not.
    pub fn accepted(&self) -> &[Quality] {
        &self.accepted
    }

    /// Waits for the next changes. An empty list is the server's sign of life. After an error the subscription has ended.
    /// Cancel safe.
    pub async fn next(&mut self) -> Result<Changes, ConnectFailure> {
        match self.changes.recv().await {
            Some(changes) => changes,
            None => Err(ConnectFailure::of(ConnectStage::Subscribe, status(StatusCode::BadNoSubscription, ""))),
        }
    }
}

/// Adds variables to a subscription. Client handles are the indices of the nodes plus one, as 0 stands for none.
async fn watch(
    shared: &Shared,
    subscription: u32,
    first: usize,
    nodes: &[NodeId],
    intervals: SubscriptionIntervals,
) -> Result<Vec<Quality>, ConnectFailure> {
    let items = nodes.iter().enumerate().map(|(at, node)| MonitoredItemCreateRequest {
        item_to_monitor: ReadValueId {
            node_id: ua_node_id(node),
            attribute_id: AttributeId::Value as u32,
            ..Default::default()
        },
        monitoring_mode: MonitoringMode::Reporting,
        requested_parameters: MonitoringParameters {
            client_handle: (first + at + 1) as u32,
            sampling_interval: intervals.sampling.as_secs_f64() * 1000.0,
            queue_size: intervals.queue,
            discard_oldest: true,
            ..Default::default()
        },
    });
    let items: Vec<_> = items.collect();
    let request = shared.header(|shared, token, handle| {
        CreateMonitoredItems::new_manual(subscription, &shared.monitored_items, 0, REQUEST, token, handle)
            .timestamps_to_return(TimestampsToReturn::Both)
            .items_to_create(items)
            .send(shared.channel())
    });
    let created = shared.answered(ConnectStage::Subscribe, request).await?.results;
    Ok(created.into_iter().map(|item| quality(item.result.status_code)).collect())
}

/// Asks for notifications, one Publish request after the other.
struct Publishing {
    shared: Arc<Shared>,
    subscription: u32,
    timeout: Duration,
    nodes: usize,
    changes: mpsc::Sender<Result<Changes, ConnectFailure>>,
}

impl Publishing {
    async fn run(self) {
        let mut acknowledged = None;
        loop {
            let result = self.publish(&mut acknowledged).await;
            let is_over = result.is_err();
            if self.changes.send(result).await.is_err() || is_over {
                return;
            }
        }
    }

    async fn publish(&self, acknowledged: &mut Option<u32>) -> Result<Changes, ConnectFailure> {
        let request = self.shared.header(|shared, token, handle| {
            let mut publish = Publish::new_manual(0, self.timeout, token, handle);
            if let Some(sequence_number) = acknowledged.take() {
                publish = publish.ack(self.subscription, sequence_number);
            }
            publish.send(shared.channel())
        });
        let response = self.shared.answered(ConnectStage::Subscribe, request).await?;
        let NotificationMessage { sequence_number, notification_data, .. } = response.notification_message;
        let notifications = notification_data.unwrap_or_default();
        if !notifications.is_empty() {
            *acknowledged = Some(sequence_number);
        }
        let mut changes = Changes::new();
        for notification in notifications {
            self.take_in(notification, &mut changes)?;
        }
        Ok(changes)
    }

    fn take_in(&self, notification: ExtensionObject, changes: &mut Changes) -> Result<(), ConnectFailure> {
        if let Some(change) = notification.inner_as::<StatusChangeNotification>() {
            return Err(ConnectFailure::of(ConnectStage::Subscribe, status(change.status, "")));
        }
        // Events are not subscribed.
        let Some(data) = notification.into_inner_as::<DataChangeNotification>() else { return Ok(()) };
        for item in data.monitored_items.unwrap_or_default() {
            let index = (item.client_handle as usize).wrapping_sub(1);
            if index >= self.nodes {
                return Err(wrong_answer(ConnectStage::Subscribe));
            }
            changes.push((index, data_value(item.value)));
        }
        Ok(())
    }
}

const REQUEST: Duration = Duration::from_secs(20);
/// Publishing intervals without a change after which the server gives a sign of life.
const KEEP_ALIVE_COUNT: u32 = 20;
const MAX_NOTIFICATIONS: u32 = 2_000;
/// Notifications that wait to be taken; the server keeps the next ones.
const WAITING_NOTIFICATIONS: usize = 16;
const MAX_INTERVAL_MS: f64 = 60_000.0;
