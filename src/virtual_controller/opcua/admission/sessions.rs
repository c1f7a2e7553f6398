use std::collections::HashMap;
use std::sync::Arc;

use opcua::types::NodeId;
use parking_lot::Mutex;

use super::connections::{GateConnection, StopReason};
use super::fault::Fault;
use crate::pki::Certificate;
use crate::virtual_controller::connection_limits::{LimitedConnection as _, SourceNetwork};

/// The sessions of the server, the oldest first, and how many more there may be.
///
/// "The Server shall close the oldest Session that is not activated before reaching the maximum number of supported
/// Sessions" (OPC 10000-4 §5.7.2.1). Here it is the oldest of the client that has most of them, one without a
/// certificate first; and a client that has its share already makes room itself. A client is told apart by its source
/// and its certificate.
#[derive(Debug, Default)]
pub(super) struct OpcUaSessions(Mutex<SessionTable>);

#[derive(Debug, Default)]
struct SessionTable {
    next: SessionNumber,
    held: Vec<SessionSlot>,
}

pub(super) type SessionNumber = u64;

#[derive(Debug)]
struct SessionSlot {
    number: SessionNumber,
    /// What the client shows in every request; `None` until the server has created the session.
    token: Option<NodeId>,
    /// The one that asked for it.
    connection: Arc<GateConnection>,
    /// Another one takes its slot.
    is_closing: bool,
}

/// What the server says about a session.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LiveSession {
    pub(super) is_activated: bool,
    /// The secure channel it is used on.
    pub(super) channel: u32,
}

/// Asks the server for a session by its token; `None` if there is none any more.
pub(super) type FindSession<'a> = &'a dyn Fn(&NodeId) -> Option<LiveSession>;

impl OpcUaSessions {
    /// Takes in one more session, for which another one may have to end. `None` if the client has its share, or if all
    /// sessions are activated.
    pub(super) fn enter(&self, connection: &Arc<GateConnection>, find: FindSession<'_>) -> Option<SessionNumber> {
        let mut taken = self.0.lock();
        taken.forget_ended(find);
        let of_connection = |held: &SessionSlot| Arc::ptr_eq(&held.connection, connection);
        let waiting = |held: &SessionSlot| of_connection(held) && !held.is_activated(find);
        if taken.count(of_connection) >= PER_CONNECTION || taken.count(waiting) >= WAITING_PER_CONNECTION {
            return None;
        }
        let (source, certificate) = (connection.source(), connection.certificate());
        if taken.count(|held| held.connection.source() == source) >= PER_SOURCE {
            taken.make_room(connection, find, |other| other.source() == source)?;
        }
        if certificate.is_some() && taken.count(|held| held.connection.certificate() == certificate) >= PER_CERTIFICATE
        {
            taken.make_room(connection, find, |other| other.certificate() == certificate)?;
        }
        if taken.count(|_| true) >= MAX_SESSIONS {
            taken.make_room(connection, find, |_| true)?;
        }
        let number = taken.next;
        taken.next += 1;
        taken.held.push(SessionSlot { number, token: None, connection: connection.clone(), is_closing: false });
        Some(number)
    }

    /// The server has created the session.
    pub(super) fn created(&self, number: SessionNumber, token: NodeId) {
        if let Some(held) = self.0.lock().held.iter_mut().find(|held| held.number == number) {
            held.token = Some(token);
        }
    }

    /// The server has not created the session.
    pub(super) fn refused(&self, number: SessionNumber) {
        self.0.lock().held.retain(|held| held.number != number);
    }

    /// The sessions that end with their connection, by their tokens: those that are not activated, since they can be on
    /// no other channel. The others can be taken up again by their client (OPC 10000-4 §5.7.1), as long as fewer than
    /// half of the sessions are taken.
    pub(super) fn leave(&self, connection: &Arc<GateConnection>, channel: u32, find: FindSession<'_>) -> Vec<NodeId> {
        let mut taken = self.0.lock();
        taken.held.retain(|held| held.token.is_some() || !Arc::ptr_eq(&held.connection, connection));
        taken.forget_ended(find);
        let is_crowded = taken.count(|_| true) > MAX_SESSIONS / 2;
        let mut closed = Vec::new();
        for held in &mut taken.held {
            let Some((token, live)) = held.token.as_ref().and_then(|token| Some((token, find(token)?))) else {
                continue;
            };
            if live.channel == channel && (is_crowded || !live.is_activated) {
                closed.push(token.clone());
                held.is_closing = true;
            }
        }
        closed
    }
}

impl SessionTable {
    fn forget_ended(&mut self, find: FindSession<'_>) {
        self.held.retain(|held| held.token.as_ref().is_none_or(|token| find(token).is_some()));
    }

    fn count(&self, counts: impl Fn(&SessionSlot) -> bool) -> usize {
        self.held.iter().filter(|held| !held.is_closing && counts(held)).count()
    }

    /// Ends a connection that has only sessions that are not activated, and is not `new`.
    fn make_room(
        &mut self,
        new: &Arc<GateConnection>,
        find: FindSession<'_>,
        may_go: impl Fn(&GateConnection) -> bool,
    ) -> Option<()> {
        let is_used = |connection: &Arc<GateConnection>| {
            self.held.iter().any(|held| Arc::ptr_eq(&held.connection, connection) && held.is_activated(find))
        };
        let candidates: Vec<&SessionSlot> = self
            .held
            .iter()
            .filter(|held| !held.is_closing && may_go(&held.connection))
            .filter(|held| !Arc::ptr_eq(&held.connection, new) && !is_used(&held.connection))
            .collect();
        let without_certificate = candidates.iter().any(|held| held.connection.certificate().is_none());
        let mut by_client: HashMap<Client, (usize, usize)> = HashMap::new();
        for (index, held) in candidates.iter().enumerate() {
            let certificate = held.connection.certificate();
            if !without_certificate || certificate.is_none() {
                let client = (held.connection.source(), certificate.map(|leaf| leaf.der().to_vec()));
                by_client.entry(client).or_insert((0, index)).0 += 1;
            }
        }
        let (_, oldest) = by_client.into_values().max_by_key(|(count, oldest)| (*count, std::cmp::Reverse(*oldest)))?;
        let connection = candidates[oldest].connection.clone();
        for held in self.held.iter_mut().filter(|held| Arc::ptr_eq(&held.connection, &connection)) {
            held.is_closing = true;
        }
        let status = opcua::types::StatusCode::BadTcpNotEnoughResources;
        connection.stop(StopReason::AtOnce(Fault::new(status, "others need the session, which was not activated")));
        Some(())
    }
}

type Client = (SourceNetwork, Option<Vec<u8>>);

impl SessionSlot {
    fn is_activated(&self, find: FindSession<'_>) -> bool {
        self.token.as_ref().and_then(find).is_some_and(|live| live.is_activated)
    }
}

impl GateConnection {
    /// The client's own, if it has one.
    fn certificate(&self) -> Option<Certificate> {
        self.state.lock().identity.as_ref().and_then(|identity| identity.leaf().cloned())
    }
}

/// Sessions of all clients (manual 3.1).
pub(super) const MAX_SESSIONS: usize = 20;
const PER_SOURCE: usize = 15;
const PER_CERTIFICATE: usize = 10;
const PER_CONNECTION: usize = 8;
/// Sessions of one connection that are not activated yet.
const WAITING_PER_CONNECTION: usize = 2;

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use tokio::sync::watch;

    use super::*;

    /// A server that keeps the sessions it is told to.
    #[derive(Default)]
    struct Server(Mutex<HashMap<NodeId, LiveSession>>);

    impl Server {
        fn find(&self) -> impl Fn(&NodeId) -> Option<LiveSession> {
            |token| self.0.lock().get(token).copied()
        }

        /// One session on a connection of its own.
        fn create(&self, sessions: &OpcUaSessions, address: u8, is_activated: bool) -> Option<Arc<GateConnection>> {
            let connection = connection(address);
            self.create_on(sessions, &connection, is_activated)?;
            Some(connection)
        }

        fn create_on(
            &self,
            sessions: &OpcUaSessions,
            connection: &Arc<GateConnection>,
            is_activated: bool,
        ) -> Option<NodeId> {
            let number = sessions.enter(connection, &self.find())?;
            let token = NodeId::new(0, u32::try_from(number).unwrap());
            self.0.lock().insert(token.clone(), LiveSession { is_activated, channel: 7 });
            sessions.created(number, token.clone());
            Some(token)
        }
    }

    fn connection(address: u8) -> Arc<GateConnection> {
        Arc::new(GateConnection::new(([192, 168, 0, address], 50_000).into(), watch::channel(None).0))
    }

    #[test]
    fn the_oldest_session_that_is_not_activated_makes_room() {
        let (sessions, server) = (OpcUaSessions::default(), Server::default());
        let used: Vec<_> = (0..5).map(|i| server.create(&sessions, i, true).unwrap()).collect();
        let hogs: Vec<_> = (0..100).map(|_| server.create(&sessions, 77, false).unwrap()).collect();
        let ended = hogs.iter().filter(|hog| hog.is_stopped()).count();
        assert_eq!(ended, 100 - PER_SOURCE, "the share of one source");
        assert!(hogs[..ended].iter().all(|hog| hog.is_stopped()), "the oldest first");

        let honest = server.create(&sessions, 9, false).unwrap();
        let more: Vec<_> = (0..100).map(|_| server.create(&sessions, 77, false).unwrap()).collect();
        assert!(!honest.is_stopped() && used.iter().all(|used| !used.is_stopped()));
        assert!(more.last().is_some_and(|newest| !newest.is_stopped()));
    }

    #[test]
    fn sessions_in_use_make_no_room_and_one_client_cannot_have_them_all() {
        let (sessions, server) = (OpcUaSessions::default(), Server::default());
        let held: Vec<_> = (0..PER_SOURCE).map(|_| server.create(&sessions, 1, true).unwrap()).collect();
        assert!(server.create(&sessions, 1, true).is_none(), "its share");
        for address in 2..7 {
            server.create(&sessions, address, true).unwrap();
        }
        assert!(server.create(&sessions, 8, false).is_none(), "all are in use");
        server.0.lock().remove(&NodeId::new(0, 0_u32));
        assert!(server.create(&sessions, 8, false).is_some(), "one has ended");
        assert!(held.iter().all(|held| !held.is_stopped()));
    }

    #[test]
    fn one_connection_has_few_sessions() {
        let (sessions, server, connection) = (OpcUaSessions::default(), Server::default(), connection(1));
        for _ in 0..WAITING_PER_CONNECTION {
            server.create_on(&sessions, &connection, false).unwrap();
        }
        assert!(server.create_on(&sessions, &connection, false).is_none());
        assert!(!connection.is_stopped());
    }

    #[test]
    fn what_nobody_can_use_any_more_ends_with_its_connection() {
        let (sessions, server, connection) = (OpcUaSessions::default(), Server::default(), connection(1));
        let used = server.create_on(&sessions, &connection, true).unwrap();
        let waiting = server.create_on(&sessions, &connection, false).unwrap();
        sessions.enter(&connection, &server.find()).unwrap();
        assert!(sessions.leave(&connection, 8, &server.find()).is_empty(), "of another channel");
        assert_eq!(sessions.leave(&connection, 7, &server.find()), [waiting]);
        for address in 2..12 {
            server.create(&sessions, address, true).unwrap();
        }
        let closed = sessions.leave(&connection, 7, &server.find());
        assert!(closed.contains(&used), "too many are taken to keep one for a client that may come back");
    }
}
