//! The main window.

mod command_palette;
mod details;
mod main_menu;
mod row_menu;
mod status_bar;
mod table;
mod toolbar;
mod welcome;

use egui::{CentralPanel, Frame, Panel, Ui};

use super::theme::{self, palette};
use crate::ui::model::{Message, Model};

pub use toolbar::search_id;

pub fn window(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    let bar = |margin| Frame::new().fill(palette.panel).inner_margin(margin);
    Panel::top("menu").frame(bar(theme::MENU_MARGIN)).show(ui, |ui| main_menu::show(ui, model, messages));
    Panel::top("toolbar").frame(bar(theme::TOOLBAR_MARGIN)).show(ui, |ui| toolbar::show(ui, model, messages));
    Panel::bottom("status").frame(bar(theme::STATUS_MARGIN)).show(ui, |ui| status_bar::show(ui, model, messages));
    if model.options.window.details && !model.rows.is_empty() {
        details::show(ui, model, messages);
    }
    CentralPanel::default().frame(Frame::new().fill(palette.background)).show(ui, |ui| {
        if model.rows.is_empty() {
            welcome::show(ui, model, messages);
        } else {
            table::show(ui, model, messages);
        }
    });
    row_menu::show(ui, model, messages);
    command_palette::show(ui, model, messages);
}
