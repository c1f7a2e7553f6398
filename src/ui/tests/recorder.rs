//! Recordings, and looking at recordings.

use std::path::PathBuf;
use std::sync::LazyLock;

use super::*;
use crate::jobs::{FindServer, FoundServer, RecordEnd, RecordEvent, RecordRequest};
use crate::model::SerialNumber;
use crate::pki::{Certificate, client_identity};
use crate::recorder::{
    Format, LiveColumn, Progress, Quantity, RecordSettings, Recorded, RecordingHeader, RecordingPhase, Series, Sidecar,
    StopReason,
};
use crate::session::opcua_client::{ControllerServer, ServerLocation};
use crate::ui::features::recorder::{RecorderForm, RecordingState, RecordingView};
use crate::ui::model::{CloseChoice, Closing, RecorderEvent, RecorderWork};
use crate::workspace::ConfiguratorIdentity;

fn found() -> FoundServer {
    static CERTIFICATE: LazyLock<Certificate> =
        LazyLock::new(|| client_identity("OPC UA Configurator", "desk", now()).unwrap().certificate);
    FoundServer {
        serial: "SN1".parse::<SerialNumber>().unwrap(),
        server: ControllerServer {
            target: ServerLocation { host: "10.0.0.1".into(), port: 4840 },
            certificate: CERTIFICATE.clone(),
        },
        own: ConfiguratorIdentity {
            certificate: CERTIFICATE.clone(),
            certificate_path: PathBuf::from("/nowhere/own.der"),
            key_path: PathBuf::from("/nowhere/own.pem"),
        },
    }
}

fn sidecar(settings: RecordSettings, stopped_by: StopReason) -> Sidecar {
    Sidecar {
        version: 1,
        header: RecordingHeader {
            controller: "Paint".into(),
            serial: "SN1".into(),
            url: "opc.tcp://10.0.0.1:4840".into(),
            settings,
            started_at: now(),
            format: "csv".into(),
            keep_packets: false,
        },
        ended_at: now(),
        stopped_by,
        time_base: None,
        rows: 80,
        packets: 10,
        bytes: 26_080,
        seconds: 0.08,
        undecodable: 0,
        gaps: vec![],
        recordings: vec![],
        columns: vec![],
    }
}

fn ended(stopped_by: StopReason) -> RecorderEvent {
    let file = PathBuf::from("/nowhere/recordings/Paint.csv");
    let sidecar = sidecar(RecordSettings::motion(0, 0).unwrap(), stopped_by);
    let recorded = Recorded { sidecar_file: file.with_extension("csv.json"), file, packets: None, sidecar };
    RecorderEvent::Ended(Box::new(RecordEnd { recorded: Some(recorded), problem: None }))
}

fn failed(code: ErrorCode) -> RecorderEvent {
    RecorderEvent::Ended(Box::new(RecordEnd { recorded: None, problem: Some(code.into()) }))
}

fn form(model: &Model) -> &RecorderForm {
    model.working::<RecorderForm>().unwrap()
}

fn states(model: &Model) -> Vec<RecordingState> {
    form(model).recordings.iter().map(|recording| recording.state.clone()).collect()
}

fn tell(model: &mut Model, job: JobId, event: RecorderEvent) -> Vec<BackendCommand> {
    reduce(model, Message::Event(BackendEvent::Recorder { job, event }))
}

fn work(commands: &[BackendCommand]) -> (JobId, &RecorderWork) {
    let work = commands.iter().rev().find_map(|command| match command {
        BackendCommand::Recorder { job, work } => Some((*job, work)),
        _ => None,
    });
    work.unwrap_or_else(|| panic!("{commands:?}"))
}

fn request(commands: &[BackendCommand]) -> (JobId, RecordRequest) {
    match work(commands) {
        (job, RecorderWork::Record(request)) => (job, RecordRequest::clone(request)),
        (_, other) => panic!("{other:?}"),
    }
}

/// Two controllers are asked for their servers.
fn finding(change: impl Fn(&mut RecorderForm)) -> (Model, JobId) {
    let mut model = model();
    tick(&mut model, &["Paint", "Weld 2"]);
    reduce(&mut model, Message::Invoke(UiCommand::RECORDER));
    change(model.dialog::<RecorderForm>().unwrap());
    let commands = reduce(&mut model, Message::Submit);
    let (job, RecorderWork::Recover(folder)) = work(&commands) else { panic!("{commands:?}") };
    assert_eq!(*folder, PathBuf::from("/nowhere/recordings"));
    let commands = tell(&mut model, job, RecorderEvent::Recovered(vec![]));
    assert!(model.job.as_ref().unwrap().task.operation::<FindServer>().is_some());
    (model, super::job(&commands))
}

/// Both record.
fn recording() -> (Model, [JobId; 2]) {
    let (mut model, find) = finding(|_| {});
    let jobs = [0, 1].map(|index| request(&done(&mut model, find, index, found())).0);
    super::ended(&mut model, find, 2, 0);
    for job in jobs {
        let progress = Progress { phase: RecordingPhase::Running, rows: 8, ..Progress::default() };
        tell(&mut model, job, RecorderEvent::Seen(RecordEvent::Progress(Box::new(progress))));
    }
    (model, jobs)
}

#[test]
fn what_is_chosen_is_recorded_of_each_controller() {
    let (mut model, find) = finding(|form| {
        let setup = &mut form.setup;
        setup.sampling_interval = 2;
        setup.format = Format::Parquet;
        setup.keep_packets = true;
        setup.seconds = "60".into();
        (setup.user, setup.password.0) = ("operator1".into(), "Passw0rd1".into());
    });
    let (_, request) = request(&done(&mut model, find, 0, found()));
    assert_eq!(request.settings, RecordSettings::motion(2, 0).unwrap());
    assert_eq!((request.format, request.keep_packets, request.name.as_str()), (Format::Parquet, true, "Weld 2"));
    assert_eq!(request.limits.duration, Some(std::time::Duration::from_secs(60)));
    assert_eq!(request.login.unwrap().name.as_str(), "operator1");
    assert!(form(&model).setup.password.0.is_empty(), "wiped");
    let problem = fail(&mut model, find, 1, ErrorCode::ServerNotRunning);
    assert!(problem.is_empty());
    super::ended(&mut model, find, 1, 1);
    assert_eq!(
        states(&model),
        [RecordingState::At(RecordingPhase::Connecting), RecordingState::Failed(ErrorCode::ServerNotRunning.into())]
    );
    assert!(model.job.is_none() && model.top::<RecorderForm>().is_some());

    // Another try is for those that failed.
    let commands = reduce(&mut model, Message::act(Model::retry_recordings));
    let [BackendCommand::Run { controllers, .. }] = &commands[..] else { panic!("{commands:?}") };
    assert_eq!(controllers.len(), 1);
    assert_eq!(states(&model)[1], RecordingState::Finding);
}

#[test]
fn a_recording_goes_on_without_its_dialog_and_is_found_again() {
    let (mut model, [one, other]) = recording();
    assert!(reduce(&mut model, Message::Close).is_empty());
    assert!(model.dialogs.is_empty() && model.active_recordings() == 2);
    tell(&mut model, one, ended(StopReason::Duration));
    tell(&mut model, other, failed(ErrorCode::WorkspaceFull));
    assert_eq!((form(&model).active(), form(&model).failed()), (0, 1));
    // Nothing is ticked; the recordings are shown all the same.
    reduce(&mut model, Message::TickAll(false));
    assert!(UiCommand::RECORDER.why_disabled(&model).is_none());
    reduce(&mut model, Message::Invoke(UiCommand::RECORDER));
    let states = states(&model);
    assert_eq!(states[0], RecordingState::Ended(StopReason::Duration));
    assert_eq!(model.top::<RecorderForm>().unwrap().recordings[0].progress.rows, 80);
    reduce(&mut model, Message::Close);
    assert_eq!(UiCommand::RECORDER.why_disabled(&model), Some(TextKey::WhyTick), "nothing goes on any more");
}

#[test]
fn recordings_are_ended_one_by_one_or_all() {
    let (mut model, [one, other]) = recording();
    let row = form(&model).recordings[0].row;
    let commands = reduce(&mut model, Message::act(move |model| model.end_recording(row)));
    assert!(matches!(commands[..], [BackendCommand::Cancel(job)] if job == one));
    assert_eq!(states(&model)[0], RecordingState::Ending);
    // What it still reports does not look like a recording that goes on.
    let progress = Progress { phase: RecordingPhase::Running, rows: 16, ..Progress::default() };
    tell(&mut model, one, RecorderEvent::Seen(RecordEvent::Progress(Box::new(progress))));
    assert_eq!((states(&model)[0].clone(), form(&model).recordings[0].progress.rows), (RecordingState::Ending, 16));
    tell(&mut model, one, ended(StopReason::Request));
    let commands = reduce(&mut model, Message::Submit);
    assert!(matches!(commands[..], [BackendCommand::Cancel(job)] if job == other));
    tell(&mut model, other, ended(StopReason::Request));
    // The main button leads back to the settings.
    reduce(&mut model, Message::Submit);
    assert!(form(&model).recordings.is_empty());
}

#[test]
fn the_window_closes_once_the_files_are_complete() {
    let (mut model, [one, other]) = recording();
    reduce(&mut model, Message::Closing(CloseChoice::Ask));
    let commands = reduce(&mut model, Message::Closing(CloseChoice::Finish));
    let jobs: Vec<JobId> = commands
        .iter()
        .map(|command| match command {
            BackendCommand::Cancel(job) => *job,
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(jobs, [one, other]);
    assert_eq!((model.closing, model.active_recordings()), (Some(Closing::Finishing), 2));
    tell(&mut model, one, ended(StopReason::Request));
    tell(&mut model, other, ended(StopReason::Request));
    assert_eq!(model.active_recordings(), 0);
}

#[test]
fn a_controller_that_is_not_found_yet_is_not_waited_for_after_closing() {
    let (mut model, find) = finding(|_| {});
    let (one, _) = request(&done(&mut model, find, 0, found()));
    let commands = reduce(&mut model, Message::Close);
    assert!(matches!(commands[..], [BackendCommand::Cancel(job)] if job == find) && model.job.is_none());
    assert_eq!(states(&model)[1], RecordingState::Failed(ErrorCode::Cancelled.into()));
    tell(&mut model, one, ended(StopReason::Size));
    assert_eq!(model.active_recordings(), 0);
}

#[test]
fn who_is_refused_is_trusted_and_recorded() {
    let (mut model, [one, other]) = recording();
    for job in [one, other] {
        tell(&mut model, job, failed(ErrorCode::ConfiguratorNotTrusted));
    }
    reduce(&mut model, Message::act(Model::trust_for_recordings));
    assert!(model.top::<ConfirmDialog>().is_some(), "asked first");
    let trust = job(&reduce(&mut model, Message::Submit));
    for index in [0, 1] {
        done(&mut model, trust, index, NoOutput);
    }
    let commands = super::ended(&mut model, trust, 2, 0);
    assert!(commands.iter().any(|command| matches!(command, BackendCommand::Run { .. })));
    assert_eq!(states(&model), [RecordingState::Finding, RecordingState::Finding]);
    assert!(model.job.as_ref().unwrap().task.operation::<FindServer>().is_some());
}

#[test]
fn the_quantities_that_are_chosen_are_read_of_a_recording() {
    let mut model = model();
    reduce(&mut model, Message::Invoke(UiCommand::OPEN_RECORDING));
    assert_eq!(model.top::<RecordingView>().unwrap().incomplete(), Some(TextKey::FileRule));
    model.dialog::<RecordingView>().unwrap().path = "recordings/Paint.csv".into();
    let commands = reduce(&mut model, Message::Submit);
    let (job, RecorderWork::Describe(file)) = work(&commands) else { panic!("{commands:?}") };
    assert_eq!(*file, PathBuf::from("/nowhere/recordings/Paint.csv"));
    let sidecar = sidecar(RecordSettings::force(2, 1, 0).unwrap(), StopReason::Footer);
    let commands = tell(&mut model, job, RecorderEvent::Described(Ok(Box::new(sidecar.header.clone()))));
    let (load, RecorderWork::Load { values, .. }) = work(&commands) else { panic!("{commands:?}") };
    let column = |name: &str| LiveColumn { name: name.into(), unit: "N".into(), series: Series::default() };
    values.replace(vec![column("Fx"), column("Tx")]);
    assert!(model.top::<RecordingView>().unwrap().is_reading());
    tell(&mut model, load, RecorderEvent::Loaded(Ok(Box::new(sidecar))));
    let view = model.dialog::<RecordingView>().unwrap();
    assert!(!view.is_reading() && view.opened.as_ref().unwrap().sidecar.is_some());

    // What is added is read on its own; what is not shown any more is dropped.
    view.plot.toggle(Quantity::Position);
    let commands = reduce(&mut model, Message::act(Model::recording_plot_changed));
    let (load, _) = work(&commands);
    let view = model.dialog::<RecordingView>().unwrap();
    assert_eq!(view.opened.as_ref().unwrap().values.len(), 2);
    view.plot.toggle(Quantity::Position);
    let commands = reduce(&mut model, Message::act(Model::recording_plot_changed));
    assert!(matches!(commands[..], [BackendCommand::Cancel(job)] if job == load));
    let problem = Problem::from(ErrorCode::NoRecordingDescription);
    tell(&mut model, load, RecorderEvent::Loaded(Err(problem)));
    assert_eq!(model.top::<RecordingView>().unwrap().problem, None, "of values that are not wanted any more");
}
