//! The parameters of commands, each in both forms.

use zeroize::Zeroizing;

use super::decode_error::{DecodeError, EncodeError, Fault};
use super::reader::Reader;
use crate::model::controller_text;

/// A parameter of a command.
pub(super) trait Field: Sized {
    /// Its length in frames; `None` if it has no fixed one.
    const WIDTH: Option<usize>;

    fn put_frame(&self, out: &mut Vec<u8>) -> Result<(), EncodeError>;
    fn take_frame(reader: &mut Reader<'_>) -> Result<Self, DecodeError>;
    /// With the comma before it.
    fn put_text(&self, out: &mut Vec<u8>) -> Result<(), EncodeError>;
    fn take_text(reader: &mut Reader<'_>) -> Result<Self, DecodeError>;
}

macro_rules! numbers {
    ($($(#[$doc:meta])* $name:ident($inner:ident) $first:literal..=$last:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name($inner);

        impl $name {
            #[doc = concat!("`None` unless it is ", stringify!($first), "–", stringify!($last), ".")]
            pub fn new(number: $inner) -> Option<Self> {
                ($first..=$last).contains(&number).then_some(Self(number))
            }

            /// The number.
            pub const fn get(self) -> $inner {
                self.0
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                self.0.fmt(f)
            }
        }

        impl Field for $name {
            const WIDTH: Option<usize> = Some(size_of::<$inner>());

            fn put_frame(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
                out.extend(self.0.to_be_bytes());
                Ok(())
            }

            fn take_frame(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
                let at = reader.position();
                let number = $inner::from_be_bytes(reader.array()?);
                Self::new(number).ok_or_else(|| reader.error_at(Fault::OutOfRange, at))
            }

            fn put_text(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
                out.extend(format!(",{}", self.0).into_bytes());
                Ok(())
            }

            fn take_text(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
                // Behind the comma.
                let at = reader.position() + 1;
                let number = $inner::try_from(reader.decimal()?).ok().and_then(Self::new);
                number.ok_or_else(|| reader.error_at(Fault::OutOfRange, at))
            }
        }
    )*};
}

numbers! {
    /// The number of a function: 0 is `main`, 1 `main1`, up to 63.
    FunctionNumber(u8) 0..=63;
    /// A robot, 1–16; 0 is all robots where a command can act on all.
    RobotNumber(u8) 0..=16;
    /// The number of an I/O or memory I/O bit.
    BitNumber(u16) 0..=65535;
    /// The number of a byte or word of I/O or memory I/O.
    PortNumber(u8) 0..=255;
    /// The number of an alarm of a part that wears.
    AlarmNumber(u8) 0..=255;
    /// A part that wears, of the monitoring command GetHealthRB.
    PartNumber(u8) 0..=255;
    /// A joint of a robot, from 1 on.
    JointNumber(u8) 0..=255;
    /// The number of an error or warning.
    ErrorNumber(u16) 0..=9999;
    /// The language of a message: 0 English, 1 Japanese, 2 German, 3 French, 4 simplified and 5 traditional Chinese.
    MessageLanguage(u8) 0..=5;
}

impl RobotNumber {
    /// All robots.
    pub const ALL: Self = Self(0);
}

impl MessageLanguage {
    /// The encoding in which a controller sends messages of this language.
    pub(super) const fn encoding(self) -> &'static encoding_rs::Encoding {
        match self.0 {
            1 => encoding_rs::SHIFT_JIS,
            4 => encoding_rs::GB18030,
            5 => encoding_rs::BIG5,
            _ => encoding_rs::WINDOWS_1252,
        }
    }
}

/// The state of a bit: 00 or 01; `0` or `1`.
impl Field for bool {
    const WIDTH: Option<usize> = Some(1);

    fn put_frame(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        out.push(u8::from(*self));
        Ok(())
    }

    fn take_frame(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        let at = reader.position();
        match reader.array()? {
            [0] => Ok(false),
            [1] => Ok(true),
            _ => Err(reader.error_at(Fault::OutOfRange, at)),
        }
    }

    fn put_text(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        out.extend(if *self { b",1" } else { b",0" });
        Ok(())
    }

    fn take_text(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        let at = reader.position() + 1;
        match reader.decimal()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(reader.error_at(Fault::OutOfRange, at)),
        }
    }
}

macro_rules! io_values {
    ($($(#[$doc:meta])* $type:ident $digits:literal $format:literal;)*) => {$(
        $(#[$doc])*
        impl Field for $type {
            const WIDTH: Option<usize> = Some(size_of::<$type>());

            fn put_frame(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
                out.extend(self.to_be_bytes());
                Ok(())
            }

            fn take_frame(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
                Ok(Self::from_be_bytes(reader.array()?))
            }

            fn put_text(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
                out.extend(format!($format, self).into_bytes());
                Ok(())
            }

            fn take_text(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
                let at = reader.position() + 1;
                Self::try_from(reader.hexadecimal($digits)?).map_err(|_| reader.error_at(Fault::OutOfRange, at))
            }
        }
    )*};
}

io_values! {
    /// Eight bits of I/O: one byte; two hexadecimal digits.
    u8 2 ",{:02X}";
    /// Sixteen bits of I/O: two bytes, high byte first; four hexadecimal digits.
    u16 4 ",{:04X}";
}

/// A password of Login: at most 16 printable ASCII characters, or empty. Wiped when it is dropped, not shown by `Debug`.
#[derive(Clone, PartialEq, Eq, Default)]
pub struct Password(Zeroizing<String>);

/// The longest password of Login, in characters.
pub const MAX_PASSWORD_CHARS: usize = 16;

impl Password {
    /// `None` for one that no controller can have.
    pub fn new(password: &str) -> Option<Self> {
        let printable = password.bytes().all(|byte| matches!(byte, b' '..=b'~'));
        (printable && password.len() <= MAX_PASSWORD_CHARS).then(|| Self(Zeroizing::new(password.to_owned())))
    }

    /// The characters. They must not be logged.
    pub fn expose(&self) -> &str {
        &self.0
    }

    fn from_bytes(bytes: &[u8], fault: impl FnOnce(Fault) -> DecodeError) -> Result<Self, DecodeError> {
        if bytes.len() > MAX_PASSWORD_CHARS {
            return Err(fault(Fault::TooLong));
        }
        match std::str::from_utf8(bytes).ok().and_then(Self::new) {
            Some(password) => Ok(password),
            None => Err(fault(Fault::Malformed)),
        }
    }
}

impl std::fmt::Debug for Password {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Password(***)")
    }
}

impl Field for Password {
    const WIDTH: Option<usize> = None;

    fn put_frame(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        out.extend(self.0.as_bytes());
        Ok(())
    }

    fn take_frame(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        let at = reader.position();
        Self::from_bytes(reader.rest(), |fault| reader.error_at(fault, at))
    }

    fn put_text(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        out.push(b',');
        self.put_frame(out)
    }

    fn take_text(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        reader.expect(b',')?;
        Self::take_frame(reader)
    }
}

/// A command of SPEL+ for Execute: 1–256 bytes, without control characters. On the wire it stands in double quotes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SpelCommand(String);

/// The longest command of Execute, in bytes.
pub const MAX_COMMAND_BYTES: usize = 256;
/// The longest result of Execute, in bytes.
pub const MAX_RESULT_BYTES: usize = 4060;

impl SpelCommand {
    /// Errors: [`EncodeError::TooLong`], also for an empty text, and [`EncodeError::ControlCharacter`].
    pub fn new(text: impl Into<String>) -> Result<Self, EncodeError> {
        let text = text.into();
        if text.is_empty() || text.len() > MAX_COMMAND_BYTES {
            return Err(EncodeError::TooLong);
        }
        if text.contains(char::is_control) {
            return Err(EncodeError::ControlCharacter);
        }
        Ok(Self(text))
    }

    /// The text, without the quotes around it.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl Field for SpelCommand {
    const WIDTH: Option<usize> = None;

    fn put_frame(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        quote(&self.0, out);
        Ok(())
    }

    fn take_frame(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        let at = reader.position();
        let text = quoted(reader.rest()).map_err(|fault| reader.error_at(fault, at))?;
        let command = match Self::new(controller_text(text)) {
            Ok(command) => Ok(command),
            Err(_) if text.is_empty() => Err(Fault::Missing),
            Err(EncodeError::TooLong) => Err(Fault::TooLong),
            Err(_) => Err(Fault::Malformed),
        };
        command.map_err(|fault| reader.error_at(fault, at))
    }

    fn put_text(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
        out.push(b',');
        self.put_frame(out)
    }

    fn take_text(reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
        reader.expect(b',')?;
        Self::take_frame(reader)
    }
}

/// A text in double quotes. Quotes inside stand as they are: the last one ends the text.
pub(super) fn quote(text: &str, out: &mut Vec<u8>) {
    out.push(b'"');
    out.extend(text.as_bytes());
    out.push(b'"');
}

/// Reads [`quote`].
pub(super) const fn quoted(bytes: &[u8]) -> Result<&[u8], Fault> {
    match bytes {
        [] => Err(Fault::Missing),
        [b'"', text @ .., b'"'] => Ok(text),
        _ => Err(Fault::Malformed),
    }
}
