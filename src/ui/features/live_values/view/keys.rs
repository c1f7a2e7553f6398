//! The keyboard in the dialog, as far as no widget takes it.

use egui::{Context, Key, Modifiers};

use crate::ui::features::live_values::{BrowserMove, LiveForm, LiveSection};
use crate::ui::model::{Message, Model};

/// How far Page Up and Page Down go in the tree.
const PAGE: isize = 15;

/// Ctrl+Page Up and Ctrl+Page Down turn the tabs; the arrow keys move in the tree.
pub fn read(ctx: &Context, form: &mut LiveForm, messages: &mut Vec<Message>) {
    if form.layout.is_none() || egui::Popup::is_any_open(ctx) {
        return;
    }
    for (key, by) in [(Key::PageDown, 1), (Key::PageUp, -1)] {
        if ctx.input_mut(|input| input.consume_key(Modifiers::COMMAND, key)) {
            form.section = form.section.turned(by);
            messages.push(Message::act(Model::live_section_changed));
        }
    }
    // A focused button or field takes the arrows itself.
    if form.section != LiveSection::Nodes || ctx.memory(|memory| memory.focused()).is_some() {
        return;
    }
    let pressed = |key: Key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let browser = &mut form.browser;
    for (key, by) in [
        (Key::ArrowDown, 1),
        (Key::ArrowUp, -1),
        (Key::PageDown, PAGE),
        (Key::PageUp, -PAGE),
        (Key::Home, isize::MIN),
        (Key::End, isize::MAX),
    ] {
        if pressed(key)
            && let Some(node) = browser.move_selection(by)
        {
            messages.push(Message::act(move |model| model.live_moved(BrowserMove::Selected(node))));
        }
    }
    let right = pressed(Key::ArrowRight).then(|| browser.right()).flatten();
    let left = pressed(Key::ArrowLeft).then(|| browser.left()).flatten();
    if let Some(moved) = right.or(left) {
        messages.push(Message::act(move |model| model.live_moved(moved)));
    }
}
