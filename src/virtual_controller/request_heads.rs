//! The heads of requests, checked before the HTTP library reads them.
//!
//! The library answers a malformed head itself, without the [`FailureBody`](crate::protocol::FailureBody) that the protocol
//! promises, and of a request with both Content-Length and Transfer-Encoding it drops one without a word. What is
//! refused here reaches the service as a request of its own, so that the answer keeps its place behind those before it.

use std::io;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, ready};

use axum::http::uri::{Authority, Uri};
use axum::http::{Method, StatusCode};
use parking_lot::Mutex;
use thiserror::Error;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use zeroize::Zeroizing;

use crate::model::{Cause, with_cause};

/// The longest head of a request that is taken, in bytes. Those of the configurator have 300.
pub const MAX_HEAD_BYTES: usize = 16 * 1024;
/// The longest target of a request. The longest of the protocol has 60 bytes.
const MAX_TARGET_BYTES: usize = 2048;
const MAX_HEADERS: usize = 64;

/// Why a head is refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum RejectedHead {
    #[error("the head of the request has more than {MAX_HEAD_BYTES} bytes or {MAX_HEADERS} headers")]
    TooLong,
    #[error("the target of the request has more than {MAX_TARGET_BYTES} bytes")]
    TargetTooLong,
    #[error("the protocol is spoken over HTTP/1.1")]
    OtherVersion,
    #[error("{0}")]
    Malformed(#[source] Cause),
}

impl RejectedHead {
    /// The HTTP status of the answer.
    pub const fn status(&self) -> StatusCode {
        match self {
            Self::TooLong => StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE,
            Self::TargetTooLong => StatusCode::URI_TOO_LONG,
            Self::OtherVersion => StatusCode::HTTP_VERSION_NOT_SUPPORTED,
            Self::Malformed(_) => StatusCode::BAD_REQUEST,
        }
    }
}

/// Where the service finds the refusal of its connection.
#[derive(Debug, Clone, Default)]
pub struct RejectedHeads(Arc<Mutex<Option<RejectedHead>>>);

impl RejectedHeads {
    /// What is to be answered to this request instead of doing it, if it stands for one that was refused.
    pub fn of(&self, target: &Uri) -> Option<RejectedHead> {
        if target.path() == REFUSED { self.0.lock().take() } else { None }
    }
}

/// Stands for a request that was refused. No path of the protocol, so a client that sends it gets 404.
const REFUSED: &str = "/refused";
const REFUSED_HEAD: &[u8] = b"GET /refused HTTP/1.1\r\nhost: refused\r\nconnection: close\r\n\r\n";

/// A connection whose requests have checked heads.
#[derive(Debug)]
pub struct CheckedHeads<S> {
    stream: S,
    rejected: RejectedHeads,
    /// What was read and not given yet.
    held: Zeroizing<Vec<u8>>,
    /// So much of `held` may be given.
    cleared: usize,
    /// Where in `held` the end of the head is looked for.
    searched: usize,
    next: Next,
    /// Bytes read after a refused request.
    discarded: usize,
}

/// What follows what is cleared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Next {
    Head,
    /// So many bytes of a body.
    Body(u64),
    /// A body in chunks. The service ends the connection after it, so no head follows.
    Chunks,
    /// The connection ends: its last request was refused.
    End,
}

impl<S> CheckedHeads<S> {
    pub fn new(stream: S) -> (Self, RejectedHeads) {
        let rejected = RejectedHeads::default();
        let held = Zeroizing::new(Vec::new());
        (
            Self { stream, rejected: rejected.clone(), held, cleared: 0, searched: 0, next: Next::Head, discarded: 0 },
            rejected,
        )
    }

    /// Looks for a whole head in what is held. `false`: more must be read.
    fn look_for_head(&mut self) -> bool {
        let Some(length) = end_of_head(&self.held, self.searched) else {
            self.searched = self.held.len().saturating_sub(3);
            if self.held.len() > MAX_HEAD_BYTES {
                self.refuse(RejectedHead::TooLong);
                return true;
            }
            return false;
        };
        self.searched = 0;
        match check(&self.held[..length]) {
            Err(refusal) => self.refuse(refusal),
            Ok(Next::Body(body)) => {
                let here = (self.held.len() - length).min(usize::try_from(body).unwrap_or(usize::MAX));
                self.cleared = length + here;
                let left = body - here as u64;
                self.next = if left == 0 { Next::Head } else { Next::Body(left) };
            }
            Ok(next) => {
                self.cleared = self.held.len();
                self.next = next;
            }
        }
        true
    }

    fn refuse(&mut self, refusal: RejectedHead) {
        *self.rejected.0.lock() = Some(refusal);
        self.held = Zeroizing::new(REFUSED_HEAD.to_vec());
        self.cleared = self.held.len();
        self.next = Next::End;
    }
}

impl<S: AsyncRead + Unpin> AsyncRead for CheckedHeads<S> {
    fn poll_read(self: Pin<&mut Self>, cx: &mut Context<'_>, buf: &mut ReadBuf<'_>) -> Poll<io::Result<()>> {
        let this = self.get_mut();
        loop {
            if this.cleared > 0 {
                let given = this.cleared.min(buf.remaining());
                buf.put_slice(&this.held[..given]);
                this.held.drain(..given);
                this.cleared -= given;
                return Poll::Ready(Ok(()));
            }
            if this.next == Next::Head && !this.held.is_empty() && this.look_for_head() {
                continue;
            }
            let most = match this.next {
                // What follows is thrown away; the end of the stream would end the connection before the answer.
                Next::End if this.discarded > MAX_DISCARDED => return Poll::Pending,
                Next::End => PIECE,
                Next::Chunks => return Pin::new(&mut this.stream).poll_read(cx, buf),
                Next::Body(left) => usize::try_from(left).unwrap_or(usize::MAX).min(buf.remaining()),
                Next::Head => PIECE,
            };
            // May hold a password.
            let mut piece = Zeroizing::new([0; PIECE]);
            let mut piece = ReadBuf::new(&mut piece[..most.min(PIECE)]);
            ready!(Pin::new(&mut this.stream).poll_read(cx, &mut piece))?;
            let read = piece.filled();
            if read.is_empty() {
                return Poll::Ready(Ok(()));
            }
            if this.next == Next::End {
                this.discarded += read.len();
                continue;
            }
            if let Next::Body(left) = this.next {
                buf.put_slice(read);
                let left = left - read.len() as u64;
                this.next = if left == 0 { Next::Head } else { Next::Body(left) };
                return Poll::Ready(Ok(()));
            }
            this.held.extend_from_slice(read);
        }
    }
}

impl<S: AsyncWrite + Unpin> AsyncWrite for CheckedHeads<S> {
    fn poll_write(self: Pin<&mut Self>, cx: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.get_mut().stream).poll_write(cx, bytes)
    }

    fn poll_flush(self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.get_mut().stream).poll_flush(cx)
    }

    fn poll_shutdown(self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.get_mut().stream).poll_shutdown(cx)
    }
}

/// The length of the head with its empty line, if that is there.
fn end_of_head(bytes: &[u8], from: usize) -> Option<usize> {
    let mut ends = (from..bytes.len()).filter(|at| bytes[*at] == b'\n');
    ends.find_map(|at| match &bytes[at + 1..] {
        [b'\n', ..] => Some(at + 2),
        [b'\r', b'\n', ..] => Some(at + 3),
        _ => None,
    })
}

/// RFC 9112 §3, §3.2 and §6.3, more strictly where a lenient reader and a strict one would read different requests.
fn check(head: &[u8]) -> Result<Next, RejectedHead> {
    if head.len() > MAX_HEAD_BYTES {
        return Err(RejectedHead::TooLong);
    }
    let mut headers = [httparse::EMPTY_HEADER; MAX_HEADERS];
    let mut request = httparse::Request::new(&mut headers);
    match request.parse(head) {
        Ok(httparse::Status::Complete(length)) if length == head.len() => {}
        Ok(_) => return Err(bad("the head of the request is not whole")),
        Err(httparse::Error::TooManyHeaders) => {
            return Err(RejectedHead::TooLong);
        }
        Err(httparse::Error::Version) => return Err(RejectedHead::OtherVersion),
        Err(error) => return Err(with_cause(RejectedHead::Malformed)(error)),
    }
    if request.version != Some(1) {
        return Err(RejectedHead::OtherVersion);
    }
    if request.method.is_none_or(|method| method.parse::<Method>().is_err()) {
        return Err(bad("the method cannot be read"));
    }
    let target = request.path.unwrap_or_default();
    if target.len() > MAX_TARGET_BYTES {
        return Err(RejectedHead::TargetTooLong);
    }
    if target.parse::<Uri>().is_err() {
        return Err(bad("the path cannot be read"));
    }
    let values = |name: &str| -> Vec<&[u8]> {
        request
            .headers
            .iter()
            .filter(|header| header.name.eq_ignore_ascii_case(name))
            .map(|header| header.value)
            .collect()
    };
    match values("host")[..] {
        [host] if Authority::try_from(host).is_ok() => {}
        [_] => return Err(bad("the Host header is no host")),
        [] => return Err(bad("the Host header is missing")),
        _ => return Err(bad("there is more than one Host header")),
    }
    match (&values("content-length")[..], &values("transfer-encoding")[..]) {
        ([], []) => Ok(Next::Body(0)),
        ([length], []) => {
            let digits = length.iter().all(u8::is_ascii_digit);
            let length = std::str::from_utf8(length).ok().filter(|_| digits).and_then(|length| length.parse().ok());
            length.map(Next::Body).ok_or_else(|| bad("Content-Length is no number"))
        }
        ([], [coding]) if coding.eq_ignore_ascii_case(b"chunked") => Ok(Next::Chunks),
        ([], _) => Err(bad("Transfer-Encoding is something else than chunked")),
        (_, []) => Err(bad("there is more than one Content-Length")),
        _ => Err(bad("there are Content-Length and Transfer-Encoding")),
    }
}

fn bad(why: &'static str) -> RejectedHead {
    RejectedHead::Malformed(Cause::finding(why))
}

const PIECE: usize = 4096;
/// So that a client that is still sending gets to read the answer.
const MAX_DISCARDED: usize = 64 * 1024;

#[cfg(test)]
mod tests {
    use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};

    use super::*;

    fn status(head: &str) -> Result<Next, u16> {
        check(head.as_bytes()).map_err(|refusal| refusal.status().as_u16())
    }

    #[test]
    fn a_head_is_read_in_one_way_only() {
        for (head, expected) in [
            ("GET /v1/hello HTTP/1.1\r\nHost: robot:7943\r\n\r\n", Ok(Next::Body(0))),
            ("POST /v1/login HTTP/1.1\r\nhost: [::1]\r\ncontent-length: 15\r\n\r\n", Ok(Next::Body(15))),
            ("POST /v1/login HTTP/1.1\r\nhost: a\r\nTransfer-Encoding: Chunked\r\n\r\n", Ok(Next::Chunks)),
            ("GET /v1/hello HTTP/1.1\r\n\r\n", Err(400)),
            ("GET /v1/hello HTTP/1.1\r\nhost: a\r\nhost: a\r\n\r\n", Err(400)),
            ("GET /v1/hello HTTP/1.1\r\nhost: a b\r\n\r\n", Err(400)),
            ("POST / HTTP/1.1\r\nhost: a\r\ncontent-length: 5\r\ntransfer-encoding: chunked\r\n\r\n", Err(400)),
            ("POST / HTTP/1.1\r\nhost: a\r\ntransfer-encoding: chunked\r\ncontent-length: 5\r\n\r\n", Err(400)),
            ("POST / HTTP/1.1\r\nhost: a\r\ncontent-length: 5\r\ncontent-length: 5\r\n\r\n", Err(400)),
            ("POST / HTTP/1.1\r\nhost: a\r\ncontent-length: +5\r\n\r\n", Err(400)),
            ("POST / HTTP/1.1\r\nhost: a\r\ntransfer-encoding: gzip, chunked\r\n\r\n", Err(400)),
            ("GET /\u{7f} HTTP/1.1\r\nhost: a\r\n\r\n", Err(400)),
            ("GET / HTTP/1.1\r\nhost: a\r\nno colon\r\n\r\n", Err(400)),
            ("GET / HTTP/1.0\r\nhost: a\r\n\r\n", Err(505)),
            ("PRI * HTTP/2.0\r\n\r\n", Err(505)),
            ("220 printer ready\r\n\r\n", Err(505)),
            ("\r\n\r\n", Err(400)),
        ] {
            assert_eq!(status(head), expected, "{head:?}");
        }
        let long = format!("GET /{} HTTP/1.1\r\nhost: a\r\n\r\n", "a".repeat(MAX_TARGET_BYTES));
        assert_eq!(status(&long), Err(414));
        let many = format!("GET / HTTP/1.1\r\nhost: a\r\n{}\r\n", "x: y\r\n".repeat(MAX_HEADERS));
        assert_eq!(status(&many), Err(431));
    }

    /// Everything the service reads of a connection on which these bytes arrive in pieces of this size.
    async fn passed(bytes: &str, size: usize) -> (String, Option<RejectedHead>) {
        let (mut client, server) = tokio::io::duplex(64 * 1024);
        let (mut server, rejected) = CheckedHeads::new(server);
        let bytes = bytes.as_bytes().to_vec();
        tokio::spawn(async move {
            for piece in bytes.chunks(size) {
                client.write_all(piece).await.unwrap();
                client.flush().await.unwrap();
                tokio::task::yield_now().await;
            }
        });
        let mut read = String::new();
        server.read_to_string(&mut read).await.unwrap();
        let refusal = rejected.of(&Uri::from_static(REFUSED));
        (read, refusal)
    }

    #[tokio::test]
    async fn good_requests_pass_unchanged_however_they_arrive() {
        let one = "POST /v1/login HTTP/1.1\r\nhost: a\r\ncontent-length: 8\r\n\r\n\n\nbody\n\n";
        let two = "GET /v1/hello HTTP/1.1\r\nhost: a\r\n\r\n";
        let all = [one, two, one].concat();
        for size in [1, 2, 7, 60, 4096] {
            assert_eq!(passed(&all, size).await, (all.clone(), None), "{size}");
        }
    }

    #[tokio::test]
    async fn a_refused_request_takes_its_place_and_ends_the_connection() {
        let good = "POST /v1/login HTTP/1.1\r\nhost: a\r\ncontent-length: 2\r\n\r\n{}";
        let all = [good, "GET / HTTP/1.1\r\n\r\n", good].concat();
        for size in [1, 5, 4096] {
            let (read, refusal) = passed(&all, size).await;
            assert_eq!(read.as_bytes(), [good.as_bytes(), REFUSED_HEAD].concat());
            assert_eq!(refusal.map(|refusal| refusal.to_string()).as_deref(), Some("the Host header is missing"));
        }
        let endless = "a".repeat(MAX_HEAD_BYTES + 1);
        assert_eq!(passed(&endless, 4096).await.1.map(|refusal| refusal.status().as_u16()), Some(431));
    }

    #[test]
    fn nobody_takes_a_refusal_by_another_path() {
        let rejected = RejectedHeads::default();
        assert_eq!(rejected.of(&Uri::from_static(REFUSED)), None);
        *rejected.0.lock() = Some(bad("x"));
        assert_eq!(rejected.of(&Uri::from_static("/v1/hello")), None);
        assert_eq!(rejected.of(&Uri::from_static(REFUSED)), Some(bad("x")));
    }
}
