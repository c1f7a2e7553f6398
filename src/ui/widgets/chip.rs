use egui::{Color32, Response, RichText, Sense, Ui, WidgetInfo, WidgetText, pos2, vec2};

use crate::ui::theme;

/// A state: a dot and a word in its colour.
pub fn chip(ui: &mut Ui, text: &str, color: Color32) -> Response {
    let font = RichText::new(text).size(theme::SMALL_TEXT).color(color);
    let room = ui.available_width() - 2.0 * theme::SPACE - 11.0;
    let galley =
        WidgetText::from(font).into_galley(ui, Some(egui::TextWrapMode::Truncate), room, egui::TextStyle::Small);
    let size = vec2(galley.size().x + 2.0 * theme::SPACE + 11.0, theme::CHIP_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    if ui.is_rect_visible(rect) {
        let painter = ui.painter();
        painter.rect_filled(rect, theme::CHIP_HEIGHT / 2.0, color.gamma_multiply(theme::CHIP_FILL));
        let dot = pos2(rect.left() + theme::SPACE + theme::CHIP_DOT, rect.center().y);
        painter.circle_filled(dot, theme::CHIP_DOT, color);
        let at = pos2(dot.x + theme::CHIP_DOT + 5.0, rect.center().y - galley.size().y / 2.0);
        painter.galley(at, galley, color);
    }
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, true, text));
    response
}

/// A small word in a colour, after something it qualifies.
pub fn word(ui: &mut Ui, text: &str, color: Color32) -> Response {
    ui.label(RichText::new(text).size(theme::SMALL_TEXT).color(color))
}
