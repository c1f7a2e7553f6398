//! The lists as the controller reports them.

use super::{Freshness, ShownLists, TrustForm};
use crate::jobs::{JobController, ListTrust, TrustSnapshot, WatchEvent};
use crate::texts::TextKey;
use crate::ui::model::{BackendCommand, JobId, Model, RowId, Task};

fn list_trust() -> Task {
    let task = Task::with_results(TextKey::TrustTitle, ListTrust, |model, _, result| match result {
        Ok(held) => model.watch(Box::new(held)),
        Err(_) => vec![],
    });
    task.for_dialog::<TrustForm>().on_end(Model::trust_job_ended).without_password(Model::trust_without_password)
}

impl Model {
    /// For one controller its lists, for several what adds to them (manual 2.7.3.3, 2.7.3.6).
    pub(in crate::ui) fn open_trust(&mut self, shows: ShownLists, rows: Vec<RowId>) -> Vec<BackendCommand> {
        let [row] = rows[..] else {
            self.open_add_trust(shows, rows);
            return vec![];
        };
        let name = self.rows.names(&rows).pop().unwrap_or_default();
        self.open(TrustForm::new(row, name, shows, self.zone, self.now));
        self.start(list_trust(), rows, None)
    }

    /// The lists were read for the first time, or again: from now on they are watched.
    pub(in crate::ui) fn watch(&mut self, held: Box<TrustSnapshot>) -> Vec<BackendCommand> {
        let (job, now) = (self.next_job(), self.now);
        let Some(form) = self.dialog::<TrustForm>() else { return vec![] };
        form.fill(held, now);
        form.link = Freshness::Live;
        let before = form.watch.replace(job);
        let pending = std::mem::take(&mut form.pending);
        let row = form.row;
        let Some(controller) = self.rows.get(row).map(|row| JobController::from(&row.entry)) else { return vec![] };
        let mut commands: Vec<BackendCommand> = before.map(BackendCommand::Cancel).into_iter().collect();
        commands.push(BackendCommand::WatchTrust { job, controller: Box::new(controller) });
        if !pending.is_empty() {
            commands.extend(self.dropped_trust(pending));
        }
        commands
    }

    pub(in crate::ui) fn trust_seen(&mut self, job: JobId, event: WatchEvent) {
        let now = self.now;
        let Some(form) = self.dialog::<TrustForm>().filter(|form| form.watch == Some(job)) else { return };
        match event {
            WatchEvent::Lists(held) => {
                form.link = Freshness::Live;
                form.fill(held, now);
                self.replan();
            }
            WatchEvent::Lost(problem) => form.link = Freshness::Lost(problem),
            WatchEvent::Ended(problem) => {
                form.link = Freshness::Ended(problem);
                form.watch = None;
            }
        }
    }

    /// Reads the lists again; a missing password is asked for.
    pub(in crate::ui) fn reconnect(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.dialog::<TrustForm>().filter(|form| !form.busy) else { return vec![] };
        form.link = Freshness::Reading;
        let row = form.row;
        self.start(list_trust(), vec![row], None)
    }

    /// The dialog was closed: watching ends.
    pub(in crate::ui) fn close_trust(&mut self, form: &TrustForm) -> Vec<BackendCommand> {
        let mut commands = self.drop_job();
        commands.extend(form.watch.map(BackendCommand::Cancel));
        commands
    }
}
