//! A self-signed server certificate (manual 2.7.1.2), and the request for one that a CA signs (2.7.1.5).

mod form;
mod view;

use egui::Ui;

use crate::jobs;
use crate::model::FileFormat;
use crate::texts::TextKey;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, Task, UiCommand};

pub use form::SelfSignedForm;

impl UiCommand {
    /// Makes a self-signed certificate.
    pub const SELF_SIGNED: Self =
        Self::new(TextKey::SelfSigned, TextKey::SelfSignedTip, |model, rows| model.open_self_signed(rows, None))
            .in_menu(TextKey::MenuCertificate)
            .for_controllers();
}

impl Dialog for SelfSignedForm {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let planned = self.task(model).map(|task| (task, self.rows.clone()));
        model.ask(self, planned)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.drop_job()
    }

    fn is_done_by_confirming(&self) -> bool {
        true
    }
}

impl Model {
    /// For a certificate, or for a request in this format.
    pub(in crate::ui) fn open_self_signed(
        &mut self,
        rows: Vec<RowId>,
        request: Option<FileFormat>,
    ) -> Vec<BackendCommand> {
        let form = SelfSignedForm::new(rows.clone(), request, self);
        let reading = form.reading;
        self.open(form);
        if reading { self.start(read_policies(), rows, None) } else { vec![] }
    }
}

fn read_policies() -> Task {
    Task::with_results(TextKey::SettingsTitle, jobs::ReadBasicSettings, |model, row, result| {
        let name = model.rows.get(row).and_then(|row| row.info()).map(|info| info.application_name.clone());
        if let (Ok(settings), Some(form)) = (result, model.dialog::<SelfSignedForm>()) {
            form.reading = false;
            form.offer(&settings.value.security_policies);
            if let Some(name) = name.filter(|_| form.common_name.is_empty()) {
                form.common_name = name;
            }
        }
        vec![]
    })
    .for_dialog::<SelfSignedForm>()
}
