use std::net::IpAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinSet;
use tokio::time::Instant;
use tokio_util::sync::CancellationToken;

use super::backup_file::BackupFile;
use super::connection::serve;
use super::conversation::Conversation;
use super::request_handler::RequestHandler;
use super::wire::Wire;

/// After an error of `accept`, which is most likely that the process is out of file descriptors.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// Which form the clients of a port speak.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    Text,
    Frames,
}

impl Form {
    pub fn wire(self, handler: &RequestHandler) -> Wire {
        match self {
            Self::Text => Wire::text(handler.options()),
            Self::Frames => Wire::frames(),
        }
    }
}

/// Serves one client after the other until `off`. A client that comes while another one is connected is disconnected.
pub(super) async fn listen(
    listener: TcpListener,
    form: Form,
    handler: RequestHandler,
    kept: BackupFile,
    off: CancellationToken,
) {
    let is_busy = Arc::new(AtomicBool::new(false));
    let mut clients = JoinSet::new();
    loop {
        let accepted = tokio::select! {
            accepted = listener.accept() => accepted,
            Some(_) = clients.join_next() => continue,
            () = off.cancelled() => break,
        };
        match accepted {
            Ok((stream, address)) => {
                let Some(turn) = Turn::take(&is_busy) else {
                    tracing::debug!(%address, "a second client of the remote commands is disconnected");
                    continue;
                };
                let (handler, kept, off) = (handler.clone(), kept.clone(), off.clone());
                clients.spawn(async move {
                    serve_client(stream, form, handler, &kept, &off).await;
                    drop(turn);
                });
            }
            Err(error) => {
                tracing::warn!(%error, "a client of the remote commands could not be accepted");
                tokio::time::sleep(ACCEPT_PAUSE).await;
            }
        }
    }
    while clients.join_next().await.is_some() {}
}

async fn serve_client(
    mut stream: TcpStream,
    form: Form,
    handler: RequestHandler,
    kept: &BackupFile,
    off: &CancellationToken,
) {
    // Answers are small and should not wait for acknowledgements.
    let _ = stream.set_nodelay(true);
    let is_global = stream.local_addr().is_ok_and(|address| is_global(address.ip()));
    let wire = form.wire(&handler);
    let mut conversation = Conversation::new(handler, wire, is_global, Instant::now());
    serve(&mut stream, &mut conversation, kept, off).await;
}

/// The right to be the only client, until dropped.
struct Turn(Arc<AtomicBool>);

impl Turn {
    fn take(is_busy: &Arc<AtomicBool>) -> Option<Self> {
        let was_busy = is_busy.swap(true, Ordering::AcqRel);
        (!was_busy).then(|| Self(Arc::clone(is_busy)))
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        self.0.store(false, Ordering::Release);
    }
}

/// Whether an address is one of the internet: not of this machine, a private network (RFC 1918, RFC 4193), a carrier's
/// network (RFC 6598) or a link (RFC 3927, RFC 4291).
fn is_global(address: IpAddr) -> bool {
    match address {
        IpAddr::V4(v4) => {
            let [first, second, ..] = v4.octets();
            let is_shared = first == 100 && (64..128).contains(&second);
            !(v4.is_private() || v4.is_loopback() || v4.is_link_local() || v4.is_unspecified() || is_shared)
        }
        IpAddr::V6(v6) => match v6.to_ipv4_mapped() {
            Some(v4) => is_global(v4.into()),
            None => !(v6.is_loopback() || v6.is_unspecified() || v6.is_unique_local() || v6.is_unicast_link_local()),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_of_the_internet_are_told_from_those_of_a_plant() {
        for local in [
            "127.0.0.1",
            "192.168.0.1",
            "10.1.2.3",
            "172.16.5.4",
            "169.254.1.1",
            "100.64.0.1",
            "::1",
            "fe80::1",
            "fd00::1",
        ] {
            assert!(!is_global(local.parse().unwrap()), "{local}");
        }
        for global in ["8.8.8.8", "172.32.0.1", "100.128.0.1", "2001:db8::1", "::ffff:8.8.8.8"] {
            assert!(is_global(global.parse().unwrap()), "{global}");
        }
        assert!(!is_global("::ffff:192.168.0.1".parse().unwrap()));
    }
}
