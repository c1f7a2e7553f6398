//! One exchange with the window that has the workspace open.

use std::io::{self, Read, Write};
use std::sync::Arc;
use std::time::Duration;

use tokio::io::{AsyncRead, AsyncReadExt as _, AsyncWrite, AsyncWriteExt as _};
use tokio::time::timeout;

/// What becomes of a request to show the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShowWindowOutcome {
    /// The window comes to the front.
    InFront,
    /// The window asks for attention; the desktop does not let programs bring windows to the front (Wayland).
    Marked,
}

impl ShowWindowOutcome {
    pub(super) fn as_line(self) -> &'static [u8] {
        match self {
            Self::InFront => b"in front\n",
            Self::Marked => b"marked\n",
        }
    }
}

pub(super) fn ask(mut stream: impl Read + Write) -> io::Result<ShowWindowOutcome> {
    stream.write_all(REQUEST)?;
    let mut answer = Vec::new();
    while !answer.ends_with(b"\n") && answer.len() < MAX_LINE {
        let mut byte = [0];
        stream.read_exact(&mut byte)?;
        answer.extend(byte);
    }
    let known =
        [ShowWindowOutcome::InFront, ShowWindowOutcome::Marked].into_iter().find(|shown| shown.as_line() == answer);
    known.ok_or_else(|| io::ErrorKind::InvalidData.into())
}

/// Answers one request, and tells `on_request` before.
pub(super) async fn answer(
    mut stream: impl AsyncRead + AsyncWrite + Unpin,
    shown: ShowWindowOutcome,
    on_request: Arc<impl Fn()>,
) {
    let exchange = async {
        let mut request = [0; REQUEST.len()];
        stream.read_exact(&mut request).await?;
        if request != *REQUEST {
            return Err(io::Error::from(io::ErrorKind::InvalidData));
        }
        on_request();
        stream.write_all(shown.as_line()).await?;
        stream.flush().await?;
        // The other side closes first: a pipe forgets what was not read.
        stream.read(&mut [0]).await
    };
    let _ = timeout(EXCHANGE, exchange).await;
}

pub(super) const REQUEST: &[u8; 23] = b"show the window please\n";
const MAX_LINE: usize = 32;
const EXCHANGE: Duration = Duration::from_secs(2);
