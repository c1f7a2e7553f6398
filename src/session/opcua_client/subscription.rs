use std::sync::Arc;
use std::time::Duration;

use opcua::client::UARequest;
use opcua::client::services::{CreateMonitoredItems, CreateSubscription, DeleteMonitoredItems, Publish};
use opcua::types::{
    AttributeId, DataChangeNotification, ExtensionObject, MonitoredItemCreateRequest, MonitoringMode,
    MonitoringParameters, NotificationMessage, ReadValueId, StatusChangeNotification, StatusCode, TimestampsToReturn,
};
use parking_lot::Mutex;
use tokio::sync::mpsc;
use tokio_util::sync::{CancellationToken, DropGuard};

use super::convert::{data_value, quality, ua_node_id};
use super::failure::{ConnectFailure, ConnectStage, status};
use super::session_channel::{MAX_OPERATIONS, SessionChannel, wrong_answer};
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
///
/// A session has one subscription at a time: a Publish response belongs to any of the session's subscriptions.
#[derive(Debug)]
pub struct Subscription {
    channel: Arc<SessionChannel>,
    id: u32,
    intervals: SubscriptionIntervals,
    changes: mpsc::Receiver<Result<Notified, ConnectFailure>>,
    /// In the order of the nodes: whether the server watches each.
    accepted: Vec<Quality>,
    /// The server's ids of the monitored items.
    items: Vec<u32>,
    handles: Arc<Mutex<ClientHandles>>,
    _stop: DropGuard,
}

/// Changes, and the first client handle of the variables that they are of.
type Notified = (u32, Changes);

/// The client handles of the variables that are watched now. The node with index 0 has the handle `first`. Handles are
/// not used again, so that a late notification of a removed variable is recognised. 0 stands for none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct ClientHandles {
    first: u32,
    count: u32,
}

impl ClientHandles {
    /// The handles of so many other nodes.
    const fn next(self, count: u32) -> Self {
        Self { first: self.first.saturating_add(self.count), count }
    }

    /// The index of the node with this handle; `None` if its variable was removed.
    fn index(self, handle: u32) -> Option<usize> {
        handle.checked_sub(self.first).filter(|index| *index < self.count).map(|index| index as usize)
    }

    /// Whether no variable ever had this handle.
    const fn is_unknown(self, handle: u32) -> bool {
        handle == 0 || handle >= self.first.saturating_add(self.count)
    }
}

impl Subscription {
    pub(super) async fn create(
        channel: Arc<SessionChannel>,
        nodes: &[NodeId],
        intervals: SubscriptionIntervals,
    ) -> Result<Self, ConnectFailure> {
        let request = channel.request(|channel, token, handle| {
            CreateSubscription::new_manual(0, REQUEST, token, handle)
                .publishing_interval(intervals.publishing)
                .max_keep_alive_count(KEEP_ALIVE_COUNT)
                .max_lifetime_count(KEEP_ALIVE_COUNT * 10)
                .max_notifications_per_publish(MAX_NOTIFICATIONS)
                .send(channel.secure())
        });
        let created = channel.answered(ConnectStage::Subscribe, request).await?;
        let id = created.subscription_id;
        let handles = Arc::new(Mutex::new(ClientHandles { first: 1, count: 0 }));
        let stop = CancellationToken::new();
        let (sender, changes) = mpsc::channel(WAITING_NOTIFICATIONS);
        // A server that has nothing to tell sends a keep-alive after so long.
        let silence = Duration::from_secs_f64(created.revised_publishing_interval.clamp(0.0, MAX_INTERVAL_MS) / 1000.0)
            * created.revised_max_keep_alive_count.clamp(1, 1_000);
        let publishing = Publishing {
            channel: channel.clone(),
            subscription: id,
            timeout: silence + REQUEST,
            handles: handles.clone(),
            changes: sender,
        };
        let stopped = stop.clone();
        tokio::spawn(async move {
            tokio::select! {
                () = publishing.run() => {}
                () = stopped.cancelled() => {}
            }
        });
        let mut subscription = Self {
            channel,
            id,
            intervals,
            changes,
            accepted: Vec::new(),
            items: Vec::new(),
            handles,
            _stop: stop.drop_guard(),
        };
        subscription.add(nodes).await?;
        Ok(subscription)
    }

    /// Watches these variables from now on, and no longer those before. The indices of the changes are those of `nodes`;
    /// changes of the former variables that have not been taken are dropped.
    pub async fn replace(&mut self, nodes: &[NodeId]) -> Result<(), ConnectFailure> {
        // From here on what is still under way for the former variables is ignored.
        let next = self.handles.lock().next(0);
        *self.handles.lock() = next;
        let items = std::mem::take(&mut self.items);
        for some in items.chunks(MAX_OPERATIONS) {
            let request = self.channel.request(|channel, token, handle| {
                DeleteMonitoredItems::new_manual(self.id, 0, REQUEST, token, handle)
                    .items_to_delete(some.to_vec())
                    .send(channel.secure())
            });
            self.channel.answered(ConnectStage::Subscribe, request).await?;
        }
        self.add(nodes).await
    }

    async fn add(&mut self, nodes: &[NodeId]) -> Result<(), ConnectFailure> {
        let handles = self.handles.lock().next(u32::try_from(nodes.len()).unwrap_or(u32::MAX));
        *self.handles.lock() = handles;
        self.accepted.clear();
        for (page, some) in nodes.chunks(MAX_OPERATIONS).enumerate() {
            let first = handles.first.saturating_add((page * MAX_OPERATIONS) as u32);
            for (quality, item) in watch(&self.channel, self.id, first, some, self.intervals).await? {
                if !quality.is_bad() {
                    self.items.push(item);
                }
                self.accepted.push(quality);
            }
        }
        Ok(())
    }

    /// Whether the server watches each node, in the order of the nodes; a bad quality says why not.
    pub fn accepted(&self) -> &[Quality] {
        &self.accepted
    }

    /// Waits for the next changes. An empty list is the server's sign of life. After an error the subscription has ended.
    /// Cancel safe.
    pub async fn next(&mut self) -> Result<Changes, ConnectFailure> {
        match self.changes.recv().await {
            Some(Ok((first, changes))) if first == self.handles.lock().first => Ok(changes),
            // Of variables that are no longer watched.
            Some(Ok(_)) => Ok(Changes::new()),
            Some(Err(failure)) => Err(failure),
            None => Err(ConnectFailure::of(ConnectStage::Subscribe, status(StatusCode::BadNoSubscription, ""))),
        }
    }
}

/// Adds variables to a subscription, with client handles from `first` on; whether the server watches each, and its id of
/// the monitored item.
async fn watch(
    channel: &SessionChannel,
    subscription: u32,
    first: u32,
    nodes: &[NodeId],
    intervals: SubscriptionIntervals,
) -> Result<Vec<(Quality, u32)>, ConnectFailure> {
    let items = nodes.iter().zip(first..).map(|(node, client_handle)| MonitoredItemCreateRequest {
        item_to_monitor: ReadValueId {
            node_id: ua_node_id(node),
            attribute_id: AttributeId::Value as u32,
            ..Default::default()
        },
        monitoring_mode: MonitoringMode::Reporting,
        requested_parameters: MonitoringParameters {
            client_handle,
            sampling_interval: intervals.sampling.as_secs_f64() * 1000.0,
            queue_size: intervals.queue,
            discard_oldest: true,
            ..Default::default()
        },
    });
    let items: Vec<_> = items.collect();
    let request = channel.request(|channel, token, handle| {
        CreateMonitoredItems::new_manual(subscription, &channel.monitored_items, 0, REQUEST, token, handle)
            .timestamps_to_return(TimestampsToReturn::Both)
            .items_to_create(items)
            .send(channel.secure())
    });
    let created = channel.answered(ConnectStage::Subscribe, request).await?.results;
    if created.len() != nodes.len() {
        return Err(wrong_answer(ConnectStage::Subscribe));
    }
    Ok(created.into_iter().map(|item| (quality(item.result.status_code), item.result.monitored_item_id)).collect())
}

/// Asks for notifications, one Publish request after the other.
struct Publishing {
    channel: Arc<SessionChannel>,
    subscription: u32,
    timeout: Duration,
    handles: Arc<Mutex<ClientHandles>>,
    changes: mpsc::Sender<Result<Notified, ConnectFailure>>,
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

    async fn publish(&self, acknowledged: &mut Option<u32>) -> Result<Notified, ConnectFailure> {
        let request = self.channel.request(|channel, token, handle| {
            let mut publish = Publish::new_manual(0, self.timeout, token, handle);
            if let Some(sequence_number) = acknowledged.take() {
                publish = publish.ack(self.subscription, sequence_number);
            }
            publish.send(channel.secure())
        });
        let response = self.channel.answered(ConnectStage::Subscribe, request).await?;
        let NotificationMessage { sequence_number, notification_data, .. } = response.notification_message;
        let notifications = notification_data.unwrap_or_default();
        if !notifications.is_empty() {
            *acknowledged = Some(sequence_number);
        }
        let handles = *self.handles.lock();
        let mut changes = Changes::new();
        for notification in notifications {
            take_in(notification, handles, &mut changes)?;
        }
        Ok((handles.first, changes))
    }
}

fn take_in(notification: ExtensionObject, handles: ClientHandles, changes: &mut Changes) -> Result<(), ConnectFailure> {
    if let Some(change) = notification.inner_as::<StatusChangeNotification>() {
        return Err(ConnectFailure::of(ConnectStage::Subscribe, status(change.status, "")));
    }
    // Events are not subscribed.
    let Some(data) = notification.into_inner_as::<DataChangeNotification>() else { return Ok(()) };
    for item in data.monitored_items.unwrap_or_default() {
        if handles.is_unknown(item.client_handle) {
            return Err(wrong_answer(ConnectStage::Subscribe));
        }
        if let Some(index) = handles.index(item.client_handle) {
            changes.push((index, data_value(item.value)));
        }
    }
    Ok(())
}

const REQUEST: Duration = Duration::from_secs(20);
/// Publishing intervals without a change after which the server gives a sign of life.
const KEEP_ALIVE_COUNT: u32 = 20;
const MAX_NOTIFICATIONS: u32 = 2_000;
/// Notifications that wait to be taken; the server keeps the next ones.
const WAITING_NOTIFICATIONS: usize = 16;
const MAX_INTERVAL_MS: f64 = 60_000.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_late_notification_of_a_removed_variable_is_recognised() {
        let first = ClientHandles { first: 1, count: 0 }.next(3);
        assert_eq!([1, 3].map(|handle| first.index(handle)), [Some(0), Some(2)]);
        assert!(first.is_unknown(0) && first.is_unknown(4));
        let second = first.next(0).next(2);
        assert_eq!([3, 4, 5].map(|handle| second.index(handle)), [None, Some(0), Some(1)]);
        assert!(!second.is_unknown(3) && second.is_unknown(6));
    }
}
