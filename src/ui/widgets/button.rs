use egui::{Button, Response, RichText, Stroke, Ui};

use crate::texts::TextKey;
use crate::ui::model::{Message, Model, RowId, UiCommand};
use crate::ui::theme::palette;

/// The one filled button of a window or dialog.
pub fn primary<'a>(ui: &Ui, text: &str) -> Button<'a> {
    let palette = palette(ui);
    Button::new(RichText::new(text).color(palette.on_accent).strong()).fill(palette.accent).stroke(Stroke::NONE)
}

/// A command as a button.
pub fn command_button(ui: &mut Ui, command: UiCommand, accent: bool, model: &Model, messages: &mut Vec<Message>) {
    let text = command.text().text(model.language);
    let why = command.why_disabled(model);
    // A disabled accent button would still look like the thing to press.
    let button = if accent && why.is_none() { primary(ui, text) } else { Button::new(text) };
    if answer(ui, command, why, button, model).clicked() {
        messages.push(Message::Invoke(command));
    }
}

/// A command as an item of a menu.
pub fn command_item(ui: &mut Ui, command: UiCommand, model: &Model, messages: &mut Vec<Message>) {
    item(ui, command, command.why_disabled(model), Message::Invoke(command), model, messages);
}

/// A command as an item of the context menu of a row.
pub fn row_command_item(ui: &mut Ui, command: UiCommand, row: RowId, model: &Model, messages: &mut Vec<Message>) {
    let why = command.why_disabled_for(model, model.targets_of(row));
    item(ui, command, why, Message::InvokeFor { command, row }, model, messages);
}

fn item(
    ui: &mut Ui,
    command: UiCommand,
    why: Option<TextKey>,
    message: Message,
    model: &Model,
    messages: &mut Vec<Message>,
) {
    let mut button = Button::new(command.text().text(model.language));
    if let Some(shortcut) = command.shortcut() {
        button = button.shortcut_text(ui.ctx().format_shortcut(&shortcut));
    }
    if answer(ui, command, why, button, model).clicked() {
        messages.push(message);
    }
}

fn answer(ui: &mut Ui, command: UiCommand, why: Option<TextKey>, button: Button<'_>, model: &Model) -> Response {
    // Without this a screen reader reads the shortcut as part of the name.
    let response = ui.add_enabled(why.is_none(), button).accessible_name(command.text().text(model.language));
    let tooltip = command.tooltip().text(model.language);
    match (why, command.shortcut()) {
        (Some(why), _) => response.on_disabled_hover_text(why.text(model.language)),
        (None, Some(shortcut)) => response.on_hover_ui(|ui| {
            ui.label(format!("{tooltip} ({})", ui.ctx().format_shortcut(&shortcut)));
        }),
        (None, None) => response.on_hover_text(tooltip),
    }
}
