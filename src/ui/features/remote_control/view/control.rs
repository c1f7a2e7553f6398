use egui::{ComboBox, DragValue, Grid, Label, RichText, Ui, vec2};

use super::button::{act, act_unless};
use crate::model::Problem;
use crate::model::untrusted_text::one_line;
use crate::remote::client::ControllerIdentity;
use crate::remote::{FunctionNumber, Request, RobotNumber};
use crate::texts::{self, TextKey as T};
use crate::ui::features::remote_control::RemoteForm;
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};

/// Program, robots, and what the controller is.
pub fn show(ui: &mut Ui, form: &mut RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    program(ui, form, model, messages);
    robots(ui, form, model, messages);
    identity(ui, form, model);
}

fn program(ui: &mut Ui, form: &mut RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    heading(ui, text(T::RemoteProgram));
    ui.horizontal_wrapped(|ui| {
        let label = ui.label(text(T::RemoteFunction));
        let number = DragValue::new(&mut form.function).range(0..=63_u8).custom_formatter(|number, _| function(number));
        ui.add(number.custom_parser(function_number)).labelled_by(label.id);
        if let Some(function) = FunctionNumber::new(form.function) {
            act(ui, form, T::RemoteStart, &Request::Start { function }, model, messages);
        }
        for (label, request) in [
            (T::RemoteStop, Request::Stop),
            (T::RemotePause, Request::Pause),
            (T::RemoteContinue, Request::Continue),
            (T::RemoteReset, Request::Reset),
            (T::RemoteAbort, Request::Abort),
        ] {
            act(ui, form, label, &request, model, messages);
        }
    });
}

/// Function 0 is `main`, 1 is `main1`, up to `main63`.
fn function(number: f64) -> String {
    if number < 0.5 { "main".to_owned() } else { format!("main{number:.0}") }
}

/// Reads what [`function`] writes, and a number alone.
fn function_number(text: &str) -> Option<f64> {
    let text = text.trim();
    match text.strip_prefix("main") {
        Some("") => Some(0.0),
        rest => rest.unwrap_or(text).parse().ok(),
    }
}

fn robots(ui: &mut Ui, form: &mut RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    heading(ui, text(T::RemoteRobots));
    ui.horizontal_wrapped(|ui| {
        let name = |robot: RobotNumber| match robot {
            RobotNumber::ALL => text(T::RemoteAllRobots).to_owned(),
            one => texts::remote_robot(model.language, one.get()),
        };
        let list = ComboBox::from_id_salt("robot").selected_text(name(form.robot)).show_ui(ui, |ui| {
            for robot in (0..=16).filter_map(RobotNumber::new) {
                ui.selectable_value(&mut form.robot, robot, name(robot));
            }
        });
        list.response.on_hover_text(text(T::RemoteRobotTip));
        let robot = form.robot;
        act(ui, form, T::RemoteMotorsOn, &Request::SetMotorsOn { robot }, model, messages);
        act(ui, form, T::RemoteMotorsOff, &Request::SetMotorsOff { robot }, model, messages);
        for (label, request) in
            [(T::RemoteHome, Request::Home { robot }), (T::RemoteSelectRobot, Request::SetCurRobot { robot })]
        {
            act_unless(ui, form.why_not_one_robot(request.command()), label, &request, model, messages);
        }
    });
    let said = match &form.current_robot {
        None => text(T::Reading).to_owned(),
        Some(Ok(robot)) => texts::remote_robot(model.language, *robot),
        Some(Err(error)) => Problem::from(error.clone()).code.explain(model.language).message.to_owned(),
    };
    let color = palette(ui).weak;
    ui.label(RichText::new(format!("{}: {said}", text(T::RemoteCurrentRobot))).size(theme::SMALL_TEXT).color(color));
}

fn identity(ui: &mut Ui, form: &RemoteForm, model: &Model) {
    let text = |key: T| key.text(model.language);
    heading(ui, text(T::LiveController));
    let Some(identity) = &form.identity else { return drop(ui.label(text(T::Reading))) };
    if identity.is_empty() {
        return drop(ui.label(RichText::new(text(T::RemoteNothingTold)).color(palette(ui).weak)));
    }
    let rows = facts(identity);
    Grid::new("remote identity").num_columns(4).spacing(vec2(theme::SPACE_LARGE, 4.0)).show(ui, |ui| {
        for (index, (label, value)) in rows.iter().enumerate() {
            ui.label(RichText::new(text(*label)).color(palette(ui).weak));
            ui.add(Label::new(one_line(value, MAX_CHARS)).selectable(true));
            if index % 2 == 1 {
                ui.end_row();
            }
        }
    });
    for robot in &identity.robots {
        ui.add(Label::new(texts::remote_robot_line(model.language, robot)).wrap().selectable(true));
    }
}

/// What the controller told, each with its label.
fn facts(identity: &ControllerIdentity) -> Vec<(T, String)> {
    let battery = identity.battery.as_ref().map(|battery| format!("{} %", battery.consumption));
    let rows = [
        (T::RemoteName, identity.name.clone()),
        (T::RemoteSerial, identity.serial.clone()),
        (T::RemoteModel, identity.model.clone()),
        (T::RemoteFirmware, identity.firmware.clone()),
        (T::RemoteProject, identity.project.clone()),
        (T::RemoteControlDevice, identity.control_device.clone()),
        (T::RemoteCpuLoad, identity.cpu_load.clone()),
        (T::RemoteBattery, battery),
        (T::RemoteMac, identity.mac_address.clone()),
        (T::RemoteSubnetMask, identity.subnet_mask.clone()),
        (T::RemoteGateway, identity.gateway.clone()),
    ];
    rows.into_iter().filter_map(|(label, value)| Some((label, value?))).collect()
}

fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(theme::SPACE);
    ui.label(RichText::new(text).strong());
}

/// Characters of a fact.
const MAX_CHARS: usize = 60;
