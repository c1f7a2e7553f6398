use egui::{Label, RichText, Ui};

use crate::model::activation::{ActivationDecision, ActivationKey, KeyError, LicenceKey};
use crate::texts::{self, TextKey as T};
use crate::ui::features::activation::{ActivationForm, ActivationPreview, KeysForm, key_error};
use crate::ui::model::{DialogAnswer, Message, Model, SecretInput};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{
    Buttons, cell, dialog, file_field, form, labelled, list, list_title, mistake, note, small_note, text_field,
};

/// Lines of a list before it scrolls.
const MOST: usize = 6;

/// Activation of legacy controllers by keys (manual 2.6.3).
pub fn show(
    ui: &Ui,
    activation: &mut ActivationForm,
    focus: bool,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let submit = if activation.reads_file() { T::ReadFile } else { T::Apply };
    let why = activation.incomplete().map(text);
    let buttons = Buttons { submit: Some((text(submit), why)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::ActivationTitle, &activation.names);
    let width = if activation.rows.len() == 1 { theme::DIALOG } else { theme::DIALOG_WIDE };
    let answer = dialog(ui, "activation", &title, width, buttons, |ui| match &mut activation.keys {
        KeysForm::Typed { licence, activation } => {
            form(ui, "keys", |ui| {
                key::<LicenceKey>(ui, T::LicenceKey, "xxxx-xxxx-xxxx-xxxx", licence, focus, model);
                key::<ActivationKey>(ui, T::ActivationKey, "XXXX-XXXX-XXXX-XXXX-XXXX-XXXX", activation, false, model);
            });
        }
        KeysForm::File { file, preview } => {
            note(ui, palette(ui).accent, |ui| drop(ui.add(Label::new(text(T::ActivationMany)).wrap())));
            ui.add_space(theme::SPACE);
            file_field(ui, file, focus, model, messages);
            if let (true, Some(preview)) = (file.is_shown(), preview) {
                table(ui, preview, model);
            }
        }
    });
    activation.normalise();
    answer
}

fn key<K: std::str::FromStr<Err = KeyError>>(
    ui: &mut Ui,
    label: T,
    hint: &str,
    typed: &mut SecretInput,
    focus: bool,
    model: &Model,
) {
    labelled(ui, label.text(model.language), |ui| {
        let response = text_field(ui, &mut typed.0, hint);
        if focus {
            response.request_focus();
        }
        match (key_error::<K>(typed), typed.0.parse::<K>()) {
            (Some(error), _) => mistake(ui, &texts::key_error(model.language, error)),
            (None, Err(KeyError::Length { found, expected })) => {
                small_note(ui, &texts::key_progress(model.language, found, expected));
            }
            _ => small_note(ui, T::KeyComplete.text(model.language)),
        }
        Some(response)
    });
}

fn table(ui: &mut Ui, preview: &ActivationPreview, model: &Model) {
    let language = model.language;
    let palette = palette(ui);
    let known = preview.plan.controllers.len();
    list_title(ui, &texts::keys_found(language, preview.plan.ready(), known + preview.unknown.len()));
    list(ui, "controllers", known + preview.unknown.len(), MOST, |ui, index| {
        let Some(planned) = preview.plan.controllers.get(index) else {
            cell(ui, 190.0, RichText::new(&preview.unknown[index - known]).strong());
            cell(ui, 110.0, RichText::new("—").color(palette.weak));
            cell(ui, f32::INFINITY, RichText::new(T::KeysUnknown.text(language)).color(palette.warning));
            return;
        };
        cell(ui, 190.0, RichText::new(planned.name.as_str()).strong());
        cell(ui, 110.0, RichText::new(planned.serial.as_str()).monospace().color(palette.weak));
        let (said, color) = match &planned.decision {
            ActivationDecision::Activate { line } => (texts::line(language, *line), palette.ok),
            ActivationDecision::Missing => (T::KeysMissing.text(language).to_owned(), palette.error),
            ActivationDecision::Mistake(mistake) => (texts::line_mistake(language, mistake), palette.error),
            ActivationDecision::FirmwareTooNew => (T::WhyActivationOption.text(language).to_owned(), palette.error),
        };
        cell(ui, f32::INFINITY, RichText::new(said).color(color));
    });
    let mistakes = preview.file.mistakes();
    if !mistakes.is_empty() {
        list_title(ui, T::LinesWithMistakes.text(language));
        list(ui, "mistakes", mistakes.len(), MOST, |ui, index| {
            let said = texts::line_mistake(language, &mistakes[index]);
            cell(ui, f32::INFINITY, RichText::new(said).color(palette.error));
        });
    }
    let unused = &preview.plan.unused;
    if !unused.is_empty() {
        list_title(ui, T::LinesUnused.text(language));
        list(ui, "unused", unused.len(), MOST, |ui, index| {
            let (line, serial) = &unused[index];
            cell(ui, 90.0, RichText::new(texts::line(language, *line)));
            cell(ui, f32::INFINITY, RichText::new(serial.as_str()).monospace().color(palette.weak));
        });
    }
}
