use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;
use std::time::Duration;

use parking_lot::Mutex;

use super::{Activity, ConnectionStage, SourceNetwork};

/// A connection that takes one of the [`ConnectionSlots`].
pub trait LimitedConnection {
    fn source(&self) -> SourceNetwork;

    fn activity(&self) -> &Activity;

    /// Ends the connection, because another one needs its slot. Must not block.
    fn evict(&self);
}

/// How many connections a listener has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ConnectionLimits {
    /// All connections at once.
    pub connections: usize,
    /// Connections of one source.
    pub per_source: usize,
    /// How long a connection with a session may be unused until it counts as one without.
    pub silence: Duration,
}

/// The connections of a listener, the oldest first.
#[derive(Debug)]
pub struct ConnectionSlots<C> {
    limits: ConnectionLimits,
    taken: Mutex<TakenSlot<C>>,
}

#[derive(Debug)]
struct TakenSlot<C> {
    next: u64,
    by_age: BTreeMap<u64, Arc<C>>,
}

/// A slot among the connections, given back when it is dropped.
#[derive(Debug)]
pub struct ConnectionSlot<C> {
    slots: Arc<ConnectionSlots<C>>,
    number: u64,
    pub connection: Arc<C>,
}

impl<C: LimitedConnection> ConnectionSlots<C> {
    pub fn new(limits: ConnectionLimits) -> Self {
        Self { limits, taken: Mutex::new(TakenSlot { next: 0, by_age: BTreeMap::new() }) }
    }

    /// Takes in one more, for which another one may have to end. `None` if every other one has a session that is used.
    pub fn enter(self: &Arc<Self>, connection: C) -> Option<ConnectionSlot<C>> {
        let mut taken = self.taken.lock();
        let source = connection.source();
        let of_source = taken.by_age.values().filter(|other| other.source() == source).count();
        if of_source >= self.limits.per_source {
            self.evict(&mut taken, |other| other.source() == source)?;
        } else if taken.by_age.len() >= self.limits.connections {
            self.evict(&mut taken, |_| true)?;
        }
        let number = taken.next;
        taken.next += 1;
        let connection = Arc::new(connection);
        taken.by_age.insert(number, connection.clone());
        Some(ConnectionSlot { slots: self.clone(), number, connection })
    }

    fn evict(&self, taken: &mut TakenSlot<C>, may_go: impl Fn(&C) -> bool) -> Option<()> {
        let stage = |connection: &C| connection.activity().stage(self.limits.silence);
        let candidates = || taken.by_age.iter().filter(|(_, connection)| may_go(connection));
        let lowest = candidates().map(|(_, connection)| stage(connection)).min()?;
        if lowest == ConnectionStage::InSession {
            return None;
        }
        let mut by_source: HashMap<SourceNetwork, (usize, u64)> = HashMap::new();
        for (number, connection) in candidates().filter(|(_, connection)| stage(connection) == lowest) {
            by_source.entry(connection.source()).or_insert((0, *number)).0 += 1;
        }
        let (_, oldest) = by_source.into_values().max_by_key(|(count, oldest)| (*count, std::cmp::Reverse(*oldest)))?;
        taken.by_age.remove(&oldest)?.evict();
        Some(())
    }

    pub fn all(&self) -> Vec<Arc<C>> {
        self.taken.lock().by_age.values().cloned().collect()
    }

    pub fn has(&self, connection: &Arc<C>) -> bool {
        self.taken.lock().by_age.values().any(|other| Arc::ptr_eq(other, connection))
    }
}

impl<C> Drop for ConnectionSlot<C> {
    fn drop(&mut self) {
        self.slots.taken.lock().by_age.remove(&self.number);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicBool, Ordering};

    use super::*;

    struct Peer {
        source: SourceNetwork,
        activity: Activity,
        is_evicted: AtomicBool,
    }

    impl LimitedConnection for Peer {
        fn source(&self) -> SourceNetwork {
            self.source
        }

        fn activity(&self) -> &Activity {
            &self.activity
        }

        fn evict(&self) {
            self.is_evicted.store(true, Ordering::Relaxed);
        }
    }

    fn slots(silence: Duration) -> Arc<ConnectionSlots<Peer>> {
        Arc::new(ConnectionSlots::new(ConnectionLimits { connections: 4, per_source: 3, silence }))
    }

    fn enter(slots: &Arc<ConnectionSlots<Peer>>, address: u8, stage: ConnectionStage) -> Option<ConnectionSlot<Peer>> {
        let source = SourceNetwork::new([192, 168, 0, address].into());
        let slot = slots.enter(Peer { source, activity: Activity::new(), is_evicted: AtomicBool::new(false) })?;
        slot.connection.activity.reached(stage);
        Some(slot)
    }

    fn is_evicted(slot: &ConnectionSlot<Peer>) -> bool {
        slot.connection.is_evicted.load(Ordering::Relaxed)
    }

    const LONG: Duration = Duration::from_secs(60);

    #[test]
    fn the_oldest_connection_without_a_session_makes_room() {
        let slots = slots(LONG);
        let first = enter(&slots, 1, ConnectionStage::InSession).unwrap();
        let second = enter(&slots, 1, ConnectionStage::Opened).unwrap();
        let third = enter(&slots, 1, ConnectionStage::Opened).unwrap();
        let other = enter(&slots, 2, ConnectionStage::Opened).unwrap();
        let fourth = enter(&slots, 1, ConnectionStage::Opened).unwrap();
        assert!(is_evicted(&second));
        assert!([&first, &third, &other, &fourth].into_iter().all(|slot| !is_evicted(slot)));

        let _new = enter(&slots, 3, ConnectionStage::Opened).unwrap();
        assert!(is_evicted(&third), "the oldest of the source that has most");
        assert_eq!(slots.all().len(), 4);
    }

    #[test]
    fn the_one_that_has_come_least_far_makes_room() {
        let slots = slots(LONG);
        let proven = enter(&slots, 1, ConnectionStage::Proven).unwrap();
        let opened = enter(&slots, 2, ConnectionStage::Opened).unwrap();
        let accepted: Vec<_> =
            (3..5).map(|address| enter(&slots, address, ConnectionStage::Accepted).unwrap()).collect();
        let new: Vec<_> = (5..8).map(|address| enter(&slots, address, ConnectionStage::Proven).unwrap()).collect();
        assert!(accepted.iter().all(is_evicted) && is_evicted(&opened));
        assert!(!is_evicted(&proven) && !new.iter().any(is_evicted));
    }

    #[test]
    fn a_connection_with_a_session_makes_room_once_it_is_silent() {
        let slots = slots(Duration::from_millis(50));
        let held: Vec<_> = (0..3).map(|_| enter(&slots, 1, ConnectionStage::InSession).unwrap()).collect();
        assert!(enter(&slots, 1, ConnectionStage::Accepted).is_none());
        std::thread::sleep(Duration::from_millis(60));
        held[0].connection.activity.used();
        assert!(enter(&slots, 1, ConnectionStage::Accepted).is_some());
        assert!(!is_evicted(&held[0]) && is_evicted(&held[1]));
    }

    #[test]
    fn a_place_is_given_back() {
        let slots = slots(LONG);
        let slot = enter(&slots, 1, ConnectionStage::Accepted).unwrap();
        let connection = slot.connection.clone();
        assert!(slots.has(&connection));
        drop(slot);
        assert!(!slots.has(&connection) && slots.all().is_empty());
    }
}
