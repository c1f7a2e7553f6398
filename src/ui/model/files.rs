//! Files that dialogs ask for: chosen or typed in, then read elsewhere.

use std::path::PathBuf;

use super::{Dialog, JobId, Model};
use crate::model::{ErrorCode, Problem};
use crate::texts::TextKey;
use crate::ui::backend::{Command, FileContents};
use crate::ui::picker::FileKind;

/// A field for the path of a file that is read later, by the operation itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathField {
    CaCertificate,
    UserPfx,
    UserCertificate,
    UserKey,
    KeyBackup,
    /// Where the server log is saved.
    LogTarget,
}

impl PathField {
    const fn kind(self) -> FileKind {
        match self {
            Self::CaCertificate | Self::UserCertificate => FileKind::Certificate,
            Self::UserPfx | Self::KeyBackup => FileKind::Pkcs12,
            Self::UserKey => FileKind::Key,
            Self::LogTarget => FileKind::Text,
        }
    }

    fn of(self, dialog: &mut Dialog) -> Option<&mut String> {
        match (self, dialog) {
            (Self::CaCertificate, Dialog::CaSigned(form)) => Some(&mut form.file),
            (Self::UserPfx, Dialog::UserSpecified(form)) => Some(&mut form.pfx),
            (Self::UserCertificate, Dialog::UserSpecified(form)) => Some(&mut form.certificate),
            (Self::UserKey, Dialog::UserSpecified(form)) => Some(&mut form.key),
            (Self::KeyBackup, Dialog::Restore(form)) => Some(&mut form.file),
            (Self::LogTarget, Dialog::SaveLog(form)) => Some(&mut form.path),
            _ => None,
        }
    }
}

/// A file to be read.
#[derive(Debug)]
pub struct FileForm {
    /// As it is typed.
    pub path: String,
    pub kind: FileKind,
    /// A larger file is refused.
    pub most: usize,
    /// The path whose contents the dialog shows.
    pub shown: Option<String>,
    pub picking: Option<JobId>,
    pub reading: Option<JobId>,
    /// Why the last attempt failed.
    pub problem: Option<Problem>,
}

impl FileForm {
    pub fn new(kind: FileKind, most: usize) -> Self {
        Self { path: String::new(), kind, most, shown: None, picking: None, reading: None, problem: None }
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
    fn trimmed(&self) -> &str {
        self.path.trim().trim_matches('"')
    }
}

/// As a field shows it.
pub(super) fn first_path(paths: &[PathBuf]) -> String {
    paths.first().map(|path| path.display().to_string()).unwrap_or_default()
}

impl Model {
    pub(super) fn choose_file(&mut self) -> Vec<Command> {
        let job = self.next_job();
        let title = TextKey::ChooseFileTitle.text(self.language).to_owned();
        let Some(file) = self.dialogs.last_mut().and_then(Dialog::file) else { return vec![] };
        // One dialog of the desktop is enough.
        if file.picking.is_some() {
            return vec![];
        }
        file.picking = Some(job);
        vec![Command::PickFile { job, kind: file.kind, title }]
    }

    pub(super) fn browse(&mut self, field: PathField) -> Vec<Command> {
        // One dialog of the desktop is enough.
        if self.browsing.is_some() {
            return vec![];
        }
        let job = self.next_job();
        self.browsing = Some((job, field));
        let kind = field.kind();
        if let (PathField::LogTarget, Some(Dialog::SaveLog(form))) = (field, self.dialogs.last()) {
            let title = TextKey::SaveLogTitle.text(self.language).to_owned();
            let begin = form.target(self.workspace.root());
            return vec![Command::PickTarget { job, kind, title, begin }];
        }
        let title = TextKey::ChooseFileTitle.text(self.language).to_owned();
        vec![Command::PickFile { job, kind, title }]
    }

    pub(super) fn file_picked(&mut self, job: JobId, result: Result<Option<PathBuf>, Problem>) -> Vec<Command> {
        if let Some((_, field)) = self.browsing.take_if(|(browsing, _)| *browsing == job) {
            match result {
                Ok(None) => {}
                Ok(Some(path)) => {
                    // Its dialog may be closed by now.
                    if let Some(text) = self.dialogs.iter_mut().find_map(|dialog| field.of(dialog)) {
                        *text = path.display().to_string();
                    }
                }
                Err(problem) => self.show_problem(problem),
            }
            return vec![];
        }
        let read = self.next_job();
        let mut files = self.dialogs.iter_mut().filter_map(Dialog::file);
        // Its dialog may be closed by now.
        let Some(file) = files.find(|file| file.picking == Some(job)) else { return vec![] };
        file.picking = None;
        match result {
            Ok(None) => vec![],
            Ok(Some(path)) => {
                file.path = path.display().to_string();
                vec![file.read(read, path)]
            }
            Err(problem) => {
                file.problem = Some(problem);
                vec![]
            }
        }
    }

    /// Reads the file whose path is typed into the dialog on top. A relative path starts at the workspace.
    pub(super) fn read_typed(&mut self) -> Vec<Command> {
        let job = self.next_job();
        let root = self.workspace.root().to_owned();
        let Some(file) = self.dialogs.last_mut().and_then(Dialog::file) else { return vec![] };
        if file.incomplete().is_some() {
            return vec![];
        }
        let path = root.join(file.trimmed());
        vec![file.read(job, path)]
    }

    pub(super) fn file_read(&mut self, job: JobId, result: Result<(PathBuf, FileContents), Problem>) {
        let waits = |dialog: &mut Dialog| dialog.file().is_some_and(|file| file.reading == Some(job));
        let Some(index) = self.dialogs.iter_mut().position(waits) else { return };
        // Out of the model for a moment, as it looks at the rest of it.
        let mut dialog = self.dialogs.remove(index);
        let taken = result.and_then(|(_, contents)| match &mut dialog {
            Dialog::Activation(form) => form.take_in(&contents.0, self),
            Dialog::ConnectionList(form) => form.take_in(&contents.0, self),
            Dialog::AuthorityForm(form) => form.take_in(&contents.0),
            _ => Ok(()),
        });
        let looked = match &mut dialog {
            Dialog::ConnectionList(form) => std::mem::take(&mut form.looking),
            _ => false,
        };
        if let Some(file) = dialog.file() {
            file.reading = None;
            match taken {
                Ok(()) => file.shown = Some(file.path.clone()),
                Err(problem) if looked && problem.code == ErrorCode::FileNotFound => {}
                Err(mut problem) => {
                    // No import folder is meant here.
                    if problem.code == ErrorCode::FileNotFound {
                        problem.code = ErrorCode::FileUnreadable;
                    }
                    file.problem = Some(problem);
                }
            }
        }
        self.dialogs.insert(index, dialog);
    }
}

impl FileForm {
    fn read(&mut self, job: JobId, path: PathBuf) -> Command {
        self.problem = None;
        self.shown = None;
        self.reading = Some(job);
        Command::ReadFile { job, path, most: self.most }
    }
}
