use egui::{Label, RichText, Ui};

use crate::texts::{self, TextKey as T};
use crate::ui::features::settings_transfer::{ExportPreview, TransferDirection, TransferForm};
use crate::ui::model::{DialogAnswer, Message, Model};
use crate::ui::shell::error;
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form, labelled, mistake, note, path_line, secret_field, small_note};

/// Export or import of settings, for one controller or many (manual 2.6.4, 2.6.5).
pub fn show(
    ui: &Ui,
    transfer: &mut TransferForm,
    focus: bool,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let (title, submit, what) = match transfer.transfer {
        TransferDirection::Export => (T::ExportTitle, T::ExportButton, T::ExportText),
        TransferDirection::Import => (T::ImportTitle, T::ImportButton, T::ImportSettingsText),
    };
    let buttons =
        Buttons { submit: Some((text(submit), transfer.incomplete().map(text))), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, title, &transfer.names);
    dialog(ui, "transfer", &title, theme::DIALOG, buttons, |ui| {
        ui.add(Label::new(text(what)).wrap());
        ui.add_space(theme::SPACE_LARGE);
        form(ui, "transfer", |ui| fields(ui, transfer, focus, model, messages));
        if let ExportPreview::Unfit(problem) = &transfer.preview {
            ui.add_space(theme::SPACE);
            note(ui, palette(ui).error, |ui| {
                ui.label(RichText::new(problem.code.explain(model.language).message).strong());
                ui.add_space(theme::SPACE);
                error::explanation(ui, problem, model.language);
            });
        }
    })
}

fn fields(ui: &mut Ui, transfer: &mut TransferForm, focus: bool, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let export = transfer.transfer == TransferDirection::Export;
    labelled(ui, text(T::File), |ui| {
        ui.add_space(theme::SPACE / 2.0);
        let path = RichText::new(transfer.path.display().to_string()).monospace();
        ui.add(Label::new(path).wrap().selectable(true));
        if !transfer.path_of_one {
            small_note(ui, text(T::FilePerSerial));
        }
        None
    });
    labelled(ui, text(T::Folder), |ui| {
        path_line(ui, transfer.folder(model), true, model.language, messages);
        None
    });
    match &transfer.preview {
        ExportPreview::Reading(_) => labelled(ui, text(T::ExportedAt), |ui| {
            ui.add_space(theme::SPACE / 2.0);
            ui.label(RichText::new(text(T::Reading)).color(palette(ui).weak));
            None
        }),
        ExportPreview::Found(found) => labelled(ui, text(T::ExportedAt), |ui| {
            ui.add_space(theme::SPACE / 2.0);
            let at = model.zone.date_time(found.exported);
            ui.label(texts::exported_at(model.language, &at, found.firmware));
            None
        }),
        // The row stays: else the field below would lose the keyboard.
        ExportPreview::Unfit(_) => labelled(ui, text(T::ExportedAt), |ui| {
            ui.add_space(theme::SPACE / 2.0);
            ui.label("—");
            None
        }),
        ExportPreview::None => {}
    }
    labelled(ui, text(T::Passphrase), |ui| {
        let TransferForm { passphrase, show_passphrase, .. } = transfer;
        let response = secret_field(ui, &mut passphrase.0, show_passphrase, text(T::Optional), model.language);
        if focus {
            response.request_focus();
        }
        if let Some(error) = transfer.passphrase_error() {
            mistake(ui, text(error));
        }
        small_note(ui, text(if export { T::ExportPassphraseTip } else { T::ImportPassphraseTip }));
        Some(response)
    });
}
