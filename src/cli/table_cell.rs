//! The cells of the tables that the command line prints.

use crate::model::{CertificateType, Language, ServerStatus};
use crate::texts::{self, TextKey};

/// One cell of a table: a value as it is, or a word in the reader's language.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TableCell {
    Value(String),
    Word(TextKey),
    /// A word, then a value.
    Both(TextKey, String),
    /// Sentences, in the order of [`Language::ALL`].
    Sentences(Vec<String>),
}

impl TableCell {
    /// What is said in each language.
    pub fn said(text: impl Fn(Language) -> String) -> Self {
        Self::Sentences(Language::ALL.into_iter().map(text).collect())
    }

    /// The same with this behind it.
    pub fn followed_by(self, value: String) -> Self {
        match self {
            Self::Value(text) => Self::Value(text + &value),
            Self::Word(word) => Self::Both(word, value),
            Self::Both(word, text) => Self::Both(word, text + &value),
            Self::Sentences(texts) => Self::Sentences(texts.into_iter().map(|text| text + &value).collect()),
        }
    }

    pub fn text(&self, language: Language) -> String {
        match self {
            Self::Value(value) => value.clone(),
            Self::Word(word) => word.text(language).to_owned(),
            Self::Both(word, value) => format!("{}{value}", word.text(language)),
            Self::Sentences(texts) => {
                let said = Language::ALL.into_iter().zip(texts).find(|(known, _)| *known == language);
                said.map(|(_, text)| text.clone()).unwrap_or_default()
            }
        }
    }
}

impl From<String> for TableCell {
    fn from(value: String) -> Self {
        Self::Value(value)
    }
}

impl From<TextKey> for TableCell {
    fn from(word: TextKey) -> Self {
        Self::Word(word)
    }
}

impl From<ServerStatus> for TableCell {
    fn from(status: ServerStatus) -> Self {
        Self::Word(texts::status(status))
    }
}

impl From<CertificateType> for TableCell {
    fn from(kind: CertificateType) -> Self {
        Self::Word(texts::certificate_type(kind))
    }
}

/// Yes or no.
impl From<bool> for TableCell {
    fn from(yes: bool) -> Self {
        Self::Word(if yes { TextKey::Yes } else { TextKey::No })
    }
}
