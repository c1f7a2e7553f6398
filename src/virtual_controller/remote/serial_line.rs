//! Frames on a pseudo-terminal or a serial device (Unix).

use std::io::{self, Read as _, Write as _};
use std::path::PathBuf;
use std::pin::Pin;
use std::task::{Context, Poll, ready};
use std::time::Duration;

use tokio::io::unix::AsyncFd;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::time::Instant;
use tokio_util::sync::CancellationToken;

use super::backup_file::BackupFile;
use super::connection::serve;
use super::conversation::Conversation;
use super::options::SerialChoice;
use super::request_handler::RequestHandler;
use super::wire::Wire;
use crate::platform::terminal_line::{TerminalLine, pseudo_terminal, serial_device};

/// A line as a stream.
#[derive(Debug)]
pub(super) struct SerialLine {
    line: AsyncFd<TerminalFile>,
    path: PathBuf,
}

/// Its file, for the reactor; the rest of the line lives as long.
#[derive(Debug)]
struct TerminalFile(TerminalLine);

impl std::os::fd::AsRawFd for TerminalFile {
    fn as_raw_fd(&self) -> std::os::fd::RawFd {
        std::os::fd::AsRawFd::as_raw_fd(&self.0.file)
    }
}

/// After a line broke, as when the adapter is unplugged.
const PAUSE: Duration = Duration::from_secs(1);

impl SerialLine {
    /// Opens the line. Has to be called in a runtime.
    pub fn open(choice: &SerialChoice) -> io::Result<Self> {
        let line = match choice {
            SerialChoice::PseudoTerminal => pseudo_terminal()?,
            SerialChoice::Device { path, baud } => serial_device(path, *baud)?,
        };
        let path = line.path.clone();
        // SAFETY: the file is open, is owned by what is registered, and is neither closed nor replaced before that is dropped.
        let line = unsafe { AsyncFd::register(TerminalFile(line)) }?;
        Ok(Self { line, path })
    }

    /// What a client opens.
    pub fn path(&self) -> &std::path::Path {
        &self.path
    }

    /// Answers one session after the other until `off`.
    pub async fn listen(mut self, handler: RequestHandler, kept: BackupFile, off: CancellationToken) {
        while !off.is_cancelled() {
            let mut conversation = Conversation::new(handler.clone(), Wire::frames(), false, Instant::now());
            serve(&mut self, &mut conversation, &kept, &off).await;
            if !conversation.is_over() {
                // The line broke.
                off.run_until_cancelled(tokio::time::sleep(PAUSE)).await;
            }
        }
    }
}

impl AsyncRead for SerialLine {
    fn poll_read(self: Pin<&mut Self>, context: &mut Context<'_>, buffer: &mut ReadBuf<'_>) -> Poll<io::Result<()>> {
        loop {
            let mut ready = ready!(self.line.poll_read_ready(context))?;
            let unfilled = buffer.initialize_unfilled();
            match ready.try_io(|line| (&line.get_ref().0.file).read(unfilled)) {
                Ok(Ok(length)) => {
                    buffer.advance(length);
                    return Poll::Ready(Ok(()));
                }
                Ok(Err(error)) => return Poll::Ready(Err(error)),
                Err(_would_block) => {}
            }
        }
    }
}

impl AsyncWrite for SerialLine {
    fn poll_write(self: Pin<&mut Self>, context: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        loop {
            let mut ready = ready!(self.line.poll_write_ready(context))?;
            match ready.try_io(|line| (&line.get_ref().0.file).write(bytes)) {
                Ok(written) => return Poll::Ready(written),
                Err(_would_block) => {}
            }
        }
    }

    fn poll_flush(self: Pin<&mut Self>, _context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }

    fn poll_shutdown(self: Pin<&mut Self>, _context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }
}
