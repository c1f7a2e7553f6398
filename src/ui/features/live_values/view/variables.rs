use egui::{RichText, Ui};

use super::value::{ValueCells, heading, headings, table};
use crate::texts::TextKey as T;
use crate::ui::model::Message;
use crate::ui::theme::palette;
use crate::ui::widgets::small_note;

/// The variables of SPEL projects. Returns whether there is no project.
pub fn show(ui: &mut Ui, cells: &ValueCells<'_>, messages: &mut Vec<Message>) -> bool {
    let Some(layout) = &cells.form.layout else { return true };
    for (index, project) in layout.projects.iter().enumerate() {
        heading(ui, cells.text(T::LiveProject));
        cells.value(ui, &project.name, messages);
        if project.variables.is_empty() {
            small_note(ui, cells.text(T::LiveNoVariables));
            continue;
        }
        table(ui, ("variables", index), 3, |ui| {
            headings(ui, &[T::LiveVariable, T::LiveValue, T::LiveKind].map(|key| cells.text(key)));
            for variable in &project.variables {
                ui.label(&variable.name);
                cells.value(ui, &Some(variable.clone()), messages);
                let kind = cells.form.value(&variable.node).map(|value| value.value.type_name());
                ui.label(RichText::new(kind.unwrap_or_default()).color(palette(ui).weak));
                ui.end_row();
            }
        });
    }
    layout.projects.is_empty()
}
