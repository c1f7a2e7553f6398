use std::net::{IpAddr, SocketAddr};

use tokio_util::sync::CancellationToken;

use super::connection_limits::{Activity, ConnectionStage, LimitedConnection, SourceNetwork};

/// One connection of a peer of the management protocol.
#[derive(Debug)]
pub struct PeerConnection {
    address: IpAddr,
    pub(super) activity: Activity,
    pub(super) evicted: CancellationToken,
}

impl PeerConnection {
    pub fn new(address: SocketAddr) -> Self {
        Self { address: address.ip().to_canonical(), activity: Activity::new(), evicted: CancellationToken::new() }
    }

    pub fn address(&self) -> IpAddr {
        self.address
    }

    /// A request with a valid session has come.
    pub fn has_session(&self) {
        self.activity.reached(ConnectionStage::InSession);
        self.activity.used();
    }
}

impl LimitedConnection for PeerConnection {
    fn source(&self) -> SourceNetwork {
        SourceNetwork::new(self.address)
    }

    fn activity(&self) -> &Activity {
        &self.activity
    }

    fn evict(&self) {
        self.evicted.cancel();
    }
}
