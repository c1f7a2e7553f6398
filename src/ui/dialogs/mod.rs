//! Everything that opens over the window. One file a dialog; each draws from the model and its own form.

mod about;
mod activation;
mod add_controller;
mod authority;
mod authority_form;
mod ca_signed;
mod confirm;
mod connection_list;
mod drop;
mod error;
mod export_self_signed;
mod file;
mod import_review;
mod licences;
mod options;
mod password;
mod processing;
mod restore;
mod self_signed;
mod server_log;
mod settings;
mod transfer;
mod trust;
mod type_select;
mod user_specified;
mod users;
mod vault;
mod verify;

use egui::output::OutputEvent;
use egui::{Context, Id, Key, Modifiers, Role, Ui};

use super::model::{Dialog, Message, Model};
use super::widgets::Answer;

/// Draws the open dialogs, the last on top. `opened`: the top one is new and takes the keyboard.
pub fn show(ui: &Ui, open: &mut [Dialog], opened: bool, model: &Model, messages: &mut Vec<Message>) {
    let top = open.len();
    let enter = top > 0 && model.closing.is_none() && enter_confirms(ui);
    for (index, dialog) in open.iter_mut().enumerate() {
        let on_top = index + 1 == top;
        let answer = one(ui, dialog, on_top, on_top && opened, model, messages);
        match answer {
            _ if !on_top => {}
            Answer::Close => messages.push(Message::Close),
            Answer::Submit => messages.push(Message::Submit),
            Answer::None if enter && enter_submits(dialog, model) => messages.push(Message::Submit),
            Answer::None => {}
        }
    }
    if top > 0 {
        remember_focused_button(ui.ctx());
    }
}

/// Enter confirms the dialog whatever has the focus, except a push button, which it presses, and an open list. Tick
/// boxes and radio buttons are changed with Space.
pub fn enter_confirms(ui: &Ui) -> bool {
    let ctx = ui.ctx();
    let focused = ctx.memory(|memory| memory.focused());
    let button: Option<Id> = ctx.data(|data| data.get_temp(focused_button_id())).flatten();
    let on_button = focused.is_some() && focused == button;
    !on_button
        && !egui::Popup::is_any_open(ctx)
        && ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Enter))
}

/// Notes whether the widget that has just got the focus is a push button: egui tells what a widget is only then.
fn remember_focused_button(ctx: &Context) {
    let gained = ctx.output(|output| {
        output.events.iter().rev().find_map(|event| match event {
            OutputEvent::FocusGained(widget) => Some(matches!(widget.role, Role::Button | Role::Link)),
            _ => None,
        })
    });
    let focused = ctx.memory(|memory| memory.focused());
    if let (Some(is_button), Some(id)) = (gained, focused) {
        ctx.data_mut(|data| data.insert_temp(focused_button_id(), is_button.then_some(id)));
    }
}

fn focused_button_id() -> Id {
    Id::unique("focused button")
}

/// Enter never stops a running job.
fn enter_submits(dialog: &Dialog, model: &Model) -> bool {
    match dialog {
        Dialog::Processing(_) => model.job.as_ref().is_none_or(|job| job.summary.is_some()),
        // Its text field filters.
        Dialog::ServerLog(_) => false,
        _ => true,
    }
}

fn one(ui: &Ui, dialog: &mut Dialog, on_top: bool, focus: bool, model: &Model, messages: &mut Vec<Message>) -> Answer {
    match dialog {
        Dialog::AddController(form) => add_controller::show(ui, form, focus, model, messages),
        Dialog::Delete { names, .. } => confirm::delete(ui, names, model),
        Dialog::Confirm { task, names, confirmation, .. } => confirm::show(ui, task, names, *confirmation, model),
        Dialog::Password(form) => password::show(ui, form, focus, model),
        Dialog::Processing(view) => processing::show(ui, view, model, messages),
        Dialog::Settings(form) => settings::show(ui, form, model),
        Dialog::Users(form) => users::list(ui, form, model, messages),
        Dialog::AddUser(form) => users::add(ui, form, focus, model),
        Dialog::SelfSigned(form) => self_signed::show(ui, form, model),
        Dialog::Activation(form) => activation::show(ui, form, focus, model, messages),
        Dialog::ConnectionList(form) => connection_list::show(ui, form, focus, model, messages),
        Dialog::TypeSelect(form) => type_select::show(ui, form, model),
        Dialog::ExportSelfSigned(form) => export_self_signed::show(ui, form, model, messages),
        Dialog::CaSigned(form) => ca_signed::show(ui, form, model, messages),
        Dialog::UserSpecified(form) => user_specified::show(ui, form, focus, model, messages),
        Dialog::Restore(form) => restore::show(ui, form, focus, model, messages),
        Dialog::ImportReview(review) => import_review::show(ui, review, model),
        Dialog::ServerLog(log) => server_log::show(ui, log, model, messages),
        Dialog::SaveLog(form) => server_log::save(ui, form, model, messages),
        Dialog::Verify(view) => verify::show(ui, view, model, messages),
        Dialog::Transfer(form) => transfer::show(ui, form, focus, model, messages),
        Dialog::Trust(form) => trust::show(ui, form, on_top, model, messages),
        Dialog::AddTrust(form) => trust::add(ui, form, focus, model, messages),
        Dialog::DeleteTrust(asked) => trust::delete(ui, asked, model),
        Dialog::MoveTrust(asked) => trust::move_anyway(ui, asked, model),
        Dialog::TrustDetails(view) => trust::details(ui, view, model),
        Dialog::Drop(form) => drop::show(ui, form, model),
        Dialog::Authority(view) => authority::show(ui, view, model, messages),
        Dialog::AuthorityForm(form) => authority_form::show(ui, form, focus, model, messages),
        Dialog::Vault(form) => vault::show(ui, form, focus, model),
        Dialog::Backup { on } => options::backup(ui, on, model),
        Dialog::Options => options::options(ui, model, messages),
        Dialog::Error(problem) => error::show(ui, problem, model),
        Dialog::Licences(view) => licences::show(ui, view, focus, model),
        Dialog::About => about::about(ui, model, messages),
        Dialog::Shortcuts => about::shortcuts(ui, model),
    }
}
