//! Files dropped onto the window or held over it, and what can be done with them.

use std::path::PathBuf;

use super::{JobId, UiCommand};
use crate::model::Problem;
use crate::texts::TextKey;
use crate::workspace::Recognised;

/// More files at once are not looked at.
pub const MAX_DROPPED: usize = 100;

/// One of the files, and what it is.
#[derive(Debug, Clone, PartialEq)]
pub struct DroppedFile {
    /// The file.
    pub path: PathBuf,
    /// What it is by its content.
    pub found: Result<Recognised, Problem>,
}

impl DroppedFile {
    /// As a list shows it: without its folder.
    pub fn name(&self) -> String {
        self.path.file_name().unwrap_or(self.path.as_os_str()).to_string_lossy().into_owned()
    }
}

/// A dialog that some of the files are for.
#[derive(Debug, Clone, PartialEq)]
pub struct DropChoice {
    /// The command that opens the dialog.
    pub command: UiCommand,
    /// Title of the dialog.
    pub title: TextKey,
    /// Which of the files it takes.
    pub files: Vec<usize>,
    /// Why it cannot be opened.
    pub why: Option<TextKey>,
    /// Which entry of the table of dialogs that take files.
    pub route: usize,
}

/// What to do with files that were dropped, for a person to choose.
#[derive(Debug)]
pub struct DropForm {
    /// The files.
    pub files: Vec<DroppedFile>,
    /// The dialogs to choose from.
    pub choices: Vec<DropChoice>,
    /// Of the choices.
    pub selected: Option<usize>,
    /// Why none of them is looked at.
    pub blocked: Option<TextKey>,
}

impl DropForm {
    /// Files that cannot be used now, with the reason.
    pub fn blocked(why: TextKey) -> Self {
        Self { files: vec![], choices: vec![], selected: None, blocked: Some(why) }
    }

    /// Why the main button does nothing.
    pub fn incomplete(&self) -> Option<TextKey> {
        match self.selected.and_then(|at| self.choices.get(at)) {
            _ if self.blocked.is_some() => self.blocked,
            Some(choice) => choice.why,
            None => Some(TextKey::DropNothing),
        }
    }

    /// Whether anything can be chosen.
    pub fn offers(&self) -> bool {
        self.blocked.is_none() && self.choices.iter().any(|choice| choice.why.is_none())
    }
}

/// Files held over the window.
#[derive(Debug)]
pub struct HoveringFiles {
    /// The job that recognises the files.
    pub job: JobId,
    /// The files.
    pub paths: Vec<PathBuf>,
    /// `None` while they are looked at.
    pub found: Option<DropForm>,
    /// The dialog on top takes files of every kind.
    pub taken: bool,
}

impl DropForm {
    /// The choice that needs no asking: it takes all files, and there is no other.
    pub fn only(&self) -> Option<usize> {
        let mut open = self.choices.iter().enumerate().filter(|(_, choice)| choice.why.is_none());
        match (open.next(), open.next()) {
            (Some((at, choice)), None) if self.blocked.is_none() && choice.files.len() == self.files.len() => Some(at),
            _ => None,
        }
    }
}
