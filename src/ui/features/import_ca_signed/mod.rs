//! The certificate that a CA issued for a controller's CSR (manual 2.7.1.5).

mod view;

use std::path::PathBuf;

use egui::Ui;

use crate::texts::TextKey;
use crate::ui::features::certificate_import::{ImportChecks, ImportForm, ImportSource, typed_path};
use crate::ui::model::{
    BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, UiCommand, first_path,
};

/// Request and import of a certificate that a CA signs (manual 2.7.1.5).
#[derive(Debug)]
pub struct CaSignedForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    /// For one controller: a path, or empty for the only one in its folder.
    pub file: String,
    pub checks: ImportChecks,
}

impl CaSignedForm {
    fn source(&self) -> ImportSource {
        ImportSource::Ca(typed_path(&self.file).filter(|_| self.rows.len() == 1))
    }
}

impl UiCommand {
    /// Makes a CSR, and imports the certificate that a CA issued for it.
    pub const CA_SIGNED: Self = Self::new(TextKey::CaSigned, TextKey::CaSignedTip, |model, rows| {
        model.open_ca_signed(rows);
        vec![]
    })
    .in_menu(TextKey::MenuCertificate)
    .for_controllers();
}

impl Dialog for CaSignedForm {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let source = self.source();
        model.check_import(self, Some(source))
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.drop_job()
    }
}

impl ImportForm for CaSignedForm {
    fn rows(&self) -> Vec<RowId> {
        self.rows.clone()
    }

    fn checks(&mut self) -> &mut ImportChecks {
        &mut self.checks
    }
}

impl Model {
    pub(in crate::ui) fn new_csr(&mut self) -> Vec<BackendCommand> {
        match self.top::<CaSignedForm>() {
            Some(form) => self.open_csr(form.rows.clone()),
            _ => vec![],
        }
    }

    pub(in crate::ui) fn open_ca_signed(&mut self, rows: Vec<RowId>) {
        let names = self.rows.names(&rows);
        let form = CaSignedForm { rows, names, file: String::new(), checks: ImportChecks::default() };
        self.open(form);
    }

    pub(in crate::ui) fn open_ca_signed_of(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_ca_signed(self.rows.ticked());
        if let Some(form) = self.top_mut::<CaSignedForm>() {
            form.file = first_path(&paths);
        }
        vec![]
    }
}
