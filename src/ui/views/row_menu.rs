//! The context menu of a row: what the menus offer for that controller.

use egui::{Align, Id, LayerId, Layout, Popup, PopupAnchor, PopupCloseBehavior, PopupKind, Pos2, Rect, RichText, Ui};

use crate::texts::{self, TextKey as T};
use crate::ui::features::{CERTIFICATE_MENU, CREATE_MENU, SERVER_MENU};
use crate::ui::model::{Message, Model, RowId, Targets, UiCommand as C};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::row_command_item;

/// Notes where the row under the cursor is, for a menu that is opened with the keyboard.
pub fn note_cursor_row(ui: &Ui, row: Rect) {
    ui.data_mut(|data| data.insert_temp(cursor_row_id(), row));
}

fn cursor_row_id() -> Id {
    Id::unique("row under the cursor")
}

pub fn show(ui: &Ui, model: &Model, messages: &mut Vec<Message>) {
    let Some(menu) = model.row_menu else { return };
    // It may have been deleted meanwhile.
    let Some(row) = model.rows.get(menu.row) else {
        messages.push(Message::CloseRowMenu);
        return;
    };
    let below_row = |row: Rect| row.left_bottom() + egui::vec2(theme::TICK_COLUMN, 0.0);
    let cursor_row: Option<Rect> = ui.data(|data| data.get_temp(cursor_row_id()));
    let at = menu.at.map(Pos2::from).or(cursor_row.map(below_row)).unwrap_or(ui.ctx().content_rect().center());
    let mut open = true;
    Popup::new(Id::unique("row menu"), ui.ctx().clone(), PopupAnchor::Position(at), LayerId::background())
        .kind(PopupKind::Menu)
        .layout(Layout::top_down_justified(Align::Min))
        .style(egui::containers::menu::menu_style)
        .close_behavior(PopupCloseBehavior::CloseOnClick)
        .gap(0.0)
        .open_bool(&mut open)
        .show(|ui| {
            let title = match model.targets_of(row.id) {
                Targets::Ticked => texts::menu_for_ticked(model.language, model.rows.ticked_count()),
                Targets::Row(_) => texts::menu_for_one(model.language, row.entry.name.as_str()),
            };
            ui.label(RichText::new(title).size(theme::SMALL_TEXT).color(palette(ui).weak));
            items(ui, row.id, model, messages);
        });
    if !open {
        messages.push(Message::CloseRowMenu);
    }
}

fn items(ui: &mut Ui, row: RowId, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    if ui.button(text(T::RowDetails)).clicked() {
        messages.push(Message::OpenDetails(row));
    }
    ui.separator();
    groups(
        ui,
        &[&[C::START, C::STOP, C::GET_INFO, C::VERIFY, C::LIVE_VALUES, C::REMOTE_CONTROL, C::RECORDER]],
        row,
        model,
        messages,
    );
    ui.separator();
    ui.menu_button(text(T::MenuCertificate), |ui| {
        ui.menu_button(text(T::MenuCreate), |ui| groups(ui, CREATE_MENU, row, model, messages));
        groups(ui, CERTIFICATE_MENU, row, model, messages);
    });
    ui.menu_button(text(T::MenuServer), |ui| groups(ui, SERVER_MENU, row, model, messages));
    ui.separator();
    groups(ui, &[&[C::CONFIRM_IDENTITY, C::DELETE_CONTROLLERS]], row, model, messages);
}

fn groups(ui: &mut Ui, groups: &[&[C]], row: RowId, model: &Model, messages: &mut Vec<Message>) {
    for (index, group) in groups.iter().enumerate() {
        if index > 0 {
            ui.separator();
        }
        for command in *group {
            row_command_item(ui, *command, row, model, messages);
        }
    }
}
