//! What stands in the columns of a list.

use egui::{Color32, Label, RichText, Sense, Ui, vec2};

use crate::pki::CrlHealth;
use crate::ui::model::Model;
use crate::ui::model::trust::{Crl, Entry, Life, TrustColumn};
use crate::ui::texts::{self, TextKey as T};
use crate::ui::theme::{self, Palette};
use crate::ui::widgets::word;

/// At first; it can be changed.
pub const fn width(column: TrustColumn) -> f32 {
    use TrustColumn as C;
    match column {
        C::IssuedTo | C::IssuedBy => 140.0,
        C::Issuer => 220.0,
        C::FileName => 130.0,
        C::SerialNumber => 140.0,
        C::ValidFrom => 95.0,
        C::ValidUntil => 155.0,
        C::Thumbprint => 330.0,
        C::Reason | C::Health => 240.0,
        C::Address => 115.0,
        C::Count | C::Entries => 70.0,
        C::FirstSeen | C::LastSeen | C::ThisUpdate => 130.0,
        C::NextUpdate => 190.0,
        C::Number => 90.0,
    }
}

/// One column of one line.
pub fn show(ui: &mut Ui, column: TrustColumn, entry: &Entry, model: &Model, palette: &Palette) {
    use TrustColumn as C;
    let language = model.language;
    let plain = |ui: &mut Ui, text: &str| drop(ui.add(Label::new(text).truncate()));
    let weak = |ui: &mut Ui, text: &str, monospace: bool| {
        let text = RichText::new(text).color(palette.weak);
        ui.add(Label::new(if monospace { text.monospace() } else { text }).truncate());
    };
    match column {
        C::IssuedTo | C::Issuer => {
            if entry.refusal.as_ref().is_some_and(|refusal| refusal.is_new) {
                let (rect, _) = ui.allocate_exact_size(vec2(8.0, theme::ROW_HEIGHT), Sense::hover());
                ui.painter().circle_filled(rect.center(), theme::CHIP_DOT + 1.0, palette.warning);
                word(ui, T::TrustNew.text(language), palette.warning);
            }
            ui.add(Label::new(RichText::new(&entry.issued_to).strong()).truncate());
        }
        C::IssuedBy => plain(ui, &entry.issued_by),
        C::FileName => plain(ui, &entry.file_name),
        C::SerialNumber => weak(ui, &entry.serial_number, true),
        C::Thumbprint => weak(ui, &entry.id, true),
        C::ValidFrom | C::ThisUpdate => {
            let color = if entry.life == Life::NotYet { palette.error } else { palette.text };
            ui.label(RichText::new(&entry.from.text).color(color));
        }
        C::ValidUntil | C::NextUpdate => life(ui, entry, model, palette),
        C::Number => weak(ui, &entry.serial_number, true),
        C::Reason | C::Address | C::Count | C::FirstSeen | C::LastSeen => {
            let Some(refusal) = &entry.refusal else { return };
            match column {
                C::Reason => {
                    let said = refusal.status.explain(language);
                    ui.add(Label::new(RichText::new(said).color(palette.error)).truncate()).on_hover_text(said);
                }
                C::Address => weak(ui, &refusal.address, true),
                C::Count => plain(ui, &refusal.count.to_string()),
                C::FirstSeen => weak(ui, &refusal.first_seen.text, false),
                _ => weak(ui, &refusal.last_seen.text, false),
            }
        }
        C::Entries => {
            if let Some(crl) = &entry.crl {
                plain(ui, &crl.entries.to_string());
            }
        }
        C::Health => {
            let Some(health) = entry.crl.as_ref().and_then(|crl| Some((crl, crl.health.as_ref()?))) else { return };
            let (said, color) = health_words(health.0, health.1, model, palette);
            ui.add(Label::new(RichText::new(&said).color(color)).truncate()).on_hover_text(said);
        }
    }
}

/// What a CRL is good for.
pub fn health_words(crl: &Crl, health: &CrlHealth, model: &Model, palette: &Palette) -> (String, Color32) {
    let words = texts::crl_health(health);
    let color = if health.is_usable() { palette.ok } else { palette.error };
    match &crl.covers {
        Some(authority) => (texts::covers(model.language, words, authority), color),
        None => (words.text(model.language).to_owned(), color),
    }
}

fn life(ui: &mut Ui, entry: &Entry, model: &Model, palette: &Palette) {
    let Some(until) = &entry.until else {
        ui.label(RichText::new("—").color(palette.weak));
        return;
    };
    let words = match entry.life {
        Life::Past => Some((T::Expired, palette.error)),
        Life::Soon { .. } => Some((T::ExpiresSoon, palette.warning)),
        Life::NotYet => Some((T::TrustNotYetValid, palette.error)),
        Life::Good => None,
    };
    ui.label(RichText::new(&until.text).color(words.map_or(palette.text, |(_, color)| color)));
    if let Some((key, color)) = words {
        let response = word(ui, key.text(model.language), color);
        if let Life::Soon { days } = entry.life {
            response.on_hover_text(texts::days_left(model.language, days));
        }
    }
}
