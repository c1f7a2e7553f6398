//! Starting jobs, and what their events change in the window.

use secrecy::SecretString;

use crate::jobs::JobController;
use crate::model::{ErrorCode, ServerStatus};
use crate::ui::model::{
    BackendCommand, CancelState, Dialog, Job, JobId, JobRow, LastResult, Model, RowId, RowState, SecretInput, Task,
    TaskEvent,
};
use crate::ui::shell::confirm::ConfirmDialog;
use crate::ui::shell::password::PasswordDialog;
use crate::ui::shell::processing::ProcessingDialog;

impl Model {
    /// Asks first when the task changes something, else starts it.
    pub(in crate::ui) fn plan(&mut self, task: Task, rows: Vec<RowId>) -> Vec<BackendCommand> {
        match task.confirmation() {
            Some(confirmation) => {
                let names = self.rows.names(&rows);
                self.open(ConfirmDialog { task, rows, names, confirmation });
                vec![]
            }
            None => self.start(task, rows, None),
        }
    }

    pub(in crate::ui) fn start(
        &mut self,
        task: Task,
        rows: Vec<RowId>,
        password: Option<secrecy::SecretString>,
    ) -> Vec<BackendCommand> {
        let id = self.next_job();
        let entries: Vec<_> = rows.iter().filter_map(|row| self.rows.get(*row)).collect();
        let controllers: Vec<JobController> = entries.iter().map(|row| JobController::from(&row.entry)).collect();
        let rows = entries.iter().map(|row| JobRow::new(row.id, row.entry.name.to_string())).collect::<Vec<_>>();
        self.status = None;
        if task.is_shown {
            for row in &rows {
                self.rows.set_live(row.row, Some(RowState::Waiting));
            }
            let over_form = !self.dialogs.is_empty();
            self.open(ProcessingDialog { over_form, ..ProcessingDialog::default() });
        }
        self.job =
            Some(Job { id, task: task.clone(), rows, finished: 0, failed: 0, cancel: CancelState::No, summary: None });
        vec![BackendCommand::Run { job: id, controllers, task, parallelism: self.options.parallelism, password }]
    }

    /// Stops waiting for the job of a form that was closed.
    pub(in crate::ui) fn drop_job(&mut self) -> Vec<BackendCommand> {
        match self.job.take() {
            Some(job) if job.summary.is_none() => vec![BackendCommand::Cancel(job.id)],
            _ => vec![],
        }
    }

    pub(in crate::ui) fn job_event(&mut self, id: JobId, event: TaskEvent) -> Vec<BackendCommand> {
        let Some(job) = self.job.as_mut().filter(|job| job.id == id) else { return vec![] };
        match event {
            TaskEvent::Step { index, step } => {
                if let Some(row) = job.rows.get_mut(index) {
                    row.state = RowState::Step(step);
                    if job.task.is_shown {
                        self.rows.set_live(row.row, Some(RowState::Step(step)));
                    }
                }
                vec![]
            }
            TaskEvent::Finished { index, report } => {
                let is_shown = job.task.is_shown;
                let Some(row) = job.rows.get_mut(index) else { return vec![] };
                row.state = match &report.result {
                    Ok(facts) => {
                        (row.written, row.used) = (facts.written.clone(), facts.used.clone());
                        row.moved_aside.clone_from(&facts.moved_aside);
                        RowState::Done
                    }
                    Err(problem) if problem.code == ErrorCode::Cancelled => RowState::NotStarted,
                    Err(problem) => RowState::Failed(problem.clone()),
                };
                let (row, state) = (row.row, row.state.clone());
                job.finished += 1;
                job.failed += usize::from(state.problem().is_some());
                if is_shown {
                    let result = LastResult { title: job.task.title, at: self.now, state: state.clone() };
                    self.rows.set_result(row, result);
                    self.rows.set_live(row, Some(state));
                }
                if let Some(info) = report.info.clone() {
                    self.rows.set_info(row, info, self.now);
                }
                report.deliver(self, row)
            }
        }
    }

    /// Passwords were asked for, and none was given.
    pub(in crate::ui) fn without_password(&mut self, task: &Task) -> Vec<BackendCommand> {
        if let Some(hook) = task.password_hook() {
            return hook(self);
        }
        if !task.is_shown {
            task.close_waiting(self);
            self.job = None;
        } else {
            let failed = self.job.as_ref().and_then(Job::first_failed);
            if let Some(view) = self.top_mut::<ProcessingDialog>() {
                view.selected = view.selected.or(failed);
            }
        }
        vec![]
    }

    pub(in crate::ui) fn end_processing(&mut self) {
        self.close_all::<ProcessingDialog>();
        self.rows.clear_live();
        self.job = None;
    }

    pub(in crate::ui) fn keep_going(&mut self) {
        if let Some(job) = &mut self.job
            && job.cancel == CancelState::Asking
        {
            job.cancel = CancelState::No;
        }
    }

    pub(in crate::ui) fn ask_connection_passwords(&mut self) {
        let Some(job) = self.job.as_ref().filter(|job| job.summary.is_some()) else { return };
        let rows = job.without_password();
        if rows.is_empty() {
            return;
        }
        let wrong = job
            .rows
            .iter()
            .any(|row| row.state.problem().is_some_and(|problem| problem.code == ErrorCode::WrongPassword));
        self.open(PasswordDialog {
            names: self.rows.names(&rows),
            rows,
            password: SecretInput::default(),
            show_password: false,
            wrong,
            task: job.task.clone(),
        });
    }

    /// The controllers whose server runs anew after the job that has ended.
    pub fn changed_servers(&self) -> Vec<RowId> {
        let Some(job) = self.job.as_ref().filter(|job| job.summary.is_some() && job.task.restarts_server) else {
            return vec![];
        };
        let runs = |row: RowId| {
            let info = self.rows.get(row).and_then(|row| row.info());
            info.is_some_and(|info| info.status == ServerStatus::Run)
        };
        job.rows.iter().filter(|row| row.state == RowState::Done && runs(row.row)).map(|row| row.row).collect()
    }

    /// Tries a job again with controllers whose password is known by now.
    pub(in crate::ui) fn start_again(
        &mut self,
        task: Task,
        rows: Vec<RowId>,
        password: Option<SecretString>,
    ) -> Vec<BackendCommand> {
        if task.is_shown {
            self.end_processing();
        }
        self.start(task, rows, password)
    }

    pub(in crate::ui) fn cancel_last(&mut self) -> Vec<BackendCommand> {
        let job = JobId(self.last_job);
        self.next_job();
        vec![BackendCommand::Cancel(job)]
    }

    /// Asks for what a form plans; keeps the form under the confirmation, so that Cancel leads back to it.
    pub(in crate::ui) fn ask(
        &mut self,
        form: Box<dyn Dialog>,
        planned: Option<(Task, Vec<RowId>)>,
    ) -> Vec<BackendCommand> {
        self.put_back(form);
        match planned {
            Some((task, rows)) => self.plan(task, rows),
            None => vec![],
        }
    }
}
