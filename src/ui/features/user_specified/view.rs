use egui::{RichText, Ui};

use crate::texts::{self, TextKey as T};
use crate::ui::features::user_specified::{UserFiles, UserSpecifiedForm};
use crate::ui::model::{BrowseField, BrowseFor, DialogAnswer, Message, Model};
use crate::ui::picker::FileKind;
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form, labelled, mistake, path_field, path_line, secret_field};

const PFX_FILE: BrowseField = BrowseField {
    kind: FileKind::Pkcs12,
    asks_for: BrowseFor::File,
    text: |model| model.dialog::<UserSpecifiedForm>().map(|form| &mut form.pfx),
};

const CERTIFICATE_FILE: BrowseField = BrowseField {
    kind: FileKind::Certificate,
    asks_for: BrowseFor::File,
    text: |model| model.dialog::<UserSpecifiedForm>().map(|form| &mut form.certificate),
};

const KEY_FILE: BrowseField = BrowseField {
    kind: FileKind::Key,
    asks_for: BrowseFor::File,
    text: |model| model.dialog::<UserSpecifiedForm>().map(|form| &mut form.key),
};

/// Import of key and certificate made with another tool (manual 2.7.1.4).
pub fn show(
    ui: &Ui,
    user: &mut UserSpecifiedForm,
    focus: bool,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let why = match user.kind {
        _ if user.checks.running => Some(T::Checking),
        _ if user.source(model).is_some() => None,
        UserFiles::Pfx => Some(T::UserPathRule),
        UserFiles::Pair => Some(T::UserFilesRule),
    };
    let buttons = Buttons { submit: Some((text(T::ImportAsk), why.map(text))), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::UserSpecifiedTitle, std::slice::from_ref(&user.name));
    dialog(ui, "user specified", &title, theme::DIALOG_WIDE, buttons, |ui| {
        form(ui, "user specified", |ui| fields(ui, user, focus, model, messages));
        if user.checks.running {
            ui.label(RichText::new(text(T::Checking)).color(palette(ui).weak));
        }
    })
}

fn fields(ui: &mut Ui, user: &mut UserSpecifiedForm, focus: bool, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    labelled(ui, text(T::UserKind), |ui| {
        let pfx = ui.radio_value(&mut user.kind, UserFiles::Pfx, text(T::UserKindPfx));
        if focus {
            pfx.request_focus();
        }
        ui.radio_value(&mut user.kind, UserFiles::Pair, text(T::UserKindPair));
        None
    });
    labelled(ui, text(T::Folder), |ui| {
        let (folder, real) =
            model.folder_of(&[user.row], |files, serial| files.user_specified_folder(serial), "UserSpecified");
        path_line(ui, &folder, real, model.language, messages);
        None
    });
    let mut path = |ui: &mut Ui, label: T, path: &mut String, field: BrowseField| {
        path_field(ui, text(label), path, text(T::FolderFileHint), field, model.language, messages);
    };
    let (label, hint) = match user.kind {
        UserFiles::Pfx => {
            path(ui, T::PfxFile, &mut user.pfx, PFX_FILE);
            (T::UserFilePassword, "")
        }
        UserFiles::Pair => {
            path(ui, T::CertificateFile, &mut user.certificate, CERTIFICATE_FILE);
            path(ui, T::KeyFile, &mut user.key, KEY_FILE);
            if user.source(model).is_none() {
                ui.label("");
                mistake(ui, text(T::UserFilesRule));
                ui.end_row();
            }
            (T::UserKeyPassword, text(T::UserKeyPasswordHint))
        }
    };
    labelled(ui, text(label), |ui| {
        Some(secret_field(ui, &mut user.password.0, &mut user.show_password, hint, model.language))
    });
}
