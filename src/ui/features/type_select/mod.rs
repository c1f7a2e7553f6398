//! The dialogs about the server certificates a controller holds, what they ask for, and what arrives for them.

mod view;

use std::collections::BTreeMap;
use std::path::PathBuf;

use egui::Ui;

use crate::jobs::{ListCertificates, SelectCertificateType};
use crate::model::{
    CertificateSummary, CertificateType, Feature, Problem, Revisioned, SerialNumber, StoredServerCertificates,
};
use crate::pki::Certificate;
use crate::texts::TextKey;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, Task, UiCommand};
use crate::workspace::CertificateFiles;

/// Which certificate the server uses (manual 2.7.2).
#[derive(Debug)]
pub struct TypeSelectForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    /// What the controllers hold is being read.
    pub reading: bool,
    /// By controller; a problem where it could not be read.
    pub held: BTreeMap<RowId, Result<ControllerCertificates, Problem>>,
    pub selected: Option<CertificateType>,
}

/// What one controller holds.
#[derive(Debug, Clone)]
pub struct ControllerCertificates {
    pub in_use: CertificateType,
    pub stored: BTreeMap<CertificateType, CertificateSummary>,
}

impl From<StoredServerCertificates> for ControllerCertificates {
    fn from(held: StoredServerCertificates) -> Self {
        let summary = |kind| Certificate::from_der(held.of(kind)?).ok().map(|certificate| certificate.summary());
        let stored = CertificateType::ALL.into_iter().filter_map(|kind| Some((kind, summary(kind)?))).collect();
        Self { in_use: held.selected, stored }
    }
}

impl TypeSelectForm {
    /// The controllers whose certificates are known.
    pub fn known(&self) -> impl Iterator<Item = (RowId, &ControllerCertificates)> {
        self.held.iter().filter_map(|(row, held)| Some((*row, held.as_ref().ok()?)))
    }

    pub fn storing(&self, kind: CertificateType) -> usize {
        self.known().filter(|(_, held)| held.stored.contains_key(&kind)).count()
    }

    /// The certificate of this type, when there is one controller only.
    pub fn only(&self, kind: CertificateType) -> Option<&CertificateSummary> {
        match self.rows[..] {
            [row] => self.held.get(&row)?.as_ref().ok()?.stored.get(&kind),
            _ => None,
        }
    }

    /// Whether every controller that answered uses this type already.
    pub fn in_use(&self, kind: CertificateType) -> bool {
        self.known().next().is_some() && self.known().all(|(_, held)| held.in_use == kind)
    }

    /// What Apply does; `None` while nothing is chosen, or what no controller stores.
    pub fn task(&self) -> Option<Task> {
        let kind = self.selected?;
        let task = || Task::new(TextKey::TypeSelectTitle, SelectCertificateType(kind)).act(TextKey::ActSelectType);
        (!self.reading && self.storing(kind) > 0).then(|| task().restarts_server())
    }
}

impl UiCommand {
    /// Chooses which of its certificates a server uses.
    pub const TYPE_SELECT: Self = Self::new(TextKey::TypeSelect, TextKey::TypeSelectTip, Model::open_type_select)
        .in_menu(TextKey::MenuCertificate)
        .for_controllers();
}

impl Dialog for TypeSelectForm {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let planned = self.task().map(|task| (task, self.rows.clone()));
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
    /// Whether one of these controllers is known not to offer this.
    pub fn any_lacks(&self, rows: &[RowId], feature: Feature) -> bool {
        rows.iter().filter_map(|row| self.rows.get(*row)).any(|row| !row.capabilities().offers(feature))
    }

    /// The types that can be chosen for all of these controllers.
    pub fn offered_types(&self, rows: &[RowId]) -> impl Iterator<Item = CertificateType> + use<> {
        let user_specified = !self.any_lacks(rows, Feature::UserSpecifiedCertificate);
        CertificateType::ALL.into_iter().filter(move |kind| *kind != CertificateType::UserSpecified || user_specified)
    }

    /// A folder of the one controller, or what the folders of several look like, which is nothing to copy.
    pub fn folder_of(
        &self,
        rows: &[RowId],
        of: impl Fn(&CertificateFiles, &SerialNumber) -> PathBuf,
        kind: &str,
    ) -> (PathBuf, bool) {
        let info = match rows {
            [row] => self.rows.get(*row).and_then(|row| row.info()),
            _ => None,
        };
        match info {
            Some(info) => (of(&self.workspace.certificate_files(), &info.serial), true),
            None => {
                let serial = format!("<{}>", TextKey::SerialFolder.text(self.language));
                (self.workspace.root().join(serial).join("Cert").join(kind), false)
            }
        }
    }

    pub(in crate::ui) fn open_type_select(&mut self, rows: Vec<RowId>) -> Vec<BackendCommand> {
        self.open(TypeSelectForm {
            names: self.rows.names(&rows),
            rows: rows.clone(),
            reading: true,
            held: BTreeMap::new(),
            selected: None,
        });
        let task = Task::with_results(TextKey::TypeSelectTitle, ListCertificates, Model::certificates_loaded);
        self.start(task.for_dialog::<TypeSelectForm>().on_end(Model::certificates_ended), rows, None)
    }

    /// One controller has answered, or failed to.
    fn certificates_loaded(
        &mut self,
        row: RowId,
        result: Result<Revisioned<StoredServerCertificates>, Problem>,
    ) -> Vec<BackendCommand> {
        if let Some(form) = self.dialog::<TypeSelectForm>() {
            form.held.insert(row, result.map(|held| ControllerCertificates::from(held.value)));
        }
        vec![]
    }

    /// All have.
    fn certificates_ended(&mut self) -> Vec<BackendCommand> {
        self.job = None;
        let Some(form) = self.dialog::<TypeSelectForm>() else { return vec![] };
        form.reading = false;
        form.selected = CertificateType::ALL.into_iter().find(|kind| form.in_use(*kind));
        if form.known().next().is_none() {
            let problem = form.held.values().find_map(|held| held.as_ref().err().cloned());
            self.close_all::<TypeSelectForm>();
            if let Some(problem) = problem {
                self.show_problem(problem);
            }
        }
        vec![]
    }
}
