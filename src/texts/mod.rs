//! Every sentence for a person, of window and command line, in every language.
//!
//! | part | content |
//! |---|---|
//! | [`TextKey`] | a fixed text; its name and English text stand in the file of its topic in `en` |
//! | `en`, `zh`, `ja` | one folder a language, each with the same files, and the same texts and functions in them |
//! | the other files | one a topic: which sentences there are, and which text belongs to which value |
//!
//! A fixed text is a row of `english_texts!` in `en/<topic>.rs` and a row of the same name of `fixed_texts!` in
//! `<language>/<topic>.rs` for every other language. A sentence with values in it is declared in `<topic>.rs` with
//! `in_every_language!` and is a function of the same name in `<language>/<topic>.rs`. A language that lacks a text or a
//! sentence does not compile; a text that English does not have is reported as unused.
//!
//! A new language is a copy of the folder of another one, translated; its name in `in_language!`, `english_texts!` and
//! `FixedText` in this file; a variant of [`Language`]; and the order of its fonts in `ui/fonts.rs`, with a font in
//! `assets/fonts` if its characters are in none.
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

/// Declares the fixed texts of a topic with their names and their English text. Every other language has a text of the
/// same name in its file of the topic.
macro_rules! english_texts {
    ($topic:ident: $($key:ident: $text:literal;)*) => {
        #[allow(non_upper_case_globals, reason = "the texts are used like the variants of an enum")]
        impl $crate::texts::TextKey {
            $(
                #[doc = $text]
                pub const $key: Self = Self(&$crate::texts::FixedText {
                    name: stringify!($key),
                    en: $text,
                    zh: $crate::texts::zh::$topic::fixed::$key,
                    ja: $crate::texts::ja::$topic::fixed::$key,
                });
            )*
        }

        /// Every fixed text of the topic.
        #[cfg(test)]
        pub const FIXED_TEXTS: &[$crate::texts::TextKey] = &[$($crate::texts::TextKey::$key),*];
    };
}

/// The fixed texts of a topic in a language other than English.
macro_rules! fixed_texts {
    ($($key:ident: $text:literal;)*) => {
        #[allow(non_upper_case_globals, reason = "named as the constants of `TextKey`")]
        pub mod fixed { $(pub const $key: &str = $text;)* }
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

/// A text for each value of an enum: a function of that name.
macro_rules! texts_of_values {
    ($name:ident($type:ident): $($value:ident: $text:literal;)*) => {
        pub const fn $name(value: $type) -> &'static str {
            match value { $($type::$value => $text),* }
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
mod fins;
mod help;
mod live;
mod recorder;
mod remote;
mod remote_control;
mod sentences;
mod trust;
mod vault;
mod verify;
mod zone;

pub use authority::*;
pub use certificates::explain_refusal;
pub use errors::Explanation;
pub use files::*;
pub use fins::*;
pub use help::{HelpTexts, UsageErrorTexts, help};
pub use live::*;
pub use recorder::*;
pub use remote::*;
pub use remote_control::*;
pub use sentences::*;
pub use trust::*;
pub use vault::*;
pub use verify::*;
pub use zone::Zone;

use std::fmt;

use crate::model::{Country, Language};

/// A fixed text of the window or the command line. [`TextKey::text`] gives it in a language.
///
/// Each text is a constant of this type: `TextKey::Cancel`.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct TextKey(&'static FixedText);

/// A fixed text in every language.
#[derive(PartialEq, Eq, Hash)]
struct FixedText {
    name: &'static str,
    en: &'static str,
    zh: &'static str,
    ja: &'static str,
}

impl TextKey {
    /// The text in a language.
    pub const fn text(self, language: Language) -> &'static str {
        match language {
            Language::En => self.0.en,
            Language::Zh => self.0.zh,
            Language::Ja => self.0.ja,
        }
    }

    /// Every fixed text.
    #[cfg(test)]
    fn all() -> impl Iterator<Item = Self> {
        [
            en::authority::FIXED_TEXTS,
            en::cli::FIXED_TEXTS,
            en::common::FIXED_TEXTS,
            en::controllers::FIXED_TEXTS,
            en::files::FIXED_TEXTS,
            en::fins::FIXED_TEXTS,
            en::live::FIXED_TEXTS,
            en::recorder::FIXED_TEXTS,
            en::remote::FIXED_TEXTS,
            en::remote_control::FIXED_TEXTS,
            en::server::FIXED_TEXTS,
            en::server_certificates::FIXED_TEXTS,
            en::trust::FIXED_TEXTS,
            en::vault::FIXED_TEXTS,
            en::verify::FIXED_TEXTS,
            en::window::FIXED_TEXTS,
        ]
        .into_iter()
        .flatten()
        .copied()
    }
}

impl fmt::Debug for TextKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.name)
    }
}

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
