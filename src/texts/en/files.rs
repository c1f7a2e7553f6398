//! Sentences about files and their lines, in English.

use std::path::Path;

use super::sentences::controllers;
use crate::model::activation::{KeyError, LineMistake, Mistake};
use crate::workspace::Skipped;

pub fn moved_aside(name: &str, file: &Path) -> String {
    format!("{name}: a former file was moved to {}", file.display())
}

pub fn line(line: impl std::fmt::Display) -> String {
    format!("Line {line}")
}

pub fn key_error(error: KeyError) -> String {
    match error {
        KeyError::Character(c) => format!("{c:?} is neither a half-width letter nor a digit"),
        KeyError::Length { found, expected } => {
            format!("{found} letters and digits; {expected} are required")
        }
    }
}

pub fn key_progress(found: usize, expected: usize) -> String {
    format!("{found} of {expected} letters and digits")
}

pub fn keys_found(ready: usize, all: usize) -> String {
    format!("Keys found for {ready} of {}", controllers(all))
}

pub fn line_mistake(mistake: &LineMistake) -> String {
    let what = match &mistake.mistake {
        Mistake::Licence(error) => format!("licence key: {}", key_error(*error)),
        Mistake::Activation(error) => format!("activation key: {}", key_error(*error)),
        other => other.to_string(),
    };
    format!("{}: {what}", line(mistake.line))
}

pub fn to_import(ticked: usize, all: usize) -> String {
    format!("Import {ticked} of {}", controllers(all))
}

pub fn imported(count: usize) -> String {
    format!("{} added, not confirmed yet", controllers(count))
}

pub fn skipped(why: &Skipped) -> String {
    why.to_string()
}

pub fn drop_title(count: usize) -> String {
    match count {
        1 => "Drop the file here".to_owned(),
        _ => format!("Drop {count} files here"),
    }
}

pub fn drop_opens(dialog: &str) -> String {
    format!("Opens: {dialog}")
}

pub fn drop_disabled(dialog: &str, why: &str) -> String {
    format!("{dialog}: {why}")
}

pub fn more(count: usize) -> String {
    format!("and {count} more")
}

pub fn only_these(names: &[String]) -> String {
    let named = names.iter().take(3).map(String::as_str).collect::<Vec<_>>();
    let rest = if names.len() > 3 { format!(", {}", more(names.len() - 3)) } else { String::new() };
    format!("Only {}{rest}", named.join(", "))
}
