use std::collections::{HashMap, HashSet};
use std::net::SocketAddr;
use std::sync::Arc;

use opcua::crypto::SecurityPolicy;
use parking_lot::Mutex;
use tokio::sync::{Notify, watch};

use super::channel::ChannelState;
use super::fault::Fault;
use super::rewrap::SecuredClient;
use crate::pki::Certificate;
use crate::virtual_controller::connection_limits::{
    Activity, ConnectionLimits, ConnectionSlot, ConnectionSlots, ConnectionStage, LimitedConnection, SourceNetwork,
};

/// The connections there are, and the secure channel of each.
#[derive(Debug)]
pub(super) struct GateConnections {
    slots: Arc<ConnectionSlots<GateConnection>>,
    by_channel: Mutex<HashMap<u32, Arc<GateConnection>>>,
}

/// One connection of a client.
#[derive(Debug)]
pub(super) struct GateConnection {
    pub(super) peer: SocketAddr,
    pub(super) activity: Activity,
    stop: watch::Sender<Option<StopReason>>,
    pub(super) state: Mutex<ConnectionState>,
    pub(super) channel: Mutex<ChannelState>,
    answered: Notify,
}

/// How far a connection has come.
#[derive(Debug, Default)]
pub(super) struct ConnectionState {
    /// With what it was admitted.
    pub(super) identity: Option<Arc<ClaimedIdentity>>,
    /// The longest message the client takes, in bytes, if its Hello said so.
    pub(super) longest_response: Option<usize>,
    /// The secure channel the server gave it.
    pub(super) channel: Option<u32>,
    /// Sessions on it that were looked at and found to belong there.
    pub(super) sessions: HashSet<u32>,
    /// Set where the channel has security.
    pub(super) secured: Option<Arc<SecuredClient>>,
    /// What stands for the connection in the names of users who log in.
    pub(super) login_mark: Option<String>,
}

/// Who asks for a secure channel, as its OpenSecureChannel says in clear.
#[derive(Debug)]
pub(super) struct ClaimedIdentity {
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

impl ClaimedIdentity {
    pub(super) fn leaf(&self) -> Option<&Certificate> {
        self.chain.first()
    }
}

/// Why a connection has to end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum StopReason {
    /// It is told this.
    Told(Fault),
    /// Sending does not wait for the client to read it.
    AtOnce(Fault),
}

/// Why the connection with this has to end, once it has to.
pub(super) async fn stop_asked(stopped: &mut watch::Receiver<Option<StopReason>>) -> StopReason {
    let asked = stopped.wait_for(Option::is_some).await.map(|stop| stop.clone());
    match asked {
        Ok(Some(stop)) => stop,
        // No task is left that could ask.
        _ => std::future::pending().await,
    }
}

/// A connection that is served, until this is dropped.
#[derive(Debug)]
pub(super) struct ServedConnection<'a> {
    connections: &'a GateConnections,
    slot: ConnectionSlot<GateConnection>,
}

impl GateConnections {
    pub(super) fn new(limits: ConnectionLimits) -> Self {
        Self { slots: Arc::new(ConnectionSlots::new(limits)), by_channel: Mutex::default() }
    }

    /// Takes in one more, as [`ConnectionSlots::enter`] does.
    pub(super) fn enter(
        &self,
        peer: SocketAddr,
        stop: watch::Sender<Option<StopReason>>,
    ) -> Option<ServedConnection<'_>> {
        let slot = self.slots.enter(GateConnection::new(peer, stop))?;
        Some(ServedConnection { connections: self, slot })
    }

    /// Notes which secure channel the server gave a connection.
    pub(super) fn opened(&self, connection: &Arc<GateConnection>, channel: u32) {
        let mut by_channel = self.by_channel.lock();
        if channel == 0 || !self.slots.has(connection) {
            return;
        }
        let before = {
            let mut state = connection.state.lock();
            let is_proven = state.identity.as_ref().is_some_and(|identity| identity.leaf().is_some());
            connection.activity.reached(if is_proven { ConnectionStage::Proven } else { ConnectionStage::Opened });
            state.channel.replace(channel)
        };
        if let Some(before) = before {
            by_channel.remove(&before);
        }
        by_channel.insert(channel, connection.clone());
    }

    pub(super) fn of_channel(&self, channel: u32) -> Option<Arc<GateConnection>> {
        self.by_channel.lock().get(&channel).cloned()
    }

    /// Whether a connection that does not have to end was admitted with this certificate, `one` aside.
    pub(super) fn any_other_has(&self, leaf: &Certificate, one: &GateConnection) -> bool {
        self.all().iter().filter(|other| !std::ptr::eq(&***other, one) && !other.is_stopped()).any(|other| {
            let identity = other.state.lock().identity.clone();
            identity.is_some_and(|identity| identity.leaf() == Some(leaf))
        })
    }

    pub(super) fn all(&self) -> Vec<Arc<GateConnection>> {
        self.slots.all()
    }
}

impl ServedConnection<'_> {
    pub(super) fn connection(&self) -> &Arc<GateConnection> {
        &self.slot.connection
    }
}

impl Drop for ServedConnection<'_> {
    fn drop(&mut self) {
        let mut by_channel = self.connections.by_channel.lock();
        let channel = self.connection().state.lock().channel;
        if let Some(channel) = channel
            && by_channel.get(&channel).is_some_and(|other| Arc::ptr_eq(other, self.connection()))
        {
            by_channel.remove(&channel);
        }
    }
}

impl GateConnection {
    pub(super) fn new(peer: SocketAddr, stop: watch::Sender<Option<StopReason>>) -> Self {
        Self {
            peer,
            activity: Activity::new(),
            stop,
            state: Mutex::default(),
            channel: Mutex::default(),
            answered: Notify::new(),
        }
    }

    pub(super) fn notify_answered(&self) {
        self.answered.notify_waiters();
    }

    /// Waits until the server has answered every request for a session.
    pub(super) async fn all_answered(&self) {
        loop {
            let answered = self.answered.notified();
            if !self.channel.lock().awaits_answers() {
                return;
            }
            answered.await;
        }
    }

    /// Ends it, unless that has begun already.
    pub(super) fn stop(&self, stop: StopReason) {
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
}

impl LimitedConnection for GateConnection {
    fn source(&self) -> SourceNetwork {
        SourceNetwork::new(self.peer.ip())
    }

    fn activity(&self) -> &Activity {
        &self.activity
    }

    fn evict(&self) {
        let status = opcua::types::StatusCode::BadTcpNotEnoughResources;
        self.stop(StopReason::AtOnce(Fault::new(status, "others need the connection")));
    }
}

/// More than a client ever needs; it could go on opening and closing them.
const MAX_SESSIONS: usize = 64;

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn a_connection_is_known_by_its_channel_until_it_ends() {
        let limits = ConnectionLimits { connections: 4, per_source: 3, silence: Duration::from_secs(60) };
        let connections = GateConnections::new(limits);
        let peer = SocketAddr::from(([192, 168, 0, 1], 50_000));
        let entered = connections.enter(peer, watch::channel(None).0).unwrap();
        let connection = entered.connection().clone();
        connections.opened(&connection, 7);
        connections.opened(&connection, 8);
        assert!(connections.of_channel(7).is_none());
        assert!(Arc::ptr_eq(&connections.of_channel(8).unwrap(), &connection));
        drop(entered);
        assert!(connections.of_channel(8).is_none() && connections.all().is_empty());
        connections.opened(&connection, 9);
        assert!(connections.of_channel(9).is_none(), "it is gone");
    }
}
