use std::io;
use std::net::{Ipv4Addr, SocketAddr};
use std::time::Duration;

use opcua::core::comms::tcp_types::ReverseHelloMessage;
use opcua::server::{ReverseConnectTargetConfig, ServerHandle};
use opcua::types::{NodeId, SimpleBinaryEncodable as _};
use parking_lot::Mutex;
use subtle::ConstantTimeEq as _;
use tokio::io::AsyncReadExt as _;
use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinSet;
use tokio::time::timeout;

use super::sessions::LiveSession;

/// How the gate reaches the OPC UA crate's server: the server calls the gate (OPC 10000-6 §7.1.2.6, ReverseHello), for
/// one client at a time, with a secret in its first bytes. So the server has no port that other programs of this
/// machine could connect to.
#[derive(Default)]
pub(in super::super) struct InnerServer {
    handle: Mutex<Option<ServerHandle>>,
    /// Instead of it, a listener that stands for the server.
    #[cfg(test)]
    stand_in: Option<SocketAddr>,
}

/// A listener for the crate's server, which insists on one. No client can connect to it: it is one end of a connection,
/// whose other end keeps it from becoming readable and must be held as long.
pub(in super::super) fn deaf_listener() -> io::Result<(TcpListener, std::net::TcpStream)> {
    let listener = std::net::TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
    let other_end = std::net::TcpStream::connect(listener.local_addr()?)?;
    let end = loop {
        let (end, peer) = listener.accept()?;
        if peer == other_end.local_addr()? {
            break end;
        }
    };
    end.set_nonblocking(true)?;
    #[cfg(unix)]
    let listener = std::net::TcpListener::from(std::os::fd::OwnedFd::from(end));
    #[cfg(windows)]
    let listener = std::net::TcpListener::from(std::os::windows::io::OwnedSocket::from(end));
    Ok((TcpListener::from_std(listener)?, other_end))
}

impl InnerServer {
    #[cfg(test)]
    pub(super) fn standing_in(address: SocketAddr) -> Self {
        Self { stand_in: Some(address), ..Self::default() }
    }

    /// From now on this server is reached; none after `None`. A server holds its gate, so that both stay in memory
    /// until then.
    pub(super) fn attach(&self, handle: Option<ServerHandle>) {
        *self.handle.lock() = handle;
    }

    fn handle(&self) -> Option<ServerHandle> {
        self.handle.lock().clone()
    }

    /// A new connection with the server.
    pub(super) async fn connect(&self) -> io::Result<TcpStream> {
        #[cfg(test)]
        if let Some(stand_in) = self.stand_in {
            return TcpStream::connect(stand_in).await;
        }
        let handle = self.handle().ok_or(io::ErrorKind::NotConnected)?;
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await?;
        let mut secret = [0; 32];
        getrandom::fill(&mut secret).map_err(|error| io::Error::other(error.to_string()))?;
        let call = ReverseConnect::new(&handle, listener.local_addr()?, hex::encode(secret))?;
        timeout(CALL_TIMEOUT, answer(&listener, &call.expected)).await?
    }

    /// What the server says about the session with this token.
    pub(super) fn find_session(&self, token: &NodeId) -> Option<LiveSession> {
        let session = self.handle()?.session_manager().read().find_by_token(token)?;
        let session = session.read();
        Some(LiveSession { is_activated: session.is_activated(), channel: session.secure_channel_id() })
    }
}

impl std::fmt::Debug for InnerServer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("InnerServer")
    }
}

/// The server is asked to connect, until this is dropped.
struct ReverseConnect<'a> {
    server: &'a ServerHandle,
    secret: String,
    /// The server's first message, which has the secret in it.
    expected: Vec<u8>,
}

impl<'a> ReverseConnect<'a> {
    fn new(server: &'a ServerHandle, address: SocketAddr, secret: String) -> io::Result<Self> {
        let hello = ReverseHelloMessage::new(server.info().application_uri.as_ref(), &secret);
        let mut expected = Vec::new();
        hello.encode(&mut expected).map_err(io::Error::other)?;
        let target = ReverseConnectTargetConfig { address, endpoint_url: secret.clone(), id: secret.clone() };
        server.add_reverse_connect_target(target);
        Ok(Self { server, secret, expected })
    }
}

/// Waits for the connection that begins with `expected`; others are dropped.
async fn answer(listener: &TcpListener, expected: &[u8]) -> io::Result<TcpStream> {
    let mut callers: JoinSet<Option<TcpStream>> = JoinSet::new();
    loop {
        tokio::select! {
            accepted = listener.accept(), if callers.len() < MAX_CALLERS => {
                let (mut caller, _) = accepted?;
                let expected = expected.to_vec();
                callers.spawn(async move {
                    let mut first = vec![0; expected.len()];
                    caller.read_exact(&mut first).await.ok()?;
                    bool::from(first.ct_eq(&expected)).then_some(caller)
                });
            }
            Some(caller) = callers.join_next() => if let Ok(Some(server)) = caller {
                return Ok(server);
            },
        }
    }
}

impl Drop for ReverseConnect<'_> {
    fn drop(&mut self) {
        self.server.remove_reverse_connect_target(&self.secret);
    }
}

const CALL_TIMEOUT: Duration = Duration::from_secs(5);
const MAX_CALLERS: usize = 16;

#[cfg(test)]
mod tests {
    use tokio::io::AsyncWriteExt as _;

    use super::*;

    #[tokio::test]
    async fn nobody_can_connect_to_the_listener_of_the_server() {
        let (listener, _other_end) = deaf_listener().unwrap();
        assert!(TcpStream::connect(listener.local_addr().unwrap()).await.is_err());
        assert!(timeout(Duration::from_millis(200), listener.accept()).await.is_err(), "nor does it fail");
    }

    #[tokio::test]
    async fn only_the_caller_with_the_secret_is_answered() {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await.unwrap();
        let address = listener.local_addr().unwrap();
        let _silent = TcpStream::connect(address).await.unwrap();
        let mut wrong = TcpStream::connect(address).await.unwrap();
        wrong.write_all(b"secreT").await.unwrap();
        let mut right = TcpStream::connect(address).await.unwrap();
        right.write_all(b"secret and more").await.unwrap();
        let mut answered = timeout(CALL_TIMEOUT, answer(&listener, b"secret")).await.unwrap().unwrap();
        let mut rest = [0; 9];
        answered.read_exact(&mut rest).await.unwrap();
        assert_eq!(&rest, b" and more");
    }
}
