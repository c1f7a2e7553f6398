use std::time::Duration;

use tokio::io::{AsyncRead, AsyncReadExt as _, AsyncWrite, AsyncWriteExt as _};
use tokio::time::{Instant, sleep_until, timeout};
use tokio_util::sync::CancellationToken;
use zeroize::Zeroize as _;

use super::backup_file::BackupFile;
use super::conversation::{Conversation, Outgoing};

/// Carries one conversation over a stream, until the client is gone, the conversation is over, or `off`.
pub(super) async fn serve<S: AsyncRead + AsyncWrite + Unpin>(
    stream: &mut S,
    conversation: &mut Conversation,
    kept: &BackupFile,
    off: &CancellationToken,
) {
    let mut buffer = [0; 4096];
    while !conversation.is_over() {
        let outgoing = tokio::select! {
            () = off.cancelled() => break,
            read = stream.read(&mut buffer) => match read {
                Ok(0) | Err(_) => break,
                Ok(length) => {
                    let outgoing = conversation.receive(&buffer[..length], Instant::now());
                    // It may hold a password.
                    buffer[..length].zeroize();
                    outgoing
                }
            },
            () = wait_until(conversation.wakes_at()) => conversation.wake(Instant::now()),
        };
        if send(stream, conversation, kept, outgoing).await.is_err() {
            break;
        }
    }
    conversation.hang_up();
}

async fn send<S: AsyncWrite + Unpin>(
    stream: &mut S,
    conversation: &Conversation,
    kept: &BackupFile,
    outgoing: Vec<Outgoing>,
) -> std::io::Result<()> {
    for mut answer in outgoing {
        if answer.has_to_be_kept() && !kept.keep().await {
            answer.could_not_be_kept();
        }
        let bytes = conversation.encode(&answer);
        // Some clients take what one read brings as the answer, so it leaves in one write.
        timeout(WRITE_TIMEOUT, stream.write_all(&bytes)).await??;
        timeout(WRITE_TIMEOUT, stream.flush()).await??;
    }
    Ok(())
}

async fn wait_until(moment: Option<Instant>) {
    match moment {
        Some(moment) => sleep_until(moment).await,
        None => std::future::pending().await,
    }
}

/// A client that does not read its answers is disconnected.
const WRITE_TIMEOUT: Duration = Duration::from_secs(10);
