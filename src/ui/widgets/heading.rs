use egui::{Color32, Label, Response, RichText, Sense, Shape, Stroke, Ui, WidgetInfo, vec2};

use crate::model::Language;
use crate::texts::{self, TextKey as T};
use crate::ui::theme::{self, palette};

/// The heading of a column that can be sorted by. `ascending`: how it is sorted by this column now. Whether it was
/// clicked.
pub fn sort_heading(ui: &mut Ui, title: T, ascending: Option<bool>, language: Language) -> bool {
    heading(ui, title, ascending, Sense::click(), T::SortedTip.text(language), language).clicked()
}

/// As [`sort_heading`], for a column that can be dragged to another place.
pub fn column_heading(ui: &mut Ui, title: T, ascending: Option<bool>, language: Language) -> Response {
    let tip = format!("{}\n{}", T::SortedTip.text(language), T::DragColumnTip.text(language));
    heading(ui, title, ascending, Sense::click_and_drag(), &tip, language)
}

fn heading(ui: &mut Ui, title: T, ascending: Option<bool>, sense: Sense, tip: &str, language: Language) -> Response {
    let palette = palette(ui);
    let color = if ascending.is_some() { palette.text } else { palette.weak };
    let label = RichText::new(title.text(language)).size(theme::HEADER_TEXT).strong().color(color);
    let response = ui.add(Label::new(label).truncate().selectable(false).sense(sense));
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, texts::sort_by(language, title)));
    let response = response.on_hover_text(tip);
    if let Some(ascending) = ascending {
        sort_arrow(ui, ascending, color);
    }
    response
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
