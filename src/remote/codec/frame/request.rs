use zeroize::Zeroizing;

use super::message::{ETX, HEAD, MAX_REQUEST, OPEN, STX, TAIL, check, ends, message};
use crate::remote::codec::command::{Command, Request};
use crate::remote::codec::decode_error::{DecodeError, EncodeError, Fault};
use crate::remote::codec::reader::Reader;
use crate::remote::codec::received::Received;

/// A request as a frame. The bytes are wiped when they are dropped: those of Login hold the password.
///
/// Errors: [`EncodeError::TextOnly`] for a monitoring command.
pub fn encode_request(request: &Request) -> Result<Zeroizing<Vec<u8>>, EncodeError> {
    let command = request.command();
    let letter = command.letter().ok_or(EncodeError::TextOnly(command.name()))?;
    message(STX, letter, MAX_REQUEST, |out| request.put_frame_data(out))
}

/// What a controller receives.
#[derive(Debug, Clone, PartialEq)]
pub enum RequestEvent {
    /// The remote function is opened: `04`.
    Open,
    /// A request.
    Request(Request),
    /// Bytes that are no request, to be refused with [`DecodeError::refusal`].
    Bad {
        /// The command's letter, as it came; `None` if none came.
        letter: Option<u8>,
        /// What is wrong.
        error: DecodeError,
    },
}

/// Reads requests from bytes that come in pieces of any size. Holds at most 16 KiB.
#[derive(Debug, Default)]
pub struct RequestDecoder {
    received: Received,
}

/// How a message ends.
enum Ending {
    /// More bytes are needed.
    Open,
    /// With so many bytes of data, and this result.
    At(usize, Result<Request, DecodeError>),
}

impl RequestDecoder {
    /// Takes bytes in, and then asks [`RequestDecoder::next`] until it has nothing more.
    pub fn add(&mut self, bytes: &[u8]) {
        self.received.add(bytes);
    }

    /// The next request, if all of it has come. `silent`: no byte came for [`LINE_SILENCE`](super::LINE_SILENCE), so that
    /// what is there is not going on.
    pub fn next(&mut self, silent: bool) -> Option<RequestEvent> {
        if self.received.overflowed() {
            return Some(bad(None, Fault::TooLong, "data", 0));
        }
        // Noise of the line.
        self.received.skip_to(&[OPEN, STX]);
        let bytes = self.received.bytes();
        match bytes {
            [] => None,
            [OPEN, ..] => {
                self.received.drop_front(1);
                Some(RequestEvent::Open)
            }
            [_] if silent => {
                self.received.drop_front(1);
                Some(bad(None, Fault::Incomplete, "command", 1))
            }
            [_] => None,
            [_, letter, ..] => {
                let letter = *letter;
                let (length, result) = match ending(letter, bytes, silent) {
                    Ending::Open if bytes.len() > MAX_REQUEST => {
                        (bytes.len(), Err(DecodeError::new(Fault::TooLong, "data", HEAD)))
                    }
                    Ending::Open if silent => (bytes.len(), Err(unfinished(bytes))),
                    Ending::Open => return None,
                    Ending::At(data, result) => (HEAD + data + TAIL, result),
                };
                self.received.drop_front(length);
                Some(match result {
                    Ok(request) => RequestEvent::Request(request),
                    Err(error) => RequestEvent::Bad { letter: Some(letter), error },
                })
            }
        }
    }

    /// Whether a part of a message is there: then silence is to be reported.
    pub fn is_waiting(&self) -> bool {
        !self.received.bytes().is_empty()
    }
}

fn bad(letter: Option<u8>, fault: Fault, field: &'static str, offset: usize) -> RequestEvent {
    RequestEvent::Bad { letter, error: DecodeError::new(fault, field, offset) }
}

fn ending(letter: u8, bytes: &[u8], silent: bool) -> Ending {
    let Some(command) = Command::from_letter(letter) else {
        // How long it is, is unknown as well.
        let end = ends(bytes).find(|(_, is_right)| *is_right);
        let unknown = DecodeError::new(Fault::UnknownCommand, "command", 1);
        return end.map_or(Ending::Open, |(data, _)| Ending::At(data, Err(unknown)));
    };
    match command.data_width() {
        Some(width) if bytes.len() < HEAD + width + TAIL => Ending::Open,
        Some(width) => Ending::At(width, check(bytes, width).and_then(|()| read(command, &bytes[HEAD..HEAD + width]))),
        None => open_ending(command, bytes, silent),
    }
}

fn read(command: Command, data: &[u8]) -> Result<Request, DecodeError> {
    Request::take_frame_data(command, &mut Reader::new(data, HEAD))
}

/// The end of a message whose length depends on what is in it.
fn open_ending(command: Command, bytes: &[u8], silent: bool) -> Ending {
    let whole: Vec<(usize, Result<Request, DecodeError>)> = ends(bytes)
        .filter(|(_, is_right)| *is_right)
        .map(|(data, _)| (data, read(command, &bytes[HEAD..HEAD + data])))
        .filter(|(_, read)| is_whole(read))
        .collect();
    let Some((data, _)) = whole.first() else { return Ending::Open };
    let behind = &bytes[HEAD + data + TAIL..];
    // A value that looks like an end: a longer message with a right BCC is the one that was sent.
    let goes_on = match behind {
        [] => command == Command::GetVariable && bytes.last() == Some(&b','),
        [STX | OPEN, ..] => false,
        _ => true,
    };
    if !goes_on {
        return first(whole);
    }
    if whole.len() > 1 || silent {
        return whole.into_iter().next_back().map_or(Ending::Open, |(data, read)| Ending::At(data, read));
    }
    Ending::Open
}

fn first(whole: Vec<(usize, Result<Request, DecodeError>)>) -> Ending {
    whole.into_iter().next().map_or(Ending::Open, |(data, read)| Ending::At(data, read))
}

/// Whether the fields fit together, even if the controller refuses what they say.
const fn is_whole(read: &Result<Request, DecodeError>) -> bool {
    matches!(read, Ok(_) | Err(DecodeError { fault: Fault::Count, .. }))
}

/// What is wrong with a message that stopped.
fn unfinished(bytes: &[u8]) -> DecodeError {
    let Some(command) = Command::from_letter(bytes[1]) else {
        return DecodeError::new(Fault::UnknownCommand, "command", 1);
    };
    let last = ends(bytes).last().filter(|(data, _)| HEAD + data + TAIL == bytes.len());
    match last {
        // The fields are wrong.
        Some((data, true)) if command.data_width().is_none() => {
            read(command, &bytes[HEAD..HEAD + data]).err().unwrap_or(DecodeError::new(Fault::Malformed, "data", HEAD))
        }
        Some((data, false)) if command.data_width().is_none() => {
            check(bytes, data).err().unwrap_or(DecodeError::new(Fault::Malformed, "data", HEAD))
        }
        _ if command.data_width().is_none() && bytes.last() != Some(&ETX) && bytes.len() > HEAD => {
            DecodeError::new(Fault::Incomplete, "ETX", bytes.len())
        }
        _ => DecodeError::new(Fault::Incomplete, "data", bytes.len()),
    }
}
