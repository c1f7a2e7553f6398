use egui::{Align, Label, Layout, RichText, Ui};

use super::line::from_right;
use crate::model::Problem;
use crate::remote::client::RemoteError;
use crate::remote::{Command, Reply};
use crate::texts::{self, TextKey as T};
use crate::ui::features::remote_control::{AllowActing, RemoteForm};
use crate::ui::model::{DialogAnswer, Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, note, small_note};

/// Whether commands that act are allowed, and what became of the last one.
pub fn show(ui: &mut Ui, form: &RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let palette = palette(ui);
    let color = if form.may_act() { palette.warning } else { palette.accent };
    ui.add_space(theme::SPACE);
    note(ui, color, |ui| {
        from_right(ui, |ui| {
            if form.may_act() {
                if ui.button(text(T::RemoteForbid)).clicked() {
                    messages.push(Message::act(Model::forbid_remote_commands));
                }
            } else {
                let button = ui.add_enabled(form.is_live(), egui::Button::new(text(T::RemoteAllow)));
                if button.on_disabled_hover_text(text(T::RemoteWhyNotConnected)).clicked() {
                    messages.push(Message::act(Model::ask_to_allow_remote));
                }
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let (state, what) = match form.may_act() {
                    true => (T::RemoteAllowed, T::RemoteAllowedText),
                    false => (T::RemoteMonitoring, T::RemoteMonitoringText),
                };
                ui.label(RichText::new(text(state)).strong());
                ui.add(Label::new(RichText::new(text(what)).size(theme::SMALL_TEXT)).truncate());
            });
        });
        outcome(ui, form, model);
    });
}

/// What became of the last command; which one is being answered.
fn outcome(ui: &mut Ui, form: &RemoteForm, model: &Model) {
    if let Some(pending) = form.pending().last() {
        return small_note(ui, &texts::remote_waiting(model.language, pending.name()));
    }
    let Some((command, result)) = &form.outcome else { return };
    match result {
        Ok(reply) => small_note(ui, &done(*command, reply, model)),
        Err(error) => refusal(ui, *command, error, model),
    }
}

fn done(command: Command, reply: &Reply, model: &Model) -> String {
    match reply {
        Reply::Output(Some(output)) => format!("{command}: {output}"),
        _ => texts::remote_done(model.language, command.name()),
    }
}

/// Why a command was not done, with the conditions that the controller's state did not meet.
fn refusal(ui: &mut Ui, command: Command, error: &RemoteError, model: &Model) {
    let explained = Problem::from(error.clone()).code.explain(model.language);
    let said = format!("{command}: {}", explained.message);
    ui.add(Label::new(RichText::new(said).color(palette(ui).error).strong()).wrap());
    match error {
        RemoteError::NotReady { unmet, .. } if !unmet.is_empty() => {
            for condition in unmet {
                small_note(ui, condition.unmet_text().text(model.language));
            }
        }
        _ => small_note(ui, explained.remedy),
    }
}

/// What may move, before it is allowed.
pub fn allow(ui: &Ui, asked: &AllowActing, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::RemoteAllowNow), None)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::RemoteAllowTitle, std::slice::from_ref(&asked.name));
    dialog(ui, "allow acting", &title, theme::DIALOG, buttons, |ui| {
        ui.label(RichText::new(&asked.target).monospace().size(theme::SMALL_TEXT));
        ui.add_space(theme::SPACE);
        note(ui, palette(ui).warning, |ui| {
            for key in [T::RemoteAllowRobots, T::RemoteAllowOutputs, T::RemoteAllowProgram, T::RemoteAllowSafety] {
                ui.add(Label::new(text(key)).wrap());
            }
        });
        ui.add_space(theme::SPACE);
        small_note(ui, text(T::RemoteAllowEnds));
    })
}
