use egui::{Button, RichText, Ui, vec2};

use crate::texts::TextKey as T;
use crate::ui::model::{Message, Model, UiCommand as C};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{primary, small_note};

/// What an empty list shows: the ways on.
pub fn show(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    ui.vertical_centered(|ui| {
        ui.add_space((ui.available_height() * 0.28).max(theme::SPACE_LARGE));
        ui.label(RichText::new(text(T::WelcomeTitle)).size(theme::WELCOME_TEXT).strong());
        ui.add_space(theme::SPACE);
        ui.label(RichText::new(text(T::WelcomeText)).color(palette(ui).weak));
        ui.add_space(theme::SPACE_LARGE);
        let size = vec2(280.0, 36.0);
        let add = primary(ui, text(T::WelcomeAdd)).min_size(size);
        if ui.add(add).clicked() {
            messages.push(Message::Invoke(C::ADD_CONTROLLER));
        }
        if model.virtual_available {
            ui.add_space(theme::SPACE_LARGE);
            let label = if model.virtual_starting { T::StartingVirtual } else { T::TryVirtual };
            let button = ui.add_enabled(!model.virtual_starting, Button::new(text(label)).min_size(size));
            if button.on_hover_text(text(T::TryVirtualTip)).clicked() {
                messages.push(Message::StartVirtual);
            }
            ui.scope(|ui| {
                ui.set_max_width(size.x);
                small_note(ui, text(T::WelcomeVirtualText));
            });
        }
    });
}
