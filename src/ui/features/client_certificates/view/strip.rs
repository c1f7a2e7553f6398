use egui::{Align, Frame, Label, Layout, RichText, Stroke, Ui, vec2};

use super::cell::health_words;
use crate::texts::{self, TextKey as T};
use crate::ui::features::client_certificates::{TrustAction, TrustForm, TrustListEntry};
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, Palette, palette};

/// Of the frame and its lines; in a low window the lines scroll.
pub const HIGH: f32 = 104.0;
pub const LOW: f32 = 66.0;

/// Everything about the line the cursor is on, without scrolling sideways.
pub fn show(ui: &mut Ui, form: &TrustForm, height: f32, model: &Model, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    ui.add_space(theme::SPACE);
    let frame = Frame::new().fill(palette.stripe).stroke(Stroke::new(1.0, palette.line)).corner_radius(8);
    frame.inner_margin(theme::TRUST_MARGIN).show(ui, |ui| {
        let size = vec2(ui.available_width(), height - theme::TRUST_MARGIN.sum().y - 2.0);
        ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Min), |ui| {
            ui.set_min_size(size);
            let entry = form.focused().and_then(|pane| pane.cursor_entry());
            let Some(entry) = entry else {
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    ui.label(RichText::new(T::TrustPickLine.text(model.language)).color(palette.weak));
                });
                return;
            };
            if ui.button(T::TrustDetails.text(model.language)).clicked() {
                messages.push(super::act(TrustAction::Details));
            }
            ui.with_layout(Layout::top_down(Align::Min), |ui| {
                ui.spacing_mut().item_spacing.y = 3.0;
                egui::ScrollArea::vertical().id_salt(&entry.id).auto_shrink(false).show(ui, |ui| {
                    lines(ui, entry, model, palette);
                });
            });
        });
    });
}

fn lines(ui: &mut Ui, entry: &TrustListEntry, model: &Model, palette: &Palette) {
    let language = model.language;
    ui.add(Label::new(RichText::new(&entry.issued_to).strong()).truncate());
    if let Some(refusal) = &entry.refusal {
        let said = refusal.explain(language);
        ui.add(Label::new(RichText::new(&said).color(palette.error)).truncate()).on_hover_text(&said);
        let when = if refusal.count == 0 {
            T::TrustMovedHere.text(language).to_owned()
        } else {
            let (first, last) = (&refusal.first_seen.text, &refusal.last_seen.text);
            texts::refused_times(language, &refusal.address, refusal.count, first, last)
        };
        let parts = [when, refusal.status.as_str().to_owned(), refusal.reason.clone()];
        small(ui, &parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>(), palette);
    }
    if let Some(crl) = &entry.crl {
        if let Some(health) = &crl.health {
            let (said, color) = health_words(crl, health, model, palette);
            ui.add(Label::new(RichText::new(said).color(color)).truncate());
        }
        let until = entry.until.as_ref().map(|until| labelled(model, T::CrlNextUpdate, &until.text));
        let parts = [
            Some(labelled(model, T::CrlThisUpdate, &entry.from.text)),
            until,
            Some(labelled(model, T::CrlEntries, &crl.entries.to_string())),
            (!entry.serial_number.is_empty()).then(|| labelled(model, T::CrlNumber, &entry.serial_number)),
            Some(labelled(model, T::TrustFileName, &entry.file_name)),
        ];
        small(ui, &parts.into_iter().flatten().collect::<Vec<_>>(), palette);
        return;
    }
    let until = entry.until.as_ref().map_or("", |until| &until.text);
    let parts = [
        Some(labelled(model, T::TrustIssuedBy, &entry.issued_by)),
        Some(format!("{} – {until}", entry.from.text)),
        Some(labelled(model, T::ColumnSerial, &entry.serial_number)),
        (!entry.file_name.is_empty()).then(|| labelled(model, T::TrustFileName, &entry.file_name)),
        Some(labelled(model, T::TrustThumbprint, &entry.id)),
    ];
    small(ui, &parts.into_iter().flatten().collect::<Vec<_>>(), palette);
}

fn labelled(model: &Model, label: T, value: &str) -> String {
    format!("{} {value}", label.text(model.language))
}

/// As much as fits, the rest on hover.
fn small(ui: &mut Ui, parts: &[String], palette: &Palette) {
    let said = parts.join("  ·  ");
    let text = RichText::new(&said).size(theme::SMALL_TEXT).color(palette.weak);
    ui.add(Label::new(text).wrap()).on_hover_text(said);
}
