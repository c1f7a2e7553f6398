//! Pictures of remote control.

use chrono::Duration;
use opcua_configurator::jobs::{IoLabels, LoggedExchange, RemoteControlEvent};
use opcua_configurator::model::{Language, SpelValue, StatusFlag, StatusFlags};
use opcua_configurator::remote::client::{
    ControllerIdentity, Direction, Observed, PartHealth, RemoteError, RobotIdentity, WearingPart,
};
use opcua_configurator::remote::{Command, Condition, RemoteStatus, Reply, Request};
use opcua_configurator::ui::RemoteForm;
use opcua_configurator::ui::backend::{BackendCommand, BackendEvent, RecordingBackend};
use opcua_configurator::ui::model::Message;
use opcua_configurator::workspace::ThemeChoice;

use crate::harness::{SIZE, choose, click, now, type_into, window};
use crate::pictures::{W, assert_shows, picture, say, tell, tick};
use crate::samples::configuration;

/// Connected with a controller that is in these states.
fn live(size: [f32; 2], flags: &[StatusFlag], code: u16, message: &str) -> W {
    let mut window = window(RecordingBackend::default(), configuration(24, now()), size);
    tick(&mut window, &["Weld 1"]);
    choose(&mut window, &["Tools", "Remote control…"]);
    click(&mut window, "Connect");
    seen(&mut window, RemoteControlEvent::Connected);
    let mut all = StatusFlags::default();
    flags.iter().for_each(|flag| all.set(*flag, true));
    let status = RemoteStatus { flags: all, code };
    let message = (!message.is_empty()).then(|| message.to_owned());
    seen(&mut window, RemoteControlEvent::Status { status, message });
    seen(&mut window, RemoteControlEvent::Identity(Box::new(identity())));
    window
}

fn identity() -> ControllerIdentity {
    let text = |text: &str| Some(text.to_owned());
    ControllerIdentity {
        name: text("Weld 1"),
        serial: text("SN0000123"),
        model: text("RC800-A"),
        firmware: text("8.0.1.0"),
        control_device: text("Remote Ethernet"),
        project: text("Welding"),
        cpu_load: text("23"),
        battery: Some(PartHealth {
            installed: "2024/03/01 08:00:00".into(),
            consumption: "41.5".into(),
            months_left: "35.2".into(),
        }),
        robots: vec![RobotIdentity {
            number: 1,
            name: text("C8 left"),
            serial: text("RB00012345"),
            kind: text("6-Axis"),
            model: text("C8-A901S"),
            motors_on: Some(true),
            power_high: Some(false),
            parts_due: Some(vec![WearingPart::Belt, WearingPart::Grease]),
        }],
        ..ControllerIdentity::default()
    }
}

fn seen(window: &mut W, event: RemoteControlEvent) {
    let of = |command: &BackendCommand| match command {
        BackendCommand::ControlRemotely { job, .. } => Some(*job),
        _ => None,
    };
    let job = window.state().backend.sent.iter().rev().find_map(of).expect("it is connected");
    tell(window, BackendEvent::RemoteSeen { job, event });
}

fn form(window: &mut W) -> &mut RemoteForm {
    window.state_mut().model.dialog::<RemoteForm>().expect("the dialog is open")
}

/// What the tab asked for is answered.
fn answer(window: &mut W, replies: impl Fn(usize, &Request) -> Result<Reply, RemoteError>) {
    let wanted = form(window).wanted();
    let values = wanted.into_iter().enumerate().map(|(at, request)| (request.clone(), replies(at, &request)));
    let values = values.collect();
    seen(window, RemoteControlEvent::Values(values));
}

#[test]
fn a_controller_with_a_warning_refuses_home_while_a_task_runs() {
    let flags = [StatusFlag::Auto, StatusFlag::Warning, StatusFlag::Running];
    let mut window = live(SIZE, &flags, 517, "The battery of the robot is low. Replace it within a month.");
    answer(&mut window, |_, _| Ok(Reply::Robot(1)));
    click(&mut window, "Allow commands…");
    assert_shows(&window, "within your own reach");
    click(&mut window, "Allow");
    click(&mut window, "Pause");
    let status = Some(RemoteStatus::default());
    let refused = RemoteError::NotReady { command: Command::Pause, unmet: vec![Condition::Running], status };
    seen(&mut window, RemoteControlEvent::Done { request: Request::Pause, result: Err(refused) });
    picture(&mut window, "remote_control");
}

#[test]
fn inputs_with_labels_in_the_dark() {
    let mut window = live(SIZE, &[StatusFlag::Auto, StatusFlag::Ready], 0, "");
    say(&mut window, Message::SetTheme(ThemeChoice::Dark));
    click(&mut window, "I/O");
    let labels = "input,0,Door closed\ninput,1,Part present\ninput,4,Gripper open\ninput,9,Conveyor at end\n";
    form(&mut window).io.labels = IoLabels::read(labels.as_bytes()).expect("labels");
    let refused = RemoteError::Refused {
        command: Command::GetIOWord,
        code: opcua_configurator::remote::RefusalCode::SystemError,
    };
    answer(&mut window, |at, _| match at {
        0 => Ok(Reply::Word(0x8213)),
        1 => Ok(Reply::Word(0x0041)),
        _ => Err(refused.clone()),
    });
    picture(&mut window, "remote_io_dark");
    click(&mut window, "Words");
    assert_shows(&window, "8213");
    assert_shows(&window, "1000 0010 0001 0011");
    click(&mut window, "Memory I/O");
    assert_shows(&window, "New value");
}

#[test]
fn variables_execute_and_the_log() {
    let mut window = live(SIZE, &[StatusFlag::Auto, StatusFlag::Ready], 0, "");
    click(&mut window, "Variables");
    for name in ["g_Count", "g_Target"] {
        type_into(&mut window, "Name of the variable", name);
        click(&mut window, "Add");
    }
    answer(&mut window, |at, _| match at {
        0 => Ok(Reply::Values(vec![SpelValue::Int16(42)])),
        _ => Err(RemoteError::Refused {
            command: Command::GetVariable,
            code: opcua_configurator::remote::RefusalCode::NoSuchVariable,
        }),
    });
    assert_shows(&window, "42");
    assert_shows(&window, "The controller has no such variable");

    say(&mut window, Message::SetLanguage(Language::Ja));
    click(&mut window, "ログ");
    let messages = [
        (Direction::Sent, &b"$Login,***\r\n"[..], true),
        (Direction::Received, b"#Login,0\r\n", true),
        (Direction::Sent, b"$GetStatus\r\n", true),
        (Direction::Received, b"#GetStatus,00100000001,0000\r\n", true),
        (Direction::Sent, b"$Execute,\"Print Here\"\r\n", false),
        (Direction::Received, b"#Execute,\" X: -182.632 Y:  240.114 Z:  -20.002 U:  -36.156\"\r\n", false),
        (Direction::Sent, b"$GetStatus\r\n", true),
        (Direction::Received, b"#GetStatus,00100000001,0000\r\n", true),
    ];
    let messages = messages.into_iter().zip(0..).map(|((direction, bytes, is_polling), at)| LoggedExchange {
        at: now() + Duration::milliseconds(at * 37),
        is_polling,
        message: Observed { direction, bytes: bytes.to_vec() },
    });
    let messages = messages.collect();
    seen(&mut window, RemoteControlEvent::Exchanged(messages));
    picture(&mut window, "remote_log_japanese");
}
