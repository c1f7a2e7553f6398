//! Putting back a backup of a key (manual 2.8.1).

mod view;

use egui::Ui;
use secrecy::SecretString;

use crate::model::Feature;
use crate::texts::TextKey;
use crate::ui::features::certificate_import::{ImportChecks, ImportForm, ImportSource, typed_path};
use crate::ui::model::{
    BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, SecretInput, UiCommand,
};
use crate::workspace::BackupKind;

/// Putting back a backup of a key (manual 2.8.1).
#[derive(Debug)]
pub struct RestoreForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub kind: BackupKind,
    /// For one controller: a path, or empty for the one in its folder.
    pub file: String,
    /// Empty: the connection password.
    pub password: SecretInput,
    pub show_password: bool,
    pub checks: ImportChecks,
}

impl RestoreForm {
    fn source(&self) -> ImportSource {
        let password = (!self.password.0.is_empty()).then(|| SecretString::from(self.password.0.clone()));
        let file = typed_path(&self.file).filter(|_| self.rows.len() == 1);
        ImportSource::Backup { kind: self.kind, file, password }
    }
}

impl UiCommand {
    /// Puts a backup of a key back.
    pub const RESTORE_BACKUP: Self = Self::new(TextKey::RestoreBackup, TextKey::RestoreBackupTip, |model, rows| {
        model.open_restore(rows);
        vec![]
    })
    .in_menu(TextKey::MenuCertificate)
    .for_controllers()
    .disabled_if(|model, targets| {
        model.any_target_lacks(targets, Feature::KeyImport).then_some(TextKey::WhyLegacyOnly)
    });
}

impl Dialog for RestoreForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, place.focus, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let source = self.source();
        model.check_import(self, Some(source))
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.drop_job()
    }
}

impl ImportForm for RestoreForm {
    fn rows(&self) -> Vec<RowId> {
        self.rows.clone()
    }

    fn checks(&mut self) -> &mut ImportChecks {
        &mut self.checks
    }
}

impl Model {
    pub(in crate::ui) fn open_restore(&mut self, rows: Vec<RowId>) {
        self.open(RestoreForm {
            names: self.rows.names(&rows),
            rows,
            kind: BackupKind::SelfSigned,
            file: String::new(),
            password: SecretInput::default(),
            show_password: false,
            checks: ImportChecks::default(),
        });
    }
}
