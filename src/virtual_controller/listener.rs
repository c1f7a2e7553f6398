use std::convert::Infallible;
use std::sync::Arc;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use axum::http::HeaderValue;
use axum::http::header::{CONNECTION, TRANSFER_ENCODING};
use hyper::body::Incoming;
use hyper::service::service_fn;
use hyper::{Request, server::conn::http1};
use hyper_util::rt::{TokioIo, TokioTimer};
use rustls::ServerConfig;
use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinSet;
use tokio::time::Instant;
use tokio_rustls::TlsAcceptor;
use tokio_util::sync::CancellationToken;
use tower_service::Service as _;

use super::api::{self, ClientConnection, ManagementApi, ROUTER};
use super::connection_limits::{ConnectionLimits, ConnectionSlots, ConnectionStage};
use super::peer::PeerConnection;
use super::request_heads::CheckedHeads;

/// An engineer's program keeps one connection for each session. No change takes as long as `silence`.
const CONNECTION_LIMITS: ConnectionLimits =
    ConnectionLimits { connections: 64, per_source: 16, silence: Duration::from_secs(180) };
const HANDSHAKE_TIMEOUT: Duration = Duration::from_secs(5);
/// From the first byte to the first request with a valid session.
const SESSION_TIMEOUT: Duration = Duration::from_secs(20);
/// For the head of a request, and for a connection without one.
const HEAD_TIMEOUT: Duration = Duration::from_secs(10);
/// Greatest age of a connection, so that one that reads its answers slowly ends as well.
const MAX_AGE: Duration = Duration::from_secs(600);
/// What a request in hand gets when the controller is switched off or the connection has become too old.
const GRACE: Duration = Duration::from_secs(2);
/// After an error of `accept`, which is most likely that the process is out of file descriptors.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// Accepts connections of the management protocol until `off`, then lets the requests in hand finish.
pub async fn serve(listener: TcpListener, tls: Arc<ServerConfig>, api: Arc<ManagementApi>, off: CancellationToken) {
    let acceptor = TlsAcceptor::from(tls);
    let slots = Arc::new(ConnectionSlots::new(CONNECTION_LIMITS));
    let mut connections = JoinSet::new();
    loop {
        let accepted = tokio::select! {
            accepted = listener.accept() => accepted,
            Some(_) = connections.join_next() => continue,
            () = off.cancelled() => break,
        };
        match accepted {
            Ok((stream, address)) => {
                let Some(slot) = slots.enter(PeerConnection::new(address)) else {
                    tracing::debug!(%address, "too many management connections, one more refused");
                    continue;
                };
                let (acceptor, api, off) = (acceptor.clone(), Arc::clone(&api), off.clone());
                connections.spawn(async move {
                    let peer = &slot.connection;
                    let served = serve_peer(stream, peer, &acceptor, api, &off);
                    peer.evicted.run_until_cancelled(served).await;
                });
            }
            Err(error) => {
                tracing::warn!(%error, "a connection could not be accepted");
                tokio::time::sleep(ACCEPT_PAUSE).await;
            }
        }
    }
    drop(listener);
    while connections.join_next().await.is_some() {}
}

/// Serves one connection from its handshake to its end.
async fn serve_peer(
    stream: TcpStream,
    peer: &Arc<PeerConnection>,
    acceptor: &TlsAcceptor,
    api: Arc<ManagementApi>,
    off: &CancellationToken,
) {
    let accepted = Instant::now();
    let Ok(local) = stream.local_addr() else { return };
    // Small answers should not wait for acknowledgements.
    let _ = stream.set_nodelay(true);
    let handshake = tokio::time::timeout(HANDSHAKE_TIMEOUT, acceptor.accept(stream));
    let stream = match off.run_until_cancelled(handshake).await {
        Some(Ok(Ok(stream))) => stream,
        Some(Ok(Err(error))) => return tracing::debug!(peer = %peer.address(), %error, "TLS failed"),
        Some(Err(_)) | None => return,
    };
    peer.activity.reached(ConnectionStage::Opened);
    let cut = CancellationToken::new();
    let connection = ClientConnection { api, peer: Arc::clone(peer), local: local.ip(), cut: cut.clone() };
    let (stream, rejected) = CheckedHeads::new(stream);
    let service = service_fn(move |mut request: Request<Incoming>| {
        let (connection, rejected) = (connection.clone(), rejected.clone());
        async move {
            let latency = connection.api.latency();
            if !latency.is_zero() {
                tokio::time::sleep(latency).await;
            }
            if let Some(head) = rejected.of(request.uri()) {
                return Ok(api::rejected(head));
            }
            // The heads after a body in chunks are not checked.
            let is_last = request.headers().contains_key(TRANSFER_ENCODING);
            request.extensions_mut().insert(connection);
            let mut response = ROUTER.clone().call(request).await?;
            if is_last {
                response.headers_mut().insert(CONNECTION, HeaderValue::from_static("close"));
            }
            Ok::<_, Infallible>(response)
        }
    });
    let mut http = http1::Builder::new();
    // Before 1970 the library cannot write its Date header.
    http.timer(TokioTimer::new()).header_read_timeout(HEAD_TIMEOUT).auto_date_header(SystemTime::now() >= UNIX_EPOCH);
    let mut serving = std::pin::pin!(http.serve_connection(TokioIo::new(stream), service));
    let without_session = async {
        tokio::time::sleep_until(accepted + SESSION_TIMEOUT).await;
        if peer.activity.has_session() {
            std::future::pending::<()>().await;
        }
    };
    let ended = tokio::select! {
        ended = serving.as_mut() => Some(ended),
        () = cut.cancelled() => return,
        () = off.cancelled() => None,
        () = without_session => None,
        () = tokio::time::sleep_until(accepted + MAX_AGE) => None,
    };
    let ended = match ended {
        Some(ended) => ended,
        None => {
            serving.as_mut().graceful_shutdown();
            tokio::time::timeout(GRACE, serving).await.unwrap_or(Ok(()))
        }
    };
    if let Err(error) = ended {
        tracing::debug!(peer = %peer.address(), %error, "a connection broke off");
    }
}
