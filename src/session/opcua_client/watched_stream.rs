use std::io;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, ready};

use parking_lot::Mutex;
use tokio::io::{AsyncRead, ReadBuf};

/// What was heard from a server besides what the library was told.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct StreamObservations {
    /// Why no more is read: what comes is not OPC UA, or more of it than any honest answer.
    pub fault: Option<String>,
    /// The status and the words of an error message, the last thing a server sends (OPC 10000-6 §7.1.2.5). The library
    /// passes on the status at best.
    pub last_word: Option<(u32, String)>,
    /// Bytes that came.
    pub bytes: usize,
}

/// The server's end of a connection, frame by frame.
///
/// The library waits for a frame however long it is said to be; here a frame is at most what the Hello allowed, and all
/// of them together at most `total_bytes`.
pub(super) struct WatchedStream<R> {
    inner: R,
    total_bytes: Option<usize>,
    frame: FramePosition,
    heard: Arc<Mutex<StreamObservations>>,
}

impl<R> WatchedStream<R> {
    pub fn new(inner: R, total_bytes: Option<usize>) -> (Self, Arc<Mutex<StreamObservations>>) {
        let heard = Arc::new(Mutex::new(StreamObservations::default()));
        (Self { inner, total_bytes, frame: FramePosition::default(), heard: heard.clone() }, heard)
    }
}

impl<R: AsyncRead + Unpin> AsyncRead for WatchedStream<R> {
    fn poll_read(self: Pin<&mut Self>, cx: &mut Context<'_>, buf: &mut ReadBuf<'_>) -> Poll<io::Result<()>> {
        let this = self.get_mut();
        let before = buf.filled().len();
        ready!(Pin::new(&mut this.inner).poll_read(cx, buf))?;
        let new = &buf.filled()[before..];
        let mut heard = this.heard.lock();
        heard.bytes += new.len();
        let looked = match this.total_bytes {
            Some(total) if heard.bytes > total => Err(format!("it sends more than {total} bytes")),
            _ => this.frame.look(new, &mut heard.last_word),
        };
        Poll::Ready(match looked {
            Ok(()) => Ok(()),
            Err(fault) => {
                heard.fault = Some(fault.clone());
                // What is read with an error counts as not read.
                buf.set_filled(before);
                Err(io::Error::new(io::ErrorKind::InvalidData, fault))
            }
        })
    }
}

/// Where in a frame the stream is.
#[derive(Debug, Default)]
struct FramePosition {
    header: Vec<u8>,
    /// Bytes still to come, once the header is whole.
    rest: usize,
    /// The body, of an error message only.
    body: Option<Vec<u8>>,
}

impl FramePosition {
    fn look(&mut self, mut new: &[u8], last_word: &mut Option<(u32, String)>) -> Result<(), String> {
        while !new.is_empty() {
            if self.header.len() < HEADER {
                let (taken, after) = new.split_at(new.len().min(HEADER - self.header.len()));
                self.header.extend_from_slice(taken);
                new = after;
                if self.header.len() == HEADER {
                    self.begin()?;
                }
            } else {
                let (taken, after) = new.split_at(new.len().min(self.rest));
                if let Some(body) = &mut self.body {
                    body.extend_from_slice(taken);
                }
                self.rest -= taken.len();
                new = after;
            }
            if self.header.len() == HEADER && self.rest == 0 {
                if let Some(body) = self.body.take() {
                    *last_word = error_message(&body);
                }
                self.header.clear();
            }
        }
        Ok(())
    }

    fn begin(&mut self) -> Result<(), String> {
        let kind = &self.header[..3];
        if ![&b"ACK"[..], b"ERR", b"OPN", b"MSG", b"CLO"].contains(&kind) {
            return Err("what it sends is not OPC UA".to_owned());
        }
        let size = self.header[4..].iter().rev().fold(0, |size, byte| size << 8 | usize::from(*byte));
        if !(HEADER..=MAX_FRAME).contains(&size) {
            return Err(format!("it announces a message of {size} bytes"));
        }
        self.rest = size - HEADER;
        self.body = (kind == b"ERR").then(Vec::new);
        Ok(())
    }
}

/// Status and reason of an error message.
fn error_message(body: &[u8]) -> Option<(u32, String)> {
    let (status, rest) = body.split_first_chunk::<4>()?;
    let (length, text) = rest.split_first_chunk::<4>()?;
    // -1 stands for no text at all.
    let length = usize::try_from(i32::from_le_bytes(*length)).unwrap_or_default().min(text.len());
    Some((u32::from_le_bytes(*status), String::from_utf8_lossy(&text[..length]).into_owned()))
}

const HEADER: usize = 8;
/// The largest frame that is taken, and announced in the Hello.
pub(super) const MAX_FRAME: usize = 65_535;
/// All a server may send on the connection of one try, and in one message. Eleven endpoints with certificates of 4096 bits are 40 kB.
pub(super) const MAX_BYTES: usize = 2 << 20;

#[cfg(test)]
mod tests {
    use super::*;
    use tokio::io::AsyncReadExt as _;

    fn frame(kind: &[u8], body: &[u8]) -> Vec<u8> {
        [kind, &(body.len() as u32 + 8).to_le_bytes(), body].concat()
    }

    fn error(status: u32, reason: &str) -> Vec<u8> {
        let body = [&status.to_le_bytes()[..], &(reason.len() as u32).to_le_bytes(), reason.as_bytes()].concat();
        frame(b"ERRF", &body)
    }

    async fn hear(bytes: &[u8], piece: usize) -> (io::Result<usize>, StreamObservations) {
        let (mut far, near) = tokio::io::duplex(piece);
        let bytes = bytes.to_vec();
        tokio::spawn(async move {
            use tokio::io::AsyncWriteExt as _;
            let _ = far.write_all(&bytes).await;
        });
        let (mut watched, heard) = WatchedStream::new(near, Some(MAX_BYTES));
        let mut all = Vec::new();
        let result = watched.read_to_end(&mut all).await;
        let heard = heard.lock().clone();
        (result, heard)
    }

    #[tokio::test]
    async fn an_honest_server_is_heard_to_the_end_however_its_bytes_arrive() {
        let bytes = [frame(b"ACKF", &[0; 20]), frame(b"MSGF", b""), error(0x8013_0000, "not trusted")].concat();
        for piece in [1, 7, 8, 9, 4096] {
            let (result, heard) = hear(&bytes, piece).await;
            assert_eq!(result.unwrap(), bytes.len());
            assert_eq!((heard.fault, heard.last_word), (None, Some((0x8013_0000, "not trusted".into()))));
        }
        let silent = frame(b"ERRF", &[0, 0, 0x13, 0x80, 0xff, 0xff, 0xff, 0xff]);
        assert_eq!(hear(&silent, 64).await.1.last_word, Some((0x8013_0000, String::new())));
        assert_eq!(hear(&frame(b"ERRF", &[1, 2]), 64).await.1.last_word, None, "cut short");
    }

    #[tokio::test]
    async fn a_lying_server_is_not_listened_to() {
        let endless = frame(b"MSGC", &[0; 60_000]).repeat(MAX_BYTES / 60_000 + 2);
        for (bytes, fault) in [
            (b"HTTP/1.1 400 Bad Request\r\n".to_vec(), "not OPC UA"),
            ([&b"ACKF"[..], &0xffff_fff0_u32.to_le_bytes()].concat(), "4294967280 bytes"),
            ([&b"ACKF"[..], &7_u32.to_le_bytes()].concat(), "7 bytes"),
            (endless, "more than"),
        ] {
            let (result, heard) = hear(&bytes, 65_536).await;
            assert!(result.is_err());
            assert!(heard.fault.as_ref().is_some_and(|said| said.contains(fault)), "{heard:?}");
        }
    }
}
