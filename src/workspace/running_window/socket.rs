use std::fs;
use std::io;
use std::os::unix::fs::{FileTypeExt as _, PermissionsExt as _};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::exchange::{ShowWindowOutcome, answer};
use crate::workspace::WorkspaceLock;

/// Waits for other starts on the workspace; its socket is removed when this is dropped.
#[derive(Debug)]
pub struct StartRequests {
    path: PathBuf,
    listener: UnixListener,
}

impl StartRequests {
    /// The lock proves that a socket which is there belongs to no running window. A path of more than about 100 bytes
    /// is [`io::ErrorKind::InvalidInput`].
    pub fn listen(root: &Path, _lock: &WorkspaceLock) -> io::Result<Self> {
        let path = root.join(SOCKET);
        if fs::symlink_metadata(&path).is_ok_and(|there| there.file_type().is_socket()) {
            fs::remove_file(&path)?;
        }
        let listener = UnixListener::bind(&path)?;
        listener.set_nonblocking(true)?;
        fs::set_permissions(&path, fs::Permissions::from_mode(0o600))?;
        Ok(Self { path, listener })
    }

    /// Answers requests until it is dropped, and tells `on_request` of each. Needs a runtime when it is first polled.
    pub fn serve(
        &self,
        shown: ShowWindowOutcome,
        on_request: impl Fn() + Send + Sync + 'static,
    ) -> impl Future<Output = ()> + Send + 'static {
        let listener = self.listener.try_clone();
        let on_request = Arc::new(on_request);
        async move {
            let listener = match listener.and_then(tokio::net::UnixListener::from_std) {
                Ok(listener) => listener,
                Err(error) => return tracing::warn!(%error, "a second start cannot show this window"),
            };
            loop {
                let Ok((stream, _)) = listener.accept().await else {
                    tokio::time::sleep(PAUSE).await;
                    continue;
                };
                tokio::spawn(answer(stream, shown, on_request.clone()));
            }
        }
    }
}

impl Drop for StartRequests {
    fn drop(&mut self) {
        if let Err(error) = fs::remove_file(&self.path) {
            tracing::debug!(%error, "the socket stays in the workspace");
        }
    }
}

pub(super) fn connect(root: &Path) -> io::Result<UnixStream> {
    UnixStream::connect(root.join(SOCKET))
}

const SOCKET: &str = ".window";
/// After a failed accept: the process has no file descriptor left.
const PAUSE: Duration = Duration::from_secs(1);
