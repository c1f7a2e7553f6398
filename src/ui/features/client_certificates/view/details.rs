use egui::{Frame, Grid, Label, RichText, Stroke, Ui, vec2};

use crate::texts::{self, TextKey as T};
use crate::ui::features::client_certificates::{
    CertificateView, ChainNode, ChainState, CrlView, DetailField, DetailsView, PaneKind,
};
use crate::ui::model::{DialogAnswer, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, cell, dialog, list, list_title, note, small_note, word};

/// One certificate or CRL in full.
pub fn show(ui: &Ui, view: &DetailsView, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Close), None)), close: None };
    let (title, name) = match view {
        DetailsView::Certificate(view) => (T::TrustCertificateTitle, &view.title),
        DetailsView::Crl(view) => (T::CrlTitle, &view.title),
    };
    let title = texts::title_for(model.language, title, std::slice::from_ref(name));
    dialog(ui, "trust details", &title, theme::DIALOG_WIDE, buttons, |ui| match view {
        DetailsView::Certificate(view) => certificate(ui, view, model),
        DetailsView::Crl(view) => crl(ui, view, model),
    })
}

fn certificate(ui: &mut Ui, view: &CertificateView, model: &Model) {
    let language = model.language;
    if let Some(refusal) = &view.refused {
        note(ui, palette(ui).error, |ui| {
            ui.add(Label::new(RichText::new(refusal.explain(language)).strong()).wrap());
            // The words an OPC UA client would log.
            let words = [refusal.status.as_str(), &refusal.reason].into_iter().filter(|part| !part.is_empty());
            small_note(ui, &words.collect::<Vec<_>>().join(": "));
        });
        ui.add_space(theme::SPACE);
    }
    fields(ui, &view.fields, model);
    list_title(ui, T::TrustChain.text(language));
    chain(ui, &view.chain, model);
    ui.add_space(theme::SPACE);
    if ui.button(T::TrustCopyPem.text(language)).clicked() {
        ui.ctx().copy_text(view.pem.clone());
    }
}

fn fields(ui: &mut Ui, fields: &[DetailField], model: &Model) {
    let weak = palette(ui).weak;
    ui.spacing_mut().interact_size.y = 18.0;
    Grid::new("fields").num_columns(2).spacing(vec2(12.0, 4.0)).min_col_width(theme::LABEL_WIDTH).show(ui, |ui| {
        for field in fields {
            ui.with_layout(egui::Layout::left_to_right(egui::Align::TOP), |ui| {
                ui.label(RichText::new(field.label.text(model.language)).color(weak));
            });
            ui.vertical(|ui| {
                ui.set_width(ui.available_width());
                for line in &field.lines {
                    let line = if field.label == T::KeyLength {
                        RichText::new(texts::bits(model.language, line))
                    } else {
                        RichText::new(line)
                    };
                    let line = if field.monospace { line.monospace().size(theme::SMALL_TEXT) } else { line };
                    ui.add(Label::new(line).wrap().selectable(true));
                }
            });
            ui.end_row();
        }
    });
}

/// How far each step of a chain is moved in.
const STEP: f32 = 22.0;

/// As a tree: the root at the top, each below its issuer.
fn chain(ui: &mut Ui, nodes: &[ChainNode], model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    Frame::new().stroke(Stroke::new(1.0, palette.line)).corner_radius(8).inner_margin(theme::CARD_MARGIN).show(
        ui,
        |ui| {
            ui.set_width(ui.available_width());
            for (depth, node) in nodes.iter().enumerate() {
                let missing = node.states.contains(&ChainState::Missing);
                ui.horizontal(|ui| {
                    ui.add_space(STEP * depth as f32);
                    let (rect, _) = ui.allocate_exact_size(vec2(12.0, theme::DENSE_HEIGHT), egui::Sense::hover());
                    let bad = node.states.iter().any(|state| *state != ChainState::OnlySent);
                    let color = match (bad, node.list) {
                        (true, _) => palette.error,
                        (false, Some(PaneKind::Trusted | PaneKind::Issuers)) => palette.ok,
                        (false, _) => palette.off,
                    };
                    if depth > 0 {
                        let corner = egui::pos2(rect.left() - STEP + 6.0, rect.center().y);
                        let line = Stroke::new(1.0, palette.weak);
                        ui.painter().line_segment([egui::pos2(corner.x, rect.top() - 5.0), corner], line);
                        ui.painter().line_segment([corner, egui::pos2(rect.left(), corner.y)], line);
                    }
                    if missing {
                        ui.painter().circle_stroke(rect.center(), 4.0, Stroke::new(1.5, color));
                    } else {
                        ui.painter().circle_filled(rect.center(), 4.0, color);
                    }
                    let states = node.states.iter().map(|state| state.text_key().text(language));
                    let list = node.list.map(|list| list.title().text(language));
                    let words = list.into_iter().chain(states).collect::<Vec<_>>().join(", ");
                    let name = RichText::new(&node.name).strong();
                    let name = if missing { name.color(palette.error) } else { name };
                    // What is wrong must not be pushed out by a long name.
                    let room = (ui.available_width() * 0.55).max(120.0);
                    ui.scope(|ui| {
                        ui.set_max_width(room);
                        ui.add(Label::new(name).truncate()).on_hover_text(&node.name);
                    });
                    let color = if bad { palette.error } else { palette.weak };
                    ui.add(Label::new(RichText::new(words).size(theme::SMALL_TEXT).color(color)).wrap());
                });
            }
        },
    );
}

fn crl(ui: &mut Ui, view: &CrlView, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    if let Some(flaw) = &view.flaw {
        note(ui, palette.error, |ui| {
            ui.label(RichText::new(T::CrlUnusable.text(language)).strong());
            small_note(ui, &flaw.explain(&view.title, language));
        });
        ui.add_space(theme::SPACE);
    }
    fields(ui, &view.fields, model);
    list_title(ui, T::CrlRevoked.text(language));
    if view.entries.is_empty() {
        word(ui, T::CrlRevokedNone.text(language), palette.weak);
        return;
    }
    list(ui, "revoked", view.entries.len(), 10, |ui, index| {
        let line = &view.entries[index];
        cell(ui, 220.0, RichText::new(&line.serial_number).monospace());
        cell(ui, 130.0, RichText::new(&line.date));
        cell(ui, 130.0, RichText::new(line.reason.as_str()).color(palette.weak));
        cell(ui, f32::INFINITY, RichText::new(line.name.as_deref().unwrap_or_default()).strong());
    });
}
