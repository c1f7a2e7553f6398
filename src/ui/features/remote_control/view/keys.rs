//! The keyboard in the dialog, as far as no widget takes it. No key lets anything move but Enter in the field for commands
//! of SPEL+.

use egui::{Context, Key, Modifiers};

use crate::ui::features::remote_control::{RemoteForm, RemoteSection};
use crate::ui::model::Message;

/// Ctrl+Page Up and Ctrl+Page Down turn the tabs; Up and Down bring commands of SPEL+ back.
pub fn read(ctx: &Context, form: &mut RemoteForm, messages: &mut Vec<Message>) {
    if egui::Popup::is_any_open(ctx) {
        return;
    }
    for (key, by) in [(Key::PageDown, 1), (Key::PageUp, -1)] {
        if ctx.input_mut(|input| input.consume_key(Modifiers::COMMAND, key)) {
            let section = form.section.turned(by);
            messages.push(Message::act(move |model| model.turn_remote(section)));
        }
    }
    if form.section != RemoteSection::Execute || form.edits_connection {
        return;
    }
    for (key, by) in [(Key::ArrowUp, 1), (Key::ArrowDown, -1)] {
        if ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key)) {
            form.execute.recall(by);
        }
    }
}
