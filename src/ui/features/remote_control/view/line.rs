use egui::{Align, Layout, Ui, vec2};

use crate::ui::theme;

/// A line as high as a button, filled from the right. What is to stand on the left comes last.
pub fn from_right(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    let size = vec2(ui.available_width(), theme::BUTTON_HEIGHT);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), add);
}
