use std::fmt;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::ErrorCode;
use super::untrusted_text::one_line;

/// One failure, as it is shown, logged and sent: a code and, where it helps, one technical detail.
///
/// The detail never holds a secret. It is the text of an error with those of its sources ([`super::with_sources`]) or a
/// value, in English; only remarks about the arguments of a command are in the chosen language. It is one line of at most
/// 500 characters, without those that a terminal obeys ([`super::untrusted_text`]).
#[derive(Debug, Clone, PartialEq, Eq, Error, Serialize, Deserialize)]
pub struct Problem {
    /// What went wrong.
    pub code: ErrorCode,
    /// A technical detail: English, one line, without secrets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub detail: Option<String>,
}

impl Problem {
    /// A problem without a detail.
    pub const fn new(code: ErrorCode) -> Self {
        Self { code, detail: None }
    }

    /// A problem with a detail, made one line of bounded length without control characters.
    pub fn with_detail(code: ErrorCode, detail: impl fmt::Display) -> Self {
        Self { code, detail: Some(one_line(&detail.to_string(), MAX_DETAIL_CHARS)) }
    }
}

/// A detail may quote what a peer sent.
const MAX_DETAIL_CHARS: usize = 500;

impl From<ErrorCode> for Problem {
    fn from(code: ErrorCode) -> Self {
        Self::new(code)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_detail_is_one_line_that_fits_on_a_screen() {
        let detail = |text: &str| Problem::with_detail(ErrorCode::Internal, text).detail.unwrap();
        assert_eq!(detail("\u{1b}[2Jgone\r\nnext"), "�[2Jgone  next");
        assert_eq!(detail(&"长".repeat(MAX_DETAIL_CHARS)), "长".repeat(MAX_DETAIL_CHARS));
        assert_eq!(detail(&"x".repeat(4_000_000)).chars().count(), MAX_DETAIL_CHARS + 1);
    }
}
