use egui::Ui;

use super::value::{Drawn, ValueCells, heading, headings, table};
use crate::model::opcua::Value;
use crate::texts::TextKey as T;
use crate::ui::model::Message;
use crate::ui::theme::palette;

/// OperationalModeEnumeration of Robotics Part 1, in its order.
const MODES: [T; 5] =
    [T::LiveOtherMode, T::LiveManualReduced, T::LiveManualHigh, T::LiveAutomatic, T::LiveAutomaticExternal];
/// ExecutionModeEnumeration of Robotics Part 1, in its order.
const EXECUTION: [T; 3] = [T::LiveCycle, T::LiveContinuous, T::LiveStep];

/// SafetyPoints states and tasks. Returns whether there are none.
pub fn show(ui: &mut Ui, cells: &ValueCells<'_>, messages: &mut Vec<Message>) -> bool {
    let Some(layout) = &cells.form.layout else { return true };
    let palette = palette(ui);
    let stop = |value: &Value| match value {
        Value::Boolean(true) => Some((T::LiveStopped, palette.error)),
        Value::Boolean(false) => Some((T::LiveNotStopped, palette.ok)),
        _ => None,
    };
    for (index, state) in layout.safety.iter().enumerate() {
        heading(ui, cells.text(T::LiveSafetyState));
        let mode = |ui: &mut Ui, messages: &mut Vec<Message>| {
            cells.enumeration(ui, &state.operational_mode, &MODES, messages);
        };
        let emergency =
            |ui: &mut Ui, messages: &mut Vec<Message>| cells.word(ui, &state.emergency_stop, stop, messages);
        let protective =
            |ui: &mut Ui, messages: &mut Vec<Message>| cells.word(ui, &state.protective_stop, stop, messages);
        let rows: [(&str, Drawn<'_>); 3] = [
            (cells.text(T::LiveOperationalMode), &mode),
            (cells.text(T::LiveEmergencyStop), &emergency),
            (cells.text(T::LiveProtectiveStop), &protective),
        ];
        cells.facts(ui, &format!("safety {index}"), &rows, messages);
    }
    if !layout.tasks.is_empty() {
        heading(ui, cells.text(T::LiveTasks));
        table(ui, "tasks", 5, |ui| {
            let names = [T::LiveTask, T::LiveTaskName, T::LiveProgram, T::LiveExecuting, T::LiveMode];
            headings(ui, &names.map(|key| cells.text(key)));
            let executes = |value: &Value| match value {
                Value::Boolean(true) => Some((T::LiveExecutes, palette.ok)),
                Value::Boolean(false) => Some((T::LiveDoesNotExecute, palette.weak)),
                _ => None,
            };
            for task in &layout.tasks {
                ui.label(&task.name);
                cells.value(ui, &task.component_name, messages);
                cells.value(ui, &task.program, messages);
                cells.word(ui, &task.loaded, executes, messages);
                cells.enumeration(ui, &task.mode, &EXECUTION, messages);
                ui.end_row();
            }
        });
    }
    layout.safety.is_empty() && layout.tasks.is_empty()
}
