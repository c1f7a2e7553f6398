//! Activation by keys (manual 2.6.3): typed in for one controller, from a file for many.

mod view;

use std::path::PathBuf;
use std::sync::Arc;

use egui::Ui;

use crate::jobs::{Activate, KeySource};
use crate::model::activation::{
    self, ActivationFile, ActivationKey, ActivationKeys, ActivationPlan, KeyError, LicenceKey,
    MAX_ACTIVATION_FILE_BYTES,
};
use crate::model::{ErrorCode, Feature, Problem};
use crate::texts::TextKey;
use crate::ui::model::{
    BackendCommand, Dialog, DialogAnswer, DialogPlace, FileForm, Message, Model, RowId, SecretInput, Task, UiCommand,
    first_path,
};
use crate::ui::picker::FileKind;

#[derive(Debug)]
pub struct ActivationForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub keys: KeysForm,
}

/// Where the keys come from.
#[derive(Debug)]
pub enum KeysForm {
    Typed { licence: SecretInput, activation: SecretInput },
    File { file: FileForm, preview: Option<ActivationPreview> },
}

/// What a file means for the ticked controllers, before anything is sent.
#[derive(Debug)]
pub struct ActivationPreview {
    pub file: Arc<ActivationFile>,
    /// Of the controllers whose serial number is known.
    pub plan: ActivationPlan,
    /// Names of the others: whether the file has keys for them shows when they are reached.
    pub unknown: Vec<String>,
}

impl ActivationForm {
    pub fn new(rows: Vec<RowId>, model: &Model) -> Self {
        if rows.len() == 1 {
            let keys = KeysForm::Typed { licence: SecretInput::default(), activation: SecretInput::default() };
            return Self { names: model.rows.names(&rows), rows, keys };
        }
        Self::of_file(rows, String::new(), model)
    }

    fn of_file(rows: Vec<RowId>, path: String, model: &Model) -> Self {
        let file = FileForm { path, ..FileForm::new(FileKind::Csv, MAX_ACTIVATION_FILE_BYTES) };
        Self { names: model.rows.names(&rows), rows, keys: KeysForm::File { file, preview: None } }
    }

    /// Keys that are complete are shown as the licence certificate writes them, however they were pasted.
    pub fn normalise(&mut self) {
        if let KeysForm::Typed { licence, activation } = &mut self.keys {
            if let Ok(key) = licence.0.parse::<LicenceKey>() {
                licence.0 = key.to_string();
            }
            if let Ok(key) = activation.0.parse::<ActivationKey>() {
                activation.0 = key.to_string();
            }
        }
    }

    /// What Apply would do.
    pub fn operation(&self) -> Option<Activate> {
        let keys = match &self.keys {
            KeysForm::Typed { licence, activation } => KeySource::Typed(ActivationKeys {
                licence: licence.0.parse().ok()?,
                activation: activation.0.parse().ok()?,
            }),
            KeysForm::File { preview, .. } => {
                let preview = preview.as_ref().filter(|_| !self.reads_file())?;
                if preview.plan.ready() == 0 && preview.unknown.is_empty() {
                    return None;
                }
                KeySource::File(preview.file.clone())
            }
        };
        Some(Activate { keys })
    }

    /// The main button reads the file, as what is shown is not what is in it.
    pub fn reads_file(&self) -> bool {
        matches!(&self.keys, KeysForm::File { file, .. } if !file.is_shown())
    }

    /// Why the main button does nothing yet.
    pub fn incomplete(&self) -> Option<TextKey> {
        match &self.keys {
            KeysForm::File { file, .. } if self.reads_file() => file.incomplete(),
            _ if self.operation().is_some() => None,
            KeysForm::Typed { .. } => Some(TextKey::KeysRule),
            KeysForm::File { .. } => Some(TextKey::NoKeysInFile),
        }
    }

    pub(in crate::ui) fn take_in(&mut self, bytes: &[u8], model: &Model) -> Result<(), Problem> {
        let KeysForm::File { preview, .. } = &mut self.keys else { return Ok(()) };
        *preview = None;
        let file = activation::parse(bytes).map_err(|e| Problem::with_detail(ErrorCode::BadActivationFile, e))?;
        let mut known = Vec::new();
        let mut unknown = Vec::new();
        for row in self.rows.iter().filter_map(|id| model.rows.get(*id)) {
            match row.info() {
                Some(info) => known.push((row.entry.name.clone(), info.serial.clone(), info.firmware)),
                None => unknown.push(row.entry.name.to_string()),
            }
        }
        let plan = activation::plan(&file, &known);
        *preview = Some(ActivationPreview { file: Arc::new(file), plan, unknown });
        Ok(())
    }
}

/// What is wrong with a key as far as it is typed. One that is merely too short so far is no mistake.
pub fn key_error<K: std::str::FromStr<Err = KeyError>>(typed: &SecretInput) -> Option<KeyError> {
    typed
        .0
        .parse::<K>()
        .err()
        .filter(|error| !matches!(error, KeyError::Length { found, expected } if found < expected))
}

impl UiCommand {
    /// Asks for the keys that activate legacy controllers.
    pub const ACTIVATION: Self = Self::new(TextKey::Activation, TextKey::ActivationTip, |model, rows| {
        model.open(ActivationForm::new(rows, model));
        vec![]
    })
    .in_menu(TextKey::MenuServer)
    .for_controllers()
    .disabled_if(|model, targets| {
        model.any_target_lacks(targets, Feature::ActivationKeys).then_some(TextKey::WhyActivationOption)
    });
}

impl Dialog for ActivationForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, place.focus, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        if self.reads_file() {
            model.put_back(self);
            return model.read_typed();
        }
        let task = |operation| Task::new(TextKey::ActivationTitle, operation).act(TextKey::ActActivate);
        let planned = self.operation().map(|operation| (task(operation), self.rows.clone()));
        model.ask(self, planned)
    }

    fn file(&mut self) -> Option<&mut FileForm> {
        match &mut self.keys {
            KeysForm::File { file, .. } => Some(file),
            KeysForm::Typed { .. } => None,
        }
    }

    fn take_in_file(&mut self, bytes: &[u8], model: &Model) -> Result<(), Problem> {
        self.take_in(bytes, model)
    }

    fn is_done_by_confirming(&self) -> bool {
        true
    }
}

impl Model {
    /// For the ticked controllers, also when there is one only.
    pub(in crate::ui) fn open_activation_of(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        let form = ActivationForm::of_file(self.rows.ticked(), first_path(&paths), self);
        self.open(form);
        self.read_typed()
    }
}
