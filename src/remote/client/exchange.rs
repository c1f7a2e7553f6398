use std::future::poll_fn;
use std::io;
use std::pin::Pin;
use std::task::Poll;
use std::time::Duration;

use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, ReadBuf};
use tokio::time::{Instant, timeout, timeout_at};
use zeroize::Zeroizing;

use super::link::Link;
use super::observer::{Direction, Observed, Observer};
use super::target::RemoteTarget;
use crate::remote::codec::text::Terminator;
use crate::remote::codec::{Answer, DecodeError, EncodeError, Password, Request, frame, text};

/// The form of the messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    Frames,
    Text(Terminator),
}

impl Form {
    pub const fn of(target: &RemoteTarget) -> Self {
        match target {
            RemoteTarget::Ethernet { terminator, .. } => Self::Text(*terminator),
            RemoteTarget::RawTcp(_) | RemoteTarget::Serial(_) => Self::Frames,
        }
    }

    fn encode(self, request: &Request) -> Result<Zeroizing<Vec<u8>>, EncodeError> {
        match self {
            Self::Frames => frame::encode_request(request),
            Self::Text(terminator) => text::encode_request(request, terminator),
        }
    }
}

/// Why there is no answer.
#[derive(Debug)]
pub(super) enum ExchangeError {
    /// Nothing was sent.
    NotSent(EncodeError),
    /// The connection was closed before anything was sent.
    Stale,
    /// The connection failed or ended.
    Lost(io::Error),
    /// No complete answer within the limit.
    Silent,
    /// What came is no answer.
    Bad(DecodeError),
}

enum Decoder {
    Frames(frame::AnswerDecoder),
    Text(text::AnswerDecoder),
}

impl Decoder {
    fn add(&mut self, bytes: &[u8]) {
        match self {
            Self::Frames(decoder) => decoder.add(bytes),
            Self::Text(decoder) => decoder.add(bytes),
        }
    }

    fn next(&mut self, silent: bool) -> Option<Result<Answer, DecodeError>> {
        match self {
            Self::Frames(decoder) => decoder.next(silent),
            Self::Text(decoder) => decoder.next_line(),
        }
    }

    /// Whether silence decides what the bytes are that came.
    fn waits_for_silence(&self) -> bool {
        match self {
            Self::Frames(decoder) => decoder.is_waiting(),
            Self::Text(_) => false,
        }
    }
}

/// Opens the remote function of a serial line.
pub(super) async fn send_open(link: &mut dyn Link, limit: Duration) -> Result<(), ExchangeError> {
    write(link, &[frame::OPEN], limit).await
}

/// Sends a request and reads its answer. Takes at most `limit` for each of both.
pub(super) async fn exchange(
    link: &mut dyn Link,
    form: Form,
    request: &Request,
    limit: Duration,
    observer: Option<&Observer>,
) -> Result<Answer, ExchangeError> {
    let bytes = form.encode(request).map_err(ExchangeError::NotSent)?;
    drop_stale_input(link).await?;
    if let Some(observer) = observer {
        let shown = shown(form, request, &bytes);
        observer(&Observed { direction: Direction::Sent, bytes: shown });
    }
    write(link, &bytes, limit).await?;
    let mut decoder = match form {
        Form::Frames => Decoder::Frames(frame::AnswerDecoder::new(request)),
        Form::Text(_) => Decoder::Text(text::AnswerDecoder::new(request)),
    };
    let mut came = Vec::new();
    let answer = read_answer(link, &mut decoder, limit, &mut came).await;
    if let (Some(observer), false) = (observer, came.is_empty()) {
        observer(&Observed { direction: Direction::Received, bytes: came });
    }
    answer
}

async fn read_answer(
    link: &mut dyn Link,
    decoder: &mut Decoder,
    limit: Duration,
    came: &mut Vec<u8>,
) -> Result<Answer, ExchangeError> {
    let deadline = Instant::now() + limit;
    let mut buffer = [0; 4096];
    loop {
        let now = Instant::now();
        let silence = if decoder.waits_for_silence() { deadline.min(now + frame::LINE_SILENCE) } else { deadline };
        match timeout_at(silence, link.read(&mut buffer)).await {
            Ok(Ok(0)) => return Err(ExchangeError::Lost(io::ErrorKind::UnexpectedEof.into())),
            Ok(Ok(count)) => {
                came.extend_from_slice(&buffer[..count]);
                decoder.add(&buffer[..count]);
                if let Some(answer) = decoder.next(false) {
                    return answer.map_err(ExchangeError::Bad);
                }
            }
            Ok(Err(error)) => return Err(ExchangeError::Lost(error)),
            Err(_) if silence < deadline => {
                if let Some(answer) = decoder.next(true) {
                    return answer.map_err(ExchangeError::Bad);
                }
            }
            Err(_) => return Err(ExchangeError::Silent),
        }
    }
}

async fn write(link: &mut dyn Link, bytes: &[u8], limit: Duration) -> Result<(), ExchangeError> {
    let written = timeout(limit, async {
        link.write_all(bytes).await?;
        link.flush().await
    });
    match written.await {
        Ok(Ok(())) => Ok(()),
        Ok(Err(error)) => Err(ExchangeError::Lost(error)),
        Err(_) => Err(ExchangeError::Silent),
    }
}

/// Drops what came without a request: noise of the line. A controller that has closed the connection meanwhile, as it does
/// with one that is idle, is noticed before anything is sent.
async fn drop_stale_input(link: &mut dyn Link) -> Result<(), ExchangeError> {
    // Lets the runtime take in what the system has told of the connection.
    tokio::task::yield_now().await;
    let mut buffer = [0; 1024];
    for _ in 0..MAX_STALE_READS {
        let mut buffer = ReadBuf::new(&mut buffer);
        match poll_fn(|cx| Poll::Ready(Pin::new(&mut *link).poll_read(cx, &mut buffer))).await {
            Poll::Pending => return Ok(()),
            Poll::Ready(Ok(())) if !buffer.filled().is_empty() => {}
            Poll::Ready(_) => return Err(ExchangeError::Stale),
        }
    }
    Ok(())
}

/// A peer that sends without end does not hold up the request.
const MAX_STALE_READS: usize = 64;

/// Waits until the line is silent, so that the rest of a damaged answer is not taken for the next one.
pub(super) async fn wait_for_silence(link: &mut dyn Link, limit: Duration) {
    let deadline = Instant::now() + limit;
    let mut buffer = [0; 1024];
    while Instant::now() < deadline {
        match timeout(frame::LINE_SILENCE, link.read(&mut buffer)).await {
            Ok(Ok(count)) if count > 0 => {}
            _ => return,
        }
    }
}

/// What is shown of a request: of a login, one with asterisks for the password.
fn shown(form: Form, request: &Request, bytes: &[u8]) -> Vec<u8> {
    let Request::Login { .. } = request else { return bytes.to_vec() };
    let password = Password::new("***").unwrap_or_default();
    form.encode(&Request::Login { password }).map(|bytes| bytes.to_vec()).unwrap_or_default()
}
