use chrono::{DateTime, Utc};
use egui::{Button, Color32, Frame, Label, RichText, Stroke, Ui};

use crate::model::CertificateProfile;
use crate::texts::{self, TextKey as T};
use crate::ui::features::certificate_authority::{AuthorityCommand, AuthorityView};
use crate::ui::model::{DialogAnswer, Expiry, Message, Model};
use crate::ui::theme::{self, Palette, palette};
use crate::ui::widgets::{Buttons, cell, chip, dialog, list, list_title, note, path_line, word};
use crate::workspace::authority::{AuthorityOverview, CertificateState, IssuedCertificate, PublishedAuthority};

/// The small CA: what it is, what it has issued, and what it can be asked for.
pub fn show(ui: &Ui, view: &mut AuthorityView, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: None, close: Some(text(T::Close)) };
    let overview = view.overview.take();
    let width = if overview.is_some() { theme::DIALOG_AUTHORITY } else { theme::DIALOG };
    let answer = dialog(ui, "authority", text(T::CaTitle), width, buttons, |ui| match &overview {
        Some(overview) => self::overview(ui, view, overview, model, messages),
        None if view.reading.is_some() => {
            ui.label(RichText::new(text(T::Reading)).color(palette(ui).weak));
        }
        None => nothing(ui, model, messages),
    });
    view.overview = overview;
    answer
}

fn nothing(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    ui.label(RichText::new(text(T::CaNone)).strong());
    ui.add(Label::new(text(T::CaNoneText)).wrap());
    ui.add_space(theme::SPACE_LARGE);
    ui.horizontal(|ui| {
        for (key, command) in [(T::CaCreate, AuthorityCommand::Create), (T::CaRestore, AuthorityCommand::Restore)] {
            if ui.button(text(key)).clicked() {
                messages.push(Message::act(move |model| model.ask_authority(command)));
            }
        }
    });
}

fn overview(
    ui: &mut Ui,
    view: &mut AuthorityView,
    overview: &AuthorityOverview,
    model: &Model,
    messages: &mut Vec<Message>,
) {
    let text = |key: T| key.text(model.language);
    if let Some(saved) = &view.saved {
        note(ui, palette(ui).ok, |ui| {
            ui.add(Label::new(texts::ca_saved(model.language, saved)).wrap().selectable(true));
        });
        ui.add_space(theme::SPACE);
    }
    Frame::new().stroke(Stroke::new(1.0, palette(ui).line)).corner_radius(8).inner_margin(theme::CARD_MARGIN).show(
        ui,
        |ui| {
            ui.set_width(ui.available_width());
            for ca in std::iter::once(&overview.signing).chain(&overview.root) {
                authority(ui, ca, model);
            }
            path_line(ui, &overview.folder, true, model.language, messages);
        },
    );
    list_title(ui, text(T::CaIssued));
    issued(ui, view, overview, model);
    ui.add_space(theme::SPACE);
    actions(ui, view, overview, model, messages);
}

fn authority(ui: &mut Ui, ca: &PublishedAuthority, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(texts::authority(language, &ca.summary, model.zone)).strong());
        due(ui, ca.summary.not_after, model, palette);
    });
    ui.horizontal_wrapped(|ui| {
        let next = ca.crl.next_update();
        let entries = ca.crl.summary().entries;
        let said = texts::crl_state(language, entries, ca.crl_number, next.map(|next| model.zone.date(next)));
        ui.label(format!("{}  {said}", T::CaCrl.text(language)));
        if let Some(next) = next {
            due(ui, next, model, palette);
        }
    });
    ui.add_space(theme::SPACE / 2.0);
}

/// Says so where something is over or soon will be.
fn due(ui: &mut Ui, end: DateTime<Utc>, model: &Model, palette: &Palette) {
    match Expiry::of(end, model.now) {
        Expiry::Past => drop(word(ui, T::Expired.text(model.language), palette.error)),
        Expiry::Soon { days } => {
            let response = word(ui, T::ExpiresSoon.text(model.language), palette.warning);
            response.on_hover_text(texts::days_left(model.language, days));
        }
        Expiry::Later => {}
    }
}

fn issued(ui: &mut Ui, view: &mut AuthorityView, overview: &AuthorityOverview, model: &Model) {
    let text = |key: T| key.text(model.language);
    if overview.issued.is_empty() {
        ui.label(RichText::new(text(T::CaIssuedNone)).color(palette(ui).weak));
        return;
    }
    let count = overview.issued.len();
    list(ui, "issued", count, 9, |ui, index| {
        // The newest first.
        let issued = &overview.issued[count - 1 - index];
        line(ui, view, issued, model);
    });
}

fn line(ui: &mut Ui, view: &mut AuthorityView, issued: &IssuedCertificate, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    let state = issued.state(model.now);
    let mut on = view.ticked.contains(&issued.serial_number);
    ui.scope(|ui| {
        ui.set_width(TO_WIDTH);
        let tick = egui::Checkbox::new(&mut on, &issued.issued_to);
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Truncate);
        if ui.add_enabled(state != CertificateState::Revoked, tick).changed() {
            if on {
                view.ticked.insert(issued.serial_number.clone());
            } else {
                view.ticked.remove(&issued.serial_number);
            }
        }
    });
    cell(ui, SERIAL_WIDTH, RichText::new(&issued.serial_number).size(theme::SMALL_TEXT).monospace());
    let profile = match issued.profile {
        CertificateProfile::Server => T::CaServer,
        CertificateProfile::Client => T::CaClient,
    };
    cell(ui, PROFILE_WIDTH, RichText::new(profile.text(language)));
    status(ui, issued, state, model);
    let expiry = Expiry::of(issued.not_after, model.now);
    let color = match expiry {
        Expiry::Past => palette.error,
        Expiry::Soon { .. } => palette.warning,
        Expiry::Later => palette.text,
    };
    cell(ui, DATE_WIDTH, RichText::new(model.zone.date(issued.not_after)).color(color));
    let controller = issued.controller.as_ref().map(|controller| controller.name.to_string()).unwrap_or_default();
    cell(ui, ui.available_width(), RichText::new(controller).color(palette.weak));
}

fn status(ui: &mut Ui, issued: &IssuedCertificate, state: CertificateState, model: &Model) {
    let palette = palette(ui);
    let (key, color): (T, Color32) = match state {
        CertificateState::Valid => (T::CaValid, palette.ok),
        CertificateState::Expired => (T::CaExpired, palette.error),
        CertificateState::Revoked => (T::CaRevoked, palette.error),
    };
    let size = egui::vec2(STATUS_WIDTH, theme::LIST_ROW);
    ui.allocate_ui_with_layout(size, egui::Layout::left_to_right(egui::Align::Center), |ui| {
        ui.set_min_width(STATUS_WIDTH);
        let response = chip(ui, key.text(model.language), color);
        if let Some(revocation) = issued.revoked {
            let reason = texts::reason(revocation.reason).text(model.language);
            response.on_hover_text(format!("{} – {reason}", model.zone.date_time(revocation.at)));
        }
    });
}

fn actions(
    ui: &mut Ui,
    view: &AuthorityView,
    overview: &AuthorityOverview,
    model: &Model,
    messages: &mut Vec<Message>,
) {
    let text = |key: T| key.text(model.language);
    let nobody = (model.rows.ticked_count() == 0).then_some(T::WhyTick);
    let nothing = view.ticked.is_empty().then_some(T::CaTickIssued);
    let expired = (overview.signing.summary.not_after < model.now).then_some(T::Expired);
    ui.horizontal_wrapped(|ui| {
        for (key, command, why) in [
            (T::CaSignTicked, AuthorityCommand::SignControllers, expired.or(nobody)),
            (T::CaSignFile, AuthorityCommand::SignFile, expired),
            (T::CaRevoke, AuthorityCommand::Revoke, expired.or(nothing)),
            (T::CaPublish, AuthorityCommand::PublishCrl, expired),
            (T::CaBackUp, AuthorityCommand::BackUp, None),
        ] {
            let response = ui.add_enabled(why.is_none(), Button::new(text(key)));
            let response = match (why, key) {
                (Some(why), _) => response.on_disabled_hover_text(text(why)),
                (None, T::CaSignTicked) => response.on_hover_text(text(T::CaSignTickedTip)),
                _ => response,
            };
            if response.clicked() {
                messages.push(Message::act(move |model| model.ask_authority(command)));
            }
        }
    });
}

const TO_WIDTH: f32 = 280.0;
const SERIAL_WIDTH: f32 = 250.0;
const PROFILE_WIDTH: f32 = 88.0;
const STATUS_WIDTH: f32 = 92.0;
const DATE_WIDTH: f32 = 90.0;
