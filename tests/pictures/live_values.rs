//! Pictures of the values of an OPC UA server.

use chrono::Duration;
use egui_kittest::kittest::Queryable as _;
use opcua_configurator::jobs::{
    AxisPoints, ConsumablePoints, IoGroupPoints, IoSignalPoint, LiveEvent, LiveLayout, LivePoint, NoOutput, QueueKind,
    QueuePoints, QueueSystemPoints, RobotPoints, SafetyPoints, StatusPoints, TaskPoints,
};
use opcua_configurator::model::ErrorCode;
use opcua_configurator::model::opcua::{DataValue, NodeId, Quality, Value};
use opcua_configurator::ui::backend::{BackendEvent, RecordingBackend};
use opcua_configurator::ui::model::Message;
use opcua_configurator::workspace::ThemeChoice;

use crate::harness::{SIZE, choose, click, now, settle, window};
use crate::pictures::{W, assert_shows, chinese, end_job, job, picture, say, succeed, tell, tick};
use crate::samples::configuration;

/// A server with the values that it reports.
#[derive(Default)]
struct Server {
    layout: LiveLayout,
    values: Vec<(NodeId, DataValue)>,
}

impl Server {
    fn point(&mut self, name: &str, value: Value) -> Option<LivePoint> {
        let node = NodeId::numeric(1, self.values.len() as u32);
        let value = DataValue { value, source_time: Some(now()), ..DataValue::default() };
        self.values.push((node.clone(), value));
        Some(LivePoint { node, name: name.into(), unit: None, range: None })
    }

    fn number(&mut self, name: &str, number: f64, unit: &str) -> Option<LivePoint> {
        let point = self.point(name, Value::Double(number));
        point.map(|point| LivePoint { unit: Some(unit.into()), ..point })
    }

    fn axis(&mut self, name: &str, position: f64, range: (f64, f64)) -> AxisPoints {
        let unit = if range.1 > 200.0 { "mm" } else { "°" };
        let position = self
            .number(&format!("Robot 1 {name} ActualPosition"), position, unit)
            .map(|p| LivePoint { range: Some(range), ..p });
        AxisPoints {
            name: name.into(),
            position,
            speed: self.number("ActualSpeed", 31.25, "°/s"),
            torque: self.number("Torque", -12.5, "%"),
            load_rate: self.point("EffectiveLoadRate", Value::UInt16(46)),
            ..AxisPoints::default()
        }
    }

    fn robot(&mut self) {
        let pose =
            |z: f64| Value::String(format!(r#"{{"X":{z}, "Y":-120.5, "Z":412.0, "U":0.0, "V":90.0, "W":180.0}}"#));
        let text = |text: &str| Value::String(text.to_owned());
        let names = ["J1", "J2", "J3", "J4", "J5", "J6"];
        let positions = [12.5, -35.0, 171.5, 0.25, 88.0, -5.0];
        let axes = names.iter().zip(positions).map(|(name, at)| self.axis(name, at, (-170.0, 170.0))).collect();
        let robot = RobotPoints {
            name: "MotionDevice_1".into(),
            component_name: self.point("ComponentName", text("Robot 1")),
            model: self.point("Model", text("C8-C901S")),
            serial_number: self.point("SerialNumber", text("RB00012345")),
            number: self.point("RobotNumber", Value::UInt16(1)),
            category: self.point("MotionDeviceCategory", Value::Int32(1)),
            in_control: self.point("InControl", Value::Boolean(true)),
            power: self.point("Power", Value::Boolean(true)),
            home: self.point("Home", Value::Boolean(false)),
            speed_override: self.number("SpeedOverride", 80.0, "%"),
            motor_on_time: self.point("IntegrationMotorOnTime", text("P102DT7H")),
            motor_on_count: self.point("MotorOnCount", Value::UInt32(1_203)),
            target_position: self.point("CurPos", pose(300.0)),
            actual_position: self.point("RealPos", pose(287.4)),
            axes,
        };
        self.layout.robots.push(robot);
    }

    fn io(&mut self) {
        for (name, count, pattern) in [("Inputs", 24, 0x0082_30f1_u32), ("Outputs", 16, 0x0103)] {
            let signals = (0..count).filter_map(|number| {
                let point = self.point(name, Value::Boolean(pattern >> number & 1 == 1))?;
                Some(IoSignalPoint { point, number })
            });
            let signals = signals.collect();
            self.layout.io.push(IoGroupPoints { system: "StandardIO".into(), name: name.into(), signals });
        }
    }

    fn others(&mut self) {
        let text = |text: &str| Value::String(text.to_owned());
        let safety = SafetyPoints {
            name: "SafetyState_0".into(),
            operational_mode: self.point("OperationalMode", Value::Int32(3)),
            emergency_stop: self.point("EmergencyStop", Value::Boolean(false)),
            protective_stop: self.point("ProtectiveStop", Value::Boolean(true)),
        };
        self.layout.safety.push(safety);
        for (name, program, loaded) in [("Task_1", "main", true), ("Task_2", "conveyor", true), ("Task_3", "", false)] {
            let task = TaskPoints {
                name: name.into(),
                component_name: self.point("ComponentName", text(program)),
                program: self.point("TaskProgramName", text(if program.is_empty() { "" } else { "Main.prg" })),
                loaded: self.point("TaskProgramLoaded", Value::Boolean(loaded)),
                mode: self.point("ExecutionMode", Value::Int32(if name == "Task_2" { 2 } else { 0 })),
            };
            self.layout.tasks.push(task);
        }
        for (owner, part, months) in [
            ("Robot 1, J1", "Belt", 2.4),
            ("Robot 1", "Battery", -0.5),
            ("Robot 1, J2", "Grease", 31.0),
            ("Robot 1, J3", "Gear", -1.0),
        ] {
            let is_managed = months != -1.0;
            let part = ConsumablePoints {
                owner: owner.into(),
                part: part.into(),
                available: self.point("Available", Value::Boolean(is_managed)),
                installed: self.point("InstallationDate", Value::DateTime(Some(now() - Duration::days(900)))),
                months_left: self.point("MonthRemaining", Value::Double(months)),
                rate: self.point("ConsumptionRate", Value::Double(100.0 - months)),
            };
            self.layout.consumables.push(part);
        }
        let flags = [("Auto", true), ("Running", true), ("Warning", true), ("EStop", false), ("Error", false)];
        let flags = flags.into_iter().filter_map(|(name, is_on)| self.point(name, Value::Boolean(is_on))).collect();
        let status = StatusPoints {
            controller: "Controller_0".into(),
            flags,
            code: self.point("StatusCode", Value::UInt16(517)),
            cpu_load: self.number("CPULoad", 23.5, "%"),
        };
        self.layout.status.push(status);
        let queue = QueuePoints {
            name: "MotionLog_1".into(),
            running: self.point("LoggingStatus", text("Run")),
            data_exists: self.point("DataExistsStatus", text("Ready")),
            error: self.point("ErrorStatus", text("Warning")),
        };
        let settings = self.point("SamplingInterval", Value::UInt16(2)).into_iter().collect();
        let (kind, name) = (QueueKind::MotionLog, "MotionLogSystem".into());
        self.layout.queues.push(QueueSystemPoints { kind, name, settings, queues: vec![queue] });
    }
}

/// The dialog of a server that was connected to.
fn live(size: [f32; 2]) -> (W, Server) {
    let mut server = Server::default();
    server.robot();
    server.io();
    server.others();
    let mut window = window(RecordingBackend::default(), configuration(24, now()), size);
    tick(&mut window, &["Weld 1"]);
    choose(&mut window, &["Tools", "Live values…"]);
    succeed(&mut window, 0, NoOutput, None);
    end_job(&mut window, 1, 0, 0);
    seen(&mut window, LiveEvent::Connected(Box::new(server.layout.clone())));
    seen(&mut window, LiveEvent::Values(server.values.clone()));
    (window, server)
}

fn seen(window: &mut W, event: LiveEvent) {
    let job = job(window);
    tell(window, BackendEvent::LiveSeen { job, event });
}

#[test]
fn a_robot_that_moves() {
    let (mut window, _) = live(SIZE);
    picture(&mut window, "live_robot");
    click(&mut window, "I/O");
    assert_shows(&window, "Bit 23: on");
    click(&mut window, "Safety and tasks");
    assert_shows(&window, "Protective stop");
    assert_shows(&window, "conveyor");
    click(&mut window, "Consumables");
    chinese(&mut window);
    click(&mut window, "状态");
    picture(&mut window, "live_status_chinese");
}

#[test]
fn lamps_in_a_small_dark_window_after_the_connection_was_lost() {
    let (mut window, _) = live([900.0, 500.0]);
    say(&mut window, Message::SetTheme(ThemeChoice::Dark));
    click(&mut window, "I/O");
    seen(&mut window, LiveEvent::Lost(ErrorCode::ServerNotRunning.into()));
    picture(&mut window, "live_io_dark");
}

#[test]
fn a_plot_of_two_axes_with_a_gap() {
    let (mut window, server) = live(SIZE);
    for shown in ["12.50 °", "171.50 °"] {
        window.get_by_label(shown).click_secondary();
        settle(&mut window);
        click(&mut window, "Add to plot");
    }
    click(&mut window, "Plot");
    let axes = &server.layout.robots[0].axes;
    let nodes = [0, 2].map(|at: usize| axes[at].position.as_ref().expect("it has a position").node.clone());
    let job = job(&window);
    for step in (0..250).filter(|step| !(151..175).contains(step)) {
        let turn = f64::from(step) * 0.08;
        // The first value without quality after others is a gap.
        let name = "BadNoCommunication".to_owned();
        let quality = if step == 150 { Quality::Bad { name } } else { Quality::Good };
        let source_time = Some(now() + Duration::milliseconds(i64::from(step) * 200));
        let value = |number: f64| DataValue {
            value: Value::Double(number),
            quality: quality.clone(),
            source_time,
            ..DataValue::default()
        };
        let values = nodes.iter().cloned().zip([turn.sin() * 40.0, 100.0 + (turn * 0.4).cos() * 70.0].map(value));
        let event = LiveEvent::Values(values.collect());
        window.state_mut().backend.events.push_back(BackendEvent::LiveSeen { job, event });
    }
    window.step();
    picture(&mut window, "live_plot");
}
