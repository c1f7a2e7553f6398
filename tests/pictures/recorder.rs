//! Pictures of recordings.

use std::path::PathBuf;

use chrono::Duration;
use opcua_configurator::jobs::{FoundServer, RecordEnd, RecordEvent};
use opcua_configurator::model::{ErrorCode, Language};
use opcua_configurator::pki::{Certificate, client_identity};
use opcua_configurator::recorder::{
    Gap, GapCause, LiveColumn, LiveValues, Progress, Quantity, RecordSettings, RecordingHeader, RecordingPhase, Series,
    Sidecar, Source, StopReason, TimeBase,
};
use opcua_configurator::session::opcua_client::{ControllerServer, ServerLocation};
use opcua_configurator::ui::backend::{BackendCommand, BackendEvent, RecordingBackend};
use opcua_configurator::ui::model::{JobId, Message, RecorderEvent, RecorderWork};
use opcua_configurator::ui::reduce;
use opcua_configurator::workspace::{ConfiguratorIdentity, ThemeChoice};

use crate::harness::{SIZE, choose, click, now, settle, type_into, window};
use crate::pictures::{W, assert_shows, chinese, end_job, fail, job, picture, say, succeed, tell, tick};
use crate::samples::configuration;

fn open(controllers: &[&str]) -> W {
    let mut window = window(RecordingBackend::default(), configuration(24, now()), SIZE);
    tick(&mut window, controllers);
    choose(&mut window, &["Tools", "Recorder…"]);
    window
}

fn certificate() -> Certificate {
    client_identity("OPC UA Configurator", "desk", now()).unwrap().certificate
}

fn found(serial: &str) -> FoundServer {
    let certificate = certificate();
    FoundServer {
        serial: serial.parse().unwrap(),
        server: ControllerServer {
            target: ServerLocation { host: "192.168.10.11".into(), port: 4840 },
            certificate: certificate.clone(),
        },
        own: ConfiguratorIdentity {
            certificate,
            certificate_path: PathBuf::from("/home/engineer/EpsonRC80/OPCUA/Configurator/configurator.der"),
            key_path: PathBuf::from("/home/engineer/EpsonRC80/OPCUA/Configurator/configurator_key.pem"),
        },
    }
}

/// Starts the recordings: controllers with an index in `refused` have a server that does not run.
fn start(window: &mut W, count: usize, stopped: usize) {
    click(window, "Start recording");
    let recovering = job(window);
    tell(window, BackendEvent::Recorder { job: recovering, event: RecorderEvent::Recovered(vec![]) });
    for index in 0..count {
        match index == stopped {
            true => fail(window, index, ErrorCode::ServerNotRunning),
            false => succeed(window, index, found("R7A0000001"), None),
        }
    }
    end_job(window, count, 0, 0);
}

/// The recordings that were started, with where their values go.
fn started(window: &W) -> Vec<(JobId, LiveValues)> {
    let of = |command: &BackendCommand| match command {
        BackendCommand::Recorder { job, work: RecorderWork::Record(request) } => {
            Some((*job, request.values.clone().expect("they are plotted")))
        }
        _ => None,
    };
    window.state().backend.sent.iter().filter_map(of).collect()
}

fn see(window: &mut W, job: JobId, event: RecordEvent) {
    tell(window, BackendEvent::Recorder { job, event: RecorderEvent::Seen(event) });
}

/// Ten seconds of some quantities, without those between `gap`.
fn columns(source: Source, quantities: &[Quantity], unit: &str, gap: std::ops::Range<u32>) -> Vec<LiveColumn> {
    let names = quantities.iter().flat_map(|quantity| quantity.columns(source));
    let column = |(number, name): (usize, String)| {
        let mut series = Series::default();
        for step in 0..2_000_u32 {
            if step == gap.end {
                series.push_gap();
            }
            if gap.contains(&step) {
                continue;
            }
            let turn = f64::from(step) * 0.005;
            let number = number as f64;
            let wave = (turn * (0.5 + 0.15 * number)).sin() * (40.0 - 7.0 * number) + 5.0 * number;
            let noise = f64::from((step * 7_919 + 31) % 97) / 97.0 * 1.5;
            series.push(turn, wave + noise);
        }
        LiveColumn { name, unit: unit.into(), series }
    };
    names.enumerate().map(column).collect()
}

fn force() -> RecordSettings {
    RecordSettings::force(0, 1, 0).unwrap()
}

fn progress(phase: RecordingPhase, rows: u64) -> RecordEvent {
    RecordEvent::Progress(Box::new(Progress {
        phase,
        rows,
        packets: rows / 40,
        bytes: rows * 178,
        file_bytes: rows * 212,
        ..Progress::default()
    }))
}

fn force_columns(gap: std::ops::Range<u32>) -> Vec<LiveColumn> {
    let source = force().source();
    let mut columns = columns(source, &[Quantity::Forces], "N", gap.clone());
    columns.extend(self::columns(source, &[Quantity::Torques], "N·m", gap));
    columns
}

#[test]
fn what_is_recorded_is_chosen() {
    let mut window = open(&["Weld 1", "Weld 2"]);
    click(&mut window, "Force sensor");
    type_into(&mut window, "Time (s)", "600");
    assert_shows(&window, "Start the recording before RecordStart");
    picture(&mut window, "recorder_setup");
    type_into(&mut window, "Time (s)", "ten");
    assert_shows(&window, "A whole number from 1 on, or nothing");
}

#[test]
fn forces_of_several_controllers_while_they_are_recorded() {
    let mut window = open(&["Weld 1", "Weld 2", "Paint booth"]);
    click(&mut window, "Force sensor");
    start(&mut window, 3, 2);
    let recordings = started(&window);
    let file = |name: &str| {
        PathBuf::from(format!("/home/engineer/EpsonRC80/OPCUA/recordings/{name}-force-20260601-083015-250.csv"))
    };
    recordings[0].1.replace(force_columns(900..1_050));
    see(&mut window, recordings[0].0, RecordEvent::Started(file("Weld_1")));
    let RecordEvent::Progress(running) = progress(RecordingPhase::Running, 18_500) else { unreachable!() };
    let running = Progress { gaps: 1, missing: 750, warnings: 1, ..*running };
    see(&mut window, recordings[0].0, RecordEvent::Progress(Box::new(running)));
    see(&mut window, recordings[1].0, RecordEvent::Started(file("Weld_2")));
    see(&mut window, recordings[1].0, progress(RecordingPhase::Waiting, 0));
    picture(&mut window, "recorder_running");
    click(&mut window, "Paint booth");
    assert_shows(&window, "The OPC UA server is not running");
    say(&mut window, Message::SetTheme(ThemeChoice::Dark));
    let code = ErrorCode::OpcUaConnectionFailed;
    let detail = "the connection was closed at stage Read".to_owned();
    let RecordEvent::Progress(lost) = progress(RecordingPhase::Reconnecting { code, detail }, 18_500) else {
        unreachable!()
    };
    see(&mut window, recordings[0].0, RecordEvent::Progress(lost));
    click(&mut window, "Weld 1");
    chinese(&mut window);
    picture(&mut window, "recorder_lost_dark_chinese");
    let end = RecordEnd { recorded: None, problem: Some(ErrorCode::WorkspaceFull.into()) };
    tell(&mut window, BackendEvent::Recorder { job: recordings[0].0, event: RecorderEvent::Ended(Box::new(end)) });
    assert_shows(&window, "工作区所在磁盘已满");
}

#[test]
fn a_recording_that_was_opened() {
    let mut window = window(RecordingBackend::default(), configuration(24, now()), SIZE);
    choose(&mut window, &["Tools", "Open recording…"]);
    assert_shows(&window, "A file can also be dropped onto the window");
    let path = "/home/engineer/EpsonRC80/OPCUA/recordings/Weld_1-motion-20260601-083015-250.parquet";
    type_into(&mut window, "File", path);
    click(&mut window, "Open");
    let settings = RecordSettings::motion(0, 0).unwrap();
    let header = RecordingHeader {
        controller: "Weld 1".into(),
        serial: "R7A0000001".into(),
        url: "opc.tcp://192.168.10.11:4840".into(),
        settings,
        started_at: now() - Duration::minutes(30),
        format: "parquet".into(),
        keep_packets: false,
    };
    let described = RecorderEvent::Described(Ok(Box::new(header.clone())));
    let describing = job(&window);
    tell(&mut window, BackendEvent::Recorder { job: describing, event: described });
    let loading = job(&window);
    let values = window.state().backend.sent.iter().rev().find_map(|command| match command {
        BackendCommand::Recorder { work: RecorderWork::Load { values, .. }, .. } => Some(values.clone()),
        _ => None,
    });
    let mut shown = columns(settings.source(), &[Quantity::Position], "mm", 1_200..1_300);
    shown.extend(columns(settings.source(), &[Quantity::Orientation], "deg", 1_200..1_300));
    values.expect("values are read").replace(shown);
    let gap = |cause, missing, at_row| Gap { cause, noticed_at: now(), after: None, until: None, missing, at_row };
    let sidecar = Sidecar {
        version: 1,
        header,
        ended_at: now() - Duration::minutes(29),
        stopped_by: StopReason::Duration,
        time_base: Some(TimeBase { ticks_per_second: 80_000_000, first_ticks: 1, received_at: now() }),
        rows: 19_600,
        packets: 245,
        bytes: 6_389_600,
        seconds: 10.0,
        undecodable: 0,
        gaps: vec![gap(GapCause::ConnectionLost, Some(125), 12_000), gap(GapCause::Overwritten, None, 15_200)],
        recordings: vec![],
        columns: vec![],
    };
    tell(&mut window, BackendEvent::Recorder { job: loading, event: RecorderEvent::Loaded(Ok(Box::new(sidecar))) });
    say(&mut window, Message::SetLanguage(Language::Ja));
    picture(&mut window, "recording_japanese");
    // Another look at the same: a part of the time, and a column less.
    click(&mut window, "拡大");
    click(&mut window, "TCP.Z");
    settle(&mut window);
    assert_shows(&window, "2.499 s～7.496 s");
    reduce(&mut window.state_mut().model, Message::Close);
}
