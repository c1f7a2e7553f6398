//! What the command line says to people, in English and Chinese: headings and words of tables, sentences, and the help.
//!
//! `--json` is for programs and stays English. Usage errors are clap's own and English.

mod help;
mod phrase;
mod sentences;

pub use help::localised;
pub use phrase::{Cell, Phrase, phrases};
pub use sentences::*;
