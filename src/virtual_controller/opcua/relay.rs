use std::net::SocketAddr;
use std::time::Duration;

use tokio::io::{self, AsyncWriteExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinSet;
use tokio::time::{sleep, timeout};

use super::{Event, Events};

/// Passes bytes between clients and the OPC UA crate's server, which listens on a loopback port of its own.
///
/// The crate never lets go of a client that has stopped reading: stopping would take forever and keep a core busy.
/// The clients' connections are therefore ours; dropping this future closes them all, and the port.
pub(super) async fn relay(clients: TcpListener, server: SocketAddr, events: Events) {
    let mut connections = JoinSet::new();
    loop {
        tokio::select! {
            accepted = clients.accept() => match accepted {
                Ok((client, address)) if connections.len() < MAX_CONNECTIONS => {
                    events.tell(Event::Connected { client: address });
                    let events = events.clone();
                    connections.spawn(async move {
                        pass(client, server).await;
                        events.tell(Event::Disconnected { client: address });
                    });
                }
                Ok((_, address)) => {
                    tracing::warn!(%address, "too many OPC UA connections, one more refused");
                    events.tell(Event::TooManyConnections { client: address });
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

async fn pass(mut client: TcpStream, server: SocketAddr) {
    let Ok(mut server) = TcpStream::connect(server).await else { return };
    // Both ends write whole messages.
    let _ = client.set_nodelay(true);
    let _ = server.set_nodelay(true);
    let (mut from_client, mut to_client) = client.split();
    let (mut from_server, mut to_server) = server.split();
    let up = io::copy(&mut from_client, &mut to_server);
    tokio::pin!(up);
    tokio::select! {
        _ = &mut up => {}
        _ = io::copy(&mut from_server, &mut to_client) => {
            // The server's last message says why it hangs up; closing at once could keep it from arriving.
            let _ = to_client.shutdown().await;
            let _ = timeout(LINGER, up).await;
        }
    }
}

/// Far more than the sessions a server takes, since discovery needs connections too.
const MAX_CONNECTIONS: usize = 100;
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);
const LINGER: Duration = Duration::from_secs(1);

#[cfg(test)]
mod tests {
    use super::*;
    use tokio::io::AsyncReadExt as _;

    async fn between() -> (TcpStream, TcpStream, tokio::task::JoinHandle<()>) {
        let clients = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let server = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = clients.local_addr().unwrap();
        let relay = tokio::spawn(relay(clients, server.local_addr().unwrap(), Events::default()));
        let client = TcpStream::connect(address).await.unwrap();
        (client, server.accept().await.unwrap().0, relay)
    }

    #[tokio::test]
    async fn bytes_pass_both_ways_and_a_last_word_arrives() {
        let (mut client, mut server, _relay) = between().await;
        let mut bytes = [0; 5];
        client.write_all(b"hello").await.unwrap();
        server.read_exact(&mut bytes).await.unwrap();
        assert_eq!(&bytes, b"hello");
        server.write_all(b"bye").await.unwrap();
        drop(server);
        let mut rest = Vec::new();
        client.read_to_end(&mut rest).await.unwrap();
        assert_eq!(rest, b"bye");
    }

    #[tokio::test]
    async fn a_client_that_does_not_read_cannot_hold_the_server() {
        let (_client, mut server, relay) = between().await;
        let stuck = tokio::spawn(async move { while server.write_all(&[0; 65536]).await.is_ok() {} });
        sleep(Duration::from_millis(200)).await;
        assert!(!stuck.is_finished());
        relay.abort();
        timeout(Duration::from_secs(10), stuck).await.unwrap().unwrap();
    }
}
