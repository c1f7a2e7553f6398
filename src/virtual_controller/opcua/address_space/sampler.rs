use std::collections::HashMap;
use std::sync::{Arc, Weak};
use std::time::{Duration, Instant};

use chrono::TimeDelta;
use opcua::server::{MonitoredItemHandle, SubscriptionCache};
use opcua::types::{AttributeId, DataValue, DateTime, MonitoringMode, NodeId};
use parking_lot::Mutex;
use tokio::sync::Notify;
use tokio::task::AbortHandle;
use tokio::time::MissedTickBehavior;

use super::id::Id;

/// The shortest sampling interval, which is the shortest publishing interval of the manual (3.1).
pub(super) const INTERVAL: Duration = Duration::from_millis(100);

/// Samples the values that clients have subscribed to. Does nothing while there are none.
pub(super) struct Sampler {
    watched: Arc<Watched>,
    task: Mutex<Option<AbortHandle>>,
}

#[derive(Default)]
struct Watched {
    nodes: Mutex<HashMap<Id, Vec<Item>>>,
    /// Told when there is the first item.
    begin: Notify,
}

struct Item {
    handle: MonitoredItemHandle,
    interval: Duration,
    is_enabled: bool,
}

/// Gives the value of a node at a moment; `None` for a node that is not sampled.
pub(super) trait Sample: Send + Sync + 'static {
    /// The values of these nodes, all of the same moment, with `now` as their timestamp.
    fn sample(&self, nodes: &[Id], now: DateTime) -> Vec<Option<DataValue>>;
}

impl Sampler {
    pub(super) fn new() -> Self {
        Self { watched: Arc::default(), task: Mutex::new(None) }
    }

    /// Samples from now on, as long as this and `source` live. Call it once, on the server's runtime.
    pub(super) fn run(&self, source: Weak<dyn Sample>, subscriptions: Arc<SubscriptionCache>) {
        let task = tokio::spawn(run(Arc::clone(&self.watched), source, subscriptions));
        *self.task.lock() = Some(task.abort_handle());
    }

    pub(super) fn add(&self, node: Id, handle: MonitoredItemHandle, interval: Duration, mode: MonitoringMode) {
        let item = Item { handle, interval: interval.max(INTERVAL), is_enabled: mode != MonitoringMode::Disabled };
        self.watched.nodes.lock().entry(node).or_default().push(item);
        self.watched.begin.notify_one();
    }

    pub(super) fn set_interval(&self, node: Id, handle: MonitoredItemHandle, interval: Duration) {
        self.change(node, handle, |item| item.interval = interval.max(INTERVAL));
    }

    pub(super) fn set_mode(&self, node: Id, handle: MonitoredItemHandle, mode: MonitoringMode) {
        self.change(node, handle, |item| item.is_enabled = mode != MonitoringMode::Disabled);
        self.watched.begin.notify_one();
    }

    pub(super) fn remove(&self, node: Id, handle: MonitoredItemHandle) {
        let mut nodes = self.watched.nodes.lock();
        if let Some(items) = nodes.get_mut(&node) {
            items.retain(|item| item.handle != handle);
            if items.is_empty() {
                nodes.remove(&node);
            }
        }
    }

    fn change(&self, node: Id, handle: MonitoredItemHandle, change: impl FnOnce(&mut Item)) {
        let mut nodes = self.watched.nodes.lock();
        if let Some(item) = nodes.get_mut(&node).and_then(|items| items.iter_mut().find(|item| item.handle == handle)) {
            change(item);
        }
    }
}

impl Drop for Sampler {
    fn drop(&mut self) {
        if let Some(task) = self.task.get_mut() {
            task.abort();
        }
    }
}

async fn run(watched: Arc<Watched>, source: Weak<dyn Sample>, subscriptions: Arc<SubscriptionCache>) {
    loop {
        watched.begin.notified().await;
        let mut tick = tokio::time::interval(INTERVAL);
        tick.set_missed_tick_behavior(MissedTickBehavior::Skip);
        // Timestamps are exact multiples of the interval apart: the server drops a sample that comes a little too early.
        let (first, first_time) = (Instant::now(), DateTime::now());
        let mut last_sampled = HashMap::new();
        loop {
            let elapsed = tick.tick().await.into_std().saturating_duration_since(first);
            let Some(due) = watched.due(elapsed, &mut last_sampled) else { break };
            let Some(source) = source.upgrade() else { return };
            let now = first_time.as_chrono() + TimeDelta::from_std(elapsed).unwrap_or_default();
            let values = source.sample(&due, now.into());
            let ids: Vec<NodeId> = due.into_iter().map(NodeId::from).collect();
            let changes = values.into_iter().zip(&ids).filter_map(|(value, id)| Some((value?, id, AttributeId::Value)));
            subscriptions.notify_data_change(changes);
        }
    }
}

impl Watched {
    /// The nodes to be sampled now; `None` if no item is enabled.
    fn due(&self, elapsed: Duration, last_sampled: &mut HashMap<Id, Duration>) -> Option<Vec<Id>> {
        let nodes = self.nodes.lock();
        last_sampled.retain(|id, _| nodes.contains_key(id));
        let mut is_any_enabled = false;
        let mut due = Vec::new();
        for (id, items) in nodes.iter() {
            let Some(interval) = items.iter().filter(|item| item.is_enabled).map(|item| item.interval).min() else {
                continue;
            };
            is_any_enabled = true;
            if last_sampled.get(id).is_none_or(|last| elapsed.saturating_sub(*last) >= interval) {
                last_sampled.insert(*id, elapsed);
                due.push(*id);
            }
        }
        is_any_enabled.then_some(due)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NODE: Id = Id::own(1);

    fn handle(number: u32) -> MonitoredItemHandle {
        MonitoredItemHandle { subscription_id: 1, monitored_item_id: number }
    }

    /// At which of the first ten ticks the node is sampled; `None` from where on nothing is left to do.
    fn sampled(sampler: &Sampler) -> Option<Vec<u32>> {
        let mut last = HashMap::new();
        let mut ticks = Vec::new();
        for tick in 0..10 {
            if !sampler.watched.due(INTERVAL * tick, &mut last)?.is_empty() {
                ticks.push(tick);
            }
        }
        Some(ticks)
    }

    #[test]
    fn a_node_is_sampled_as_often_as_its_fastest_enabled_item_wants() {
        let sampler = Sampler::new();
        assert_eq!(sampled(&sampler), None);
        sampler.add(NODE, handle(1), INTERVAL * 5, MonitoringMode::Reporting);
        assert_eq!(sampled(&sampler), Some(vec![0, 5]));
        sampler.add(NODE, handle(2), Duration::ZERO, MonitoringMode::Sampling);
        assert_eq!(sampled(&sampler), Some((0..10).collect()), "no faster than every tick");
        sampler.set_interval(NODE, handle(2), INTERVAL * 3);
        assert_eq!(sampled(&sampler), Some(vec![0, 3, 6, 9]));
        sampler.set_mode(NODE, handle(2), MonitoringMode::Disabled);
        assert_eq!(sampled(&sampler), Some(vec![0, 5]));
        sampler.remove(NODE, handle(1));
        assert_eq!(sampled(&sampler), None, "only a disabled item is left");
        sampler.remove(NODE, handle(2));
        assert!(sampler.watched.nodes.lock().is_empty());
    }
}
