use egui::{Color32, Label, RichText, Sense, Shape, Stroke, Ui, WidgetInfo, vec2};

use crate::model::Language;
use crate::texts::{self, TextKey as T};
use crate::ui::theme::{self, palette};

/// The heading of a column that can be sorted by. `ascending`: how it is sorted by this column now. Whether it was
/// clicked.
pub fn sort_heading(ui: &mut Ui, title: T, ascending: Option<bool>, language: Language) -> bool {
    let palette = palette(ui);
    let color = if ascending.is_some() { palette.text } else { palette.weak };
    let label = RichText::new(title.text(language)).size(theme::HEADER_TEXT).strong().color(color);
    let response = ui.add(Label::new(label).truncate().selectable(false).sense(Sense::click()));
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, texts::sort_by(language, title)));
    let clicked = response.on_hover_text(T::SortedTip.text(language)).clicked();
    if let Some(ascending) = ascending {
        sort_arrow(ui, ascending, color);
    }
    clicked
}

/// Drawn, as no font that is always there has such a character.
fn sort_arrow(ui: &mut Ui, ascending: bool, color: Color32) {
    let (rect, _) = ui.allocate_exact_size(vec2(8.0, 5.0), Sense::hover());
    let points = if ascending {
        vec![rect.left_bottom(), rect.center_top(), rect.right_bottom()]
    } else {
        vec![rect.left_top(), rect.right_top(), rect.center_bottom()]
    };
    ui.painter().add(Shape::convex_polygon(points, color, Stroke::NONE));
}
