use std::collections::{HashMap, HashSet};
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use opcua::crypto::SecurityPolicy;
use parking_lot::Mutex;
use tokio::sync::watch;

use super::fault::Fault;
use super::limits::Limits;
use super::rewrap::ChainedClient;
use crate::pki::Certificate;

/// The connections there are, by the secure channel of each, and how many more there may be.
#[derive(Debug)]
pub(super) struct Connections {
    limits: Limits,
    live: Mutex<Live>,
}

#[derive(Debug, Default)]
struct Live {
    next: u64,
    by_id: HashMap<u64, Arc<Connection>>,
    by_channel: HashMap<u32, Arc<Connection>>,
}

/// One connection of a client.
#[derive(Debug)]
pub(super) struct Connection {
    id: u64,
    pub(super) peer: SocketAddr,
    since: Instant,
    /// Milliseconds after `since`.
    heard: AtomicU64,
    stop: watch::Sender<Option<Stop>>,
    pub(super) state: Mutex<ConnectionState>,
}

/// How far a connection has come.
#[derive(Debug, Default)]
pub(super) struct ConnectionState {
    /// With what it was admitted.
    pub(super) identity: Option<Arc<Identity>>,
    /// The secure channel the server gave it.
    pub(super) channel: Option<u32>,
    /// Sessions on it that were looked at and found to belong there.
    pub(super) sessions: HashSet<u32>,
    /// Set where a chain was sent, which the server cannot read.
    pub(super) chained: Option<Arc<ChainedClient>>,
}

/// Who asks for a secure channel, as its OpenSecureChannel says in clear.
#[derive(Debug)]
pub(super) struct Identity {
    pub(super) policy: SecurityPolicy,
    /// The certificate and what was sent with it, byte for byte; empty without security.
    pub(super) sent: Vec<u8>,
    /// The same, leaf first.
    pub(super) chain: Vec<Certificate>,
}

impl ConnectionState {
    pub(super) fn add_session(&mut self, session: u32) {
        // The others are looked at again, if they are still there.
        if self.sessions.len() >= MAX_SESSIONS {
            self.sessions.clear();
        }
        self.sessions.insert(session);
    }
}

impl Identity {
    pub(super) fn leaf(&self) -> Option<&Certificate> {
        self.chain.first()
    }
}

/// Why a connection has to end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Stop {
    /// It is told this.
    Told(Fault),
    /// Nobody waits until it has read this.
    AtOnce(Fault),
}

/// Why the connection with this has to end, once it has to.
pub(super) async fn stop_asked(stopped: &mut watch::Receiver<Option<Stop>>) -> Stop {
    let asked = stopped.wait_for(Option::is_some).await.map(|stop| stop.clone());
    match asked {
        Ok(Some(stop)) => stop,
        // Nobody is left who could ask.
        _ => std::future::pending().await,
    }
}

/// A place among the connections, given back when it is dropped.
#[derive(Debug)]
pub(super) struct Place<'a> {
    connections: &'a Connections,
    pub(super) connection: Arc<Connection>,
}

impl Connections {
    pub(super) fn new(limits: Limits) -> Self {
        Self { limits, live: Mutex::default() }
    }

    /// Takes in one more. When there is no room, the oldest connection without a session has to go: one of the same
    /// address if that address has too many, else one of the address that holds most of them. `None` if all have
    /// sessions.
    pub(super) fn enter(&self, peer: SocketAddr, stop: watch::Sender<Option<Stop>>) -> Option<Place<'_>> {
        let mut live = self.live.lock();
        let source = source(peer);
        let of_source = live.by_id.values().filter(|c| c.source() == source).count();
        if of_source >= self.limits.per_address {
            self.evict(&mut live, Some(source))?;
        } else if live.by_id.len() >= self.limits.connections {
            self.evict(&mut live, None)?;
        }
        let id = live.next;
        live.next += 1;
        let connection = Arc::new(Connection {
            id,
            peer,
            since: Instant::now(),
            heard: AtomicU64::new(0),
            stop,
            state: Mutex::default(),
        });
        live.by_id.insert(id, connection.clone());
        Some(Place { connections: self, connection })
    }

    fn evict(&self, live: &mut Live, source: Option<IpAddr>) -> Option<()> {
        let mut held: HashMap<IpAddr, Vec<&Arc<Connection>>> = HashMap::new();
        for connection in live.by_id.values().filter(|c| !c.is_in_use(self.limits.silence)) {
            held.entry(connection.source()).or_default().push(connection);
        }
        let candidates = match source {
            Some(source) => held.remove(&source)?,
            None => held.into_values().max_by_key(Vec::len)?,
        };
        let oldest = candidates.into_iter().min_by_key(|c| c.id)?.clone();
        live.remove(&oldest);
        let fault = Fault::new(opcua::types::StatusCode::BadTcpNotEnoughResources, "others need the connection");
        oldest.stop(Stop::AtOnce(fault));
        Some(())
    }

    /// Notes which secure channel the server gave a connection.
    pub(super) fn opened(&self, connection: &Arc<Connection>, channel: u32) {
        let mut live = self.live.lock();
        if channel == 0 || !live.by_id.contains_key(&connection.id) {
            return;
        }
        if let Some(before) = connection.state.lock().channel.replace(channel) {
            live.by_channel.remove(&before);
        }
        live.by_channel.insert(channel, connection.clone());
    }

    pub(super) fn of_channel(&self, channel: u32) -> Option<Arc<Connection>> {
        self.live.lock().by_channel.get(&channel).cloned()
    }

    /// Whether a connection that does not have to end was admitted with this certificate, `one` aside.
    pub(super) fn any_other_has(&self, leaf: &Certificate, one: &Connection) -> bool {
        self.all().iter().filter(|other| other.id != one.id && !other.is_stopped()).any(|other| {
            let identity = other.state.lock().identity.clone();
            identity.is_some_and(|identity| identity.leaf() == Some(leaf))
        })
    }

    pub(super) fn all(&self) -> Vec<Arc<Connection>> {
        self.live.lock().by_id.values().cloned().collect()
    }
}

impl Live {
    fn remove(&mut self, connection: &Connection) {
        self.by_id.remove(&connection.id);
        let channel = connection.state.lock().channel;
        if let Some(channel) = channel
            && self.by_channel.get(&channel).is_some_and(|c| c.id == connection.id)
        {
            self.by_channel.remove(&channel);
        }
    }
}

impl Drop for Place<'_> {
    fn drop(&mut self) {
        self.connections.live.lock().remove(&self.connection);
    }
}

impl Connection {
    pub(super) fn source(&self) -> IpAddr {
        source(self.peer)
    }

    /// Ends it, unless that has begun already.
    pub(super) fn stop(&self, stop: Stop) {
        self.stop.send_if_modified(|slot| {
            let first = slot.is_none();
            if first {
                *slot = Some(stop);
            }
            first
        });
    }

    pub(super) fn is_stopped(&self) -> bool {
        self.stop.borrow().is_some()
    }

    /// The client has sent something.
    pub(super) fn heard(&self) {
        let after = u64::try_from(self.since.elapsed().as_millis()).unwrap_or(u64::MAX);
        self.heard.store(after, Ordering::Relaxed);
    }

    pub(super) fn has_session(&self) -> bool {
        !self.state.lock().sessions.is_empty()
    }

    /// Whether there is a session on it, which is not over since long.
    fn is_in_use(&self, silence: Duration) -> bool {
        let heard = Duration::from_millis(self.heard.load(Ordering::Relaxed));
        self.has_session() && self.since.elapsed().saturating_sub(heard) <= silence
    }
}

/// What counts as one peer.
pub(super) fn source(peer: SocketAddr) -> IpAddr {
    peer.ip().to_canonical()
}

/// More than a client ever needs; it could go on opening and closing them.
const MAX_SESSIONS: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;

    fn limits() -> Limits {
        Limits { connections: 4, per_address: 3, ..Limits::default() }
    }

    fn peer(address: u8) -> SocketAddr {
        SocketAddr::from(([192, 168, 0, address], 50_000))
    }

    struct Entered<'a> {
        place: Option<Place<'a>>,
        stopped: watch::Receiver<Option<Stop>>,
    }

    fn enter(connections: &Connections, address: u8) -> Entered<'_> {
        let (stop, stopped) = watch::channel(None);
        Entered { place: connections.enter(peer(address), stop), stopped }
    }

    impl Entered<'_> {
        fn with_session(self) -> Self {
            self.place.as_ref().unwrap().connection.state.lock().sessions.insert(1);
            self
        }

        fn is_evicted(&self) -> bool {
            matches!(*self.stopped.borrow(), Some(Stop::AtOnce(_)))
        }
    }

    #[test]
    fn the_oldest_connection_without_a_session_makes_room() {
        let connections = Connections::new(limits());
        let (first, second) = (enter(&connections, 1).with_session(), enter(&connections, 1));
        let (third, other) = (enter(&connections, 1), enter(&connections, 2));
        let fourth = enter(&connections, 1);
        assert!(fourth.place.is_some() && second.is_evicted());
        assert!(!first.is_evicted() && !third.is_evicted() && !other.is_evicted());

        let new = enter(&connections, 3);
        assert!(new.place.is_some() && third.is_evicted(), "the oldest of the address that holds most");
        assert_eq!(connections.all().len(), 4);
    }

    #[test]
    fn nobody_with_a_session_makes_room_until_it_is_silent() {
        let connections = Connections::new(Limits { silence: Duration::from_millis(50), ..limits() });
        let held: Vec<_> = (0..3).map(|_| enter(&connections, 1).with_session()).collect();
        assert!(enter(&connections, 1).place.is_none());
        std::thread::sleep(Duration::from_millis(60));
        held[0].place.as_ref().unwrap().connection.heard();
        assert!(enter(&connections, 1).place.is_some());
        assert!(!held[0].is_evicted() && held[1].is_evicted());
    }

    #[test]
    fn a_place_is_given_back_with_its_channel() {
        let connections = Connections::new(limits());
        let entered = enter(&connections, 1);
        let connection = entered.place.as_ref().unwrap().connection.clone();
        connections.opened(&connection, 7);
        connections.opened(&connection, 8);
        assert!(connections.of_channel(7).is_none());
        assert_eq!(connections.of_channel(8).unwrap().id, connection.id);
        drop(entered);
        assert!(connections.of_channel(8).is_none() && connections.all().is_empty());
        connections.opened(&connection, 9);
        assert!(connections.of_channel(9).is_none(), "it is gone");
    }

    #[test]
    fn an_address_is_the_same_in_both_its_forms() {
        assert_eq!(source("[::ffff:192.168.0.1]:1".parse().unwrap()), source(peer(1)));
    }
}
