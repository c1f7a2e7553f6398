//! Every sentence for a person, of window and command line, in every language.
//!
//! | part | content |
//! |---|---|
//! | [`TextKey`] | the names of fixed texts |
//! | `en`, `zh`, `ja` | one folder a language, each with the same files and the same functions in them |
//! | the other files | one a topic: which sentences there are, and which text belongs to which value |
//!
//! A language that lacks a text does not compile: fixed texts are looked up by an exhaustive `match`, and `in_language!`
//! calls a function of the same name in each language. A new language is a folder here, a variant of [`Language`] and an
//! arm of `in_language!`. Its glyphs are in a font (`assets/fonts`).
//!
//! What `--json` prints, what logs hold and what a controller is sent is for programs and stays English.

/// Calls the function of that name and topic in the folder of the language.
macro_rules! in_language {
    ($language:expr, $topic:ident::$name:ident($($arg:expr),* $(,)?)) => {
        match $language {
            $crate::model::Language::En => $crate::texts::en::$topic::$name($($arg),*),
            $crate::model::Language::Zh => $crate::texts::zh::$topic::$name($($arg),*),
            $crate::model::Language::Ja => $crate::texts::ja::$topic::$name($($arg),*),
        }
    };
}

/// Declares sentences that every language has in its file of that topic.
macro_rules! in_every_language {
    ($topic:ident: $($(#[$doc:meta])* fn $name:ident($($arg:ident: $type:ty),*) -> $output:ty;)*) => {$(
        $(#[$doc])*
        pub fn $name(language: $crate::model::Language, $($arg: $type),*) -> $output {
            in_language!(language, $topic::$name($($arg),*))
        }
    )*};
}

/// The fixed texts of a language.
macro_rules! fixed_texts {
    ($($key:ident: $text:literal;)*) => {
        pub const fn text(key: $crate::texts::TextKey) -> &'static str {
            match key { $($crate::texts::TextKey::$key => $text),* }
        }
    };
}

/// Message, cause and remedy of every error in a language.
macro_rules! error_texts {
    ($($code:ident: $message:literal, $cause:literal, $remedy:literal;)*) => {
        pub const fn explain(code: $crate::model::ErrorCode) -> $crate::texts::Explanation {
            match code {
                $($crate::model::ErrorCode::$code => {
                    $crate::texts::Explanation { message: $message, cause: $cause, remedy: $remedy }
                })*
            }
        }
    };
}

/// The names of all countries in a language.
macro_rules! country_names {
    ($($code:ident: $name:literal;)*) => {
        pub const fn name(country: $crate::model::Country) -> &'static str {
            match country { $($crate::model::Country::$code => $name),* }
        }
    };
}

mod en;
mod ja;
mod zh;

mod authority;
mod certificates;
pub mod cli;
mod errors;
mod files;
mod help;
mod key;
mod sentences;
mod trust;
mod vault;
mod verify;
mod zone;

pub use authority::*;
pub use certificates::explain_refusal;
pub use errors::Explanation;
pub use files::*;
pub use help::{HelpTexts, UsageErrorTexts, help};
pub use key::TextKey;
pub use sentences::*;
pub use trust::*;
pub use vault::*;
pub use verify::*;
pub use zone::Zone;

use crate::model::{Country, Language};

impl Country {
    /// The short name of Unicode CLDR.
    pub const fn name(self, language: Language) -> &'static str {
        in_language!(language, countries::name(self))
    }
}

/// The end of a sentence as a line of its own.
pub fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map(|first| first.to_uppercase().chain(chars).collect()).unwrap_or_default()
}

/// A sentence that becomes part of another.
fn without_stop(sentence: &str) -> &str {
    sentence.trim_end_matches(['.', '。'])
}

fn byte_count(bytes: u64) -> String {
    const KIB: u64 = 1024;
    match bytes {
        0..KIB => format!("{bytes} B"),
        KIB..0x10_0000 => format!("{:.1} KiB", bytes as f64 / KIB as f64),
        _ => format!("{:.1} MiB", bytes as f64 / (KIB * KIB) as f64),
    }
}

#[cfg(test)]
mod tests;
