mod view;

use egui::Ui;

use super::{ImportForm, ImportSource};
use crate::jobs::{CertificateChecked, Confirmation, ServerEffect};
use crate::model::Problem;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId};
use crate::workspace::Workspace;

/// What was found, and what the import will do, to be agreed to.
#[derive(Debug)]
pub struct ImportReview {
    pub source: ImportSource,
    pub names: Vec<String>,
    pub found: Vec<(RowId, String, Result<CertificateChecked, Problem>)>,
    /// Closes the form that asked for the import.
    close_form: fn(&mut Model),
}

impl ImportReview {
    /// `F`: the form that asked for the import.
    pub(super) fn new<F: ImportForm>(
        source: ImportSource,
        names: Vec<String>,
        found: Vec<(RowId, String, Result<CertificateChecked, Problem>)>,
    ) -> Self {
        Self { source, names, found, close_form: Model::close_all::<F> }
    }

    /// The controllers whose certificate clients would not refuse.
    pub fn importable(&self) -> Vec<RowId> {
        let good =
            |found: &Result<CertificateChecked, Problem>| found.as_ref().is_ok_and(|checked| !checked.is_refused());
        self.found.iter().filter(|(_, _, found)| good(found)).map(|(row, ..)| *row).collect()
    }

    /// What is agreed to. Signing requests without certificates replace no certificate, and no server is started again
    /// for them.
    pub fn confirmation(&self, workspace: &Workspace) -> Confirmation {
        let all = self.source.import(self.warns(), workspace).confirmation().unwrap_or_default();
        let mut checked = self.found.iter().filter_map(|(_, _, found)| found.as_ref().ok());
        if checked.any(|checked| checked.summary.is_some()) {
            return all;
        }
        Confirmation { server: ServerEffect::GoesOn, replaces_certificate: false, ..all }
    }

    /// Whether clients may complain about something that is imported.
    pub fn warns(&self) -> bool {
        let checked = self.found.iter().filter_map(|(_, _, found)| found.as_ref().ok());
        checked.filter(|checked| !checked.is_refused()).any(|checked| !checked.findings.is_empty())
    }
}

impl Dialog for ImportReview {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.import(self)
    }
}

impl Model {
    /// The import was agreed to; the form that asked for it has done its work.
    fn import(&mut self, review: Box<ImportReview>) -> Vec<BackendCommand> {
        let (rows, accept_warnings) = (review.importable(), review.warns());
        if rows.is_empty() {
            self.put_back(review);
            return vec![];
        }
        (review.close_form)(self);
        let task = review.source.import(accept_warnings, &self.workspace);
        self.start(task, rows, None)
    }
}
