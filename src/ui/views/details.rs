//! The details pane: what is known about the controller under the cursor.

use egui::{Align, Button, Frame, Label, Layout, Panel, RichText, ScrollArea, Ui};

use crate::model::{CertificateSummary, ControllerInfo, UserTokenPolicy};
use crate::texts::{self, TextKey as T};
use crate::ui::model::{Message, Model, Row, RowState};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::small_note;

pub fn show(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    let width = model.options.window.details_width.unwrap_or(theme::DETAILS);
    let most = (ui.available_width() - theme::DETAILS_LEAVES).max(theme::DETAILS_MIN);
    let frame = Frame::new().fill(palette(ui).panel).inner_margin(theme::CARD_MARGIN);
    let shown = Panel::right("details")
        .frame(frame)
        .resizable(true)
        .default_size(width.clamp(theme::DETAILS_MIN, most))
        .size_range(theme::DETAILS_MIN..=most)
        .show(ui, |ui| pane(ui, model, messages));
    let now = shown.response.rect.width().round();
    // A window that is too narrow for it is no choice to remember.
    if (now - width).abs() >= 1.0 && ui.input(|input| input.pointer.any_released()) && width <= most {
        messages.push(Message::DetailsWidth(now));
    }
}

fn pane(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let row = model.rows.at_cursor();
    ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
        if ui.button(text(T::Close)).clicked() {
            messages.push(Message::CloseDetails);
        }
        ui.with_layout(Layout::left_to_right(Align::Min), |ui| {
            let title = row.map_or(text(T::RowDetails), |row| row.entry.name.as_str());
            ui.add(Label::new(RichText::new(title).size(theme::TITLE_TEXT).strong()).truncate());
        });
    });
    ui.add_space(theme::SPACE);
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| match row {
        Some(row) => details(ui, row, model, messages),
        None => small_note(ui, text(T::DetailsChoose)),
    });
}

fn details(ui: &mut Ui, row: &Row, model: &Model, messages: &mut Vec<Message>) {
    controller(ui, row, model);
    if let Some(info) = row.info() {
        server(ui, info, model);
        certificate(ui, info, model);
    }
    last_result(ui, row, model);
    lists(ui, row, model, messages);
}

fn controller(ui: &mut Ui, row: &Row, model: &Model) {
    let text = |key: T| key.text(model.language);
    field(ui, text(T::ColumnAddress), &row.address);
    field(ui, text(T::ColumnType), row.entry.series.as_str());
    match &row.entry.fingerprint {
        Some(fingerprint) => field(ui, text(T::FingerprintLabel), &fingerprint.to_string()),
        None => colored(ui, text(T::FingerprintLabel), text(T::NotConfirmed), palette(ui).warning),
    }
    match &row.entry.last {
        Some(last) => field(ui, text(T::ColumnRetrieved), &model.zone.date_time(last.at)),
        None => field(ui, text(T::ColumnRetrieved), text(T::NotRead)),
    }
    if let Some(info) = row.info() {
        field(ui, text(T::ColumnSerial), info.serial.as_str());
        field(ui, text(T::DetailsFirmware), &info.firmware.to_string());
        field(ui, text(T::ColumnActivation), text(if info.activated { T::Yes } else { T::No }));
    }
}

fn server(ui: &mut Ui, info: &ControllerInfo, model: &Model) {
    let text = |key: T| key.text(model.language);
    heading(ui, text(T::DetailsServer));
    let status = text(texts::status(info.status));
    match info.error {
        None => field(ui, text(T::ColumnStatus), status),
        Some(error) => {
            let status = texts::status_with_error(status, error);
            colored(ui, text(T::ColumnStatus), &status, palette(ui).error);
            small_note(ui, error.explain(model.language).remedy);
        }
    }
    field(ui, text(T::VerifyEndpoint), &info.endpoint);
}

fn certificate(ui: &mut Ui, info: &ControllerInfo, model: &Model) {
    let text = |key: T| key.text(model.language);
    heading(ui, text(T::MenuCertificate));
    let Some(certificate) = &info.certificate else {
        ui.label(text(T::DetailsNoCertificate));
        return;
    };
    field(ui, text(T::ColumnCertificate), text(texts::certificate_type(certificate.kind)));
    let summary = &certificate.summary;
    let CertificateSummary {
        issued_to, issued_by, not_before, not_after, thumbprint, key_bits, application_uri, ..
    } = summary;
    field(ui, text(T::TrustIssuedTo), issued_to);
    field(ui, text(T::TrustIssuedBy), issued_by);
    field(ui, text(T::TrustValidFrom), &model.zone.date(*not_before));
    let until = model.zone.date(*not_after);
    if *not_after <= model.now {
        colored(ui, text(T::TrustValidUntil), &format!("{until} – {}", text(T::Expired)), palette(ui).error);
    } else {
        field(ui, text(T::TrustValidUntil), &until);
    }
    field(ui, text(T::KeyLength), &format!("RSA {key_bits}"));
    if let Some(uri) = application_uri {
        field(ui, text(T::DetailsApplicationUri), uri);
    }
    field(ui, text(T::TrustThumbprint), thumbprint);
}

fn last_result(ui: &mut Ui, row: &Row, model: &Model) {
    let text = |key: T| key.text(model.language);
    heading(ui, text(T::DetailsLastResult));
    let Some(result) = &row.last_result else {
        small_note(ui, text(T::DetailsNoResult));
        return;
    };
    let name = text(result.title).trim_end_matches('…');
    let when = model.zone.date_time(result.at);
    match &result.state {
        RowState::Failed(problem) => {
            colored(ui, &format!("{name}, {when}"), text(T::StateFailed), palette(ui).error);
            let explained = problem.code.explain(model.language);
            for sentence in [explained.message, explained.remedy] {
                ui.add(Label::new(sentence).wrap());
            }
        }
        RowState::NotStarted => field(ui, &format!("{name}, {when}"), text(T::StateNotStarted)),
        _ => field(ui, &format!("{name}, {when}"), text(T::StateDone)),
    }
}

fn lists(ui: &mut Ui, row: &Row, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    heading(ui, text(T::DetailsLists));
    match &row.overview {
        None => small_note(ui, text(T::DetailsNotRead)),
        Some(read) => {
            field(ui, text(T::ColumnRetrieved), &model.zone.date_time(read.at));
            let overview = &read.overview;
            let names = |names: Vec<&str>| match names[..] {
                [] => text(T::DetailsNone).to_owned(),
                _ => names.join(", "),
            };
            let policies = overview.settings.security_policies.iter().map(|policy| policy.as_str()).collect();
            field(ui, text(T::SecurityPolicy), &names(policies));
            let tokens = overview.settings.user_tokens.iter().map(|token| text(token_name(*token))).collect();
            field(ui, text(T::TokenPolicy), &names(tokens));
            let counts = [
                (T::UsersTitle, Some(overview.users)),
                (T::TrustTrusted, Some(overview.trusted)),
                (T::TrustRejected, Some(overview.rejected)),
                (T::TrustIssuers, overview.issuers),
                (T::TrustCrls, Some(overview.crls)),
            ];
            for (label, count) in counts {
                if let Some(count) = count {
                    field(ui, text(label), &count.to_string());
                }
            }
        }
    }
    let can_read = row.entry.fingerprint.is_some() && model.job.is_none();
    if ui.add_enabled(can_read, Button::new(text(T::DetailsRead))).clicked() {
        messages.push(Message::ReadOverview(row.id));
    }
    let live = Button::new(text(T::LiveValues));
    if ui.add_enabled(can_read, live).on_hover_text(text(T::LiveValuesTip)).clicked() {
        let row = row.id;
        messages.push(Message::act(move |model| model.open_live_values(row)));
    }
}

const fn token_name(token: UserTokenPolicy) -> T {
    match token {
        UserTokenPolicy::Anonymous => T::TokenAnonymous,
        UserTokenPolicy::UserName => T::TokenUserName,
    }
}

fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(theme::SPACE);
    ui.separator();
    ui.label(RichText::new(text).strong());
}

/// A small label over a value that can be selected and wraps.
fn field(ui: &mut Ui, label: &str, value: &str) {
    colored(ui, label, value, palette(ui).text);
}

fn colored(ui: &mut Ui, label: &str, value: &str, color: egui::Color32) {
    ui.spacing_mut().item_spacing.y = theme::DETAILS_SPACING;
    ui.label(RichText::new(label).size(theme::SMALL_TEXT).color(palette(ui).weak));
    ui.add(Label::new(RichText::new(value).color(color)).wrap().selectable(true));
    ui.add_space(3.0 * theme::DETAILS_SPACING);
}
