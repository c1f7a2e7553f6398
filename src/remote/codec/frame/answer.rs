use zeroize::Zeroizing;

use super::message::{ACK, ETX, HEAD, MAX_ANSWER, NAK, TAIL, check, ends, message};
use crate::remote::codec::command::{Command, Request};
use crate::remote::codec::decode_error::{DecodeError, EncodeError, Fault};
use crate::remote::codec::reader::Reader;
use crate::remote::codec::received::Received;
use crate::remote::codec::refusal::RefusalCode;
use crate::remote::codec::reply::{Answer, DataLength, ExpectedReply, Reply};

/// The command that is answered, and its answer.
type DecodedAnswer = Result<(Command, Answer), DecodeError>;

/// A good answer as a frame.
///
/// Errors: [`EncodeError`] if the answer cannot be sent in frames.
pub fn encode_reply(command: Command, reply: &Reply) -> Result<Zeroizing<Vec<u8>>, EncodeError> {
    let letter = command.letter().ok_or(EncodeError::TextOnly(command.name()))?;
    message(ACK, letter, MAX_ANSWER, |out| reply.put_frame_data(command, out))
}

/// A refusal as a frame: the letter as it came, and the code in two ASCII digits.
pub fn encode_refusal(letter: u8, code: RefusalCode) -> Vec<u8> {
    let [tens, ones] = code.digits();
    vec![NAK, letter, tens, ones, ETX, letter ^ tens ^ ones ^ ETX]
}

/// Data of a refusal.
const CODE: usize = 2;

/// Reads the answer to one request from bytes that come in pieces of any size, and to another one that is sent meanwhile.
/// Holds at most 16 KiB.
#[derive(Debug)]
pub struct AnswerDecoder {
    expected: ExpectedReply,
    interjected: Option<ExpectedReply>,
    received: Received,
}

impl AnswerDecoder {
    /// Of this request.
    pub fn new(request: &Request) -> Self {
        Self { expected: ExpectedReply::to(request), interjected: None, received: Received::default() }
    }

    /// Expects the answer to another request as well, instead of the former other one.
    pub fn interject(&mut self, request: &Request) {
        self.interjected = Some(ExpectedReply::to(request));
    }

    /// Takes bytes in, and then asks [`AnswerDecoder::next`].
    pub fn add(&mut self, bytes: &[u8]) {
        self.received.add(bytes);
    }

    /// The answer, if all of it has come. `silent`: no byte came for [`LINE_SILENCE`](super::LINE_SILENCE), so that what is
    /// there is not going on.
    pub fn next(&mut self, silent: bool) -> Option<Result<Answer, DecodeError>> {
        Some(self.next_of_two(silent)?.map(|(_, answer)| answer))
    }

    /// As [`AnswerDecoder::next`], the answer to either request, and to which command it is.
    pub fn next_of_two(&mut self, silent: bool) -> Option<Result<(Command, Answer), DecodeError>> {
        if self.received.overflowed() {
            return Some(Err(DecodeError::new(Fault::TooLong, "data", 0)));
        }
        // Noise of the line.
        self.received.skip_to(&[ACK, NAK]);
        let bytes = self.received.bytes();
        let (result, length) = match self.read(bytes) {
            None if bytes.len() > MAX_ANSWER => (Err(DecodeError::new(Fault::TooLong, "data", HEAD)), bytes.len()),
            None if silent && !bytes.is_empty() => (Err(unfinished(bytes)), bytes.len()),
            None => return None,
            Some((data, result)) => (result, HEAD + data + TAIL),
        };
        self.received.drop_front(length);
        Some(result)
    }

    /// Whether a part of an answer is there: then silence is to be reported.
    pub fn is_waiting(&self) -> bool {
        !self.received.bytes().is_empty()
    }

    /// Length of the data and the answer; `None` while bytes are missing.
    fn read(&self, bytes: &[u8]) -> Option<(usize, DecodedAnswer)> {
        let [first, letter, data @ ..] = bytes else { return None };
        let mut expected = std::iter::once(&self.expected).chain(&self.interjected);
        let Some(expected) = expected.find(|one| one.command.letter() == Some(*letter)) else {
            return Some((data.len(), Err(DecodeError::new(Fault::OtherCommand, "command", 1))));
        };
        let command = expected.command;
        let length = if *first == NAK { DataLength::Exactly(CODE) } else { expected.data_length(data) };
        let length = match length {
            DataLength::Exactly(length) => length,
            DataLength::Unknown => return None,
            DataLength::UpToEtx => {
                let mut right = ends(bytes).filter(|(_, is_right)| *is_right);
                return right.find_map(|(length, _)| {
                    let answer = good(expected, bytes, length).ok()?;
                    Some((length, Ok((command, answer))))
                });
            }
        };
        if bytes.len() < HEAD + length + TAIL {
            return None;
        }
        let answer = check(bytes, length).and_then(|()| match *first {
            NAK => refusal([bytes[HEAD], bytes[HEAD + 1]]),
            _ => good(expected, bytes, length),
        });
        Some((length, answer.map(|answer| (command, answer))))
    }
}

fn good(expected: &ExpectedReply, bytes: &[u8], length: usize) -> Result<Answer, DecodeError> {
    let mut reader = Reader::new(&bytes[HEAD..HEAD + length], HEAD);
    expected.take_frame_data(&mut reader).map(Answer::Good)
}

/// The manual does not say how the code is written: two ASCII digits, as all numbers of the answer to GetStatus; two bytes
/// with the high one 0 are understood as well.
fn refusal(code: [u8; CODE]) -> Result<Answer, DecodeError> {
    let code = match code {
        [0, number] => RefusalCode::from_number(number),
        digits => RefusalCode::from_digits(digits),
    };
    code.map(Answer::Refused).ok_or(DecodeError::new(Fault::Malformed, "code", HEAD))
}

/// What is wrong with an answer that stopped.
fn unfinished(bytes: &[u8]) -> DecodeError {
    match ends(bytes).last() {
        Some((data, false)) if HEAD + data + TAIL == bytes.len() => {
            check(bytes, data).err().unwrap_or(DecodeError::new(Fault::Malformed, "data", HEAD))
        }
        Some((data, true)) if HEAD + data + TAIL == bytes.len() => DecodeError::new(Fault::Malformed, "data", HEAD),
        _ => DecodeError::new(Fault::Incomplete, "data", bytes.len()),
    }
}
