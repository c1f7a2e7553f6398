use egui::{Button, Label, RichText, Ui};

use crate::model::{ErrorCode, Problem};
use crate::texts::TextKey as T;
use crate::ui::features::live_values::form::{LiveConnection, LiveForm};
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{form as fields, labelled, mistake, note, secret_field, small_note, text_field};

/// Why there is no connection and what helps, and the fields for another login.
pub fn show(ui: &mut Ui, form: &mut LiveForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let palette = palette(ui);
    match form.link.clone() {
        LiveConnection::Lost(problem) => {
            note(ui, palette.warning, |ui| why(ui, &problem, form.layout.is_some(), model))
        }
        LiveConnection::Ended(problem) => note(ui, palette.error, |ui| {
            why(ui, &problem, form.layout.is_some(), model);
            ui.horizontal(|ui| {
                if problem.code == ErrorCode::ConfiguratorNotTrusted && ui.button(text(T::VerifyTrust)).clicked() {
                    messages.push(Message::act(Model::trust_for_live_values));
                }
                if !form.asks_for_login && ui.button(text(T::Retry)).clicked() {
                    messages.push(Message::act(Model::reconnect_live));
                }
            });
        }),
        LiveConnection::Connecting if form.layout.is_none() => {
            ui.label(RichText::new(text(T::LiveConnecting)).color(palette.weak));
        }
        LiveConnection::Connecting | LiveConnection::Live => {}
    }
    if form.asks_for_login {
        login(ui, form, model, messages);
    }
    if form.asks_for_login || !matches!(form.link, LiveConnection::Live | LiveConnection::Connecting) {
        ui.add_space(theme::SPACE);
    }
}

fn why(ui: &mut Ui, problem: &Problem, has_values: bool, model: &Model) {
    let explained = problem.code.explain(model.language);
    ui.add(Label::new(RichText::new(explained.message).strong()).wrap());
    small_note(ui, explained.remedy);
    if has_values {
        small_note(ui, T::LiveOld.text(model.language));
    }
}

fn login(ui: &mut Ui, form: &mut LiveForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    ui.add_space(theme::SPACE);
    small_note(ui, text(T::LiveLoginText));
    let why = form.typed_login().err();
    fields(ui, "live login", |ui| {
        labelled(ui, text(T::UserName), |ui| Some(text_field(ui, &mut form.user, text(T::UserRule))));
        labelled(ui, text(T::UserPassword), |ui| {
            let response = secret_field(ui, &mut form.password.0, &mut form.show_password, "", model.language);
            if let Some(why) = why {
                mistake(ui, text(why));
            }
            Some(response)
        });
    });
    let button = ui.add_enabled(why.is_none(), Button::new(text(T::LiveConnect)));
    if button.on_disabled_hover_text(why.map_or("", text)).clicked() {
        messages.push(Message::act(Model::reconnect_live));
    }
}
