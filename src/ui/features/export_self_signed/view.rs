use egui::{Label, Ui};

use crate::model::FileFormat;
use crate::texts::{self, TextKey as T};
use crate::ui::features::export_self_signed::ExportSelfSignedForm;
use crate::ui::model::{DialogAnswer, Message, Model};
use crate::ui::theme;
use crate::ui::widgets::{Buttons, choices, dialog, form, labelled, path_line};

/// Saves the self-signed certificates on this computer (manual 2.7.1.3).
pub fn show(ui: &Ui, export: &mut ExportSelfSignedForm, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Export), None)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::ExportSelfSignedTitle, &export.names);
    dialog(ui, "export self-signed", &title, theme::DIALOG, buttons, |ui| {
        ui.add(Label::new(text(T::ExportSelfSignedTip)).wrap());
        ui.add_space(theme::SPACE);
        form(ui, "export self-signed", |ui| {
            labelled(ui, text(T::FileFormat), |ui| {
                format(ui, &mut export.format);
                None
            });
            labelled(ui, text(T::GoesTo), |ui| {
                let (folder, real) =
                    model.folder_of(&export.rows, |files, serial| files.self_signed_folder(serial), "SelfSigned");
                path_line(ui, &folder, real, model.language, messages);
                None
            });
        });
    })
}

pub fn format(ui: &mut Ui, format: &mut FileFormat) {
    choices(ui, |ui| {
        for choice in FileFormat::ALL {
            ui.radio_value(format, choice, choice.extension());
        }
    });
}
