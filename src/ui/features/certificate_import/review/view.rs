use egui::{Frame, Label, RichText, Stroke, Ui};

use super::ImportReview;
use crate::jobs::CertificateChecked;
use crate::model::Problem;
use crate::pki::{CertificateFinding, Issuers, Severity};
use crate::texts::{self, TextKey as T};
use crate::ui::model::{DialogAnswer, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, note, small_note, word};

/// What was found of the certificates to be imported: errors keep a certificate out, warnings have to be agreed to.
pub fn show(ui: &Ui, review: &ImportReview, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let importable = review.importable().len();
    let submit = if review.warns() { T::ImportAnyway } else { review.source.act() };
    let why = (importable == 0).then(|| text(T::NoneToImport));
    let buttons = Buttons { submit: Some((text(submit), why)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, review.source.title(), &review.names);
    dialog(ui, "import review", &title, theme::DIALOG_WIDE, buttons, |ui| {
        if importable > 0 {
            note(ui, palette(ui).warning, |ui| {
                for remark in texts::confirmation(review.confirmation(&model.workspace)) {
                    ui.add(Label::new(text(remark)).wrap());
                }
            });
            ui.add_space(theme::SPACE);
        }
        if review.found.len() > 1 {
            small_note(ui, &texts::importable(model.language, importable, review.found.len()));
        }
        for (_, name, found) in &review.found {
            one(ui, name, found, model);
        }
    })
}

fn one(ui: &mut Ui, name: &str, found: &Result<CertificateChecked, Problem>, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    let refused = found.as_ref().map_or(true, CertificateChecked::is_refused);
    let line = if refused { palette.error } else { palette.line };
    Frame::new().stroke(Stroke::new(1.0, line)).corner_radius(8).inner_margin(theme::CARD_MARGIN).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.horizontal(|ui| {
            ui.label(RichText::new(name).strong());
            if refused {
                word(ui, T::ImportRefused.text(language), palette.error);
            }
        });
        match found {
            Err(problem) => {
                let explained = problem.code.explain(language);
                ui.add(Label::new(RichText::new(explained.message).color(palette.error)).wrap());
                small_note(ui, explained.remedy);
                if let Some(detail) = &problem.detail {
                    small_note(ui, detail);
                }
            }
            Ok(checked) => {
                match &checked.summary {
                    Some(summary) => small_note(ui, &texts::stored_certificate(language, summary, model.zone)),
                    None => small_note(ui, T::RestoreRequestOnly.text(language)),
                }
                if let Some(issuers) = &checked.issuers {
                    chain(ui, issuers, model);
                }
                if checked.findings.is_empty() && checked.summary.is_some() {
                    word(ui, T::FindingNone.text(language), palette.ok);
                }
                for finding in &checked.findings {
                    self::finding(ui, finding, model);
                }
            }
        }
    });
}

/// The issuers from the certificate's own upwards, as far as they are at hand.
fn chain(ui: &mut Ui, issuers: &Issuers, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    for (depth, issuer) in issuers.chain.iter().enumerate() {
        let summary = issuer.summary();
        ui.horizontal_wrapped(|ui| {
            ui.add_space(theme::SPACE_LARGE * (depth as f32 + 1.0));
            small_note(ui, &texts::issuer(language, &summary, model.zone));
            if summary.not_after < model.now {
                word(ui, T::Expired.text(language), palette.error);
            }
        });
    }
    if !issuers.complete {
        small_note(ui, T::IssuerNotHere.text(language));
    }
}

fn finding(ui: &mut Ui, finding: &CertificateFinding, model: &Model) {
    let palette = palette(ui);
    let (severity, color) = match finding.severity {
        Severity::Error => (T::StatusError, palette.error),
        Severity::Warning => (T::Warning, palette.warning),
    };
    let said = texts::finding(model.language, severity, &finding.explain(model.language));
    ui.add(Label::new(RichText::new(said).color(color)).wrap().selectable(true));
    // The words an OPC UA client would log.
    small_note(ui, finding.status().as_str());
}
