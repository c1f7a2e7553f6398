use egui::{Frame, Label, RichText, Stroke, Ui};

use crate::texts::{self, TextKey as T};
use crate::ui::features::import_ca_signed::CaSignedForm;
use crate::ui::model::{BrowseField, BrowseFor, DialogAnswer, Message, Model};
use crate::ui::picker::FileKind;
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form, path_field, path_line, small_note};

const CERTIFICATE_FILE: BrowseField = BrowseField {
    kind: FileKind::Certificate,
    asks_for: BrowseFor::File,
    text: |model| model.dialog::<CaSignedForm>().map(|form| &mut form.file),
};

/// Request and import of a certificate that a CA signs (manual 2.7.1.5).
pub fn show(ui: &Ui, signed: &mut CaSignedForm, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let why = signed.checks.running.then(|| text(T::Checking));
    let buttons = Buttons { submit: Some((text(T::ImportAsk), why)), close: Some(text(T::Close)) };
    let title = texts::title_for(model.language, T::CaSignedTitle, &signed.names);
    let single = signed.rows.len() == 1;
    dialog(ui, "ca signed", &title, theme::DIALOG_WIDE, buttons, |ui| {
        card(ui, text(T::CsrCard), |ui| {
            ui.add(Label::new(text(T::CsrText)).wrap());
            let (folder, real) = model.folder_of(&signed.rows, |files, serial| files.csr_folder(serial), "CSR");
            path_line(ui, &folder, real, model.language, messages);
            small_note(ui, text(T::ConfirmInvalidatesCaSigned));
            let button = egui::Button::new(text(T::CreateCsr));
            if ui.add_enabled(!signed.checks.running, button).clicked() {
                messages.push(Message::act(Model::new_csr));
            }
        });
        ui.add_space(theme::SPACE);
        card(ui, text(T::ImportCard), |ui| {
            ui.add(Label::new(text(if single { T::ImportFromFolder } else { T::ImportTextMany })).wrap());
            let (folder, real) =
                model.folder_of(&signed.rows, |files, serial| files.ca_signed_folder(serial), "CASigned");
            path_line(ui, &folder, real, model.language, messages);
            if single {
                form(ui, "ca signed", |ui| {
                    let (label, hint) = (text(T::CertificateFile), text(T::FolderFileHint));
                    let (file, field) = (&mut signed.file, CERTIFICATE_FILE);
                    path_field(ui, label, file, hint, field, model.language, messages);
                });
            }
            if signed.checks.running {
                ui.label(RichText::new(text(T::Checking)).color(palette(ui).weak));
            }
        });
    })
}

fn card(ui: &mut Ui, title: &str, body: impl FnOnce(&mut Ui)) {
    let line = palette(ui).line;
    Frame::new().stroke(Stroke::new(1.0, line)).corner_radius(8).inner_margin(theme::CARD_MARGIN).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.label(RichText::new(title).strong());
        body(ui);
    });
}
