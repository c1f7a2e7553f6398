//! Saving self-signed certificates on the PC (manual 2.7.1.3).

mod view;

use egui::Ui;

use crate::jobs::ExportSelfSigned;
use crate::model::FileFormat;
use crate::texts::TextKey;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, Task, UiCommand};
use crate::workspace::Workspace;

pub use view::format;

/// Where the self-signed certificates are saved, and how (manual 2.7.1.3).
#[derive(Debug)]
pub struct ExportSelfSignedForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub format: FileFormat,
}

impl ExportSelfSignedForm {
    pub fn new(rows: Vec<RowId>, model: &Model) -> Self {
        Self { names: model.rows.names(&rows), rows, format: FileFormat::default() }
    }

    pub fn task(&self, workspace: &Workspace) -> Task {
        let operation = ExportSelfSigned { format: self.format, files: workspace.certificate_files() };
        Task::new(TextKey::ExportSelfSignedTitle, operation).act(TextKey::Export)
    }
}

impl UiCommand {
    /// Saves the self-signed certificates on the PC.
    pub const EXPORT_SELF_SIGNED: Self =
        Self::new(TextKey::ExportSelfSigned, TextKey::ExportSelfSignedTip, |model, rows| {
            model.open(ExportSelfSignedForm::new(rows, model));
            vec![]
        })
        .in_menu(TextKey::MenuCertificate)
        .for_controllers();
}

impl Dialog for ExportSelfSignedForm {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let planned = Some((self.task(&model.workspace), self.rows.clone()));
        model.ask(self, planned)
    }

    fn is_done_by_confirming(&self) -> bool {
        true
    }
}
