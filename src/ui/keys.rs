//! The keyboard, as far as no widget takes it.

use egui::{Context, Key, Modifiers};

use super::features::COMMANDS;
use super::views;
use crate::ui::model::{Message, Model, UiCommand};

/// How far Page Up and Page Down go.
const PAGE: isize = 15;

pub fn read(ctx: &Context, model: &Model, messages: &mut Vec<Message>) {
    let over_the_table = model.row_menu.is_some() || model.command_palette.is_some();
    if model.closing.is_some() || over_the_table || !model.dialogs.is_empty() || egui::Popup::is_any_open(ctx) {
        return;
    }
    let typing = ctx.text_edit_focused();
    for command in COMMANDS.iter().copied() {
        let Some(shortcut) = command.shortcut() else { continue };
        // A text field has its own use for these.
        if typing && [UiCommand::TICK_ALL, UiCommand::DELETE_CONTROLLERS].contains(&command) {
            continue;
        }
        if ctx.input_mut(|input| input.consume_shortcut(&shortcut)) {
            if command == UiCommand::SEARCH {
                ctx.memory_mut(|memory| memory.request_focus(views::search_id()));
            } else {
                messages.push(Message::Invoke(command));
            }
        }
    }
    if typing {
        if ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            ctx.memory_mut(|memory| memory.surrender_focus(views::search_id()));
        }
        return;
    }
    // A focused button or tick box takes Space and Enter itself.
    if ctx.memory(|memory| memory.focused()).is_some() {
        return;
    }
    let menu_key = ctx.input_mut(|input| {
        input.consume_key(Modifiers::NONE, Key::Menu) || input.consume_key(Modifiers::SHIFT, Key::F10)
    });
    if menu_key {
        messages.push(Message::OpenRowMenu(None));
    }
    if let Some(row) = model.rows.at_cursor().filter(|_| ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Enter)))
    {
        messages.push(Message::OpenDetails(row.id));
    }
    let mut key = |key, message: Message| {
        if ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key)) {
            messages.push(message);
        }
    };
    key(Key::ArrowDown, Message::MoveCursor(1));
    key(Key::ArrowUp, Message::MoveCursor(-1));
    key(Key::PageDown, Message::MoveCursor(PAGE));
    key(Key::PageUp, Message::MoveCursor(-PAGE));
    key(Key::Home, Message::MoveCursor(isize::MIN));
    key(Key::End, Message::MoveCursor(isize::MAX));
    key(Key::Space, Message::ToggleCursor);
}
