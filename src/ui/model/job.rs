use std::path::PathBuf;

use super::{JobId, RowId, RowState, Task};
use crate::jobs::{JobSummary, TrustUndo};
use crate::model::{DisconnectedClient, Problem};

/// Whether a running job is to be stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CancelState {
    /// The job goes on; the default.
    #[default]
    No,
    /// "Stop after the step in hand?" is shown.
    Asking,
    /// The jobs were told; controllers in hand finish their step.
    Sent,
}

/// One controller of a job.
#[derive(Debug)]
pub struct JobRow {
    /// Its row in the table.
    pub row: RowId,
    /// Its name, kept in case the row is deleted meanwhile.
    pub name: String,
    /// Where the job is with it.
    pub state: RowState,
    /// The file on this computer that was written.
    pub written: Option<PathBuf>,
    /// The file on this computer whose content is in the controller now.
    pub used: Option<PathBuf>,
    /// Where files on this computer are now that had to make room.
    pub moved_aside: Vec<PathBuf>,
    /// Whose connections the change ended.
    pub cut: Vec<DisconnectedClient>,
    /// What takes a change of whom it trusts back.
    pub undo: Option<TrustUndo>,
}

/// A job, running or ended.
#[derive(Debug)]
pub struct Job {
    /// Names it in events.
    pub id: JobId,
    /// What is done.
    pub task: Task,
    /// Its controllers, in the order of the indexes in events.
    pub rows: Vec<JobRow>,
    /// Controllers that succeeded or failed so far.
    pub finished: usize,
    /// Controllers that failed so far.
    pub failed: usize,
    /// Whether it is to be cancelled.
    pub cancel: CancelState,
    /// Set when it has ended.
    pub summary: Option<JobSummary>,
}

impl JobRow {
    /// A controller whose turn has not come.
    pub fn new(row: RowId, name: String) -> Self {
        Self {
            row,
            name,
            state: RowState::Waiting,
            written: None,
            used: None,
            moved_aside: Vec::new(),
            cut: Vec::new(),
            undo: None,
        }
    }
}

impl Job {
    /// The names of its controllers.
    pub fn names(&self) -> Vec<String> {
        self.rows.iter().map(|row| row.name.clone()).collect()
    }

    /// Why it failed, for the first controller that it failed for.
    pub fn first_problem(&self) -> Option<&Problem> {
        self.rows.iter().find_map(|row| row.state.problem())
    }

    /// The position of that controller.
    pub fn first_failed(&self) -> Option<usize> {
        self.rows.iter().position(|row| row.state.problem().is_some())
    }

    /// The controllers that failed because no password is known.
    pub fn without_password(&self) -> Vec<RowId> {
        self.rows.iter().filter(|row| row.state.needs_password()).map(|row| row.row).collect()
    }
}
