use std::fmt;

use crate::model::{ErrorCode, Language, Problem};

/// What a person reads about an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Explanation {
    /// What happened: one sentence without a full stop.
    pub message: &'static str,
    /// Why, in sentences.
    pub cause: &'static str,
    /// What to do, in sentences.
    pub remedy: &'static str,
}

impl ErrorCode {
    /// What a person reads about the error: what happened, why, what to do.
    pub const fn explain(self, language: Language) -> Explanation {
        in_language!(language, errors::explain(self))
    }
}

impl Problem {
    /// Message and technical detail.
    pub fn in_one_line(&self, language: Language) -> String {
        let message = self.code.explain(language).message;
        match &self.detail {
            Some(detail) => format!("{message} ({detail})"),
            None => message.to_owned(),
        }
    }
}

/// English, for logs and programs.
impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_one_line(Language::En))
    }
}
