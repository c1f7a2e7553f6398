//! The server log of one controller (manual 6.3).

use std::ops::Range;

use super::{Dialog, Model, Purpose, RowId, Task};
use crate::protocol::LogChunk;
use crate::ui::backend::Command;

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

    pub fn fill(&mut self, log: LogChunk) {
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

impl Model {
    pub(super) fn open_log(&mut self, row: RowId) -> Vec<Command> {
        let name = self.rows.names(&[row]).pop().unwrap_or_default();
        self.dialogs.push(Dialog::ServerLog(LogView::new(row, name)));
        self.start(Task::ReadLog, vec![row], Purpose::LoadLog, None)
    }

    /// Reads it again; what was read stays on the screen meanwhile.
    pub(super) fn refresh_log(&mut self) -> Vec<Command> {
        let Some(Dialog::ServerLog(log)) = self.form() else { return vec![] };
        log.reading = true;
        let row = log.row;
        self.start(Task::ReadLog, vec![row], Purpose::LoadLog, None)
    }

    pub(super) fn delete_log(&mut self) -> Vec<Command> {
        match self.dialogs.last() {
            Some(Dialog::ServerLog(log)) if !log.reading => {
                let row = log.row;
                self.plan(Task::DeleteLog, vec![row])
            }
            _ => vec![],
        }
    }
}
