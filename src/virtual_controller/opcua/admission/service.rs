use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use opcua::types::StatusCode;
use tokio::io::AsyncReadExt as _;
use tokio::net::tcp::{OwnedReadHalf, OwnedWriteHalf};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;
use tokio::task::JoinSet;
use tokio::time::{Instant, sleep, sleep_until, timeout};

use super::client_to_server::{ClientToServer, read_hello};
use super::connections::{GateConnection, StopReason, stop_asked};
use super::fault::Fault;
use super::gate::Gate;
use super::server_to_client::{ServerToClient, say};

impl Gate {
    /// Accepts and serves clients until the future is dropped.
    pub(in super::super) async fn run(self: Arc<Self>, clients: TcpListener) {
        let mut connections = JoinSet::new();
        loop {
            tokio::select! {
                accepted = clients.accept() => match accepted {
                    Ok((client, address)) => {
                        let gate = self.clone();
                        connections.spawn(async move { gate.serve(client, address).await });
                    }
                    Err(e) => {
                        // Most likely out of file descriptors, which passes.
                        tracing::warn!("cannot accept an OPC UA connection: {e}");
                        sleep(ACCEPT_PAUSE).await;
                    }
                },
                Some(_) = connections.join_next() => {}
            }
        }
    }

    /// Serves one connection from its first byte to its last.
    async fn serve(self: Arc<Self>, client: TcpStream, address: SocketAddr) {
        let (stop, stopped) = watch::channel(None);
        let Some(slot) = self.connections.enter(address, stop) else {
            self.reporter.too_many(address);
            let fault = Fault::new(StatusCode::BadTcpNotEnoughResources, "too many connections");
            let _ = client.try_write(&fault.to_message());
            return;
        };
        self.reporter.connected(address);
        // Both ends write whole messages.
        let _ = client.set_nodelay(true);
        let (mut from, mut to) = client.into_split();
        if self.talk(slot.connection(), &mut from, &mut to, stopped).await {
            // Closing while there is something unread could keep the last words from arriving.
            let _ = timeout(self.limits().linger, read_to_end(&mut from)).await;
        }
        self.reporter.disconnected(address);
    }

    /// From the first byte to the last word. Whether the client should be given time to read that.
    async fn talk(
        self: &Arc<Self>,
        connection: &Arc<GateConnection>,
        from: &mut OwnedReadHalf,
        to: &mut OwnedWriteHalf,
        mut stopped: watch::Receiver<Option<StopReason>>,
    ) -> bool {
        let limits = self.limits();
        let start = Instant::now();
        let greeting = tokio::select! {
            greeting = self.greet(from, start + limits.open) => greeting,
            stop = stop_asked(&mut stopped) => return say(to, &stop).await,
        };
        let (hello, server) = match greeting {
            Ok(Some(greeting)) => greeting,
            Ok(None) => return false,
            Err(fault) => return say(to, &self.refuse(connection, fault)).await,
        };
        let _ = server.set_nodelay(true);
        let (mut from_server, mut to_server) = server.into_split();
        let mut up = ClientToServer::new(self, connection, hello);
        let mut down = ServerToClient::new(self, connection);
        let told = self
            .pass_on(connection, (&mut up, from, &mut to_server), (&mut down, &mut from_server, to), stopped, start)
            .await;
        // The server may have to close sessions, or to answer first.
        let left = async {
            if up.leave(&mut to_server).await {
                std::future::pending::<()>().await;
            }
        };
        let _ = timeout(LEAVE, async {
            tokio::select! {
                () = left => {}
                () = down.read_until_end(&mut from_server) => {}
            }
        })
        .await;
        told
    }

    /// Passes on what client and server say until the connection has to end. Whether the client should be given time to
    /// read its last words.
    async fn pass_on(
        self: &Arc<Self>,
        connection: &Arc<GateConnection>,
        (up, from, to_server): (&mut ClientToServer<'_>, &mut OwnedReadHalf, &mut OwnedWriteHalf),
        (down, from_server, to): (&mut ServerToClient<'_>, &mut OwnedReadHalf, &mut OwnedWriteHalf),
        stopped: watch::Receiver<Option<StopReason>>,
        start: Instant,
    ) -> bool {
        let limits = self.limits();
        let up = async {
            if let Err(stop) = up.run(from, to_server, start + limits.open).await {
                connection.stop(stop);
                std::future::pending::<()>().await;
            }
            // The client says no more; what the server still has to say gets some time.
            sleep(limits.stall).await;
        };
        let without_session = async {
            sleep_until(start + limits.open + limits.session).await;
            if !connection.activity.has_session() {
                connection.stop(StopReason::Told(Fault::new(StatusCode::BadTimeout, "no session in time")));
            }
            std::future::pending::<()>().await;
        };
        tokio::select! {
            told = down.run(from_server, to, stopped) => told,
            () = up => false,
            () = without_session => false,
        }
    }

    /// Reads the client's Hello and finds the server. `None` if the client has gone.
    async fn greet(&self, from: &mut OwnedReadHalf, by: Instant) -> Result<Option<(Vec<u8>, TcpStream)>, Fault> {
        let Some(hello) = read_hello(from, by).await? else { return Ok(None) };
        let server = self.server.connect().await;
        let server = server.map_err(|_| Fault::new(StatusCode::BadServerHalted, "the server has stopped"))?;
        Ok(Some((hello, server)))
    }
}

/// Reads and discards until the client closes its side of the connection.
async fn read_to_end(from: &mut OwnedReadHalf) {
    let mut bytes = [0; 4096];
    while matches!(from.read(&mut bytes).await, Ok(1..)) {}
}

/// How long the server may take to close the sessions of a client that has left.
const LEAVE: Duration = Duration::from_secs(2);
/// After an error of `accept`, which is most likely that the process is out of file descriptors.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);
