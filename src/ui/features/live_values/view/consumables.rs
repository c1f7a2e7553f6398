use egui::{RichText, Ui};

use super::value::{ValueCells, headings, table};
use crate::jobs::ConsumablePoints;
use crate::model::opcua::Value;
use crate::texts::TextKey as T;
use crate::ui::features::live_values::LiveForm;
use crate::ui::model::Message;
use crate::ui::theme::palette;

/// Parts that wear, the next to be replaced first. Returns whether there are none.
pub fn show(ui: &mut Ui, cells: &ValueCells<'_>, messages: &mut Vec<Message>) -> bool {
    let Some(layout) = &cells.form.layout else { return true };
    let mut parts: Vec<&ConsumablePoints> = layout.consumables.iter().collect();
    parts.sort_by(|a, b| months(cells.form, a).total_cmp(&months(cells.form, b)));
    let palette = palette(ui);
    if !parts.is_empty() {
        table(ui, "consumables", 5, |ui| {
            let names = [T::LivePart, T::LiveOwner, T::LiveMonthsLeft, T::LiveConsumed, T::LiveInstalled];
            headings(ui, &names.map(|key| cells.text(key)));
            for part in parts {
                ui.label(&part.part);
                ui.label(&part.owner);
                if cells.form.good(&part.available) == Some(&Value::Boolean(false)) {
                    ui.label(RichText::new(cells.text(T::LiveNotManaged)).color(palette.weak));
                } else {
                    left(ui, cells, part, messages);
                    let rate = |value: &Value| value.as_f64().map(|rate| format!("{rate:.1} %")).unwrap_or_default();
                    if let Some(point) = &part.rate {
                        cells.point(ui, point, palette.text, rate, messages);
                    }
                    cells.value(ui, &part.installed, messages);
                }
                ui.end_row();
            }
        });
    }
    layout.consumables.is_empty()
}

fn left(ui: &mut Ui, cells: &ValueCells<'_>, part: &ConsumablePoints, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    let color = match months(cells.form, part) {
        ..=0.0 => palette.error,
        ..SOON => palette.warning,
        _ => palette.text,
    };
    if let Some(point) = &part.months_left {
        let said = |value: &Value| value.as_f64().map(|months| format!("{months:.1}")).unwrap_or_default();
        cells.point(ui, point, color, said, messages);
    }
}

/// Months until a part should be replaced; infinite for one that is not managed.
fn months(form: &LiveForm, part: &ConsumablePoints) -> f64 {
    let is_managed = form.good(&part.available) != Some(&Value::Boolean(false));
    let left = form.good(&part.months_left).and_then(Value::as_f64).filter(|_| is_managed);
    left.unwrap_or(f64::INFINITY)
}

/// Months from which a part is pointed out.
const SOON: f64 = 3.0;
