use super::{JobId, Model};
use crate::model::Problem;
use crate::texts::TextKey;
use crate::ui::picker::FileKind;

/// A field for the path of a file that is read or written later, by the operation itself.
#[derive(Debug, Clone, Copy)]
pub struct BrowseField {
    /// Which files the file dialog offers first.
    pub kind: FileKind,
    /// What the desktop's dialog asks for.
    pub asks_for: BrowseFor,
    /// The text of the field; `None` if its dialog was closed.
    pub text: fn(&mut Model) -> Option<&mut String>,
}

/// What a path is chosen for.
#[derive(Debug, Clone, Copy)]
pub enum BrowseFor {
    /// A file that exists.
    File,
    /// Where a file is saved; the title of the desktop's dialog.
    NewFile(TextKey),
    /// A folder; the title of the desktop's dialog.
    Folder(TextKey),
}

/// A file to be read.
#[derive(Debug)]
pub struct FileForm {
    /// As it is typed.
    pub path: String,
    /// Which files the file dialog offers first.
    pub kind: FileKind,
    /// A larger file is refused.
    pub most: usize,
    /// The path whose contents the dialog shows.
    pub shown: Option<String>,
    /// The file dialog that is open, if one is.
    pub picking: Option<JobId>,
    /// The reading that goes on, if any.
    pub reading: Option<JobId>,
    /// Why the last attempt failed.
    pub problem: Option<Problem>,
    /// It is tried first whether it exists; that there is none is no failure.
    pub optional: bool,
}

impl FileForm {
    /// An empty field for files of at most `most` bytes.
    pub fn new(kind: FileKind, most: usize) -> Self {
        Self {
            path: String::new(),
            kind,
            most,
            shown: None,
            picking: None,
            reading: None,
            problem: None,
            optional: false,
        }
    }

    /// What is shown is what is in the file whose path is in the field.
    pub fn is_shown(&self) -> bool {
        self.shown.as_deref() == Some(self.path.as_str())
    }

    /// Why it cannot be read now.
    pub fn incomplete(&self) -> Option<TextKey> {
        if self.reading.is_some() {
            Some(TextKey::Reading)
        } else if self.trimmed().is_empty() {
            Some(TextKey::FileRule)
        } else {
            None
        }
    }

    /// File managers put quotes around a path they copy.
    pub(super) fn trimmed(&self) -> &str {
        self.path.trim().trim_matches('"')
    }
}
