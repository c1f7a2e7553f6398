use std::fmt;

use zeroize::Zeroizing;

use super::line::{Lines, MAX_REQUEST, Terminator};
use crate::remote::codec::command::{Command, Request};
use crate::remote::codec::decode_error::{DecodeError, EncodeError, Fault};
use crate::remote::codec::reader::Reader;

/// A request as a line. The bytes are wiped when they are dropped: those of Login hold the password.
///
/// Errors: [`EncodeError::ControlCharacter`] and [`EncodeError::TooLong`] for a value of a String variable.
pub fn encode_request(request: &Request, terminator: Terminator) -> Result<Zeroizing<Vec<u8>>, EncodeError> {
    // Never grows, so that no copy of a password is left behind.
    let mut line = Zeroizing::new(Vec::with_capacity(2 * MAX_REQUEST));
    line.push(b'$');
    line.extend(request.command().name().as_bytes());
    request.put_text_parameters(&mut line)?;
    if line.len() > MAX_REQUEST {
        return Err(EncodeError::TooLong);
    }
    line.extend(terminator.bytes());
    Ok(line)
}

/// The name of a command as a client spelled it, to be repeated in the answer. Empty by default, for a request of which the
/// name is not known.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Spelling(String);

/// More of a name that is unknown is not repeated.
const MAX_SPELLING: usize = 32;

impl Spelling {
    fn new(name: &[u8]) -> Self {
        let shown = name.iter().take(MAX_SPELLING).map(|byte| if byte.is_ascii_graphic() { *byte } else { b'?' });
        Self(shown.map(char::from).collect())
    }
}

impl From<Command> for Spelling {
    fn from(command: Command) -> Self {
        Self(command.name().to_owned())
    }
}

impl fmt::Display for Spelling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A line that a controller receives.
#[derive(Debug, Clone, PartialEq)]
pub struct TextRequest {
    /// What stands before the first comma, without `$`.
    pub spelling: Spelling,
    /// The request, or why it is none; to be refused with [`DecodeError::refusal`].
    pub request: Result<Request, DecodeError>,
}

/// Reads requests from bytes that come in pieces of any size. Holds at most 16 KiB.
#[derive(Debug)]
pub struct RequestDecoder(Lines);

impl Default for RequestDecoder {
    fn default() -> Self {
        Self(Lines::new(MAX_REQUEST))
    }
}

impl RequestDecoder {
    /// Takes bytes in, and then asks [`RequestDecoder::next_line`] until it has nothing more.
    pub fn add(&mut self, bytes: &[u8]) {
        self.0.add(bytes);
    }

    /// The next request, if its line has come to its end.
    pub fn next_line(&mut self) -> Option<TextRequest> {
        Some(match self.0.next()? {
            Ok(line) => read(&line),
            Err(_) => {
                let error = DecodeError::new(Fault::TooLong, "line", 0);
                TextRequest { spelling: Spelling::new(b""), request: Err(error) }
            }
        })
    }
}

fn read(line: &[u8]) -> TextRequest {
    let mut reader = Reader::new(line, 0);
    reader.field("start");
    let start = reader.expect(b'$');
    reader.field("command");
    let name = reader.until(b",");
    let spelling = Spelling::new(name);
    let request = start
        .map_err(|error| DecodeError { fault: Fault::NoStart, ..error })
        .and_then(|()| {
            let command = std::str::from_utf8(name).ok().and_then(Command::from_name);
            command.ok_or_else(|| reader.error_at(Fault::UnknownCommand, 1))
        })
        .and_then(|command| Request::take_text_parameters(command, &mut reader));
    TextRequest { spelling, request }
}
