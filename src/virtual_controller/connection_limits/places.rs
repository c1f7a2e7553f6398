use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;
use std::time::Duration;

use parking_lot::Mutex;

use super::{Activity, Source, Standing};

/// A connection that takes one of the [`Places`].
pub trait Occupant {
    fn source(&self) -> Source;

    fn activity(&self) -> &Activity;

    /// Ends the connection, because another one needs its place. Must not block.
    fn evict(&self);
}

/// How many connections a listener has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlaceLimits {
    /// All connections at once.
    pub connections: usize,
    /// Connections of one source.
    pub per_source: usize,
    /// How long a connection with a session may be unused until it counts as one without.
    pub silence: Duration,
}

/// The connections of a listener, the oldest first.
#[derive(Debug)]
pub struct Places<C> {
    limits: PlaceLimits,
    taken: Mutex<Taken<C>>,
}

#[derive(Debug)]
struct Taken<C> {
    next: u64,
    by_age: BTreeMap<u64, Arc<C>>,
}

/// A place among the connections, given back when it is dropped.
#[derive(Debug)]
pub struct Place<C> {
    places: Arc<Places<C>>,
    number: u64,
    pub connection: Arc<C>,
}

impl<C: Occupant> Places<C> {
    pub fn new(limits: PlaceLimits) -> Self {
        Self { limits, taken: Mutex::new(Taken { next: 0, by_age: BTreeMap::new() }) }
    }

    /// Takes in one more, for which another one may have to end. `None` if every other one has a session that is used.
    pub fn enter(self: &Arc<Self>, connection: C) -> Option<Place<C>> {
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
        Some(Place { places: self.clone(), number, connection })
    }

    fn evict(&self, taken: &mut Taken<C>, may_go: impl Fn(&C) -> bool) -> Option<()> {
        let standing = |connection: &C| connection.activity().standing(self.limits.silence);
        let candidates = || taken.by_age.iter().filter(|(_, connection)| may_go(connection));
        let lowest = candidates().map(|(_, connection)| standing(connection)).min()?;
        if lowest == Standing::InSession {
            return None;
        }
        let mut by_source: HashMap<Source, (usize, u64)> = HashMap::new();
        for (number, connection) in candidates().filter(|(_, connection)| standing(connection) == lowest) {
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

impl<C> Drop for Place<C> {
    fn drop(&mut self) {
        self.places.taken.lock().by_age.remove(&self.number);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicBool, Ordering};

    use super::*;

    struct Peer {
        source: Source,
        activity: Activity,
        is_evicted: AtomicBool,
    }

    impl Occupant for Peer {
        fn source(&self) -> Source {
            self.source
        }

        fn activity(&self) -> &Activity {
            &self.activity
        }

        fn evict(&self) {
            self.is_evicted.store(true, Ordering::Relaxed);
        }
    }

    fn places(silence: Duration) -> Arc<Places<Peer>> {
        Arc::new(Places::new(PlaceLimits { connections: 4, per_source: 3, silence }))
    }

    fn enter(places: &Arc<Places<Peer>>, address: u8, standing: Standing) -> Option<Place<Peer>> {
        let source = Source::new([192, 168, 0, address].into());
        let place = places.enter(Peer { source, activity: Activity::new(), is_evicted: AtomicBool::new(false) })?;
        place.connection.activity.reached(standing);
        Some(place)
    }

    fn is_evicted(place: &Place<Peer>) -> bool {
        place.connection.is_evicted.load(Ordering::Relaxed)
    }

    const LONG: Duration = Duration::from_secs(60);

    #[test]
    fn the_oldest_connection_without_a_session_makes_room() {
        let places = places(LONG);
        let first = enter(&places, 1, Standing::InSession).unwrap();
        let second = enter(&places, 1, Standing::Opened).unwrap();
        let third = enter(&places, 1, Standing::Opened).unwrap();
        let other = enter(&places, 2, Standing::Opened).unwrap();
        let fourth = enter(&places, 1, Standing::Opened).unwrap();
        assert!(is_evicted(&second));
        assert!([&first, &third, &other, &fourth].into_iter().all(|place| !is_evicted(place)));

        let _new = enter(&places, 3, Standing::Opened).unwrap();
        assert!(is_evicted(&third), "the oldest of the source that has most");
        assert_eq!(places.all().len(), 4);
    }

    #[test]
    fn the_one_that_has_come_least_far_makes_room() {
        let places = places(LONG);
        let proven = enter(&places, 1, Standing::Proven).unwrap();
        let opened = enter(&places, 2, Standing::Opened).unwrap();
        let accepted: Vec<_> = (3..5).map(|address| enter(&places, address, Standing::Accepted).unwrap()).collect();
        let new: Vec<_> = (5..8).map(|address| enter(&places, address, Standing::Proven).unwrap()).collect();
        assert!(accepted.iter().all(is_evicted) && is_evicted(&opened));
        assert!(!is_evicted(&proven) && !new.iter().any(is_evicted));
    }

    #[test]
    fn a_connection_with_a_session_makes_room_once_it_is_silent() {
        let places = places(Duration::from_millis(50));
        let held: Vec<_> = (0..3).map(|_| enter(&places, 1, Standing::InSession).unwrap()).collect();
        assert!(enter(&places, 1, Standing::Accepted).is_none());
        std::thread::sleep(Duration::from_millis(60));
        held[0].connection.activity.used();
        assert!(enter(&places, 1, Standing::Accepted).is_some());
        assert!(!is_evicted(&held[0]) && is_evicted(&held[1]));
    }

    #[test]
    fn a_place_is_given_back() {
        let places = places(LONG);
        let place = enter(&places, 1, Standing::Accepted).unwrap();
        let connection = place.connection.clone();
        assert!(places.has(&connection));
        drop(place);
        assert!(!places.has(&connection) && places.all().is_empty());
    }
}
