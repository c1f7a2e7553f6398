//! The window as it looks, pixel by pixel.

use opcua_configurator::jobs::{JobStep, NoOutput, OperationOutput};
use opcua_configurator::model::{
    ControllerInfo, ControllerSeries, ErrorCode, Language, Problem, RevisionToken, Revisioned, ServerSettings, UserName,
};
use opcua_configurator::pki::Fingerprint;
use opcua_configurator::ui::backend::{BackendEvent, RecordingBackend};
use opcua_configurator::ui::model::Message;
use opcua_configurator::workspace::{Configuration, ThemeChoice};

use crate::harness::{SIZE, choose, click, now, settle, type_into, window};
use crate::pictures::{W, assert_shows, end_job, fail, job, picture, say, step, succeed, tell, tick};
use crate::samples::{configuration, info};

fn open(count: usize) -> W {
    window(RecordingBackend::default(), configuration(count, now()), SIZE)
}

fn read(index: usize) -> Option<ControllerInfo> {
    Some(info(index, now(), ControllerSeries::Rc800))
}

fn load(window: &mut W, output: impl OperationOutput) {
    succeed(window, 0, output, read(0));
    end_job(window, 1, 0, 0);
}

fn settings() -> Revisioned<ServerSettings> {
    Revisioned { revision: RevisionToken::new(4), value: ServerSettings::default() }
}

#[test]
fn main_window() {
    let mut window = open(24);
    tick(&mut window, &["Weld 2", "Paint booth"]);
    picture(&mut window, "main_light");
    say(&mut window, Message::SetTheme(ThemeChoice::Dark));
    say(&mut window, Message::SetLanguage(Language::Zh));
    picture(&mut window, "main_chinese");
    say(&mut window, Message::SetLanguage(Language::Ja));
    picture(&mut window, "main_japanese");
}

#[test]
fn small_window_and_search() {
    let mut window = window(RecordingBackend::default(), configuration(24, now()), [900.0, 500.0]);
    tick(&mut window, &["Weld 2", "Paint booth"]);
    type_into(&mut window, "Search", "weld");
    picture(&mut window, "main_small");
}

#[test]
fn welcome() {
    let mut window = window(RecordingBackend::default(), Configuration::default(), SIZE);
    window.state_mut().model.virtual_available = true;
    settle(&mut window);
    window.step();
    picture(&mut window, "welcome");
}

#[test]
fn menu() {
    let mut window = open(24);
    choose(&mut window, &["Certificate", "Create and save"]);
    picture(&mut window, "menu");
}

#[test]
fn add_controller() {
    let mut window = window(RecordingBackend::default(), Configuration::default(), SIZE);
    click(&mut window, "Add a controller");
    type_into(&mut window, "Name", "Weld 1");
    type_into(&mut window, "IP address", "10.0.0.999");
    assert_shows(&window, "Enter an IP address or a host name, with or without a port");
    type_into(&mut window, "IP address", "10.0.0.9");
    click(&mut window, "Apply");
    let probe = job(&window);
    tell(&mut window, BackendEvent::Probed { job: probe, result: Ok(Fingerprint::of(b"weld 1")) });
    picture(&mut window, "add_controller_fingerprint");
    click(&mut window, "It matches, add");
    let enroll = job(&window);
    tell(&mut window, BackendEvent::Enrolled { job: enroll, result: Err(ErrorCode::WrongPassword.into()) });
    assert_shows(&window, "The connection password is wrong");
}

#[test]
fn confirm_and_delete() {
    let mut window = open(24);
    tick(&mut window, &["Weld 1", "Weld 2", "Paint booth"]);
    click(&mut window, "Stop");
    picture(&mut window, "confirm_stop");
    click(&mut window, "Cancel");
    choose(&mut window, &["Controller", "Delete…"]);
    assert_shows(&window, "Delete from the list – 3 controllers");
}

#[test]
fn processing() {
    let mut window = open(24);
    tick(&mut window, &["Weld 1", "Weld 2", "Weld 10", "Paint booth", "Press feeder"]);
    click(&mut window, "Get new information");
    succeed(&mut window, 0, NoOutput, read(0));
    let unreachable = Problem::with_detail(ErrorCode::Unreachable, "connection refused (os error 111)");
    fail(&mut window, 1, unreachable);
    step(&mut window, 2, JobStep::Connect);
    step(&mut window, 3, JobStep::Read);
    click(&mut window, "Cancel");
    assert_shows(&window, "Stop after the step in hand?");
    click(&mut window, "Go on");
    for index in [2, 3] {
        succeed(&mut window, index, NoOutput, read(index));
    }
    fail(&mut window, 4, ErrorCode::Cancelled);
    end_job(&mut window, 3, 1, 1);
    assert_shows(&window, "3 done, 1 failed, 1 not started");
    say(&mut window, Message::SetLanguage(Language::Zh));
    picture(&mut window, "processing_summary_chinese");
}

#[test]
fn password() {
    let mut window = open(24);
    tick(&mut window, &["Weld 1", "Weld 2"]);
    click(&mut window, "Get new information");
    for index in [0, 1] {
        fail(&mut window, index, ErrorCode::PasswordMissing);
    }
    end_job(&mut window, 0, 2, 0);
    picture(&mut window, "password");
}

#[test]
fn basic_settings() {
    let mut window = open(24);
    tick(&mut window, &["Weld 1"]);
    choose(&mut window, &["Server settings", "Basic settings…"]);
    load(&mut window, settings());
    load(&mut window, Revisioned::<Vec<UserName>> { revision: RevisionToken::new(4), value: vec![] });
    assert_shows(&window, "Basic128Rsa15");
    click(&mut window, "On");
    type_into(&mut window, "Port", "80");
    say(&mut window, Message::SetTheme(ThemeChoice::Dark));
    picture(&mut window, "settings_dark");
}

#[test]
fn settings_for_many_in_chinese() {
    let mut window = open(24);
    tick(&mut window, &["Weld 1", "Weld 2"]);
    choose(&mut window, &["Server settings", "Basic settings…"]);
    say(&mut window, Message::SetLanguage(Language::Zh));
    assert_shows(&window, "服务器启动模式");
}

#[test]
fn users() {
    let mut window = open(24);
    tick(&mut window, &["Weld 1"]);
    choose(&mut window, &["Server settings", "Users…"]);
    let users: Vec<UserName> = ["operator1", "Maintenance7", "scada2026"].map(|name| name.parse().unwrap()).to_vec();
    load(&mut window, Revisioned { revision: RevisionToken::new(4), value: users });
    click(&mut window, "scada2026");
    picture(&mut window, "users");
    click(&mut window, "Add user…");
    type_into(&mut window, "User name", "operator1");
    type_into(&mut window, "Password", "short");
    assert_shows(&window, "A user of this name already exists");
}

#[test]
fn self_signed() {
    let mut window = open(24);
    tick(&mut window, &["Weld 1"]);
    choose(&mut window, &["Certificate", "Create and save", "Self-signed…"]);
    load(&mut window, settings());
    type_into(&mut window, "Organisation", "Example");
    picture(&mut window, "self_signed");
    click(&mut window, "Create and save");
    assert_shows(&window, "The certificate of this type in the controller is replaced");
    click(&mut window, "Cancel");
    click(&mut window, "Cancel");
    tick(&mut window, &["Weld 2"]);
    choose(&mut window, &["Certificate", "Create and save", "Self-signed…"]);
    say(&mut window, Message::SetLanguage(Language::Zh));
    assert_shows(&window, "自签名证书 – 2 台控制器");
}

#[test]
fn options_and_help() {
    let mut window = open(5);
    choose(&mut window, &["Options", "Options…"]);
    picture(&mut window, "options");
    click(&mut window, "Close");
    choose(&mut window, &["Options", "Backup…"]);
    assert_shows(&window, "/home/engineer/EpsonRC80/OPCUA");
    click(&mut window, "Cancel");
    choose(&mut window, &["Help", "Keyboard shortcuts"]);
    picture(&mut window, "shortcuts");
    click(&mut window, "Close");
    choose(&mut window, &["Help", "About"]);
    assert_shows(&window, "Version 0.1.0");
}

#[test]
fn error() {
    let mut window = open(5);
    window.state_mut().model.show_problem(Problem::with_detail(
        ErrorCode::ConfigurationDamaged,
        "expected value at line 3 column 7; kept as epson_opcua_config.damaged-20260601T083000Z.json",
    ));
    window.step();
    picture(&mut window, "error");
}
