use std::time::Duration;

use zeroize::Zeroizing;

use super::options::RemoteOptions;
use crate::remote::frame::{self, RequestEvent};
use crate::remote::text::{self, Spelling, Terminator};
use crate::remote::{Answer, Command, RefusalCode, Request};

/// The form in which a client speaks, and what it has sent of its next request.
#[derive(Debug)]
pub(super) enum Wire {
    Text { decoder: text::RequestDecoder, terminator: Terminator },
    Frames { decoder: frame::RequestDecoder },
}

/// What came.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Incoming {
    /// The client opens the remote function.
    Open,
    /// A request, or why it is none.
    Request { origin: Origin, request: Result<Request, RefusalCode> },
}

/// How a client has named its command, which the answer repeats.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Origin {
    /// As it was spelled.
    Text(Spelling),
    /// The letter; `None` for a message without one.
    Letter(Option<u8>),
}

impl Wire {
    pub fn text(options: &RemoteOptions) -> Self {
        Self::Text { decoder: text::RequestDecoder::default(), terminator: options.terminator }
    }

    pub fn frames() -> Self {
        Self::Frames { decoder: frame::RequestDecoder::default() }
    }

    pub fn add(&mut self, bytes: &[u8]) {
        match self {
            Self::Text { decoder, .. } => decoder.add(bytes),
            Self::Frames { decoder } => decoder.add(bytes),
        }
    }

    /// The last byte that ends a line, in the text form.
    pub fn last_end(&self, bytes: &[u8]) -> Option<usize> {
        match self {
            Self::Text { .. } => bytes.iter().rposition(|byte| matches!(byte, b'\r' | b'\n')),
            Self::Frames { .. } => None,
        }
    }

    /// The next thing that came whole. `silent`: nothing came for [`Wire::silence`].
    pub fn next(&mut self, silent: bool) -> Option<Incoming> {
        match self {
            Self::Text { decoder, .. } => {
                let text::TextRequest { spelling, request } = decoder.next_line()?;
                let request = request.map_err(|error| error.refusal());
                Some(Incoming::Request { origin: Origin::Text(spelling), request })
            }
            Self::Frames { decoder } => Some(match decoder.next(silent)? {
                RequestEvent::Open => Incoming::Open,
                RequestEvent::Request(request) => {
                    Incoming::Request { origin: Origin::Letter(request.command().letter()), request: Ok(request) }
                }
                RequestEvent::Bad { letter, error } => {
                    Incoming::Request { origin: Origin::Letter(letter), request: Err(error.refusal()) }
                }
            }),
        }
    }

    /// After how long without a byte [`Wire::next`] is to be told of it; `None` while nothing waits for more bytes.
    pub fn silence(&self) -> Option<Duration> {
        match self {
            Self::Text { .. } => None,
            Self::Frames { decoder } => decoder.is_waiting().then_some(frame::LINE_SILENCE),
        }
    }

    /// Whether a client has to open the remote function before it logs in.
    pub const fn has_to_be_opened(&self) -> bool {
        matches!(self, Self::Frames { .. })
    }

    /// The origin of a request that has not come whole.
    pub fn anonymous(&self) -> Origin {
        match self {
            Self::Text { .. } => Origin::Text(Spelling::default()),
            Self::Frames { .. } => Origin::Letter(None),
        }
    }

    /// The answer as bytes, which have to leave in one write. Empty for an answer to a message without a letter.
    pub fn encode(&self, origin: &Origin, request: Option<&Request>, answer: &Answer) -> Zeroizing<Vec<u8>> {
        let bytes = match (self, origin, answer) {
            (Self::Text { terminator, .. }, Origin::Text(spelling), answer) => match (answer, request) {
                (Answer::Good(reply), Some(request)) => text::encode_reply(spelling, request, reply, *terminator)
                    .unwrap_or_else(|_| text::encode_refusal(spelling, RefusalCode::SystemError, *terminator)),
                (Answer::Refused(code), _) => text::encode_refusal(spelling, *code, *terminator),
                (Answer::Good(_), None) => Vec::new(),
            },
            (Self::Frames { .. }, Origin::Letter(Some(letter)), Answer::Refused(code)) => {
                frame::encode_refusal(*letter, *code)
            }
            (Self::Frames { .. }, Origin::Letter(Some(letter)), Answer::Good(reply)) => {
                let command = Command::from_letter(*letter);
                let frame = command.and_then(|command| frame::encode_reply(command, reply).ok());
                return frame.unwrap_or_else(|| frame::encode_refusal(*letter, RefusalCode::SystemError).into());
            }
            _ => Vec::new(),
        };
        Zeroizing::new(bytes)
    }
}
