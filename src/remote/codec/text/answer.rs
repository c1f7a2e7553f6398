use zeroize::Zeroizing;

use super::line::{Lines, MAX_ANSWER, Terminator};
use super::request::Spelling;
use crate::remote::codec::command::{Command, Request};
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

/// Reads the answer to one request from bytes that come in pieces of any size, and to another one that is sent meanwhile.
/// Holds at most 16 KiB.
#[derive(Debug)]
pub struct AnswerDecoder {
    expected: ExpectedReply,
    interjected: Option<ExpectedReply>,
    lines: Lines,
}

impl AnswerDecoder {
    /// Of this request.
    pub fn new(request: &Request) -> Self {
        Self { expected: ExpectedReply::to(request), interjected: None, lines: Lines::new(MAX_ANSWER) }
    }

    /// Expects the answer to another request as well, instead of the former other one.
    pub fn interject(&mut self, request: &Request) {
        self.interjected = Some(ExpectedReply::to(request));
    }

    /// Takes bytes in, and then asks [`AnswerDecoder::next_line`].
    pub fn add(&mut self, bytes: &[u8]) {
        self.lines.add(bytes);
    }

    /// The answer, if its line has come to its end.
    pub fn next_line(&mut self) -> Option<Result<Answer, DecodeError>> {
        Some(self.next_of_two()?.map(|(_, answer)| answer))
    }

    /// The answer to either request, and to which command it is.
    pub fn next_of_two(&mut self) -> Option<Result<(Command, Answer), DecodeError>> {
        Some(match self.lines.next()? {
            Ok(line) => self.read(&line),
            Err(_) => Err(DecodeError::new(Fault::TooLong, "line", 0)),
        })
    }

    fn read(&self, line: &Zeroizing<Vec<u8>>) -> Result<(Command, Answer), DecodeError> {
        let mut reader = Reader::new(line, 0);
        reader.field("start");
        let is_good = reader.skip(b'#');
        if !is_good && !reader.skip(b'!') {
            return Err(reader.error(Fault::NoStart));
        }
        reader.field("command");
        let name = reader.until(b",");
        let mut expected = std::iter::once(&self.expected).chain(&self.interjected);
        let expected = expected.find(|one| name.eq_ignore_ascii_case(one.command.name().as_bytes()));
        let expected = expected.ok_or_else(|| reader.error_at(Fault::OtherCommand, 1))?;
        if is_good {
            return expected.take_text_parameters(&mut reader).map(|reply| (expected.command, Answer::Good(reply)));
        }
        reader.field("code");
        let at = reader.position() + 1;
        let code = u8::try_from(reader.decimal()?).ok().and_then(RefusalCode::from_number);
        reader.finish()?;
        let code = code.ok_or_else(|| reader.error_at(Fault::OutOfRange, at))?;
        Ok((expected.command, Answer::Refused(code)))
    }
}
