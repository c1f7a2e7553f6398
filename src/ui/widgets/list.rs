use egui::{Align, Frame, Label, Layout, RichText, ScrollArea, Stroke, Ui, vec2};

use crate::ui::theme::{self, palette};

/// A framed list, scrolling beyond `most` lines. Only the lines in sight are drawn.
pub fn list(ui: &mut Ui, id: &str, count: usize, most: usize, mut line: impl FnMut(&mut Ui, usize)) {
    let stroke = Stroke::new(1.0, palette(ui).line);
    Frame::new().stroke(stroke).corner_radius(8).inner_margin(theme::CARD_MARGIN).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 0.0;
        ui.spacing_mut().interact_size.y = theme::DENSE_HEIGHT;
        let height = theme::LIST_ROW * count.min(most) as f32;
        ScrollArea::vertical().id_salt(id).max_height(height).auto_shrink([false, true]).show_rows(
            ui,
            theme::LIST_ROW,
            count,
            |ui, range| {
                for index in range {
                    let size = vec2(ui.available_width(), theme::LIST_ROW);
                    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
                        ui.set_min_height(theme::LIST_ROW);
                        line(ui, index);
                    });
                }
            },
        );
    });
}

/// One cell of a line: so wide, cut off where it is longer, and whole on hover.
pub fn cell(ui: &mut Ui, width: f32, text: RichText) {
    let size = vec2(width.min(ui.available_width()), theme::LIST_ROW);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_width(size.x);
        ui.add(Label::new(text).truncate());
    });
}

/// A small heading over a list.
pub fn list_title(ui: &mut Ui, text: &str) {
    ui.add_space(theme::SPACE);
    ui.label(RichText::new(text).size(theme::SMALL_TEXT).color(palette(ui).weak));
}
