use egui::{Label, RichText, Ui};

use crate::texts::{self, TextKey as T};
use crate::ui::features::restore_backup::RestoreForm;
use crate::ui::model::{BrowseField, BrowseFor, DialogAnswer, Message, Model};
use crate::ui::picker::FileKind;
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form, labelled, path_field, path_line, secret_field, small_note};
use crate::workspace::BackupKind;

const BACKUP_FILE: BrowseField = BrowseField {
    kind: FileKind::Pkcs12,
    asks_for: BrowseFor::File,
    text: |model| model.dialog::<RestoreForm>().map(|form| &mut form.file),
};

/// Puts a backup of a key back, in one controller or many (manual 2.8.1).
pub fn show(
    ui: &Ui,
    restore: &mut RestoreForm,
    focus: bool,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let why = restore.checks.running.then(|| text(T::Checking));
    let buttons = Buttons { submit: Some((text(T::RestoreButton), why)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::RestoreTitle, &restore.names);
    dialog(ui, "restore", &title, theme::DIALOG_WIDE, buttons, |ui| {
        ui.add(Label::new(text(T::RestoreText)).wrap());
        ui.add_space(theme::SPACE_LARGE);
        form(ui, "restore", |ui| fields(ui, restore, focus, model, messages));
        if restore.checks.running {
            ui.label(RichText::new(text(T::Checking)).color(palette(ui).weak));
        }
    })
}

fn fields(ui: &mut Ui, restore: &mut RestoreForm, focus: bool, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    labelled(ui, text(T::RestoreKind), |ui| {
        let first = ui.radio_value(&mut restore.kind, BackupKind::SelfSigned, text(T::RestoreSelfSigned));
        if focus {
            first.request_focus();
        }
        ui.radio_value(&mut restore.kind, BackupKind::CaSigned, text(T::RestoreCaSigned));
        None
    });
    labelled(ui, text(T::Folder), |ui| {
        let (folder, real) = match restore.kind {
            BackupKind::SelfSigned => {
                model.folder_of(&restore.rows, |files, serial| files.self_signed_folder(serial), "SelfSigned")
            }
            BackupKind::CaSigned => {
                model.folder_of(&restore.rows, |files, serial| files.ca_signed_folder(serial), "CASigned")
            }
        };
        path_line(ui, &folder, real, model.language, messages);
        if restore.rows.len() == 1 {
            small_note(ui, text(T::RestoreFormer));
        }
        None
    });
    if restore.rows.len() == 1 {
        let (label, hint, field) = (text(T::RestoreFile), text(T::RestoreFileHint), BACKUP_FILE);
        path_field(ui, label, &mut restore.file, hint, field, model.language, messages);
    }
    labelled(ui, text(T::UserFilePassword), |ui| {
        let RestoreForm { password, show_password, .. } = restore;
        Some(secret_field(ui, &mut password.0, show_password, text(T::RestorePasswordHint), model.language))
    });
}
