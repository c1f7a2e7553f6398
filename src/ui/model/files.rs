//! Files that dialogs ask for: chosen or typed in, then read elsewhere.

use std::path::PathBuf;

use super::{BackendCommand, BrowseField, BrowseFor, FileContents, FileForm, JobId, Model};
use crate::model::{ErrorCode, Problem};
use crate::texts::TextKey;

/// As a field shows it.
pub fn first_path(paths: &[PathBuf]) -> String {
    paths.first().map(|path| path.display().to_string()).unwrap_or_default()
}

impl Model {
    pub(in crate::ui) fn choose_file(&mut self) -> Vec<BackendCommand> {
        let job = self.next_job();
        let title = TextKey::ChooseFileTitle.text(self.language).to_owned();
        let Some(file) = self.dialogs.last_mut().and_then(|dialog| dialog.file()) else { return vec![] };
        // One dialog of the desktop is enough.
        if file.picking.is_some() {
            return vec![];
        }
        file.picking = Some(job);
        vec![BackendCommand::PickFile { job, kind: file.kind, title }]
    }

    pub(in crate::ui) fn browse(&mut self, field: BrowseField) -> Vec<BackendCommand> {
        // One dialog of the desktop is enough.
        if self.browsing.is_some() {
            return vec![];
        }
        let job = self.next_job();
        self.browsing = Some((job, field));
        let (kind, root) = (field.kind, self.workspace.root().to_owned());
        let typed = (field.text)(self).map(|text| text.trim().trim_matches('"').to_owned()).unwrap_or_default();
        let (language, begin) = (self.language, root.join(typed));
        let title = |key: TextKey| key.text(language).to_owned();
        vec![match field.asks_for {
            BrowseFor::File => BackendCommand::PickFile { job, kind, title: title(TextKey::ChooseFileTitle) },
            BrowseFor::NewFile(key) => BackendCommand::PickTarget { job, kind, title: title(key), begin },
            BrowseFor::Folder(key) => BackendCommand::PickFolder { job, title: title(key), begin },
        }]
    }

    pub(in crate::ui) fn file_picked(
        &mut self,
        job: JobId,
        result: Result<Option<PathBuf>, Problem>,
    ) -> Vec<BackendCommand> {
        if let Some((_, field)) = self.browsing.take_if(|(browsing, _)| *browsing == job) {
            match result {
                Ok(None) => {}
                Ok(Some(path)) => {
                    // Its dialog may be closed by now.
                    if let Some(text) = (field.text)(self) {
                        *text = path.display().to_string();
                    }
                }
                Err(problem) => self.show_problem(problem),
            }
            return vec![];
        }
        let reading = self.next_job();
        let mut files = self.dialogs.iter_mut().filter_map(|dialog| dialog.file());
        // Its dialog may be closed by now.
        let Some(file) = files.find(|file| file.picking == Some(job)) else { return vec![] };
        file.picking = None;
        match result {
            Ok(None) => vec![],
            Ok(Some(path)) => {
                file.path = path.display().to_string();
                vec![read(file, reading, path)]
            }
            Err(problem) => {
                file.problem = Some(problem);
                vec![]
            }
        }
    }

    /// Reads the file whose path is typed into the dialog on top. A relative path starts at the workspace.
    pub(in crate::ui) fn read_typed(&mut self) -> Vec<BackendCommand> {
        let job = self.next_job();
        let root = self.workspace.root().to_owned();
        let Some(file) = self.dialogs.last_mut().and_then(|dialog| dialog.file()) else { return vec![] };
        if file.incomplete().is_some() {
            return vec![];
        }
        let path = root.join(file.trimmed());
        vec![read(file, job, path)]
    }

    pub(in crate::ui) fn file_read(&mut self, job: JobId, result: Result<(PathBuf, FileContents), Problem>) {
        let mut dialogs = self.dialogs.iter_mut();
        let waiting = dialogs.position(|dialog| dialog.file().is_some_and(|file| file.reading == Some(job)));
        let Some(index) = waiting else { return };
        // Out of the model for a moment, as it looks at the rest of it.
        let mut dialog = self.dialogs.remove(index);
        let taken = result.and_then(|(_, contents)| dialog.take_in_file(&contents.0, self));
        if let Some(file) = dialog.file() {
            file.reading = None;
            let optional = std::mem::take(&mut file.optional);
            match taken {
                Ok(()) => file.shown = Some(file.path.clone()),
                Err(problem) if optional && problem.code == ErrorCode::FileNotFound => {}
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

fn read(file: &mut FileForm, job: JobId, path: PathBuf) -> BackendCommand {
    file.problem = None;
    file.shown = None;
    file.reading = Some(job);
    BackendCommand::ReadFile { job, path, most: file.most }
}
