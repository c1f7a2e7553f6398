use egui::{Label, RichText, Ui};

use super::CsrForm;
use crate::texts::{self, TextKey as T};
use crate::ui::features::{export_self_signed, subject_fields};
use crate::ui::model::{DialogAnswer, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form, labelled, note};

/// A certificate signing request from one controller or many (manual 2.7.1.5).
pub fn show(ui: &Ui, csr: &mut CsrForm, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let why = csr.subject.why_not().map(text);
    let buttons = Buttons { submit: Some((text(T::CreateAndSave), why)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::CsrTitle, &csr.subject.names);
    dialog(ui, "csr", &title, theme::DIALOG, buttons, |ui| {
        if csr.subject.reading {
            ui.label(RichText::new(text(T::Reading)).color(palette(ui).weak));
            return;
        }
        note(ui, palette(ui).warning, |ui| {
            ui.add(Label::new(text(T::ConfirmInvalidatesCaSigned)).wrap());
        });
        ui.add_space(theme::SPACE);
        form(ui, "csr", |ui| {
            subject_fields::show(ui, &mut csr.subject, model);
            labelled(ui, text(T::FileFormat), |ui| {
                export_self_signed::format(ui, &mut csr.format);
                None
            });
        });
    })
}
