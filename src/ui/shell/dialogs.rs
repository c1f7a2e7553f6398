//! Draws the open dialogs.

use egui::output::OutputEvent;
use egui::{Context, Id, Key, Modifiers, Role, Ui};

use crate::ui::model::{Dialog, DialogAnswer, DialogPlace, Message, Model};

/// Draws the open dialogs, the last on top. `opened`: the top one is new and takes the keyboard.
pub fn show(ui: &Ui, open: &mut [Box<dyn Dialog>], opened: bool, model: &Model, messages: &mut Vec<Message>) {
    let top = open.len();
    let enter = top > 0 && model.closing.is_none() && enter_confirms(ui);
    for (index, dialog) in open.iter_mut().enumerate() {
        let on_top = index + 1 == top;
        let answer = dialog.show(ui, DialogPlace { on_top, focus: on_top && opened }, model, messages);
        match answer {
            _ if !on_top => {}
            DialogAnswer::Close => messages.push(Message::Close),
            DialogAnswer::Submit => messages.push(Message::Submit),
            DialogAnswer::None if enter && dialog.enter_submits(model) => messages.push(Message::Submit),
            DialogAnswer::None => {}
        }
    }
    if top > 0 {
        remember_focused_button(ui.ctx());
    }
}

/// Enter confirms the dialog. With the focus on a push button it presses that; with an open list it chooses from that.
/// Tick boxes and radio buttons are changed with Space.
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
