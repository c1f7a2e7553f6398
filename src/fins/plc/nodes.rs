//! Which client has which node (W421 7-4: automatic allocation, node conflicts).

use std::collections::BTreeMap;
use std::net::IpAddr;
use std::sync::Arc;

use tokio::sync::Notify;

use super::super::codec::frame::TcpRefusal;

/// The nodes that are given to clients that ask for none.
const GIVEN: std::ops::RangeInclusive<u8> = 239..=254;

/// The connected clients of a PLC.
#[derive(Debug)]
pub(super) struct ConnectedNodes {
    own: u8,
    most: usize,
    clients: BTreeMap<u8, Client>,
}

#[derive(Debug)]
struct Client {
    ip: IpAddr,
    /// Makes the connection send a confirmation.
    confirm: Arc<Notify>,
}

impl ConnectedNodes {
    pub(super) const fn new(own: u8, most: usize) -> Self {
        Self { own, most, clients: BTreeMap::new() }
    }

    /// Gives a node to a client that asks for `node`, or for any with 0.
    pub(super) fn connect(&mut self, node: u32, ip: IpAddr, confirm: &Arc<Notify>) -> Result<u8, TcpRefusal> {
        let node = match node {
            0 => None,
            node => Some(u8::try_from(node).ok().filter(|node| *node < 255).ok_or(TcpRefusal::NodeOutOfRange)?),
        };
        if node == Some(self.own) {
            return Err(TcpRefusal::SameNode);
        }
        if let Some(client) = node.and_then(|node| self.clients.get(&node)) {
            if client.ip == ip {
                client.confirm.notify_one();
            }
            return Err(TcpRefusal::NodeConnected);
        }
        if self.clients.len() >= self.most {
            return Err(TcpRefusal::AllConnectionsInUse);
        }
        let free = |node: &u8| *node != self.own && !self.clients.contains_key(node);
        let node = node.or_else(|| GIVEN.into_iter().find(free)).ok_or(TcpRefusal::NoNodeLeft)?;
        self.clients.insert(node, Client { ip, confirm: Arc::clone(confirm) });
        Ok(node)
    }

    pub(super) fn disconnect(&mut self, node: u8) {
        self.clients.remove(&node);
    }

    pub(super) fn connected(&self) -> Vec<u8> {
        self.clients.keys().copied().collect()
    }
}

#[cfg(test)]
mod tests {
    use std::net::Ipv4Addr;

    use super::*;

    #[test]
    fn each_client_has_a_node_of_its_own() {
        let mut nodes = ConnectedNodes::new(90, 4);
        let (here, there) = (IpAddr::from(Ipv4Addr::LOCALHOST), IpAddr::from([127, 0, 0, 2]));
        let confirm = Arc::new(Notify::new());
        let mut connect = |node, ip| nodes.connect(node, ip, &confirm);
        assert_eq!(connect(0, here), Ok(239));
        assert_eq!(connect(0, here), Ok(240));
        assert_eq!(connect(100, here), Ok(100));
        assert_eq!(connect(100, there), Err(TcpRefusal::NodeConnected));
        assert_eq!(connect(90, here), Err(TcpRefusal::SameNode));
        assert_eq!(connect(255, here), Err(TcpRefusal::NodeOutOfRange));
        assert_eq!(connect(7_000, here), Err(TcpRefusal::NodeOutOfRange));
        assert_eq!(connect(101, here), Ok(101));
        assert_eq!(connect(102, here), Err(TcpRefusal::AllConnectionsInUse));
        nodes.disconnect(239);
        assert_eq!(nodes.connect(0, here, &confirm), Ok(239));
        assert_eq!(nodes.connected(), [100, 101, 239, 240]);
    }

    #[test]
    fn the_nodes_that_are_given_run_out() {
        let mut nodes = ConnectedNodes::new(240, 100);
        let confirm = Arc::new(Notify::new());
        let mut connect = || nodes.connect(0, Ipv4Addr::LOCALHOST.into(), &confirm);
        for node in (239..=254).filter(|node| *node != 240) {
            assert_eq!(connect(), Ok(node));
        }
        assert_eq!(connect(), Err(TcpRefusal::NoNodeLeft));
    }
}
