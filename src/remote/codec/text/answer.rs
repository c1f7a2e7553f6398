use zeroize::Zeroizing;

use super::line::{Lines, MAX_ANSWER, Terminator};
use super::request::Spelling;
use crate::remote::codec::command::Request;
use crate::remote::codec::decode_error::{DecodeError, EncodeError, Fault};
use crate::remote::codec::reader::Reader;
use crate::remote::codec::refusal::RefusalCode;
use crate::remote::codec::reply::{Answer, ExpectedReply, Reply};

/// A good answer as a line. It must leave in one write: clients take what one read brings as the answer.
///
/// Errors: [`EncodeError`] if a text in it cannot be sent.
pub fn encode_reply(
    spelling: &Spelling,
    request: &Request,
    reply: &Reply,
    terminator: Terminator,
) -> Result<Vec<u8>, EncodeError> {
    let mut line = format!("#{spelling}").into_bytes();
    reply.put_text_parameters(request, &mut line)?;
    if line.len() > MAX_ANSWER {
        return Err(EncodeError::TooLong);
    }
    line.extend(terminator.bytes());
    Ok(line)
}

/// A refusal as a line.
pub fn encode_refusal(spelling: &Spelling, code: RefusalCode, terminator: Terminator) -> Vec<u8> {
    let mut line = format!("!{spelling},{code}").into_bytes();
    line.extend(terminator.bytes());
    line
}

/// Reads the answer to one request from bytes that come in pieces of any size. Holds at most 16 KiB.
#[derive(Debug)]
pub struct AnswerDecoder {
    expected: ExpectedReply,
    lines: Lines,
}

impl AnswerDecoder {
    /// Of this request.
    pub fn new(request: &Request) -> Self {
        Self { expected: ExpectedReply::to(request), lines: Lines::new(MAX_ANSWER) }
    }

    /// Takes bytes in, and then asks [`AnswerDecoder::next_line`].
    pub fn add(&mut self, bytes: &[u8]) {
        self.lines.add(bytes);
    }

    /// The answer, if its line has come to its end.
    pub fn next_line(&mut self) -> Option<Result<Answer, DecodeError>> {
        Some(match self.lines.next()? {
            Ok(line) => self.read(&line),
            Err(_) => Err(DecodeError::new(Fault::TooLong, "line", 0)),
        })
    }

    fn read(&self, line: &Zeroizing<Vec<u8>>) -> Result<Answer, DecodeError> {
        let mut reader = Reader::new(line, 0);
        reader.field("start");
        let is_good = reader.skip(b'#');
        if !is_good && !reader.skip(b'!') {
            return Err(reader.error(Fault::NoStart));
        }
        reader.field("command");
        let name = reader.until(b",");
        if !name.eq_ignore_ascii_case(self.expected.command.name().as_bytes()) {
            return Err(reader.error_at(Fault::OtherCommand, 1));
        }
        if is_good {
            return self.expected.take_text_parameters(&mut reader).map(Answer::Good);
        }
        reader.field("code");
        let at = reader.position() + 1;
        let code = u8::try_from(reader.decimal()?).ok().and_then(RefusalCode::from_number);
        reader.finish()?;
        code.map(Answer::Refused).ok_or_else(|| reader.error_at(Fault::OutOfRange, at))
    }
}
