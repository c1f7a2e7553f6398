use egui::{DragValue, RichText, Ui};

use super::SelfSignedForm;
use crate::model::Validity;
use crate::texts::{self, TextKey as T};
use crate::ui::features::subject_fields;
use crate::ui::model::{DialogAnswer, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form, labelled};

/// A self-signed server certificate for one controller or many (manual 2.7.1.2).
pub fn show(ui: &Ui, certificate: &mut SelfSignedForm, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let why = certificate.subject.why_not().map(text);
    let buttons = Buttons { submit: Some((text(T::CreateAndSave), why)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::SelfSignedTitle, &certificate.subject.names);
    dialog(ui, "self-signed", &title, theme::DIALOG, buttons, |ui| {
        if certificate.subject.reading {
            ui.label(RichText::new(text(T::Reading)).color(palette(ui).weak));
            return;
        }
        form(ui, "self-signed", |ui| {
            subject_fields::show(ui, &mut certificate.subject, model);
            labelled(ui, text(T::Validity), |ui| {
                Some(ui.add(DragValue::new(&mut certificate.years).range(Validity::MIN_YEARS..=Validity::MAX_YEARS)))
            });
        });
    })
}
