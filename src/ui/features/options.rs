//! Language, theme, and how jobs are done.

use egui::{DragValue, Ui};

use crate::model::Language;
use crate::texts::{self, TextKey as T};
use crate::ui::model::{Dialog, DialogAnswer, DialogPlace, Message, Model, UiCommand};
use crate::ui::theme::{self};
use crate::ui::widgets::{Buttons, choices, dialog, form, labelled, small_note};
use crate::workspace::{MAX_PARALLELISM, ThemeChoice};

/// The options. Everything takes effect at once.
#[derive(Debug)]
pub struct OptionsDialog;

impl UiCommand {
    /// Shows and changes the options.
    pub const OPTIONS: Self = Self::new(T::Options, T::OptionsTip, |model, _| {
        model.open(OptionsDialog);
        vec![]
    })
    .in_menu(T::MenuOptions);
}

impl Dialog for OptionsDialog {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        options(ui, model, messages)
    }
}

fn options(ui: &Ui, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
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
                small_note(ui, text(T::ParallelismTip));
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
