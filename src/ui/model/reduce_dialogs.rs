//! What the dialogs do: open, submit, close, and what arrives for them.

use std::collections::BTreeSet;

use secrecy::SecretString;

use super::reduce::get_info;
use super::trust::TrustAction;
use super::{
    AddStage, AddUserForm, CancelState, Dialog, JobId, Model, RowId, SelfSignedForm, SettingsForm, Task, Typed,
    UsersForm,
};
use crate::jobs::{self, Enrolled, RemoveUsers};
use crate::model::{Credentials, FileFormat, Problem, RevisionToken};
use crate::pki::Fingerprint;
use crate::texts::{self, TextKey};
use crate::ui::backend::Command;
use crate::workspace::{ControllerEntry, Retrieved};

impl Model {
    pub(super) fn open_settings(&mut self, rows: Vec<RowId>) -> Vec<Command> {
        let form = SettingsForm::new(rows.clone(), self);
        let reading = form.reading;
        self.dialogs.push(Dialog::Settings(form));
        if reading { self.start(read_settings(), rows, None) } else { vec![] }
    }

    pub(super) fn open_users(&mut self, rows: Vec<RowId>) -> Vec<Command> {
        match rows[..] {
            [row] => {
                let name = self.rows.names(&rows).pop().unwrap_or_default();
                self.dialogs.push(Dialog::Users(UsersForm {
                    row,
                    name,
                    reading: true,
                    revision: None,
                    users: Vec::new(),
                    ticked: BTreeSet::new(),
                }));
                self.start(list_users(), rows, None)
            }
            _ => {
                self.push_add_user(rows, None, Vec::new());
                vec![]
            }
        }
    }

    /// For a certificate, or for a request in this format.
    pub(super) fn open_self_signed(&mut self, rows: Vec<RowId>, request: Option<FileFormat>) -> Vec<Command> {
        let form = SelfSignedForm::new(rows.clone(), request, self);
        let reading = form.reading;
        self.dialogs.push(Dialog::SelfSigned(form));
        if reading { self.start(read_policies(), rows, None) } else { vec![] }
    }

    fn push_add_user(
        &mut self,
        rows: Vec<RowId>,
        revision: Option<RevisionToken>,
        existing: Vec<crate::model::UserName>,
    ) {
        self.dialogs.push(Dialog::AddUser(AddUserForm {
            names: self.rows.names(&rows),
            rows,
            revision,
            existing,
            name: String::new(),
            password: Typed::default(),
            show_password: false,
        }));
    }

    pub(super) fn new_user(&mut self) {
        if let Some(Dialog::Users(form)) = self.dialogs.last() {
            let (rows, revision, users) = (vec![form.row], form.revision, form.users.clone());
            self.push_add_user(rows, revision, users);
        }
    }

    pub(super) fn new_csr(&mut self) -> Vec<Command> {
        match self.dialogs.last() {
            Some(Dialog::CaSigned(form)) => self.open_self_signed(form.rows.clone(), Some(FileFormat::default())),
            _ => vec![],
        }
    }

    pub(super) fn delete_users(&mut self) -> Vec<Command> {
        let Some(Dialog::Users(form)) = self.dialogs.last() else { return vec![] };
        if form.ticked.is_empty() {
            return vec![];
        }
        let names = form.ticked.iter().cloned().collect();
        let remove = RemoveUsers { names, based_on: form.revision };
        let task = Task::new(TextKey::DeleteUsers, remove).act(TextKey::DeleteUsers).restarts_server();
        let task = task.on_closed(Model::reload_users);
        let row = form.row;
        self.plan(task, vec![row])
    }

    /// The main button of the dialog on top.
    pub(super) fn submit(&mut self) -> Vec<Command> {
        let Some(dialog) = self.dialogs.pop() else { return vec![] };
        match dialog {
            Dialog::AddController(form) => self.submit_controller(form),
            Dialog::Delete { rows, .. } => self.delete(&rows),
            Dialog::Password(form) => {
                let password = SecretString::from(form.password.0.clone());
                self.go_on(form.task, form.rows, Some(password))
            }
            Dialog::Vault(form) => self.submit_vault(form),
            Dialog::Confirm { task, rows, .. } => {
                // The form that asked for it has done its work.
                if self.dialogs.last().is_some_and(Dialog::is_done_by_confirming) {
                    self.dialogs.pop();
                }
                self.start(task, rows, None)
            }
            Dialog::Settings(form) => {
                let planned = form.operation().map(|operation| (set_settings(operation), form.rows.clone()));
                self.ask(Dialog::Settings(form), planned)
            }
            Dialog::AddUser(form) => {
                let planned = form.operation().map(|operation| (add_user(operation), form.rows.clone()));
                self.ask(Dialog::AddUser(form), planned)
            }
            Dialog::SelfSigned(form) => {
                let planned = form.task(self).map(|task| (task, form.rows.clone()));
                self.ask(Dialog::SelfSigned(form), planned)
            }
            Dialog::Activation(form) if form.reads_file() => {
                self.dialogs.push(Dialog::Activation(form));
                self.read_typed()
            }
            Dialog::Activation(form) => {
                let task = |operation| Task::new(TextKey::ActivationTitle, operation).act(TextKey::ActActivate);
                let planned = form.operation().map(|operation| (task(operation), form.rows.clone()));
                self.ask(Dialog::Activation(form), planned)
            }
            Dialog::ConnectionList(form) if form.reads_file() => {
                self.dialogs.push(Dialog::ConnectionList(form));
                self.read_typed()
            }
            Dialog::ConnectionList(form) if form.ticked() == 0 => {
                self.dialogs.push(Dialog::ConnectionList(form));
                vec![]
            }
            Dialog::ConnectionList(form) => self.import_connections(form),
            Dialog::TypeSelect(form) => {
                let planned = form.task().map(|task| (task, form.rows.clone()));
                self.ask(Dialog::TypeSelect(form), planned)
            }
            Dialog::ExportSelfSigned(form) => {
                let planned = (form.task(&self.workspace), form.rows.clone());
                self.ask(Dialog::ExportSelfSigned(form), Some(planned))
            }
            Dialog::CaSigned(form) => self.check_ca_signed(form),
            Dialog::UserSpecified(form) => self.check_user_specified(form),
            Dialog::Restore(form) => self.check_backup(form),
            Dialog::ImportReview(review) => self.import(review),
            Dialog::Verify(view) => self.verify_again(view),
            Dialog::Transfer(form) => {
                let planned = form.task(&self.workspace).map(|task| (task, form.rows.clone()));
                self.ask(Dialog::Transfer(form), planned)
            }
            Dialog::SaveLog(form) => self.save_log(form),
            Dialog::Trust(form) => {
                self.dialogs.push(Dialog::Trust(form));
                self.trust_action(TrustAction::Details);
                vec![]
            }
            Dialog::AddTrust(form) => self.submit_add_trust(form),
            Dialog::DeleteTrust(asked) => self.delete_trust(asked),
            Dialog::MoveTrust(asked) => self.move_anyway(asked),
            Dialog::Drop(form) if form.offers() => self.submit_dropped(form),
            Dialog::AuthorityForm(form) => self.submit_authority(form),
            Dialog::Backup { on } => {
                self.options.backup = on;
                self.save()
            }
            // Their main button is Close.
            other => {
                self.dialogs.push(other);
                self.close()
            }
        }
    }

    /// Tries a job again with controllers whose password is known by now.
    pub(super) fn go_on(&mut self, task: Task, rows: Vec<RowId>, password: Option<SecretString>) -> Vec<Command> {
        if task.is_shown {
            self.end_processing();
        }
        self.start(task, rows, password)
    }

    /// Keeps the form under the confirmation, so that Cancel leads back to it.
    fn ask(&mut self, form: Dialog, planned: Option<(Task, Vec<RowId>)>) -> Vec<Command> {
        self.dialogs.push(form);
        match planned {
            Some((task, rows)) => self.plan(task, rows),
            None => vec![],
        }
    }

    /// Cancel, Close or Esc.
    pub(super) fn close(&mut self) -> Vec<Command> {
        match self.dialogs.last_mut() {
            None => vec![],
            Some(Dialog::Processing(_)) => self.close_processing(),
            Some(Dialog::Vault(_)) => self.close_vault(),
            Some(Dialog::AddController(form)) if form.identity.is_some() => {
                let waiting = matches!(form.stage, AddStage::Probing | AddStage::Enrolling(_));
                self.dialogs.pop();
                if waiting { self.cancel_last() } else { vec![] }
            }
            Some(Dialog::AddController(form)) if form.stage != AddStage::Form => {
                let waiting = !matches!(form.stage, AddStage::Compare(_));
                form.stage = AddStage::Form;
                if waiting { self.cancel_last() } else { vec![] }
            }
            Some(Dialog::Password(form)) => {
                let task = form.task.clone();
                self.dialogs.pop();
                self.without_password(&task)
            }
            Some(Dialog::Trust(_)) => match self.dialogs.pop() {
                Some(Dialog::Trust(form)) => self.close_trust(&form),
                _ => vec![],
            },
            Some(dialog) if dialog.has_a_job() => {
                self.dialogs.pop();
                self.drop_job()
            }
            Some(_) => {
                self.dialogs.pop();
                vec![]
            }
        }
    }

    /// While the job runs: ask, then stop it. Afterwards: close.
    fn close_processing(&mut self) -> Vec<Command> {
        let Some(job) = &mut self.job else {
            self.end_processing();
            return vec![];
        };
        if job.summary.is_some() {
            let on_closed = job.task.closed_hook();
            self.end_processing();
            return on_closed.map(|hook| hook(self)).unwrap_or_default();
        }
        match job.cancel {
            CancelState::No => job.cancel = CancelState::Asking,
            CancelState::Asking => {
                job.cancel = CancelState::Sent;
                return vec![Command::Cancel(job.id)];
            }
            CancelState::Sent => {}
        }
        vec![]
    }

    fn reload_users(&mut self) -> Vec<Command> {
        let Some(Dialog::Users(form)) = self.form() else { return vec![] };
        form.reading = true;
        form.ticked.clear();
        let row = form.row;
        self.start(list_users(), vec![row], None)
    }

    fn delete(&mut self, rows: &[RowId]) -> Vec<Command> {
        let gone = self.rows.remove(rows);
        self.status = Some(texts::deleted(self.language, gone.len()));
        let forget = gone.iter().filter_map(|entry| entry.fingerprint).collect();
        let mut commands = self.save();
        commands.push(Command::Forget(forget));
        commands
    }

    fn submit_controller(&mut self, mut form: super::AddController) -> Vec<Command> {
        form.tried = true;
        form.problem = None;
        let target = form.target(self);
        let command = match (form.stage, target) {
            (AddStage::Form, Ok((_, address))) => {
                form.stage = AddStage::Probing;
                Some(Command::Probe { job: self.next_job(), connection: form.connection, address })
            }
            (AddStage::Compare(fingerprint), Ok((_, address))) => {
                form.stage = AddStage::Enrolling(fingerprint);
                let (connection, credentials) = (form.connection, Credentials::ConnectionPassword(form.secret()));
                Some(Command::Enroll { job: self.next_job(), connection, address, fingerprint, credentials })
            }
            // Shown beside the fields.
            (_, Err(_)) | (AddStage::Probing | AddStage::Enrolling(_), Ok(_)) => None,
        };
        self.dialogs.push(Dialog::AddController(form));
        command.into_iter().collect()
    }

    /// After it was not reached: it is added without a fingerprint, as those of a connection list.
    pub(super) fn add_unconfirmed(&mut self) -> Vec<Command> {
        let Some(Dialog::AddController(form)) = self.dialogs.last() else { return vec![] };
        if !form.may_be_unconfirmed() {
            return vec![];
        }
        let Ok((name, address)) = form.target(self) else { return vec![] };
        let entry = ControllerEntry::unconfirmed(name, address, form.series);
        self.dialogs.pop();
        self.status = Some(texts::added(self.language, entry.name.as_str()));
        self.rows.add(entry, self.now);
        self.save()
    }

    pub(super) fn cancel_last(&mut self) -> Vec<Command> {
        let job = JobId(self.last_job);
        self.next_job();
        vec![Command::Cancel(job)]
    }

    /// The dialog that waits for a controller, unless it was closed or tries another by now.
    fn adding(&mut self, job: JobId) -> Option<&mut super::AddController> {
        if job != JobId(self.last_job) {
            return None;
        }
        self.dialogs.iter_mut().find_map(|dialog| match dialog {
            Dialog::AddController(form) => Some(form),
            _ => None,
        })
    }

    pub(super) fn probed(&mut self, job: JobId, result: Result<Fingerprint, Problem>) {
        let Some(form) = self.adding(job).filter(|form| form.stage == AddStage::Probing) else { return };
        match result {
            Ok(fingerprint) => {
                form.stage = AddStage::Compare(fingerprint);
                form.focus_password = form.identity.is_some();
            }
            Err(problem) => {
                form.stage = AddStage::Form;
                form.problem = Some(problem);
            }
        }
    }

    pub(super) fn enrolled(&mut self, job: JobId, result: Result<Box<Enrolled>, Problem>) -> Vec<Command> {
        let now = self.now;
        let Some(form) = self.adding(job) else { return vec![] };
        let (identity, connection) = (form.identity.clone(), form.connection);
        let enrolled = match result {
            Ok(enrolled) => enrolled,
            Err(problem) => {
                form.stage = AddStage::Form;
                form.problem = Some(problem);
                return vec![];
            }
        };
        let (Ok(name), Ok(address)) = (form.name.parse(), form.address.parse()) else { return vec![] };
        let Enrolled { fingerprint, info, password_not_kept } = *enrolled;
        let entry = ControllerEntry {
            name,
            address,
            // What the controller says of itself counts.
            series: info.series,
            connection,
            fingerprint: Some(fingerprint),
            last: Some(Retrieved { at: now, info }),
        };
        if let Some(identity) = identity {
            self.rows.confirm(identity.row, entry, now);
            let mut commands = self.save();
            commands.extend(self.next_identity());
            if let Some(problem) = password_not_kept {
                self.first_password_not_kept(problem);
            }
            return commands;
        }
        self.dialogs.retain(|dialog| !matches!(dialog, Dialog::AddController(_)));
        self.status = Some(texts::added(self.language, entry.name.as_str()));
        self.rows.add(entry, now);
        if let Some(problem) = password_not_kept {
            self.first_password_not_kept(problem);
        }
        self.save()
    }

    pub(super) fn virtual_started(&mut self, result: Result<Vec<ControllerEntry>, Problem>) -> Vec<Command> {
        self.virtual_starting = false;
        let entries = match result {
            Ok(entries) => entries,
            Err(problem) => {
                self.show_problem(problem);
                return vec![];
            }
        };
        let now = self.now;
        let mut added = Vec::new();
        for entry in entries {
            if self.configuration().check_new(&entry.name, &entry.address).is_ok() {
                added.push(self.rows.add(entry, now));
            }
        }
        for row in &added {
            self.rows.tick(*row);
        }
        let mut commands = self.save();
        if !added.is_empty() {
            commands.extend(self.plan(get_info(), added));
        }
        commands
    }

    /// The form about controllers that is open, whatever is on top of it.
    pub(super) fn form(&mut self) -> Option<&mut Dialog> {
        self.dialogs.iter_mut().rev().find(|dialog| dialog.is_form())
    }

    /// Closes a form that has nothing to show.
    pub(super) fn drop_form(&mut self) {
        self.dialogs.retain_mut(|dialog| match dialog {
            // What was read before is still worth reading.
            Dialog::ServerLog(log) if log.is_read() => {
                log.reading = false;
                true
            }
            dialog => !dialog.is_form(),
        });
    }
}

fn read_settings() -> Task {
    Task::with_results(TextKey::SettingsTitle, jobs::ReadSettings, |model, _, result| {
        let (Ok(settings), Some(Dialog::Settings(form))) = (result, model.form()) else { return vec![] };
        form.reading = false;
        form.revision = Some(settings.revision);
        form.fill(settings.value);
        let rows = form.rows.clone();
        model.start(count_users(), rows, None)
    })
    .for_dialog()
}

/// For a warning only.
fn count_users() -> Task {
    Task::with_results(TextKey::UsersTitle, jobs::ListUsers, |model, _, result| {
        if let (Ok(users), Some(Dialog::Settings(form))) = (result, model.form()) {
            form.users = Some(users.value.len());
        }
        vec![]
    })
    .optional()
}

fn set_settings(operation: jobs::SetSettings) -> Task {
    Task::new(TextKey::SettingsTitle, operation).act(TextKey::ActSettings).restarts_server()
}

fn read_policies() -> Task {
    Task::with_results(TextKey::SettingsTitle, jobs::ReadSettings, |model, row, result| {
        let name = model.rows.get(row).and_then(|row| row.info()).map(|info| info.application_name.clone());
        if let (Ok(settings), Some(Dialog::SelfSigned(form))) = (result, model.form()) {
            form.reading = false;
            form.offer(&settings.value.security_policies);
            if let Some(name) = name.filter(|_| form.common_name.is_empty()) {
                form.common_name = name;
            }
        }
        vec![]
    })
    .for_dialog()
}

fn list_users() -> Task {
    Task::with_results(TextKey::UsersTitle, jobs::ListUsers, |model, _, result| {
        if let (Ok(users), Some(Dialog::Users(form))) = (result, model.form()) {
            form.reading = false;
            form.revision = Some(users.revision);
            form.users = users.value;
        }
        vec![]
    })
    .for_dialog()
}

fn add_user(operation: jobs::AddUser) -> Task {
    let task = Task::new(TextKey::AddUserTitle, operation).act(TextKey::AddUserTitle).restarts_server();
    task.on_closed(Model::reload_users)
}
