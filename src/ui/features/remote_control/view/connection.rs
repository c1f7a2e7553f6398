use egui::{Align, Button, Label, Layout, RichText, Ui};

use super::line::from_right;
use crate::model::Problem;
use crate::texts::TextKey as T;
use crate::ui::features::remote_control::{RemoteForm, RemoteLink};
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{
    chip, form as fields, labelled, mistake, note, primary, secret_field, small_note, text_field,
};

/// Where it is connected, whether what is shown is current and why not, and the fields for another connection.
pub fn show(ui: &mut Ui, form: &mut RemoteForm, focus: bool, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    from_right(ui, |ui| {
        link(ui, form, model);
        if form.watch.is_some() && ui.button(text(T::RemoteDisconnect)).clicked() {
            messages.push(Message::act(Model::disconnect_remote));
        }
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let Some(used) = form.used.as_ref().filter(|_| form.watch.is_some()) else { return };
            let target = RichText::new(used.target.to_string()).monospace().size(theme::SMALL_TEXT);
            let button = ui.selectable_label(form.edits_connection, target);
            if button.on_hover_text(text(T::RemoteChangeConnection)).clicked() {
                form.edits_connection = !form.edits_connection;
            }
        });
    });
    let palette = palette(ui);
    let has_values = form.status.is_some();
    match &form.link {
        RemoteLink::Lost(problem) => note(ui, palette.warning, |ui| why(ui, problem, has_values, model)),
        RemoteLink::Ended(problem) => note(ui, palette.error, |ui| why(ui, problem, has_values, model)),
        RemoteLink::Connecting => drop(ui.label(RichText::new(text(T::LiveConnecting)).color(palette.weak))),
        RemoteLink::Off | RemoteLink::Live => {}
    }
    if form.edits_connection {
        ui.add_space(theme::SPACE);
        edit(ui, form, focus, model, messages);
    }
    ui.add_space(theme::SPACE);
}

fn why(ui: &mut Ui, problem: &Problem, has_values: bool, model: &Model) {
    let explained = problem.code.explain(model.language);
    ui.add(Label::new(RichText::new(explained.message).strong()).wrap());
    small_note(ui, explained.remedy);
    if let Some(detail) = &problem.detail {
        small_note(ui, detail);
    }
    if has_values {
        small_note(ui, T::RemoteOld.text(model.language));
    }
}

fn edit(ui: &mut Ui, form: &mut RemoteForm, focus: bool, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let why = form.typed_connection().err();
    fields(ui, "remote connection", |ui| {
        labelled(ui, text(T::RemoteTarget), |ui| {
            let response = text_field(ui, &mut form.target, "tcp://192.168.0.1:5000");
            if focus {
                response.request_focus();
            }
            if why == Some(T::RemoteTargetRule) {
                mistake(ui, text(T::RemoteTargetRule));
            }
            small_note(ui, text(T::RemoteTargetForms));
            Some(response)
        });
        labelled(ui, text(T::UserPassword), |ui| {
            let hint = text(T::PasswordHint);
            let response = secret_field(ui, &mut form.password.0, &mut form.show_password, hint, model.language);
            if why == Some(T::RemotePasswordRule) {
                mistake(ui, text(T::RemotePasswordRule));
            }
            Some(response)
        });
    });
    small_note(ui, text(T::RemoteOneClient));
    let button = if why.is_none() { primary(ui, text(T::LiveConnect)) } else { Button::new(text(T::LiveConnect)) };
    let button = ui.add_enabled(why.is_none(), button);
    if button.on_disabled_hover_text(why.map_or("", text)).clicked() {
        messages.push(Message::act(Model::connect_remote));
    }
}

fn link(ui: &mut Ui, form: &RemoteForm, model: &Model) {
    let text = |key: T| key.text(model.language);
    let palette = palette(ui);
    let explained = |problem: &Problem| problem.code.explain(model.language).message;
    match &form.link {
        RemoteLink::Off => drop(chip(ui, text(T::RemoteNotConnected), palette.off)),
        RemoteLink::Connecting => drop(chip(ui, text(T::LiveConnecting), palette.accent)),
        RemoteLink::Live => drop(chip(ui, text(T::TrustLive), palette.ok).on_hover_text(text(T::RemoteLiveTip))),
        RemoteLink::Lost(problem) => {
            drop(chip(ui, text(T::TrustLost), palette.warning).on_hover_text(explained(problem)))
        }
        RemoteLink::Ended(problem) => {
            drop(chip(ui, text(T::TrustEnded), palette.error).on_hover_text(explained(problem)))
        }
    }
}
