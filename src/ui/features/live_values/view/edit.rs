use egui::{Label, RichText, Ui};

use crate::model::untrusted_text::one_line;
use crate::texts::{self, TextKey as T};
use crate::ui::features::live_values::EditValue;
use crate::ui::model::{DialogAnswer, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form, labelled, mistake, note, small_note, text_field};

/// The value that is to be written, and what is said against it.
pub fn show(ui: &Ui, edit: &mut EditValue, focus: bool, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let not_of_type = texts::live_not_of_type(model.language, &edit.data_type);
    let is_typed = edit.typed().is_some();
    let why = match () {
        () if edit.is_writing => Some(text(T::LiveWriting)),
        () if !is_typed => Some(not_of_type.as_str()),
        () => None,
    };
    let buttons = Buttons { submit: Some((text(T::LiveWriteNow), why)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::LiveWriteTitle, std::slice::from_ref(&edit.name));
    dialog(ui, "write value", &title, theme::DIALOG, buttons, |ui| {
        ui.add(Label::new(text(T::LiveWriteText)).wrap());
        ui.add_space(theme::SPACE);
        form(ui, "write value", |ui| {
            labelled(ui, text(T::LiveOldValue), |ui| {
                let shown = one_line(&format!("{} ({})", edit.before, edit.data_type), 200);
                ui.add(Label::new(shown).wrap());
                small_note(ui, &edit.node.to_string());
                None
            });
            labelled(ui, text(T::LiveNewValue), |ui| {
                let response = text_field(ui, &mut edit.text, &edit.data_type);
                if focus {
                    response.request_focus();
                }
                if !is_typed && !edit.text.is_empty() {
                    mistake(ui, &not_of_type);
                }
                Some(response)
            });
        });
        if let Some(refusal) = &edit.refusal {
            ui.add_space(theme::SPACE);
            note(ui, palette(ui).error, |ui| {
                let said = match refusal {
                    Ok(quality) => texts::live_write_refused(model.language, quality.name()),
                    Err(problem) => problem.code.explain(model.language).message.to_owned(),
                };
                ui.add(Label::new(RichText::new(said).strong()).wrap());
            });
        }
    })
}
