//! What a good answer holds, in both forms.

use super::command::{Command, Request};
use super::decode_error::{DecodeError, EncodeError, Fault};
use super::field::{Field as _, MAX_RESULT_BYTES, MessageLanguage, quote, quoted};
use super::reader::Reader;
use super::refusal::RefusalCode;
use super::reply_kind::ReplyKind;
use super::status::RemoteStatus;
use super::value;
use crate::model::{SpelType, SpelValue, controller_text};

/// A good answer. Which variant answers a command is fixed by the command.
#[derive(Debug, Clone, PartialEq)]
pub enum Reply {
    /// It was done; nothing is returned.
    Done,
    /// GetCurRobot: a robot, from 1 on.
    Robot(u8),
    /// GetIO, GetMemIO.
    Bit(bool),
    /// GetIOByte, GetMemIOByte.
    Byte(u8),
    /// GetIOWord, GetMemIOWord.
    Word(u16),
    /// GetVariable: one value, or as many as elements were asked for.
    Values(Vec<SpelValue>),
    /// GetStatus.
    Status(RemoteStatus),
    /// Execute: the result, if the command has one, without the quotes around it.
    Output(Option<String>),
    /// GetAlm: the numbers of the alarms.
    Alarms(Vec<u8>),
    /// Monitoring commands with one text.
    Text(String),
    /// Monitoring commands with several values.
    List(Vec<String>),
}

/// The answer of a controller to a request.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// The command was done.
    Good(Reply),
    /// The command was refused, and nothing was done.
    Refused(RefusalCode),
}

/// What a good answer to a request has to look like.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ExpectedReply {
    pub command: Command,
    /// Type and number of the values that GetVariable asks for.
    values: Option<(SpelType, usize)>,
    language: Option<MessageLanguage>,
}

impl ExpectedReply {
    pub fn to(request: &Request) -> Self {
        let values = match request {
            Request::GetVariable { variable } => Some((variable.kind(), variable.count())),
            _ => None,
        };
        let language = match request {
            Request::GetErrMsg { language, .. } => Some(*language),
            _ => None,
        };
        Self { command: request.command(), values, language }
    }

    /// How many bytes the data of a good frame has, by the bytes that came of it.
    pub fn data_length(&self, data: &[u8]) -> DataLength {
        match self.command.reply_kind() {
            ReplyKind::Nothing => DataLength::Exactly(0),
            ReplyKind::Robot | ReplyKind::Bit | ReplyKind::Byte => DataLength::Exactly(1),
            ReplyKind::Word => DataLength::Exactly(2),
            ReplyKind::Values => {
                let (kind, count) = self.values.unwrap_or(NO_VALUES);
                value::width(kind).map_or(DataLength::UpToEtx, |width| DataLength::Exactly(width * count))
            }
            // The first digit of the code stands in the place of the eleventh flag if there are ten.
            ReplyKind::Status => match data.get(OLD_FLAGS) {
                None => DataLength::Unknown,
                Some(digit) if digit.is_ascii_digit() => DataLength::Exactly(OLD_FLAGS + 4),
                Some(_) => DataLength::Exactly(OLD_FLAGS + 5),
            },
            ReplyKind::Alarms => match data.first() {
                None => DataLength::Unknown,
                Some(count) => DataLength::Exactly(1 + usize::from(*count)),
            },
            ReplyKind::Output | ReplyKind::Text | ReplyKind::List => DataLength::UpToEtx,
        }
    }

    /// Reads the data of a good frame to its end.
    pub fn take_frame_data(&self, reader: &mut Reader<'_>) -> Result<Reply, DecodeError> {
        let reply = match self.command.reply_kind() {
            ReplyKind::Nothing => Reply::Done,
            ReplyKind::Robot => {
                reader.field("robot");
                Reply::Robot(u8::take_frame(reader)?)
            }
            ReplyKind::Bit => {
                reader.field("bit");
                Reply::Bit(bool::take_frame(reader)?)
            }
            ReplyKind::Byte => {
                reader.field("byte");
                Reply::Byte(u8::take_frame(reader)?)
            }
            ReplyKind::Word => {
                reader.field("word");
                Reply::Word(u16::take_frame(reader)?)
            }
            ReplyKind::Values => {
                reader.field("value");
                let (kind, count) = self.values.unwrap_or(NO_VALUES);
                Reply::Values((0..count).map(|_| value::take_frame(kind, reader)).collect::<Result<_, _>>()?)
            }
            ReplyKind::Status => {
                reader.field("flags");
                let bytes = reader.rest();
                let malformed = || reader.error_at(Fault::Malformed, 0);
                let (flags, code) = bytes.split_last_chunk::<4>().ok_or_else(|| reader.error_at(Fault::Missing, 0))?;
                let flags = RemoteStatus::flags_from(flags, 0).ok_or_else(malformed)?;
                reader.field("code");
                let code = RemoteStatus::code_from(code)
                    .ok_or_else(|| reader.error_at(Fault::Malformed, bytes.len() - code.len()))?;
                Reply::Status(RemoteStatus { flags, code })
            }
            ReplyKind::Output => {
                reader.field("result");
                let at = reader.position();
                let result = match reader.rest() {
                    [] => Ok(None),
                    text => result(text).map(Some),
                };
                Reply::Output(result.map_err(|fault| reader.error_at(fault, at))?)
            }
            ReplyKind::Alarms => {
                reader.field("count");
                let [count] = reader.array()?;
                reader.field("alarm");
                Reply::Alarms(reader.take(usize::from(count))?.to_vec())
            }
            ReplyKind::Text | ReplyKind::List => return Err(reader.error(Fault::UnknownCommand)),
        };
        reader.finish().map(|()| reply)
    }

    /// Reads what follows the name in a good answer, to its end.
    pub fn take_text_parameters(&self, reader: &mut Reader<'_>) -> Result<Reply, DecodeError> {
        let reply = match self.command.reply_kind() {
            ReplyKind::Nothing => {
                reader.field("result");
                let at = reader.position();
                match reader.decimal()? {
                    0 => Reply::Done,
                    _ => return Err(reader.error_at(Fault::OutOfRange, at + 1)),
                }
            }
            ReplyKind::Robot => {
                reader.field("robot");
                Reply::Robot(take_u8(reader)?)
            }
            ReplyKind::Bit => {
                reader.field("bit");
                Reply::Bit(bool::take_text(reader)?)
            }
            ReplyKind::Byte => {
                reader.field("byte");
                Reply::Byte(u8::take_text(reader)?)
            }
            ReplyKind::Word => {
                reader.field("word");
                Reply::Word(u16::take_text(reader)?)
            }
            ReplyKind::Values => {
                reader.field("value");
                let (kind, count) = self.values.unwrap_or(NO_VALUES);
                Reply::Values((0..count).map(|_| take_value(kind, reader)).collect::<Result<_, _>>()?)
            }
            ReplyKind::Status => {
                reader.field("flags");
                let flags = reader.parameter()?;
                let at = reader.position() - flags.len();
                let flags =
                    RemoteStatus::flags_from(flags, b'0').ok_or_else(|| reader.error_at(Fault::Malformed, at))?;
                reader.field("code");
                let code = reader.parameter()?;
                let at = reader.position() - code.len();
                let code = RemoteStatus::code_from(code).ok_or_else(|| reader.error_at(Fault::Malformed, at))?;
                Reply::Status(RemoteStatus { flags, code })
            }
            ReplyKind::Output => {
                reader.field("result");
                reader.expect(b',')?;
                let at = reader.position();
                let result = match reader.rest() {
                    b"0" => Ok(None),
                    text => result(text).map(Some),
                };
                Reply::Output(result.map_err(|fault| reader.error_at(fault, at))?)
            }
            ReplyKind::Alarms => {
                reader.field("count");
                let count = take_u8(reader)?;
                reader.field("alarm");
                Reply::Alarms((0..count).map(|_| take_u8(reader)).collect::<Result<_, _>>()?)
            }
            ReplyKind::Text => {
                reader.field("text");
                reader.expect(b',')?;
                Reply::Text(self.text(reader.rest()))
            }
            ReplyKind::List => {
                reader.field("value");
                let mut values = vec![self.text(reader.parameter()?)];
                while !reader.is_at_end() {
                    values.push(self.text(reader.parameter()?));
                }
                Reply::List(values)
            }
        };
        reader.finish().map(|()| reply)
    }

    fn text(&self, bytes: &[u8]) -> String {
        match self.language {
            Some(language) => language.encoding().decode_without_bom_handling(bytes).0.into_owned(),
            None => controller_text(bytes),
        }
    }
}

/// How long the data of a frame is.
pub(super) enum DataLength {
    Exactly(usize),
    /// More bytes are needed to tell.
    Unknown,
    /// A text: it ends where ETX and the right checksum follow.
    UpToEtx,
}

/// Flags in the answer of old firmware.
const OLD_FLAGS: usize = 10;

/// A request that is not GetVariable.
const NO_VALUES: (SpelType, usize) = (SpelType::Boolean, 0);

fn result(bytes: &[u8]) -> Result<String, Fault> {
    let text = quoted(bytes)?;
    if text.len() > MAX_RESULT_BYTES { Err(Fault::TooLong) } else { Ok(controller_text(text)) }
}

fn take_u8(reader: &mut Reader<'_>) -> Result<u8, DecodeError> {
    let at = reader.position() + 1;
    u8::try_from(reader.decimal()?).map_err(|_| reader.error_at(Fault::OutOfRange, at))
}

fn take_value(kind: SpelType, reader: &mut Reader<'_>) -> Result<SpelValue, DecodeError> {
    let at = reader.position() + 1;
    let text = if kind == SpelType::String {
        // It may hold commas.
        reader.expect(b',')?;
        reader.rest()
    } else {
        reader.parameter()?
    };
    value::value_from_text(kind, &controller_text(text)).map_err(|fault| reader.error_at(fault, at))
}

impl Reply {
    /// The data between the letter and ETX of a frame.
    pub(super) fn put_frame_data(&self, command: Command, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        match self {
            Self::Done | Self::Output(None) => Ok(()),
            Self::Robot(number) | Self::Byte(number) => number.put_frame(out),
            Self::Bit(on) => on.put_frame(out),
            Self::Word(word) => word.put_frame(out),
            Self::Values(values) => values.iter().try_for_each(|value| value::put_frame(value, out)),
            Self::Status(status) => {
                out.extend(status.flag_bytes(0));
                out.extend(status.code_digits());
                Ok(())
            }
            Self::Output(Some(text)) => put_result(text, out),
            Self::Alarms(alarms) => {
                out.push(u8::try_from(alarms.len()).map_err(|_| EncodeError::TooLong)?);
                out.extend(alarms);
                Ok(())
            }
            Self::Text(_) | Self::List(_) => Err(EncodeError::TextOnly(command.name())),
        }
    }

    /// What follows the name in the text form.
    pub(super) fn put_text_parameters(&self, request: &Request, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        match self {
            Self::Done | Self::Output(None) => out.extend(b",0"),
            Self::Robot(number) => put_decimal(*number, out),
            Self::Byte(byte) => byte.put_text(out)?,
            Self::Bit(on) => on.put_text(out)?,
            Self::Word(word) => word.put_text(out)?,
            Self::Values(values) => {
                for value in values {
                    out.push(b',');
                    value::put_text(value, out)?;
                }
            }
            Self::Status(status) => {
                out.push(b',');
                out.extend(status.flag_bytes(b'0'));
                out.push(b',');
                out.extend(status.code_digits());
            }
            Self::Output(Some(text)) => {
                out.push(b',');
                put_result(text, out)?;
            }
            Self::Alarms(alarms) => {
                put_decimal(u8::try_from(alarms.len()).map_err(|_| EncodeError::TooLong)?, out);
                alarms.iter().for_each(|alarm| put_decimal(*alarm, out));
            }
            Self::Text(text) => put_words(std::slice::from_ref(text), request, out)?,
            Self::List(values) => put_words(values, request, out)?,
        }
        Ok(())
    }
}

fn put_decimal(number: u8, out: &mut Vec<u8>) {
    out.extend(format!(",{number}").into_bytes());
}

fn put_result(text: &str, out: &mut Vec<u8>) -> Result<(), EncodeError> {
    if text.len() > MAX_RESULT_BYTES {
        return Err(EncodeError::TooLong);
    }
    if text.contains(char::is_control) {
        return Err(EncodeError::ControlCharacter);
    }
    quote(text, out);
    Ok(())
}

/// Texts of monitoring commands, in the encoding that belongs to the language that was asked for.
fn put_words(words: &[String], request: &Request, out: &mut Vec<u8>) -> Result<(), EncodeError> {
    let encoding = match request {
        Request::GetErrMsg { language, .. } => language.encoding(),
        _ => encoding_rs::UTF_8,
    };
    for word in words {
        if word.contains(char::is_control) {
            return Err(EncodeError::ControlCharacter);
        }
        out.push(b',');
        out.extend(encoding.encode(word).0.as_ref());
    }
    Ok(())
}
