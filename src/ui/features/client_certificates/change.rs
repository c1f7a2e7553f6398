//! What is done to the lists of one controller: delete, move, undo.

use std::collections::BTreeMap;

use super::{Freshness, LastTrustChange, PaneKind, TrustAction, TrustForm, view};
use crate::jobs::{MoveClients, Operation, RemoveClients, RemoveCrls, TrustChange, TrustNote, UndoTrust};
use crate::model::{ErrorCode, Problem, RevisionToken};
use crate::texts::TextKey;
use crate::ui::model::{BackendCommand, Model, RowId, Task};

/// What is to be deleted, to be agreed to.
#[derive(Debug)]
pub struct DeleteTrust {
    pub name: String,
    pub from: PaneKind,
    /// Id, and what it is called.
    pub what: Vec<(String, String)>,
    revision: Option<RevisionToken>,
}

/// What is to be moved into a list, although there is something to think about.
#[derive(Debug)]
pub struct MoveTrust {
    pub name: String,
    pub to: PaneKind,
    /// What the certificates are called, and what is noted about them.
    pub notes: Vec<(String, Vec<TrustNote>)>,
    from: PaneKind,
    thumbprints: Vec<String>,
}

/// A task that changes the lists of controllers: the processing dialog shows who was disconnected, and can take the
/// changes back.
pub fn change_task(title: TextKey, operation: impl Operation<Output = TrustChange> + 'static) -> Task {
    Task::with_results(title, operation, keep_change).footer(view::changed)
}

/// Keeps what a job changed in the lists of one of its controllers, for the processing dialog to show.
fn keep_change(model: &mut Model, row: RowId, result: Result<TrustChange, Problem>) -> Vec<BackendCommand> {
    let rows = model.job.iter_mut().flat_map(|job| &mut job.rows);
    if let (Ok(change), Some(row)) = (result, rows.into_iter().find(|of| of.row == row)) {
        (row.cut, row.undo) = (change.cut, change.undo);
    }
    vec![]
}

impl Model {
    /// Does what was asked for in one of these dialogs.
    pub fn trust_action(&mut self, action: TrustAction) -> Vec<BackendCommand> {
        match action {
            TrustAction::Add(kind) => return self.add_to(kind),
            TrustAction::Delete(kind) => self.ask_delete(kind),
            TrustAction::Move { from, to } => return self.move_clients(from, to),
            TrustAction::Undo => return self.undo_trust(),
            TrustAction::Details => self.open_details(),
            TrustAction::Reconnect => return self.reconnect(),
            TrustAction::ChooseFiles => return self.choose_trust_files(),
            TrustAction::ReadTyped => return self.read_typed_trust(),
            TrustAction::LeaveOut(index) => self.leave_out(index),
            TrustAction::Replan => self.replan(),
        }
        vec![]
    }

    /// The form on top, if another change may be made to it now.
    fn changing(&mut self) -> Option<&mut TrustForm> {
        match self.top_mut::<TrustForm>() {
            Some(form) if form.is_ready() => Some(form),
            _ => None,
        }
    }

    fn ask_delete(&mut self, kind: PaneKind) {
        let Some(form) = self.changing() else { return };
        let chosen = form.pane(kind).map(|pane| pane.chosen()).unwrap_or_default();
        let what: Vec<_> = chosen.into_iter().map(|entry| (entry.id.clone(), entry.issued_to.clone())).collect();
        if what.is_empty() {
            return;
        }
        let revision = form.held.as_ref().map(|held| held.revision);
        let asked = DeleteTrust { name: form.name.clone(), from: kind, what, revision };
        self.open(asked);
    }

    pub(in crate::ui) fn delete_trust(&mut self, asked: DeleteTrust) -> Vec<BackendCommand> {
        let count = asked.what.len();
        let ids = asked.what.into_iter().map(|(id, _)| id).collect();
        let (done, based_on) = (LastTrustChange::Deleted { from: asked.from, count }, asked.revision);
        match asked.from.list() {
            Some(list) => {
                let remove = RemoveClients { list: Some(list), thumbprints: ids, based_on };
                self.change(TextKey::TrustTitle, remove, done)
            }
            None => self.change(TextKey::CrlTitle, RemoveCrls { ids, based_on }, done),
        }
    }

    fn move_clients(&mut self, from: PaneKind, to: PaneKind) -> Vec<BackendCommand> {
        let Some(to_list) = to.list() else { return vec![] };
        let Some(form) = self.changing() else { return vec![] };
        let chosen = form.pane(from).map(|pane| pane.chosen()).unwrap_or_default();
        let thumbprints: Vec<String> = chosen.iter().map(|entry| entry.id.clone()).collect();
        if thumbprints.is_empty() {
            return vec![];
        }
        let names: BTreeMap<&str, &str> =
            chosen.iter().map(|entry| (entry.id.as_str(), entry.issued_to.as_str())).collect();
        let notes = form.held.as_ref().map(|held| held.notes_of_move(to_list, &thumbprints)).unwrap_or_default();
        let notes: Vec<(String, Vec<TrustNote>)> = notes
            .into_iter()
            .map(|(thumbprint, notes)| (names.get(thumbprint.as_str()).copied().unwrap_or_default().to_owned(), notes))
            .collect();
        if notes.is_empty() {
            return self.send_move(from, to, thumbprints, false);
        }
        let name = form.name.clone();
        self.open(MoveTrust { name, from, to, notes, thumbprints });
        vec![]
    }

    pub(in crate::ui) fn move_anyway(&mut self, asked: MoveTrust) -> Vec<BackendCommand> {
        self.send_move(asked.from, asked.to, asked.thumbprints, true)
    }

    fn send_move(
        &mut self,
        from: PaneKind,
        to: PaneKind,
        thumbprints: Vec<String>,
        accept_notes: bool,
    ) -> Vec<BackendCommand> {
        let (Some(list), Some(to_list)) = (from.list(), to.list()) else { return vec![] };
        let done = LastTrustChange::Moved { from, to, count: thumbprints.len() };
        // Other changes since then do not matter: the certificates are named by thumbprint.
        let relist = MoveClients { from: list, to: to_list, thumbprints, accept_notes, based_on: None };
        self.change(TextKey::TrustTitle, relist, done)
    }

    fn undo_trust(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.changing() else { return vec![] };
        let Some(undo) = form.undo.last().cloned() else { return vec![] };
        let row = form.row;
        let Some(name) = self.rows.get(row).map(|row| row.entry.name.clone()) else { return vec![] };
        self.change(TextKey::TrustUndoTitle, UndoTrust(BTreeMap::from([(name, undo)])), LastTrustChange::TakenBack)
    }

    /// Takes back what the job that ended did, in every controller it changed.
    pub(in crate::ui) fn undo_job(&mut self) -> Vec<BackendCommand> {
        let Some(job) = self.job.as_mut().filter(|job| job.summary.is_some()) else { return vec![] };
        let rows: Vec<(RowId, _)> = job.rows.iter_mut().filter_map(|row| Some((row.row, row.undo.take()?))).collect();
        let undo: BTreeMap<_, _> = rows
            .iter()
            .filter_map(|(row, undo)| Some((self.rows.get(*row)?.entry.name.clone(), undo.clone())))
            .collect();
        if undo.is_empty() {
            return vec![];
        }
        self.end_processing();
        let rows = rows.into_iter().map(|(row, _)| row).collect();
        let task = change_task(TextKey::TrustUndoTitle, UndoTrust(undo)).act(TextKey::TrustUndo);
        self.start(task, rows, None)
    }

    /// Makes a change to the lists of the one controller, without a dialog of its own.
    pub(in crate::ui) fn change(
        &mut self,
        title: TextKey,
        operation: impl Operation<Output = TrustChange> + 'static,
        done: LastTrustChange,
    ) -> Vec<BackendCommand> {
        let Some(form) = self.dialog::<TrustForm>().filter(|form| form.is_ready()) else { return vec![] };
        form.busy = true;
        form.doing = Some(done);
        let row = form.row;
        let task = Task::with_results(title, operation, |model, _, result| {
            if let Ok(change) = result {
                model.changed(change);
            }
            vec![]
        });
        let task =
            task.for_dialog::<TrustForm>().on_end(Self::trust_job_ended).without_password(Self::trust_without_password);
        self.start(task, vec![row], None)
    }

    fn changed(&mut self, change: TrustChange) {
        let now = self.now;
        let Some(form) = self.dialog::<TrustForm>() else { return };
        let done = form.doing.take();
        if done == Some(LastTrustChange::TakenBack) {
            form.undo.pop();
        } else {
            form.undo.extend(change.undo);
        }
        if let Some(LastTrustChange::Deleted { from, .. } | LastTrustChange::Moved { from, .. }) = &done
            && let Some(pane) = form.pane_mut(*from)
        {
            pane.untick();
        }
        form.done = done;
        form.cut = change.cut;
        form.fill(Box::new(change.lists), now);
    }

    /// The job of the form ended; if it failed, the form stays with what it has, if it has anything.
    pub(in crate::ui) fn trust_job_ended(&mut self) -> Vec<BackendCommand> {
        let job = self.job.take();
        let problem = job.and_then(|job| job.rows.into_iter().find_map(|row| row.state.problem().cloned()));
        if let Some(form) = self.dialog::<TrustForm>() {
            form.busy = false;
            form.doing = None;
        }
        if let Some(problem) = problem {
            self.trust_failed(problem);
        }
        vec![]
    }

    /// The password was not given.
    pub(in crate::ui) fn trust_without_password(&mut self) -> Vec<BackendCommand> {
        self.job = None;
        match self.dialog::<TrustForm>() {
            Some(form) if form.held.is_some() => {
                form.busy = false;
                form.doing = None;
                if form.link == Freshness::Reading {
                    form.link = Freshness::Ended(ErrorCode::PasswordMissing.into());
                }
            }
            _ => self.drop_trust(),
        }
        vec![]
    }

    fn trust_failed(&mut self, problem: Problem) {
        match self.dialog::<TrustForm>() {
            Some(form) if form.held.is_some() => {
                if form.link == Freshness::Reading {
                    form.link = Freshness::Ended(problem.clone());
                }
            }
            _ => self.drop_trust(),
        }
        self.show_problem(problem);
    }

    /// Closes a form that has nothing to show.
    fn drop_trust(&mut self) {
        self.close_all::<TrustForm>();
    }
}
