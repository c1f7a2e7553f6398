//! Sentences about files and their lines, in English.

use std::path::Path;

use super::sentences::controllers;
use crate::model::activation::{ActivationMistake, KeyError, LineMistake};
use crate::workspace::SkippedLine;

english_texts! { files:
    // choosing a file
    FileLabel: "File";
    FileHint: "Path of the file";
    FileRule: "Choose a file or type its path";
    ChooseFile: "Choose…";
    ChooseFileTitle: "Choose a file";
    ReadFile: "Read file";
    Browse: "Browse…";
    OpenFolder: "Open folder";

    // files dropped onto the window
    DropTitle: "Dropped files";
    DropChoose: "Use as";
    DropOpen: "Open";
    DropUnseen: "Drop them to see what they are";
    DropAsks: "Several dialogs take this; you choose after dropping";
    DropNothing: "Nothing here can be used";
    DropDialogOpen: "A dialog is open: close it first, then drop the files again";
    DropTooMany: "Too many files: drop at most 100 at once";
    DropOneFile: "One file at a time: drop only that one";
    WhySplitKey: "The file holds certificate and private key together: save them as two files, or as one .pfx";
    DropCrl: "Certificate revocation list (CRL)";
    DropAuthority: "Certificate authority";
    KindActivation: "Activation file";
    KindConnectionList: "Connection list";
    KindSettingsExport: "Settings export";
    KindCertificate: "Certificate";
    KindChain: "Several certificates (PEM)";
    KindBundle: "Collection of certificates or CRLs (PKCS#7 or PEM)";
    KindCsr: "Certificate signing request (CSR)";
    KindKey: "Private key";
    KindKeyAndCertificate: "Certificate and private key in one PEM file";
    KindPkcs12: "Certificate with encrypted key (PKCS#12)";
}

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
        ActivationMistake::Licence(error) => format!("licence key: {}", key_error(*error)),
        ActivationMistake::Activation(error) => format!("activation key: {}", key_error(*error)),
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

pub fn skipped(why: &SkippedLine) -> String {
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
