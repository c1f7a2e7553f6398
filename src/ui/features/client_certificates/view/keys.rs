//! The keyboard in the lists, as far as no widget takes it.

use egui::{Context, Key, KeyboardShortcut, Modifiers};

use super::filter_id;
use crate::ui::features::client_certificates::{TrustAction, TrustForm};
use crate::ui::model::Message;

/// How far Page Up and Page Down go.
const PAGE: isize = 10;

pub const UNDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Z);
const FIND: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::F);
const ALL: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::A);

pub fn read(ctx: &Context, form: &mut TrustForm, messages: &mut Vec<Message>) {
    if egui::Popup::is_any_open(ctx) {
        return;
    }
    if ctx.input_mut(|input| input.consume_shortcut(&FIND)) {
        ctx.memory_mut(|memory| memory.request_focus(filter_id()));
    }
    if ctx.text_edit_focused() {
        // Into the list.
        if ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::ArrowDown)) {
            ctx.memory_mut(|memory| memory.surrender_focus(filter_id()));
            form.move_focus(0);
        }
        return;
    }
    if ctx.input_mut(|input| input.consume_shortcut(&UNDO)) {
        messages.push(super::act(TrustAction::Undo));
    }
    // A focused button or tick box takes Space and Enter itself.
    if ctx.memory(|memory| memory.focused()).is_some() {
        return;
    }
    if ctx.input_mut(|input| input.consume_shortcut(&ALL))
        && let Some(pane) = form.focused_mut()
    {
        pane.tick_shown(!pane.all_shown_ticked());
    }
    let pressed = |key: Key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    for (key, by) in [(Key::ArrowLeft, -1), (Key::ArrowRight, 1)] {
        if pressed(key) {
            form.move_focus(by);
        }
    }
    let Some(pane) = form.focused_mut() else { return };
    for (key, by) in [
        (Key::ArrowDown, 1),
        (Key::ArrowUp, -1),
        (Key::PageDown, PAGE),
        (Key::PageUp, -PAGE),
        (Key::Home, isize::MIN),
        (Key::End, isize::MAX),
    ] {
        if pressed(key) {
            pane.move_cursor(by);
        }
    }
    if pressed(Key::Space)
        && let Some(at) = pane.cursor()
    {
        pane.toggle(at, false);
    }
    if pressed(Key::Delete) {
        messages.push(super::act(TrustAction::Delete(pane.kind)));
    }
}
