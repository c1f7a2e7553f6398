use egui::{Color32, RichText, Sense, Ui, pos2, vec2};

use super::value::{Drawn, ValueCells, heading, headings, table};
use crate::jobs::{AxisPoints, LivePoint, RobotPoints};
use crate::model::opcua::Value;
use crate::texts::TextKey as T;
use crate::ui::features::live_values::pose;
use crate::ui::model::Message;
use crate::ui::theme::{self, palette};

/// Robots with their axes. Returns whether there are none.
pub fn show(ui: &mut Ui, cells: &ValueCells<'_>, messages: &mut Vec<Message>) -> bool {
    let Some(layout) = &cells.form.layout else { return true };
    for (index, robot) in layout.robots.iter().enumerate() {
        heading(ui, &name(cells, robot));
        facts(ui, cells, index, robot, messages);
        tool(ui, cells, index, robot);
        axes(ui, cells, index, robot, messages);
        ui.add_space(theme::SPACE_LARGE);
    }
    layout.robots.is_empty()
}

/// The robot's own name, or else that of its node.
fn name(cells: &ValueCells<'_>, robot: &RobotPoints) -> String {
    let own = cells.form.good(&robot.component_name).and_then(Value::as_text).filter(|name| !name.is_empty());
    let model = cells.form.good(&robot.model).and_then(Value::as_text).unwrap_or_default();
    format!("{}  {model}", own.unwrap_or(&robot.name)).trim_end().to_owned()
}

fn facts(ui: &mut Ui, cells: &ValueCells<'_>, index: usize, robot: &RobotPoints, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    let switch = |on: T, off: T, color: Color32| {
        move |value: &Value| match value {
            Value::Boolean(true) => Some((on, color)),
            Value::Boolean(false) => Some((off, palette.text)),
            _ => None,
        }
    };
    const KINDS: [T; 3] = [T::LiveOtherKind, T::LiveSixAxis, T::LiveScara];
    let motors = switch(T::LiveOn, T::LiveOff, palette.ok);
    let power = switch(T::LivePowerHigh, T::LivePowerLow, palette.warning);
    let home = switch(T::LiveAtHome, T::LiveNotAtHome, palette.ok);
    let draw_motors = |ui: &mut Ui, messages: &mut Vec<Message>| cells.word(ui, &robot.in_control, motors, messages);
    let draw_power = |ui: &mut Ui, messages: &mut Vec<Message>| cells.word(ui, &robot.power, power, messages);
    let draw_home = |ui: &mut Ui, messages: &mut Vec<Message>| cells.word(ui, &robot.home, home, messages);
    let draw_speed = |ui: &mut Ui, messages: &mut Vec<Message>| cells.value(ui, &robot.speed_override, messages);
    let draw_kind = |ui: &mut Ui, messages: &mut Vec<Message>| cells.enumeration(ui, &robot.category, &KINDS, messages);
    let draw_number = |ui: &mut Ui, messages: &mut Vec<Message>| cells.value(ui, &robot.number, messages);
    let draw_serial = |ui: &mut Ui, messages: &mut Vec<Message>| cells.value(ui, &robot.serial_number, messages);
    let draw_time = |ui: &mut Ui, messages: &mut Vec<Message>| cells.value(ui, &robot.motor_on_time, messages);
    let draw_count = |ui: &mut Ui, messages: &mut Vec<Message>| cells.value(ui, &robot.motor_on_count, messages);
    let rows: [(T, &Option<LivePoint>, Drawn<'_>); 9] = [
        (T::LiveMotors, &robot.in_control, &draw_motors),
        (T::LivePower, &robot.power, &draw_power),
        (T::LiveHome, &robot.home, &draw_home),
        (T::LiveSpeedOverride, &robot.speed_override, &draw_speed),
        (T::LiveKind, &robot.category, &draw_kind),
        (T::LiveNumber, &robot.number, &draw_number),
        (T::ColumnSerial, &robot.serial_number, &draw_serial),
        (T::LiveMotorOnTime, &robot.motor_on_time, &draw_time),
        (T::LiveMotorOnCount, &robot.motor_on_count, &draw_count),
    ];
    let there = rows.into_iter().filter(|(_, point, _)| point.is_some());
    let rows: Vec<(&str, Drawn<'_>)> = there.map(|(key, _, draw)| (cells.text(key), draw)).collect();
    cells.facts(ui, &format!("robot {index}"), &rows, messages);
}

/// Where the tool center point is, and where it goes.
fn tool(ui: &mut Ui, cells: &ValueCells<'_>, index: usize, robot: &RobotPoints) {
    let rows = [(T::LiveActual, &robot.actual_position), (T::LiveTarget, &robot.target_position)];
    if rows.iter().all(|(_, point)| point.is_none()) {
        return;
    }
    heading(ui, cells.text(T::LivePose));
    let color = if cells.form.is_live() { palette(ui).text } else { palette(ui).off };
    table(ui, ("tool", index), pose::NAMES.len() + 1, |ui| {
        ui.label("");
        for (at, name) in pose::NAMES.iter().enumerate() {
            let unit = if at < 3 { "mm" } else { "°" };
            let text = RichText::new(format!("{name} ({unit})")).size(theme::HEADER_TEXT).color(palette(ui).weak);
            ui.label(text);
        }
        ui.end_row();
        for (key, point) in rows {
            let Some(text) = cells.form.good(point).and_then(Value::as_text) else { continue };
            ui.label(cells.text(key));
            match pose::pose(text) {
                Some(pose) => {
                    for number in pose {
                        ui.label(RichText::new(format!("{number:>9.2}")).monospace().color(color));
                    }
                }
                None => drop(ui.label(RichText::new(crate::model::untrusted_text::one_line(text, 120)).color(color))),
            }
            ui.end_row();
        }
    });
}

type Column = (T, fn(&AxisPoints) -> &Option<LivePoint>);

const COLUMNS: [Column; 7] = [
    (T::LivePosition, |axis| &axis.position),
    (T::LiveSpeed, |axis| &axis.speed),
    (T::LiveAcceleration, |axis| &axis.acceleration),
    (T::LiveTorque, |axis| &axis.torque),
    (T::LiveLoad, |axis| &axis.load_rate),
    (T::LiveMotorTemperature, |axis| &axis.motor_temperature),
    (T::LiveHofs, |axis| &axis.hofs),
];

/// One line an axis; a column that no axis has is left out.
fn axes(ui: &mut Ui, cells: &ValueCells<'_>, index: usize, robot: &RobotPoints, messages: &mut Vec<Message>) {
    if robot.axes.is_empty() {
        return;
    }
    ui.add_space(theme::SPACE);
    let columns: Vec<&Column> =
        COLUMNS.iter().filter(|(_, of)| robot.axes.iter().any(|axis| of(axis).is_some())).collect();
    let has_range = robot.axes.iter().any(|axis| axis.position.as_ref().is_some_and(|point| point.range.is_some()));
    table(ui, ("axes", index), columns.len() + 2, |ui| {
        let mut names = vec![cells.text(T::LiveAxis)];
        if has_range {
            names.push(cells.text(T::LiveRange));
        }
        names.extend(columns.iter().map(|(key, _)| cells.text(*key)));
        headings(ui, &names);
        for axis in &robot.axes {
            ui.label(&axis.name);
            if has_range {
                range(ui, cells, &axis.position);
            }
            for (_, of) in &columns {
                cells.value(ui, of(axis), messages);
            }
            ui.end_row();
        }
    });
}

/// Where a value is in its range; beyond the ends it is in the colour of a warning.
fn range(ui: &mut Ui, cells: &ValueCells<'_>, point: &Option<LivePoint>) {
    let palette = palette(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(theme::RANGE_BAR.x, theme::DENSE_HEIGHT), Sense::hover());
    let Some((low, high)) = point.as_ref().and_then(|point| point.range) else { return };
    let bar = egui::Rect::from_center_size(rect.center(), theme::RANGE_BAR);
    ui.painter().rect_filled(bar, theme::RANGE_BAR.y / 2.0, palette.line);
    if let Some(value) = cells.form.good(point).and_then(Value::as_f64) {
        let share = ((value - low) / (high - low)) as f32;
        let color = match () {
            () if !cells.form.is_live() => palette.off,
            () if (0.0..=1.0).contains(&share) => palette.accent,
            () => palette.warning,
        };
        let at = pos2(egui::lerp(bar.x_range(), share.clamp(0.0, 1.0)), bar.center().y);
        ui.painter().circle_filled(at, theme::RANGE_BAR.y * 0.9, color);
    }
    let unit = point.as_ref().and_then(|point| point.unit.as_deref()).unwrap_or_default();
    response.on_hover_text(format!("{low} … {high} {unit}"));
}
