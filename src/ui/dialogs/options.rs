use egui::{DragValue, Label, RichText, Ui};

use crate::model::Language;
use crate::texts::{self, TextKey as T};
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Answer, Buttons, choices, dialog, fine_print, form, labelled};
use crate::workspace::{MAX_PARALLELISM, ThemeChoice};

/// Language, theme, controllers at once. Everything takes effect at once.
pub fn options(ui: &Ui, model: &Model, messages: &mut Vec<Message>) -> Answer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Close), None)), close: None };
    dialog(ui, "options", text(T::OptionsTitle), theme::DIALOG, buttons, |ui| {
        form(ui, "options", |ui| {
            labelled(ui, text(T::LanguageLabel), |ui| {
                choices(ui, |ui| {
                    for language in Language::ALL {
                        if ui.radio(model.language == language, language.own_name()).clicked() {
                            messages.push(Message::SetLanguage(language));
                        }
                    }
                });
                None
            });
            labelled(ui, text(T::ThemeLabel), |ui| {
                choices(ui, |ui| {
                    for choice in [ThemeChoice::System, ThemeChoice::Light, ThemeChoice::Dark] {
                        if ui.radio(model.options.theme == choice, text(texts::theme(choice))).clicked() {
                            messages.push(Message::SetTheme(choice));
                        }
                    }
                });
                None
            });
            labelled(ui, text(T::Parallelism), |ui| {
                let mut count = model.options.parallelism;
                let response = ui.add(DragValue::new(&mut count).range(1..=MAX_PARALLELISM));
                if response.changed() {
                    messages.push(Message::SetParallelism(count));
                }
                fine_print(ui, text(T::ParallelismTip));
                Some(response)
            });
            labelled(ui, text(T::VerifyAfterChanges), |ui| {
                let mut on = model.options.verify_after_changes;
                if ui.checkbox(&mut on, text(T::VerifyAfterChangesOn)).changed() {
                    messages.push(Message::SetVerifyAfterChanges(on));
                }
                None
            });
            if let Some(store) = &model.store {
                super::vault::options(ui, store, model, messages);
            }
        });
    })
}

/// Whether copies of certificates are kept (manual 2.8.1).
pub fn backup(ui: &Ui, on: &mut bool, model: &Model) -> Answer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Apply), None)), close: Some(text(T::Cancel)) };
    dialog(ui, "backup", text(T::BackupTitle), theme::DIALOG, buttons, |ui| {
        ui.checkbox(on, text(T::BackupOn));
        ui.add_space(theme::SPACE);
        ui.add(Label::new(text(T::BackupWhere)).wrap());
        let folder = model.workspace.root().display().to_string();
        ui.add(Label::new(RichText::new(folder).monospace().color(palette(ui).weak)).wrap().selectable(true));
        ui.add_space(theme::SPACE);
        fine_print(ui, text(T::BackupKeys));
        fine_print(ui, text(T::BackupRestore));
    })
}
