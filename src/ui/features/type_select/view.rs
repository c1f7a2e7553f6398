use egui::{Frame, Label, RichText, Stroke, Ui};

use crate::model::{CertificateType, ErrorCode, Feature};
use crate::texts::{self, TextKey as T};
use crate::ui::features::type_select::TypeSelectForm;
use crate::ui::model::{DialogAnswer, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, mistake, small_note, word};

/// Which of the certificates it holds a server uses (manual 2.7.2).
pub fn show(ui: &Ui, form: &mut TypeSelectForm, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let not_stored = ErrorCode::CertificateNotStored.explain(model.language).message;
    let why = match (form.task(), form.selected) {
        (Some(_), _) => None,
        _ if form.reading => Some(text(T::Reading)),
        (None, Some(_)) => Some(not_stored),
        (None, None) => Some(text(T::TypeSelectRule)),
    };
    let buttons = Buttons { submit: Some((text(T::Apply), why)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::TypeSelectTitle, &form.names);
    dialog(ui, "type select", &title, theme::DIALOG, buttons, |ui| {
        if form.reading {
            ui.label(RichText::new(text(T::Reading)).color(palette(ui).weak));
            return;
        }
        ui.label(RichText::new(text(T::TypeSelectText)).color(palette(ui).weak));
        ui.add_space(theme::SPACE);
        for kind in model.offered_types(&form.rows) {
            one(ui, form, kind, model);
        }
        let lacking: Vec<&str> = form.selected.map(|kind| lacking(form, kind, model)).unwrap_or_default();
        match form.selected {
            Some(kind) if form.storing(kind) == 0 => mistake(ui, not_stored),
            _ if !lacking.is_empty() => {
                let said = texts::type_lacking(model.language, &lacking);
                ui.add(Label::new(RichText::new(said).color(palette(ui).warning)).wrap());
            }
            _ => {}
        }
        for (row, problem) in form.held.iter().filter_map(|(row, held)| Some((row, held.as_ref().err()?))) {
            let name = model.rows.get(*row).map(|row| row.entry.name.as_str()).unwrap_or_default();
            let said = texts::not_read(model.language, name, problem.code.explain(model.language).message);
            ui.add(Label::new(RichText::new(said).size(theme::SMALL_TEXT).color(palette(ui).error)).wrap());
        }
        if form.rows.len() > 1 && model.any_lacks(&form.rows, Feature::UserSpecifiedCertificate) {
            small_note(ui, text(T::TypeSelectLegacy));
        }
    })
}

fn one(ui: &mut Ui, form: &mut TypeSelectForm, kind: CertificateType, model: &Model) {
    let language = model.language;
    let palette = palette(ui);
    let stored = form.storing(kind);
    let line = if form.selected == Some(kind) { palette.accent } else { palette.line };
    Frame::new().stroke(Stroke::new(1.0, line)).corner_radius(8).inner_margin(theme::CARD_MARGIN).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.horizontal(|ui| {
            ui.radio_value(&mut form.selected, Some(kind), texts::certificate_type(kind).text(language));
            if form.in_use(kind) {
                word(ui, T::TypeInUse.text(language), palette.ok);
            }
        });
        match form.only(kind) {
            Some(summary) => {
                small_note(ui, &texts::stored_certificate(language, summary, model.zone));
                if summary.not_after < model.now {
                    word(ui, T::Expired.text(language), palette.error);
                }
            }
            None if form.rows.len() == 1 => small_note(ui, T::TypeNotStored.text(language)),
            None => small_note(ui, &texts::stored_in(language, stored, form.rows.len())),
        }
    });
}

/// The controllers that do not store it, of those that answered.
fn lacking<'a>(form: &TypeSelectForm, kind: CertificateType, model: &'a Model) -> Vec<&'a str> {
    let rows = form.known().filter(|(_, held)| !held.stored.contains_key(&kind));
    rows.filter_map(|(row, _)| model.rows.get(row)).map(|row| row.entry.name.as_str()).collect()
}
