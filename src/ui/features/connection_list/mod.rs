//! Controllers from a connection list (manual 2.5.3).

mod view;

use std::path::PathBuf;

use egui::Ui;

use crate::model::{ControllerSeries, Problem};
use crate::texts::{self, TextKey};
use crate::ui::model::{
    BackendCommand, Dialog, DialogAnswer, DialogPlace, FileForm, Message, Model, UiCommand, first_path,
};
use crate::ui::picker::FileKind;
use crate::workspace::{ConnectionList, MAX_CONNECTION_LIST_BYTES, NewConnection, SkippedLine};

#[derive(Debug)]
pub struct ConnectionListForm {
    pub file: FileForm,
    /// The list does not know it; what a controller says of itself replaces it later.
    pub series: ControllerSeries,
    pub new: Vec<FoundConnection>,
    pub left_out: Vec<LeftOut>,
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
    pub why: SkippedLine,
}

impl ConnectionListForm {
    fn new(model: &Model) -> Self {
        let mut file = FileForm::new(FileKind::Csv, MAX_CONNECTION_LIST_BYTES);
        file.optional = true;
        file.path = model.workspace.connection_list_path().display().to_string();
        Self { file, series: ControllerSeries::ASSUMED, new: Vec::new(), left_out: Vec::new() }
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

    pub(in crate::ui) fn take_in(&mut self, bytes: &[u8], model: &Model) -> Result<(), Problem> {
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

impl UiCommand {
    /// Registers the controllers of a connection list.
    pub const CONNECTION_LIST: Self =
        Self::new(TextKey::ConnectionList, TextKey::ConnectionListTip, |model, _| model.open_connection_list())
            .in_menu(TextKey::MenuController);
}

impl Dialog for ConnectionListForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, place.focus, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        if self.reads_file() {
            model.put_back(self);
            return model.read_typed();
        }
        if self.ticked() == 0 {
            model.put_back(self);
            return vec![];
        }
        model.import_connections(*self)
    }

    fn file(&mut self) -> Option<&mut FileForm> {
        Some(&mut self.file)
    }

    fn take_in_file(&mut self, bytes: &[u8], model: &Model) -> Result<(), Problem> {
        self.take_in(bytes, model)
    }
}

impl Model {
    pub(in crate::ui) fn open_connection_list(&mut self) -> Vec<BackendCommand> {
        self.open(ConnectionListForm::new(self));
        self.read_typed()
    }

    pub(in crate::ui) fn open_connection_list_of(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        let mut form = ConnectionListForm::new(self);
        form.file.path = first_path(&paths);
        form.file.optional = false;
        self.open(form);
        self.read_typed()
    }

    /// Adds what is ticked, and ticks nothing but it: what to do next is to confirm who they are.
    pub(in crate::ui) fn import_connections(&mut self, form: ConnectionListForm) -> Vec<BackendCommand> {
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
