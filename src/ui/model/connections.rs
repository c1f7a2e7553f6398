//! Controllers from a connection list (manual 2.5.3).

use std::path::PathBuf;

use super::files::first_path;
use super::{FileForm, Model};
use crate::model::{ControllerSeries, Problem};
use crate::texts::{self, TextKey};
use crate::ui::backend::Command;
use crate::ui::picker::FileKind;
use crate::workspace::{ConnectionList, MAX_CONNECTION_LIST_BYTES, NewConnection, Skipped};

#[derive(Debug)]
pub struct ConnectionListForm {
    pub file: FileForm,
    /// The list does not know it; what a controller says of itself replaces it later.
    pub series: ControllerSeries,
    pub new: Vec<FoundConnection>,
    pub left_out: Vec<LeftOut>,
    /// The list of the workspace is tried first; that there is none is no failure.
    pub(super) looking: bool,
}

/// A line that can be imported.
#[derive(Debug)]
pub struct FoundConnection {
    pub line: usize,
    pub connection: NewConnection,
    pub ticked: bool,
}

#[derive(Debug)]
pub struct LeftOut {
    pub line: usize,
    /// As it stands in the file.
    pub name: String,
    pub why: Skipped,
}

impl ConnectionListForm {
    fn new(model: &Model) -> Self {
        let mut file = FileForm::new(FileKind::Csv, MAX_CONNECTION_LIST_BYTES);
        file.path = model.workspace.connection_list_path().display().to_string();
        Self { file, series: ControllerSeries::ASSUMED, new: Vec::new(), left_out: Vec::new(), looking: true }
    }

    pub fn reads_file(&self) -> bool {
        !self.file.is_shown()
    }

    pub fn ticked(&self) -> usize {
        self.new.iter().filter(|found| found.ticked).count()
    }

    /// Why the main button does nothing yet.
    pub fn incomplete(&self) -> Option<TextKey> {
        if self.reads_file() { self.file.incomplete() } else { (self.ticked() == 0).then_some(TextKey::TickConnection) }
    }

    pub(super) fn take_in(&mut self, bytes: &[u8], model: &Model) -> Result<(), Problem> {
        self.new.clear();
        self.left_out.clear();
        for planned in ConnectionList::parse(bytes)?.plan(&model.configuration()) {
            let line = planned.line;
            match planned.verdict {
                Ok(connection) => self.new.push(FoundConnection { line, connection, ticked: true }),
                Err(why) => self.left_out.push(LeftOut { line, name: planned.name, why }),
            }
        }
        Ok(())
    }
}

impl Model {
    pub(super) fn open_connection_list(&mut self) -> Vec<Command> {
        self.dialogs.push(super::Dialog::ConnectionList(ConnectionListForm::new(self)));
        self.read_typed()
    }

    pub(super) fn open_connection_list_of(&mut self, paths: Vec<PathBuf>) -> Vec<Command> {
        let mut form = ConnectionListForm::new(self);
        form.file.path = first_path(&paths);
        form.looking = false;
        self.dialogs.push(super::Dialog::ConnectionList(form));
        self.read_typed()
    }

    /// Adds what is ticked, and ticks nothing but it: what to do next is to confirm who they are.
    pub(super) fn import_connections(&mut self, form: ConnectionListForm) -> Vec<Command> {
        let configuration = self.configuration();
        let series = form.series;
        let ticked = form.new.into_iter().filter(|found| found.ticked).map(|found| found.connection);
        let entries: Vec<_> = ticked
            // The list of controllers may have grown since the file was read.
            .filter(|new| configuration.check_new(&new.name, &new.address).is_ok())
            .map(|new| new.entry(series))
            .collect();
        self.status = Some(texts::imported(self.language, entries.len()));
        self.rows.add_all_ticked(entries, self.now);
        self.save()
    }
}
