//! The server log of one controller (manual 6.3).

mod view;

use std::ops::Range;
use std::path::{Path, PathBuf};

use egui::Ui;

use crate::jobs::{BasicSettingsChange, LogPart, ReadLog, SaveLog, SetBasicSettings};
use crate::model::{LogChunk, untrusted_text};
use crate::texts::TextKey;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, Task, UiCommand};

/// The end of the log, as it was read last.
#[derive(Debug)]
pub struct LogView {
    pub row: RowId,
    pub name: String,
    pub reading: bool,
    /// `None`: not read yet.
    log: Option<LogChunk>,
    /// Where the lines are in the text.
    lines: Vec<Range<usize>>,
    /// Characters of the longest line.
    longest: usize,
    pub filter: String,
    /// Indices into `lines`: those the filter lets through.
    shown: Vec<usize>,
}

impl LogView {
    pub fn new(row: RowId, name: String) -> Self {
        Self {
            row,
            name,
            reading: true,
            log: None,
            lines: Vec::new(),
            longest: 0,
            filter: String::new(),
            shown: Vec::new(),
        }
    }

    pub fn fill(&mut self, mut log: LogChunk) {
        log.text = untrusted_text::lines(&log.text);
        let mut start = 0;
        let line = |line: &str| {
            let begin = start;
            start += line.len();
            begin..begin + line.trim_end_matches(['\r', '\n']).len()
        };
        self.lines = log.text.split_inclusive('\n').map(line).collect();
        self.longest = log.text.lines().map(|line| line.chars().count()).max().unwrap_or_default();
        self.log = Some(log);
        self.reading = false;
        self.find();
    }

    /// Applies the filter; to be called when it has changed.
    pub fn find(&mut self) {
        let needle = self.filter.trim().to_lowercase();
        let text = self.text();
        let matches = |line: &Range<usize>| needle.is_empty() || text[line.clone()].to_lowercase().contains(&needle);
        self.shown = (0..self.lines.len()).filter(|at| matches(&self.lines[*at])).collect();
    }

    fn text(&self) -> &str {
        self.log.as_ref().map_or("", |log| &log.text)
    }

    pub fn is_read(&self) -> bool {
        self.log.is_some()
    }

    /// Bytes of the whole log in the controller, and of the end of it that is here.
    pub fn size(&self) -> (u64, u64) {
        self.log.as_ref().map_or((0, 0), |log| (log.size, log.size.saturating_sub(log.from)))
    }

    pub fn lines(&self) -> usize {
        self.lines.len()
    }

    pub fn longest(&self) -> usize {
        self.longest
    }

    /// How many lines the filter lets through.
    pub fn shown(&self) -> usize {
        self.shown.len()
    }

    /// A line the filter lets through.
    pub fn line(&self, at: usize) -> &str {
        self.shown.get(at).map_or("", |index| &self.text()[self.lines[*index].clone()])
    }

    /// What is shown, to be pasted elsewhere.
    pub fn copied(&self) -> String {
        (0..self.shown()).flat_map(|at| [self.line(at), "\n"]).collect()
    }
}

/// Where the server log of one controller is to be saved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SaveLogForm {
    /// The row of the controller.
    pub row: RowId,
    /// The name of the controller.
    pub name: String,
    /// As it is typed.
    pub path: String,
}

impl SaveLogForm {
    /// Why it cannot be saved yet.
    pub fn incomplete(&self) -> Option<TextKey> {
        self.typed().is_empty().then_some(TextKey::FileRule)
    }

    /// The file. A relative path starts at the workspace.
    pub(in crate::ui) fn target(&self, root: &Path) -> PathBuf {
        root.join(self.typed())
    }

    /// File managers put quotes around a path they copy.
    fn typed(&self) -> &str {
        self.path.trim().trim_matches('"')
    }
}

fn read_log() -> Task {
    Task::with_results(TextKey::ServerLog, ReadLog { part: LogPart::End }, |model, _, result| {
        if let (Ok(chunk), Some(log)) = (result, model.dialog::<LogView>()) {
            log.fill(chunk);
        }
        vec![]
    })
    .for_dialog::<LogView>()
}

impl UiCommand {
    /// Shows the server log of one controller.
    pub const SERVER_LOG: Self = Self::new(TextKey::ServerLogCommand, TextKey::ServerLogTip, |model, rows| {
        rows.first().map(|row| model.open_log(*row)).unwrap_or_default()
    })
    .in_menu(TextKey::MenuServer)
    .for_controllers()
    .disabled_if(|model, targets| (model.target_count(targets) > 1).then_some(TextKey::WhyOne));
}

impl Dialog for LogView {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, model, messages)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.drop_job()
    }

    /// Its text field filters.
    fn enter_submits(&self, _model: &Model) -> bool {
        false
    }

    /// What was read before is still worth reading.
    fn stays_after_failure(&mut self) -> bool {
        self.reading = false;
        self.is_read()
    }
}

impl Dialog for SaveLogForm {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::save(ui, self, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.save_log(self)
    }
}

impl Model {
    /// Proposes a file in the controller's folder of the workspace.
    pub(in crate::ui) fn ask_where_to_save_log(&mut self) -> Vec<BackendCommand> {
        let Some(log) = self.top::<LogView>() else { return vec![] };
        let (row, name) = (log.row, log.name.clone());
        let serial = self.rows.get(row).and_then(|row| row.info()).map(|info| info.serial.folder_name());
        let folder = self.workspace.root().join(serial.unwrap_or_default());
        let file = format!("server-log-{}.txt", self.now.format("%Y%m%dT%H%M%SZ"));
        let path = folder.join(file).display().to_string();
        self.open(SaveLogForm { row, name, path });
        vec![]
    }

    fn save_log(&mut self, form: Box<SaveLogForm>) -> Vec<BackendCommand> {
        if form.incomplete().is_some() {
            self.put_back(form);
            return vec![];
        }
        let path = form.target(self.workspace.root());
        self.start(Task::new(TextKey::SaveLogTitle, SaveLog { path }), vec![form.row], None)
    }

    pub(in crate::ui) fn open_log(&mut self, row: RowId) -> Vec<BackendCommand> {
        let name = self.rows.names(&[row]).pop().unwrap_or_default();
        self.open(LogView::new(row, name));
        self.start(read_log(), vec![row], None)
    }

    /// Reads it again; what was read stays on the screen meanwhile.
    pub(in crate::ui) fn refresh_log(&mut self) -> Vec<BackendCommand> {
        let Some(log) = self.dialog::<LogView>() else { return vec![] };
        log.reading = true;
        let row = log.row;
        self.start(read_log(), vec![row], None)
    }

    pub(in crate::ui) fn delete_log(&mut self) -> Vec<BackendCommand> {
        match self.top::<LogView>() {
            Some(log) if !log.reading => {
                let row = log.row;
                let change = BasicSettingsChange { delete_log: true, ..BasicSettingsChange::default() };
                let operation = SetBasicSettings { change, ..SetBasicSettings::default() };
                let task = Task::new(TextKey::DeleteLog, operation).act(TextKey::DeleteLog);
                self.plan(task.on_closed(Model::refresh_log), vec![row])
            }
            _ => vec![],
        }
    }
}
