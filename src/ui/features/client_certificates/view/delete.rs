use egui::{Label, Ui};

use crate::texts::{self, TextKey as T};
use crate::ui::features::client_certificates::{DeleteTrust, PaneKind};
use crate::ui::model::{DialogAnswer, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, list, note};

/// What is deleted, and what comes of it.
pub fn show(ui: &Ui, asked: &DeleteTrust, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let (title, remark) = match asked.from {
        PaneKind::Crls => (T::CrlDeleteTitle, T::CrlDeleteText),
        PaneKind::Rejected => (T::TrustDeleteTitle, T::TrustDeleteRejected),
        PaneKind::Trusted | PaneKind::Issuers => (T::TrustDeleteTitle, T::TrustDeleteText),
    };
    let buttons = Buttons { submit: Some((text(T::Delete), None)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, title, std::slice::from_ref(&asked.name));
    dialog(ui, "delete trust", &title, theme::DIALOG, buttons, |ui| {
        note(ui, palette(ui).warning, |ui| drop(ui.add(Label::new(text(remark)).wrap())));
        ui.add_space(theme::SPACE);
        ui.label(egui::RichText::new(text(asked.from.title())).size(theme::SMALL_TEXT).color(palette(ui).weak));
        list(ui, "what", asked.what.len(), 8, |ui, index| {
            ui.add(Label::new(&asked.what[index].1).truncate());
        });
    })
}
