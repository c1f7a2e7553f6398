//! A certificate signing request, for a certificate that a CA signs (manual 2.7.1.5).

mod view;

use egui::Ui;

use crate::jobs;
use crate::model::FileFormat;
use crate::texts::TextKey;
use crate::ui::features::subject_fields::{SubjectFields, SubjectForm};
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, Task};

/// A certificate signing request (manual 2.7.1.5).
#[derive(Debug)]
pub struct CsrForm {
    pub subject: SubjectFields,
    /// The file it is saved to.
    pub format: FileFormat,
}

impl CsrForm {
    /// What Apply does; `None` while something is wrong.
    fn task(&self, model: &Model) -> Option<Task> {
        let (files, backup) = (model.workspace.certificate_files(), model.options.backup);
        let operation = jobs::CreateCsr { fields: self.subject.request()?, format: self.format, files, backup };
        Some(Task::new(TextKey::CsrTitle, operation).act(TextKey::ActCreateCsr))
    }
}

impl Dialog for CsrForm {
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

impl SubjectForm for CsrForm {
    fn subject_fields(&mut self) -> &mut SubjectFields {
        &mut self.subject
    }
}

impl Model {
    pub(in crate::ui) fn open_csr(&mut self, rows: Vec<RowId>) -> Vec<BackendCommand> {
        self.open_subject_form(rows, |subject| CsrForm { subject, format: FileFormat::default() })
    }
}
