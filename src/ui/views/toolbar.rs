use egui::{Align, Id, Layout, TextEdit, Ui};

use crate::texts::TextKey as T;
use crate::ui::model::{Message, Model, UiCommand as C};
use crate::ui::theme;
use crate::ui::widgets::command_button;

/// The search field, for the key that leads there.
pub fn search_id() -> Id {
    Id::unique("search")
}

pub fn show(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    ui.horizontal(|ui| {
        command_button(ui, C::START, true, model, messages);
        command_button(ui, C::STOP, false, model, messages);
        ui.separator();
        command_button(ui, C::GET_INFO, false, model, messages);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let mut text = model.rows.filter().to_owned();
            let edit = TextEdit::singleline(&mut text)
                .id(search_id())
                .hint_text(T::SearchTip.text(model.language))
                .desired_width(theme::SEARCH_WIDTH)
                .margin(theme::SEARCH_MARGIN);
            // A hint is not a name.
            let response = ui.add(edit).accessible_name(T::Search.text(model.language));
            if response.changed() {
                messages.push(Message::Filter(text));
            }
        });
    });
}
