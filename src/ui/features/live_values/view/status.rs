use egui::Ui;

use super::value::{Drawn, ValueCells, heading, headings, table};
use crate::jobs::{LivePoint, QueueKind};
use crate::model::opcua::Value;
use crate::texts::TextKey as T;
use crate::ui::model::Message;
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{chip, small_note};

/// Status flags, code and load of controllers; what they are; force sensor and motion log. Returns whether there is
/// nothing.
pub fn show(ui: &mut Ui, cells: &ValueCells<'_>, messages: &mut Vec<Message>) -> bool {
    let Some(layout) = &cells.form.layout else { return true };
    let palette = palette(ui);
    for (index, status) in layout.status.iter().enumerate() {
        heading(ui, &status.controller);
        ui.horizontal_wrapped(|ui| {
            for flag in &status.flags {
                let is_on = cells.form.good(&Some(flag.clone())) == Some(&Value::Boolean(true));
                let color = match is_on {
                    true if !cells.form.is_live() => palette.off,
                    true if is_alarming(&flag.name) => palette.error,
                    true => palette.ok,
                    false => palette.off,
                };
                let said = cells.text(if is_on { T::LiveOn } else { T::LiveOff });
                chip(ui, &format!("{}: {said}", flag.name), color);
            }
        });
        let code = |ui: &mut Ui, messages: &mut Vec<Message>| cells.value(ui, &status.code, messages);
        let load = |ui: &mut Ui, messages: &mut Vec<Message>| cells.value(ui, &status.cpu_load, messages);
        let rows: [(&str, Drawn<'_>); 2] =
            [(cells.text(T::LiveStatusCode), &code), (cells.text(T::LiveCpuLoad), &load)];
        cells.facts(ui, &format!("status {index}"), &rows, messages);
    }
    for (index, controller) in layout.controllers.iter().enumerate() {
        heading(ui, &format!("{} {}", cells.text(T::LiveController), controller.name));
        points(ui, cells, &format!("controller {index}"), &controller.points, messages);
    }
    queues(ui, cells, messages);
    layout.status.is_empty() && layout.controllers.is_empty() && layout.queues.is_empty()
}

/// The flags of a controller that stands still or should be looked at.
fn is_alarming(flag: &str) -> bool {
    ["EStop", "EmergencyStop", "Safeguard", "SError", "SeriousError", "Error", "Warning"].contains(&flag)
}

fn points(ui: &mut Ui, cells: &ValueCells<'_>, id: &str, points: &[LivePoint], messages: &mut Vec<Message>) {
    let points: Vec<Option<LivePoint>> = points.iter().cloned().map(Some).collect();
    type DrawPoint<'a> = Box<dyn Fn(&mut Ui, &mut Vec<Message>) + 'a>;
    let draw_point = |point| -> DrawPoint<'_> { Box::new(move |ui, messages| cells.value(ui, point, messages)) };
    let draw: Vec<DrawPoint<'_>> = points.iter().map(draw_point).collect();
    let name = |point: &Option<LivePoint>| point.as_ref().map_or(String::new(), |point| point.name.clone());
    let names: Vec<String> = points.iter().map(name).collect();
    let rows: Vec<(&str, Drawn<'_>)> =
        names.iter().map(String::as_str).zip(draw.iter().map(|draw| -> Drawn<'_> { draw.as_ref() })).collect();
    cells.facts(ui, id, &rows, messages);
}

fn queues(ui: &mut Ui, cells: &ValueCells<'_>, messages: &mut Vec<Message>) {
    let Some(layout) = cells.form.layout.as_ref().filter(|layout| !layout.queues.is_empty()) else { return };
    let palette = palette(ui);
    for (index, system) in layout.queues.iter().enumerate() {
        heading(
            ui,
            cells.text(match system.kind {
                QueueKind::ForceSensor => T::LiveForce,
                QueueKind::MotionLog => T::LiveMotionLog,
            }),
        );
        points(ui, cells, &format!("queue settings {index}"), &system.settings, messages);
        table(ui, ("queues", index), 4, |ui| {
            let names = [T::LiveQueue, T::LiveRecording, T::LiveDataExists, T::LiveQueueError];
            headings(ui, &names.map(|key| cells.text(key)));
            for queue in &system.queues {
                ui.label(&queue.name);
                cells.value(ui, &queue.running, messages);
                cells.value(ui, &queue.data_exists, messages);
                let color = match cells.form.good(&queue.error).and_then(Value::as_text) {
                    Some("Warning") => palette.warning,
                    Some("Error") => palette.error,
                    _ => palette.text,
                };
                if let Some(point) = &queue.error {
                    cells.point(ui, point, color, ToString::to_string, messages);
                }
                ui.end_row();
            }
        });
    }
    ui.add_space(theme::SPACE);
    small_note(ui, cells.text(T::LiveDataNote));
}
