//! A self-signed server certificate (manual 2.7.1.2).

mod view;

use egui::Ui;

use crate::jobs::{self, CsrFields, SelfSignedFields};
use crate::model::Validity;
use crate::texts::TextKey;
use crate::ui::features::subject_fields::{SubjectFields, SubjectForm};
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, Task, UiCommand};

/// A self-signed server certificate (manual 2.7.1.2).
#[derive(Debug)]
pub struct SelfSignedForm {
    pub subject: SubjectFields,
    /// How long it is valid. Default 5.
    pub years: u8,
}

impl SelfSignedForm {
    /// What Apply does; `None` while something is wrong.
    fn task(&self, model: &Model) -> Option<Task> {
        let CsrFields { common_name, country, state, locality, organisation, key_length } = self.subject.request()?;
        let validity = Validity::try_from(self.years).ok()?;
        let fields = SelfSignedFields { common_name, country, state, locality, organisation, key_length, validity };
        let backup = model.options.backup.then(|| model.workspace.certificate_files());
        let task = Task::new(TextKey::SelfSignedTitle, jobs::SelfSigned { fields, backup });
        Some(task.act(TextKey::ActSelfSigned).restarts_server())
    }
}

impl UiCommand {
    /// Makes a self-signed certificate.
    pub const SELF_SIGNED: Self =
        Self::new(TextKey::SelfSigned, TextKey::SelfSignedTip, |model, rows| model.open_self_signed(rows))
            .in_menu(TextKey::MenuCertificate)
            .for_controllers();
}

impl Dialog for SelfSignedForm {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let planned = self.task(model).map(|task| (task, self.subject.rows.clone()));
        model.ask(self, planned)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.drop_job()
    }

    fn is_done_by_confirming(&self) -> bool {
        true
    }
}

impl SubjectForm for SelfSignedForm {
    fn subject_fields(&mut self) -> &mut SubjectFields {
        &mut self.subject
    }
}

impl Model {
    pub(in crate::ui) fn open_self_signed(&mut self, rows: Vec<RowId>) -> Vec<BackendCommand> {
        self.open_subject_form(rows, |subject| SelfSignedForm { subject, years: 5 })
    }
}
