use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use hyper::body::Incoming;
use hyper::service::service_fn;
use hyper::{Request, server::conn::http1};
use hyper_util::rt::{TokioIo, TokioTimer};
use rustls::ServerConfig;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio::task::JoinSet;
use tokio_rustls::TlsAcceptor;
use tokio_util::sync::CancellationToken;
use tower_service::Service as _;

use super::api::{Api, Connection, ROUTER};

/// More wait in the operating system's queue until one has gone.
const MAX_CONNECTIONS: usize = 64;
const HANDSHAKE_TIMEOUT: Duration = Duration::from_secs(5);
/// For the head of a request, and for a connection without one.
const HEAD_TIMEOUT: Duration = Duration::from_secs(10);
/// No connection is older, whatever it does: one that reads its answers slowly is over some day.
const MAX_AGE: Duration = Duration::from_secs(600);
/// What a request in hand gets when the controller is switched off or the connection has become too old.
const GRACE: Duration = Duration::from_secs(2);
/// After an error of `accept`, which is almost always a want of file handles.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// Accepts connections of the management protocol until `off`, then lets the requests in hand finish.
pub async fn serve(listener: TcpListener, tls: Arc<ServerConfig>, api: Arc<Api>, off: CancellationToken) {
    let acceptor = TlsAcceptor::from(tls);
    let slots = Arc::new(Semaphore::new(MAX_CONNECTIONS));
    let mut connections = JoinSet::new();
    while let Some(Ok(slot)) = off.run_until_cancelled(Arc::clone(&slots).acquire_owned()).await {
        let accepted = loop {
            tokio::select! {
                accepted = listener.accept() => break Some(accepted),
                Some(_) = connections.join_next() => {}
                () = off.cancelled() => break None,
            }
        };
        match accepted {
            None => break,
            Some(Ok((stream, peer))) => {
                let (acceptor, api, off) = (acceptor.clone(), Arc::clone(&api), off.clone());
                connections.spawn(async move {
                    let _slot = slot;
                    converse(stream, peer, acceptor, api, off).await;
                });
            }
            Some(Err(error)) => {
                tracing::warn!(%error, "a connection could not be accepted");
                tokio::time::sleep(ACCEPT_PAUSE).await;
            }
        }
    }
    drop(listener);
    while connections.join_next().await.is_some() {}
}

/// One connection from its handshake to its end.
async fn converse(stream: TcpStream, peer: SocketAddr, acceptor: TlsAcceptor, api: Arc<Api>, off: CancellationToken) {
    let Ok(local) = stream.local_addr() else { return };
    // Small answers should not wait for acknowledgements.
    let _ = stream.set_nodelay(true);
    let handshake = tokio::time::timeout(HANDSHAKE_TIMEOUT, acceptor.accept(stream));
    let stream = match off.run_until_cancelled(handshake).await {
        Some(Ok(Ok(stream))) => stream,
        Some(Ok(Err(error))) => return tracing::debug!(%peer, %error, "TLS failed"),
        Some(Err(_)) | None => return,
    };
    let cut = CancellationToken::new();
    let connection = Connection { api, peer: peer.ip().to_canonical(), local: local.ip(), cut: cut.clone() };
    let service = service_fn(move |mut request: Request<Incoming>| {
        let connection = connection.clone();
        async move {
            let latency = connection.api.latency();
            if !latency.is_zero() {
                tokio::time::sleep(latency).await;
            }
            request.extensions_mut().insert(connection);
            ROUTER.clone().call(request).await
        }
    });
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(HEAD_TIMEOUT);
    let mut serving = std::pin::pin!(http.serve_connection(TokioIo::new(stream), service));
    let ended = tokio::select! {
        ended = serving.as_mut() => Some(ended),
        () = cut.cancelled() => return,
        () = off.cancelled() => None,
        () = tokio::time::sleep(MAX_AGE) => None,
    };
    let ended = match ended {
        Some(ended) => ended,
        None => {
            serving.as_mut().graceful_shutdown();
            tokio::time::timeout(GRACE, serving).await.unwrap_or(Ok(()))
        }
    };
    if let Err(error) = ended {
        tracing::debug!(%peer, %error, "a connection broke off");
    }
}
