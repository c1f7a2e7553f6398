//! Export and import of settings (manual 2.6.4, 2.6.5).

mod view;

use std::path::{Path, PathBuf};

use egui::Ui;
use secrecy::SecretString;

use crate::jobs::{ExportSettings, ImportSettings};
use crate::model::{ControllerInfo, Feature, Problem};
use crate::texts::TextKey;
use crate::ui::model::{
    BackendCommand, Dialog, DialogAnswer, DialogPlace, ExportFound, JobId, Message, Model, RowId, SecretInput, Targets,
    Task, UiCommand,
};
use crate::workspace::{MIN_PASSPHRASE_CHARS, Workspace};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransferDirection {
    Export,
    Import,
}

/// Where the settings of one controller or many go to or come from, and what protects them.
#[derive(Debug)]
pub struct TransferForm {
    pub transfer: TransferDirection,
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    /// With `<serial>` in it when it is not that of one known controller.
    pub path: PathBuf,
    pub path_of_one: bool,
    /// An import from this file, not from the controller's own.
    pub file: Option<PathBuf>,
    /// Empty: the connection password protects the file.
    pub passphrase: SecretInput,
    pub show_passphrase: bool,
    pub preview: ExportPreview,
}

/// The file of the one controller, as far as it can be read without its passphrase.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum ExportPreview {
    /// Several controllers, or one whose serial number is not known yet.
    #[default]
    None,
    Reading(JobId),
    Found(ExportFound),
    /// It cannot be imported.
    Unfit(Problem),
}

impl TransferForm {
    pub fn new(transfer: TransferDirection, rows: Vec<RowId>, model: &Model) -> Self {
        let files = model.workspace.settings_files();
        let one = one_info(&rows, model);
        Self {
            transfer,
            names: model.rows.names(&rows),
            path: one.map_or_else(|| files.any_path(), |info| files.path(&info.serial)),
            path_of_one: one.is_some(),
            file: None,
            rows,
            passphrase: SecretInput::default(),
            show_passphrase: false,
            preview: ExportPreview::None,
        }
    }

    /// The folder of the file; of several files, the one that holds theirs.
    pub fn folder<'a>(&'a self, model: &'a Model) -> &'a Path {
        match self.path.parent() {
            Some(folder) if self.path_of_one => folder,
            _ => model.workspace.root(),
        }
    }

    /// An import takes the passphrase that the file was made with, of any length.
    pub fn passphrase_error(&self) -> Option<TextKey> {
        let count = self.passphrase.0.chars().count();
        let short = self.transfer == TransferDirection::Export && (1..MIN_PASSPHRASE_CHARS).contains(&count);
        short.then_some(TextKey::PassphraseRule)
    }

    /// Why the form cannot be sent yet.
    pub fn incomplete(&self) -> Option<TextKey> {
        match self.preview {
            ExportPreview::Reading(_) => Some(TextKey::Reading),
            ExportPreview::Unfit(_) => Some(TextKey::ImportNothing),
            ExportPreview::None | ExportPreview::Found(_) => self.passphrase_error(),
        }
    }

    /// What Apply does; `None` while something is missing or wrong.
    pub fn task(&self, workspace: &Workspace) -> Option<Task> {
        if self.incomplete().is_some() {
            return None;
        }
        let passphrase = (!self.passphrase.0.is_empty()).then(|| SecretString::from(self.passphrase.0.clone()));
        Some(match self.transfer {
            TransferDirection::Export => {
                let operation = ExportSettings { files: workspace.settings_files(), passphrase };
                Task::new(TextKey::ExportTitle, operation).act(TextKey::ExportButton)
            }
            TransferDirection::Import => {
                let files = workspace.settings_files();
                let files = self.file.clone().map_or(files.clone(), |file| files.of_file(file));
                let operation = ImportSettings { files, passphrase };
                Task::new(TextKey::ImportTitle, operation).act(TextKey::ActImportSettings).restarts_server()
            }
        })
    }
}

fn one_info<'a>(rows: &[RowId], model: &'a Model) -> Option<&'a ControllerInfo> {
    match rows {
        [row] => model.rows.get(*row)?.info(),
        _ => None,
    }
}

impl UiCommand {
    /// Saves the settings of legacy controllers.
    pub const EXPORT_SETTINGS: Self = Self::new(TextKey::ExportSettings, TextKey::ExportSettingsTip, |model, rows| {
        model.open_transfer(TransferDirection::Export, rows)
    })
    .in_menu(TextKey::MenuServer)
    .for_controllers()
    .disabled_if(why_no_transfer);

    /// Puts saved settings back.
    pub const IMPORT_SETTINGS: Self = Self::new(TextKey::ImportSettings, TextKey::ImportSettingsTip, |model, rows| {
        model.open_transfer(TransferDirection::Import, rows)
    })
    .in_menu(TextKey::MenuServer)
    .for_controllers()
    .disabled_if(why_no_transfer);
}

fn why_no_transfer(model: &Model, targets: Targets) -> Option<TextKey> {
    model.any_target_lacks(targets, Feature::SettingsTransfer).then_some(TextKey::WhyLegacyOnly)
}

impl Dialog for TransferForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, place.focus, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let planned = self.task(&model.workspace).map(|task| (task, self.rows.clone()));
        model.ask(self, planned)
    }

    fn is_done_by_confirming(&self) -> bool {
        true
    }
}

impl Model {
    pub(in crate::ui) fn open_transfer(
        &mut self,
        transfer: TransferDirection,
        rows: Vec<RowId>,
    ) -> Vec<BackendCommand> {
        self.open_transfer_form(TransferForm::new(transfer, rows, self))
    }

    /// For the one ticked controller.
    pub(in crate::ui) fn open_import_of(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        let mut form = TransferForm::new(TransferDirection::Import, self.rows.ticked(), self);
        form.file = paths.into_iter().next();
        if let Some(file) = &form.file {
            (form.path, form.path_of_one) = (file.clone(), true);
        }
        self.open_transfer_form(form)
    }

    fn open_transfer_form(&mut self, mut form: TransferForm) -> Vec<BackendCommand> {
        let known = one_info(&form.rows, self).filter(|_| form.transfer == TransferDirection::Import).cloned();
        let commands = match known {
            Some(info) => {
                let job = self.next_job();
                form.preview = ExportPreview::Reading(job);
                vec![BackendCommand::LookAtExport { job, of: Box::new(info), file: form.file.clone() }]
            }
            None => vec![],
        };
        self.open(form);
        commands
    }

    pub(in crate::ui) fn export_seen(&mut self, job: JobId, result: Result<ExportFound, Problem>) {
        let waiting = self.dialog::<TransferForm>().filter(|form| form.preview == ExportPreview::Reading(job));
        if let Some(form) = waiting {
            form.preview = match result {
                Ok(found) => ExportPreview::Found(found),
                Err(problem) => ExportPreview::Unfit(problem),
            };
        }
    }
}
