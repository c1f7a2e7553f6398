use std::future::poll_fn;
use std::io;
use std::pin::Pin;
use std::task::Poll;
use std::time::Duration;

use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, ReadBuf};
use tokio::sync::mpsc::UnboundedReceiver;
use tokio::time::{Instant, timeout, timeout_at};
use zeroize::Zeroizing;

use super::link::Link;
use super::observer::{Direction, Observed, Observer};
use super::target::RemoteTarget;
use crate::remote::codec::text::Terminator;
use crate::remote::codec::{Answer, Command, DecodeError, EncodeError, Password, Request, frame, text};

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

/// Commands that are sent while an Execute is being answered, one after the other, and what is told of their answers.
#[expect(missing_debug_implementations, reason = "a function has nothing to show")]
pub struct Interjections<'a> {
    /// Commands that the controller accepts during Execute: [`Command::is_accepted_during_execute`].
    pub requests: &'a mut UnboundedReceiver<Request>,
    /// Is told of each answer. Must not block.
    pub answered: &'a mut (dyn FnMut(Request, Answer) + Send),
}

enum Decoder {
    Frames(frame::AnswerDecoder),
    Text(text::AnswerDecoder),
}

impl Decoder {
    fn new(form: Form, request: &Request) -> Self {
        match form {
            Form::Frames => Self::Frames(frame::AnswerDecoder::new(request)),
            Form::Text(_) => Self::Text(text::AnswerDecoder::new(request)),
        }
    }

    fn add(&mut self, bytes: &[u8]) {
        match self {
            Self::Frames(decoder) => decoder.add(bytes),
            Self::Text(decoder) => decoder.add(bytes),
        }
    }

    fn next(&mut self, silent: bool) -> Option<Result<(Command, Answer), DecodeError>> {
        match self {
            Self::Frames(decoder) => decoder.next_of_two(silent),
            Self::Text(decoder) => decoder.next_of_two(),
        }
    }

    fn interject(&mut self, request: &Request) {
        match self {
            Self::Frames(decoder) => decoder.interject(request),
            Self::Text(decoder) => decoder.interject(request),
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
    drop_stale_input(link).await?;
    send(link, form, request, limit, observer).await?;
    let mut decoder = Decoder::new(form, request);
    let mut came = Vec::new();
    let answer = read_answer(link, &mut decoder, limit, &mut came).await;
    if let (Some(observer), false) = (observer, came.is_empty()) {
        observer(&Observed { direction: Direction::Received, bytes: came });
    }
    answer
}

/// Sends Execute and reads its answer within `limit`; meanwhile sends what is interjected, and waits `short` for the answer
/// to what was sent last when that of Execute has come.
pub(super) async fn execute(
    link: &mut dyn Link,
    form: Form,
    request: &Request,
    (limit, short): (Duration, Duration),
    observer: Option<&Observer>,
    interjections: Interjections<'_>,
) -> Result<Answer, ExchangeError> {
    let Interjections { requests, answered } = interjections;
    drop_stale_input(link).await?;
    send(link, form, request, limit, observer).await?;
    let mut decoder = Decoder::new(form, request);
    let mut deadline = Instant::now() + limit;
    let mut outstanding: Option<Request> = None;
    let mut answer = None;
    let mut buffer = [0; 4096];
    loop {
        let silence = match decoder.waits_for_silence() {
            true => deadline.min(Instant::now() + frame::LINE_SILENCE),
            false => deadline,
        };
        let next = tokio::select! {
            read = timeout_at(silence, link.read(&mut buffer)) => Err(read),
            Some(next) = requests.recv(), if outstanding.is_none() && answer.is_none() => Ok(next),
        };
        let is_silent = match next {
            Ok(next) => {
                send(link, form, &next, short, observer).await?;
                decoder.interject(&next);
                outstanding = Some(next);
                continue;
            }
            Err(Ok(Ok(0))) => return Err(ExchangeError::Lost(io::ErrorKind::UnexpectedEof.into())),
            Err(Ok(Ok(count))) => {
                let bytes = &buffer[..count];
                decoder.add(bytes);
                if let Some(observer) = observer {
                    observer(&Observed { direction: Direction::Received, bytes: bytes.to_vec() });
                }
                false
            }
            Err(Ok(Err(error))) => return Err(ExchangeError::Lost(error)),
            Err(Err(_)) if silence < deadline => true,
            Err(Err(_)) => return Err(ExchangeError::Silent),
        };
        while let Some(come) = decoder.next(is_silent) {
            let (command, come) = come.map_err(ExchangeError::Bad)?;
            match outstanding.take_if(|sent| sent.command() == command) {
                Some(sent) => answered(sent, come),
                None => {
                    answer = Some(come);
                    deadline = deadline.min(Instant::now() + short);
                }
            }
        }
        if let (Some(answer), None) = (&answer, &outstanding) {
            return Ok(answer.clone());
        }
    }
}

async fn send(
    link: &mut dyn Link,
    form: Form,
    request: &Request,
    limit: Duration,
    observer: Option<&Observer>,
) -> Result<(), ExchangeError> {
    let bytes = form.encode(request).map_err(ExchangeError::NotSent)?;
    if let Some(observer) = observer {
        let shown = shown(form, request, &bytes);
        observer(&Observed { direction: Direction::Sent, bytes: shown });
    }
    write(link, &bytes, limit).await
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
                    return answer.map(|(_, answer)| answer).map_err(ExchangeError::Bad);
                }
            }
            Ok(Err(error)) => return Err(ExchangeError::Lost(error)),
            Err(_) if silence < deadline => {
                if let Some(answer) = decoder.next(true) {
                    return answer.map(|(_, answer)| answer).map_err(ExchangeError::Bad);
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
