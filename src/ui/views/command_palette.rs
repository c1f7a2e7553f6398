//! The command palette over the window.

use egui::{Align, Align2, Button, Frame, Id, Key, Layout, Modal, Modifiers, RichText, ScrollArea, TextEdit, Ui, vec2};

use crate::texts::TextKey as T;
use crate::ui::features::COMMANDS;
use crate::ui::model::{Message, Model, PaletteAction, UiCommand};
use crate::ui::theme::{self, palette};

/// How far Page Up and Page Down go.
const PAGE: isize = 8;

pub fn show(ui: &Ui, model: &Model, messages: &mut Vec<Message>) {
    let Some(state) = &model.command_palette else { return };
    let ctx = ui.ctx();
    let found = state.found(model.language, COMMANDS);
    let selected = state.selected(found.len());
    // Taken before the text field sees them.
    let pressed = |key: Key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    for (key, by) in [(Key::ArrowDown, 1), (Key::ArrowUp, -1), (Key::PageDown, PAGE), (Key::PageUp, -PAGE)] {
        if pressed(key) {
            messages.push(Message::Palette(PaletteAction::Select(by)));
        }
    }
    if pressed(Key::Escape) {
        messages.push(Message::Palette(PaletteAction::Close));
    }
    let mut chosen = pressed(Key::Enter).then(|| found.get(selected).copied()).flatten();

    let room = ctx.content_rect();
    let id = Id::unique("command palette");
    let area = Modal::default_area(id).anchor(Align2::CENTER_TOP, vec2(0.0, theme::PALETTE_TOP));
    Modal::new(id).area(area).frame(Frame::window(ui.style())).show(ctx, |ui| {
        ui.set_width(theme::PALETTE.min(room.width() - 4.0 * theme::SPACE_LARGE));
        let mut query = state.query.clone();
        let edit = TextEdit::singleline(&mut query)
            .hint_text(T::PaletteHint.text(model.language))
            .desired_width(f32::INFINITY)
            .margin(theme::SEARCH_MARGIN);
        // A hint is not a name.
        let response = ui.add(edit).accessible_name(T::CommandPalette.text(model.language));
        if response.changed() {
            messages.push(Message::Palette(PaletteAction::Type(query)));
        }
        response.request_focus();
        ui.add_space(theme::SPACE);
        if found.is_empty() {
            ui.label(RichText::new(T::PaletteNone.text(model.language)).color(palette(ui).weak));
            return;
        }
        let is_new = is_new_selection(ui, selected, found.len());
        let height = (room.height() - theme::PALETTE_TOP - theme::DIALOG_MARGIN).min(theme::LIST_HEIGHT);
        ScrollArea::vertical().max_height(height).auto_shrink([false, true]).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            theme::style_rows(ui);
            ui.with_layout(Layout::top_down_justified(Align::Min), |ui| {
                for (position, command) in found.iter().enumerate() {
                    let clicked = line(ui, *command, position == selected, is_new, model);
                    chosen = chosen.or(clicked.then_some(*command));
                }
            });
        });
    });
    if let Some(command) = chosen.filter(|command| command.why_disabled(model).is_none()) {
        messages.push(Message::Palette(PaletteAction::Close));
        if command == UiCommand::SEARCH {
            ctx.memory_mut(|memory| memory.request_focus(super::search_id()));
        } else {
            messages.push(Message::Invoke(command));
        }
    }
}

/// Whether another command is selected than in the frame before; then the list scrolls to it.
fn is_new_selection(ui: &Ui, selected: usize, found: usize) -> bool {
    let id = Id::unique("selected command");
    let before: Option<(usize, usize)> = ui.data(|data| data.get_temp(id));
    ui.data_mut(|data| data.insert_temp(id, (selected, found)));
    before != Some((selected, found))
}

/// One command: its name, and on the right its shortcut, or why it cannot be done now. Whether it was clicked.
fn line(ui: &mut Ui, command: UiCommand, is_selected: bool, scroll: bool, model: &Model) -> bool {
    let (language, weak) = (model.language, palette(ui).weak);
    let why = command.why_disabled(model);
    let right = match (why, command.shortcut()) {
        (Some(why), _) => why.text(language).to_owned(),
        (None, Some(shortcut)) => ui.ctx().format_shortcut(&shortcut),
        (None, None) => String::new(),
    };
    let name = command.full_name(language);
    let button = Button::selectable(is_selected, name.as_str())
        .right_text(RichText::new(right).size(theme::SMALL_TEXT).color(weak))
        .min_size(vec2(0.0, theme::LIST_ROW))
        .truncate();
    // A screen reader reads the reason, but no shortcut, as part of the name.
    let spoken = why.map_or_else(|| name.clone(), |why| format!("{name} – {}", why.text(language)));
    let response = ui.add_enabled(why.is_none(), button).accessible_name(spoken);
    if is_selected && scroll {
        response.scroll_to_me(None);
    }
    response.on_hover_text(command.tooltip().text(language)).clicked()
}
