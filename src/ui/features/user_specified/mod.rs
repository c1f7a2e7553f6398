//! A key and a certificate that were made with another tool (manual 2.7.1.4).

mod view;

use std::path::PathBuf;

use egui::Ui;
use secrecy::SecretString;

use crate::jobs::UserSpecifiedFiles;
use crate::model::Feature;
use crate::texts::TextKey;
use crate::ui::features::certificate_import::{ImportChecks, ImportForm, ImportSource, typed_path};
use crate::ui::model::{
    BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, SecretInput, UiCommand, first_path,
};

/// How a certificate made with another tool comes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UserFiles {
    Pfx,
    Pair,
}

/// Import of a certificate made with another tool (manual 2.7.1.4).
#[derive(Debug)]
pub struct UserSpecifiedForm {
    pub row: RowId,
    pub name: String,
    pub kind: UserFiles,
    pub pfx: String,
    pub certificate: String,
    pub key: String,
    pub password: SecretInput,
    pub show_password: bool,
    pub checks: ImportChecks,
}

impl UserSpecifiedForm {
    /// What is imported; `None` while a path is missing. Nothing typed stands for the only files in the folder.
    pub fn source(&self, model: &Model) -> Option<ImportSource> {
        let info = model.rows.get(self.row).and_then(|row| row.info());
        let folder = info.map(|info| (model.workspace.certificate_files(), info.serial.clone()));
        let files = match self.kind {
            UserFiles::Pfx => match (typed_path(&self.pfx), folder) {
                (Some(path), _) => UserSpecifiedFiles::Pfx(path),
                (None, folder) => folder.map(|(files, serial)| UserSpecifiedFiles::PfxIn(files, serial))?,
            },
            UserFiles::Pair => match (typed_path(&self.certificate), typed_path(&self.key), folder) {
                (Some(certificate), Some(key), _) => UserSpecifiedFiles::Pair { certificate, key },
                (None, None, Some((files, serial))) => UserSpecifiedFiles::PairIn(files, serial),
                _ => return None,
            },
        };
        let given = self.kind == UserFiles::Pfx || !self.password.0.is_empty();
        Some(ImportSource::User { files, password: given.then(|| SecretString::from(self.password.0.clone())) })
    }
}

impl UiCommand {
    /// Imports a key and a certificate that were made with another tool.
    pub const USER_SPECIFIED: Self = Self::new(TextKey::UserSpecified, TextKey::UserSpecifiedTip, |model, rows| {
        model.open_user_specified(&rows);
        vec![]
    })
    .in_menu(TextKey::MenuCertificate)
    .for_controllers()
    .disabled_if(|model, targets| match model.target_count(targets) {
        ..=1 => model.any_target_lacks(targets, Feature::UserSpecifiedCertificate).then_some(TextKey::WhyUserLegacy),
        _ => Some(TextKey::WhyUserOne),
    });
}

impl Dialog for UserSpecifiedForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, place.focus, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let source = self.source(model);
        model.check_import(self, source)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.drop_job()
    }
}

impl ImportForm for UserSpecifiedForm {
    fn rows(&self) -> Vec<RowId> {
        vec![self.row]
    }

    fn checks(&mut self) -> &mut ImportChecks {
        &mut self.checks
    }
}

impl Model {
    pub(in crate::ui) fn open_user_specified(&mut self, rows: &[RowId]) {
        let [row] = *rows else { return };
        self.open(UserSpecifiedForm {
            row,
            name: self.rows.names(rows).pop().unwrap_or_default(),
            kind: UserFiles::Pfx,
            pfx: String::new(),
            certificate: String::new(),
            key: String::new(),
            password: SecretInput::default(),
            show_password: false,
            checks: ImportChecks::default(),
        });
    }

    pub(in crate::ui) fn open_user_pfx(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_user_of(|form| form.pfx = first_path(&paths))
    }

    pub(in crate::ui) fn open_user_certificate(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_user_of(|form| (form.kind, form.certificate) = (UserFiles::Pair, first_path(&paths)))
    }

    pub(in crate::ui) fn open_user_key(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_user_of(|form| (form.kind, form.key) = (UserFiles::Pair, first_path(&paths)))
    }

    /// The certificate first.
    pub(in crate::ui) fn open_user_pair(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_user_of(|form| {
            let (certificate, key) = paths.split_at(paths.len().min(1));
            (form.kind, form.certificate, form.key) = (UserFiles::Pair, first_path(certificate), first_path(key));
        })
    }

    fn open_user_of(&mut self, fill: impl FnOnce(&mut UserSpecifiedForm)) -> Vec<BackendCommand> {
        self.open_user_specified(&self.rows.ticked());
        if let Some(form) = self.top_mut::<UserSpecifiedForm>() {
            fill(form);
        }
        vec![]
    }
}
