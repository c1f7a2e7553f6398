//! A controller to be added to the list (manual 2.5.1), or one of the list whose identity is confirmed.

mod form;
mod identity;
mod view;

use egui::{Key, Modifiers, Ui};

use crate::jobs::Enrolled;
use crate::model::{Credentials, Problem};
use crate::pki::Fingerprint;
use crate::texts::{self, TextKey as T};
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, JobId, Message, Model, UiCommand};
use crate::workspace::{ControllerEntry, RetrievedInfo};

pub use form::{AddControllerForm, AddStage, ConfirmIdentityForm};

impl UiCommand {
    /// Registers a controller.
    pub const ADD_CONTROLLER: Self = Self::new(T::AddController, T::AddControllerTip, |model, _| {
        model.open(AddControllerForm::new());
        vec![]
    })
    .in_menu(T::MenuController)
    .key(Modifiers::COMMAND, Key::N);
}

impl Dialog for AddControllerForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, place.focus, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.submit_controller(*self)
    }

    fn close(mut self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let waiting = self.is_waiting();
        if self.identity.is_none() && self.stage != AddStage::Form {
            self.stage = AddStage::Form;
            model.put_back(self);
        }
        if waiting { model.cancel_last() } else { vec![] }
    }
}

impl Model {
    fn submit_controller(&mut self, mut form: AddControllerForm) -> Vec<BackendCommand> {
        form.tried = true;
        form.problem = None;
        let target = form.target(self);
        let command = match (form.stage, target) {
            (AddStage::Form, Ok((_, address))) => {
                form.stage = AddStage::Probing;
                Some(BackendCommand::Probe { job: self.next_job(), connection: form.connection, address })
            }
            (AddStage::Compare(fingerprint), Ok((_, address))) => {
                form.stage = AddStage::Enrolling(fingerprint);
                let (connection, credentials) = (form.connection, Credentials::ConnectionPassword(form.secret()));
                Some(BackendCommand::Enroll { job: self.next_job(), connection, address, fingerprint, credentials })
            }
            // Shown beside the fields.
            (_, Err(_)) | (AddStage::Probing | AddStage::Enrolling(_), Ok(_)) => None,
        };
        self.open(form);
        command.into_iter().collect()
    }

    /// After it was not reached: it is added without a fingerprint, as those of a connection list.
    pub(in crate::ui) fn add_unconfirmed(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.top::<AddControllerForm>() else { return vec![] };
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

    /// The dialog that waits for a controller, unless it was closed or tries another by now.
    fn adding(&mut self, job: JobId) -> Option<&mut AddControllerForm> {
        if job != JobId(self.last_job) {
            return None;
        }
        self.dialog::<AddControllerForm>()
    }

    pub(in crate::ui) fn probed(&mut self, job: JobId, result: Result<Fingerprint, Problem>) {
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

    pub(in crate::ui) fn enrolled(
        &mut self,
        job: JobId,
        result: Result<Box<Enrolled>, Problem>,
    ) -> Vec<BackendCommand> {
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
            last: Some(RetrievedInfo { at: now, info }),
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
        self.close_all::<AddControllerForm>();
        self.status = Some(texts::added(self.language, entry.name.as_str()));
        self.rows.add(entry, now);
        if let Some(problem) = password_not_kept {
            self.first_password_not_kept(problem);
        }
        self.save()
    }
}
