use std::error::Error;
use std::fmt;

use crate::model::Language;
use crate::texts::cli as texts;

/// Why a parser of this program does not take the value of an argument.
///
/// Its `Display`, which clap appends to its own message, is English; `usage_error` asks for the other languages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ValueError {
    NeitherOnNorOff,
    /// The value is none of these.
    NoneOf(Vec<&'static str>),
    /// The value is not a time in RFC 3339, by the reader's own error.
    Time(chrono::ParseError),
}

impl ValueError {
    /// Why, as the end of a sentence in brackets.
    pub fn reason(&self, language: Language) -> String {
        match self {
            Self::NeitherOnNorOff => texts::value_on_or_off(language),
            Self::NoneOf(known) => texts::value_known(language, known),
            Self::Time(_) => texts::value_time(language),
        }
    }
}

impl fmt::Display for ValueError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason(Language::En))
    }
}

impl Error for ValueError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Time(error) => Some(error),
            Self::NeitherOnNorOff | Self::NoneOf(_) => None,
        }
    }
}
