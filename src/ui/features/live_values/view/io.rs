use egui::{Align2, Button, FontId, Sense, Stroke, Ui, WidgetInfo, pos2};

use super::value::ValueCells;
use crate::jobs::IoGroupPoints;
use crate::texts;
use crate::ui::features::live_values::LiveForm;
use crate::ui::features::live_values::io::{IoBit, bits};
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};

/// One group of signals as lamps, to be chosen among all. Returns whether there are none.
pub fn show(ui: &mut Ui, cells: &ValueCells<'_>, messages: &mut Vec<Message>) -> bool {
    let Some(layout) = &cells.form.layout else { return true };
    ui.horizontal_wrapped(|ui| {
        for (index, group) in layout.io.iter().enumerate() {
            let title = format!("{} · {}", group.system, group.name);
            if ui.add(Button::selectable(index == cells.form.io_group, title)).clicked() {
                messages.push(Message::act(move |model| {
                    if let Some(form) = model.dialog::<LiveForm>() {
                        form.io_group = index;
                    }
                    Model::live_section_changed(model)
                }));
            }
        }
    });
    ui.add_space(theme::SPACE);
    if let Some(group) = layout.io.get(cells.form.io_group) {
        lamps(ui, cells, group, messages);
    }
    layout.io.is_empty()
}

/// Rows of eight or sixteen, so that the numbers of a column differ by whole bytes.
fn lamps(ui: &mut Ui, cells: &ValueCells<'_>, group: &IoGroupPoints, messages: &mut Vec<Message>) {
    let bits = bits(group, cells.form.values());
    let in_row = if ui.available_width() >= 16.0 * theme::LAMP.x { 16 } else { 8 };
    ui.spacing_mut().item_spacing = egui::Vec2::ZERO;
    for row in bits.chunks(in_row) {
        ui.horizontal(|ui| {
            for bit in row {
                lamp(ui, cells, bit, messages);
            }
        });
    }
}

fn lamp(ui: &mut Ui, cells: &ValueCells<'_>, bit: &IoBit<'_>, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    let (rect, response) = ui.allocate_exact_size(theme::LAMP, Sense::click_and_drag());
    if ui.is_rect_visible(rect) {
        let center = pos2(rect.center().x, rect.top() + theme::LAMP_RADIUS + 4.0);
        let color = if cells.form.is_live() { palette.ok } else { palette.off };
        let painter = ui.painter();
        match bit.is_on {
            Some(true) => drop(painter.circle_filled(center, theme::LAMP_RADIUS, color)),
            Some(false) => drop(painter.circle_stroke(center, theme::LAMP_RADIUS, Stroke::new(1.5, palette.off))),
            None => drop(painter.circle_filled(center, 2.0, palette.off)),
        }
        let at = pos2(rect.center().x, center.y + theme::LAMP_RADIUS + 3.0);
        let font = FontId::proportional(theme::SMALL_TEXT);
        painter.text(at, Align2::CENTER_TOP, bit.number, font, palette.weak);
    }
    let said = texts::live_bit(cells.model.language, bit.number, bit.is_on);
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, true, &said));
    cells.offer(&response, bit.point, bit.is_on.is_some(), messages);
    response.on_hover_text(format!("{said}\n{}", bit.point.name));
}
