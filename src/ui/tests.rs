//! The rules of the window, without a window.

mod client_certificates;
mod live_values;
mod recorder;
mod remote_control;
mod server_log;
mod transfer;
mod vault;
mod verify;

use chrono::{DateTime, Duration, Utc};

use super::features::COMMANDS;
use super::features::activation::{ActivationForm, KeysForm};
use super::features::add_controller::{AddControllerForm, AddStage};
use super::features::basic_settings::BasicSettingsForm;
use super::model::{
    BackendCommand, BackendEvent, CancelState, Column, FileContents, JobId, Message, Model, TaskEvent, UiCommand,
};
use super::reduce;
use super::shell::confirm::ConfirmDialog;
use super::shell::error::ErrorDialog;
use super::shell::password::PasswordDialog;
use super::shell::processing::ProcessingDialog;
use crate::jobs::{ControllerReport, JobStep, JobSummary, NoOutput, OperationOutput, SetBasicSettings};
use crate::model::{ControllerInfo, ErrorCode, Language, Problem, RevisionToken, Revisioned, ServerSettings};
use crate::pki::Fingerprint;
use crate::texts::TextKey;
use crate::workspace::{Configuration, ControllerEntry, Workspace};

fn now() -> DateTime<Utc> {
    "2026-06-01T08:30:00Z".parse().unwrap()
}

fn entry(name: &str, address: &str) -> ControllerEntry {
    ControllerEntry {
        name: name.parse().unwrap(),
        address: address.parse().unwrap(),
        series: crate::model::ControllerSeries::Rc800,
        connection: crate::model::ConnectionKind::Management,
        fingerprint: Some(Fingerprint::of(name.as_bytes())),
        last: None,
    }
}

fn model() -> Model {
    let mut configuration = Configuration::default();
    configuration.controllers =
        vec![entry("Weld 10", "10.0.0.9"), entry("Weld 2", "10.0.0.10"), entry("Paint", "10.0.0.1")];
    Model::new(configuration, Workspace::new("/nowhere"), Language::En, now())
}

fn shown(model: &Model) -> Vec<&str> {
    (0..model.rows.shown()).filter_map(|at| model.rows.at(at)).map(|row| row.entry.name.as_str()).collect()
}

fn info() -> ControllerInfo {
    serde_json::from_value(serde_json::json!({
        "name": "RC", "serial": "SN1", "series": "RC800", "firmware": "8.0.0", "status": "Run", "error": null,
        "activated": true, "certificate": null, "application_name": "EpsonRC.SN1", "endpoint": "opc.tcp://x:4840",
        "used_ports": [5000], "limits": { "trusted": 50, "issuers": 50, "crls": 50 },
        "clock": "2026-06-01T08:30:00Z", "revision": 1
    }))
    .unwrap()
}

/// The operation of the job succeeds for one of its controllers.
fn done<O: OperationOutput>(model: &mut Model, job: JobId, index: usize, output: O) -> Vec<BackendCommand> {
    let task = model.job.as_ref().expect("a job").task.clone();
    let report = ControllerReport { result: Ok(output), info: Some(info()) };
    event(model, job, task.finished(index, report).expect("a result of this operation"))
}

/// It fails for one of them.
fn fail(model: &mut Model, job: JobId, index: usize, problem: impl Into<Problem>) -> Vec<BackendCommand> {
    let task = model.job.as_ref().expect("a job").task.clone();
    event(model, job, task.failed(index, problem.into()))
}

/// A model whose controllers are not confirmed yet, all ticked.
fn unconfirmed() -> Model {
    let mut model = model();
    let entries: Vec<ControllerEntry> = model.rows.all().iter().map(|row| row.entry.clone()).collect();
    let mut configuration = Configuration::default();
    configuration.controllers =
        entries.into_iter().map(|entry| ControllerEntry { fingerprint: None, ..entry }).collect();
    model = Model::new(configuration, Workspace::new("/nowhere"), Language::En, now());
    reduce(&mut model, Message::TickAll(true));
    model
}

fn probe(commands: &[BackendCommand]) -> (JobId, String) {
    let Some(BackendCommand::Probe { job, connection: _, address }) = commands.last() else { panic!("{commands:?}") };
    (*job, address.to_string())
}

#[test]
fn whose_identity_is_not_confirmed_is_asked_about_one_after_the_other() {
    let mut model = unconfirmed();
    let (first, address) = probe(&reduce(&mut model, Message::Invoke(UiCommand::GET_INFO)));
    assert_eq!(address, "10.0.0.9");
    let skipped = reduce(&mut model, Message::act(Model::skip_identity));
    assert!(matches!(skipped[0], BackendCommand::Cancel(job) if job == first));
    let (second, address) = probe(&skipped);
    assert_eq!(address, "10.0.0.10");

    // An answer about the one that was skipped is dropped.
    let fingerprint = Fingerprint::of(b"second");
    reduce(&mut model, Message::Event(BackendEvent::Probed { job: first, result: Ok(Fingerprint::of(b"first")) }));
    reduce(&mut model, Message::Event(BackendEvent::Probed { job: second, result: Ok(fingerprint) }));
    let asked = reduce(&mut model, Message::Submit);
    let [BackendCommand::Enroll { job, fingerprint: agreed, .. }] = &asked[..] else { panic!("{asked:?}") };
    assert_eq!(*agreed, fingerprint);
    let enrolled = crate::jobs::Enrolled { fingerprint, info: info(), password_not_kept: None };
    let next = reduce(&mut model, Message::Event(BackendEvent::Enrolled { job: *job, result: Ok(Box::new(enrolled)) }));
    assert!(matches!(next[0], BackendCommand::Save(_)));
    assert_eq!(probe(&next).1, "10.0.0.1");
    let confirmed: Vec<bool> = model.rows.all().iter().map(|row| row.entry.fingerprint.is_some()).collect();
    assert_eq!(confirmed, [false, true, false]);

    // Cancel ends it all.
    assert!(matches!(reduce(&mut model, Message::Close)[..], [BackendCommand::Cancel(_)]));
    assert!(model.dialogs.is_empty());
    assert_eq!(UiCommand::CONFIRM_IDENTITY.why_disabled(&model), None);
}

#[test]
fn a_file_that_comes_after_its_dialog_was_closed_is_dropped() {
    let mut model = model();
    tick(&mut model, &["Weld 2", "Paint"]);
    reduce(&mut model, Message::Invoke(UiCommand::ACTIVATION));
    let picking = reduce(&mut model, Message::ChooseFile);
    let [BackendCommand::PickFile { job: picking, .. }] = picking[..] else { panic!("{picking:?}") };
    assert!(reduce(&mut model, Message::ChooseFile).is_empty(), "one dialog of the desktop is enough");
    let picked = || BackendEvent::FilePicked { job: picking, result: Ok(Some("/keys.csv".into())) };
    let reading = reduce(&mut model, Message::Event(picked()));
    let [BackendCommand::ReadFile { job: reading, .. }] = reading[..] else { panic!("{reading:?}") };
    reduce(&mut model, Message::Close);
    reduce(&mut model, Message::Invoke(UiCommand::ACTIVATION));
    assert!(reduce(&mut model, Message::Event(picked())).is_empty());
    let contents = FileContents(b"OPCUA.Activation.Ver.1.0\n".to_vec());
    reduce(
        &mut model,
        Message::Event(BackendEvent::FileRead { job: reading, result: Ok(("/keys.csv".into(), contents)) }),
    );
    let Some(form) = model.top::<ActivationForm>() else { panic!("{:?}", model.dialogs) };
    assert!(form.operation().is_none());
    let KeysForm::File { file, preview } = &form.keys else { panic!("{form:?}") };
    assert!(file.path.is_empty() && preview.is_none());
}

/// The types of the open dialogs, the last on top.
fn open(model: &Model) -> Vec<String> {
    let name = |shown: String| shown.chars().take_while(|c| c.is_alphanumeric()).collect();
    model.dialogs.iter().map(|dialog| name(format!("{dialog:?}"))).collect()
}

fn tick(model: &mut Model, names: &[&str]) {
    for name in names {
        let row = model.rows.all().iter().find(|row| row.entry.name.as_str() == *name).unwrap().id;
        reduce(model, Message::Toggle { row, range: false });
    }
}

fn job(commands: &[BackendCommand]) -> JobId {
    let [BackendCommand::Run { job, .. }] = commands else { panic!("{commands:?}") };
    *job
}

fn event(model: &mut Model, job: JobId, event: TaskEvent) -> Vec<BackendCommand> {
    reduce(model, Message::Event(BackendEvent::Job { job, event }))
}

fn ended(model: &mut Model, job: JobId, done: usize, failed: usize) -> Vec<BackendCommand> {
    reduce(model, Message::Event(BackendEvent::JobEnded { job, summary: JobSummary { done, failed, not_started: 0 } }))
}

#[test]
fn names_sort_as_people_count_and_addresses_by_number() {
    let mut model = model();
    reduce(&mut model, Message::Sort(Column::Name));
    assert_eq!(shown(&model), ["Paint", "Weld 2", "Weld 10"]);
    reduce(&mut model, Message::Sort(Column::Address));
    assert_eq!(shown(&model), ["Paint", "Weld 10", "Weld 2"]);
    reduce(&mut model, Message::Sort(Column::Address));
    assert_eq!(shown(&model), ["Weld 2", "Weld 10", "Paint"]);
    assert_eq!(model.configuration().options.window.sort, Some(("address".into(), false)));
}

#[test]
fn a_tick_survives_the_search_and_is_counted() {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    reduce(&mut model, Message::Filter("WELD".into()));
    assert_eq!(shown(&model), ["Weld 10", "Weld 2"]);
    assert_eq!((model.rows.ticked_count(), model.rows.ticked_hidden()), (1, 1));
    reduce(&mut model, Message::TickAll(true));
    assert_eq!(model.rows.ticked_count(), 3);
    reduce(&mut model, Message::TickAll(false));
    assert_eq!(model.rows.ticked_count(), 1, "what is hidden keeps its tick");
    reduce(&mut model, Message::Filter("10.0.0.10".into()));
    assert_eq!(shown(&model), ["Weld 2"]);
}

#[test]
fn shift_ticks_a_range_and_the_keyboard_moves_a_cursor() {
    let mut model = model();
    let (first, last) = (model.rows.at(0).unwrap().id, model.rows.at(2).unwrap().id);
    reduce(&mut model, Message::Toggle { row: first, range: false });
    reduce(&mut model, Message::Toggle { row: last, range: true });
    assert_eq!(model.rows.ticked_count(), 3);
    reduce(&mut model, Message::MoveCursor(isize::MIN));
    reduce(&mut model, Message::ToggleCursor);
    assert!(!model.rows.at(0).unwrap().ticked);
    reduce(&mut model, Message::MoveCursor(isize::MAX));
    assert_eq!(model.rows.cursor(), Some(2));
}

#[test]
fn a_command_that_is_disabled_does_nothing() {
    let mut model = model();
    for command in COMMANDS.iter().copied() {
        if command.why_disabled(&model).is_some() {
            assert!(reduce(&mut model, Message::Invoke(command)).is_empty());
            assert!(model.dialogs.is_empty(), "{command:?}");
        }
    }
}

#[test]
fn reading_closes_by_itself_when_all_went_well() {
    let mut model = model();
    tick(&mut model, &["Weld 2", "Paint"]);
    let id = job(&reduce(&mut model, Message::Invoke(UiCommand::GET_INFO)));
    event(&mut model, id, TaskEvent::Step { index: 0, step: JobStep::Connect });
    done(&mut model, id, 0, NoOutput);
    done(&mut model, id, 1, NoOutput);
    assert!(model.is_only::<ProcessingDialog>());
    let saved = ended(&mut model, id, 2, 0);
    assert!(matches!(saved[..], [BackendCommand::Save(_)]));
    assert!(model.dialogs.is_empty());
    assert_eq!(model.status.as_deref(), Some("Get new information: 2 controllers done"));
    assert!(model.rows.all().iter().all(|row| row.live.is_none()));
    assert_eq!(model.rows.all()[1].info(), Some(&info()));
}

#[test]
fn a_failure_stays_until_it_was_read() {
    let mut model = model();
    tick(&mut model, &["Weld 2", "Paint"]);
    let id = job(&reduce(&mut model, Message::Invoke(UiCommand::GET_INFO)));
    done(&mut model, id, 0, NoOutput);
    fail(&mut model, id, 1, ErrorCode::Unreachable);
    ended(&mut model, id, 1, 1);
    assert_eq!(model.top::<ProcessingDialog>().unwrap().selected, Some(1));
    reduce(&mut model, Message::Submit);
    assert!(model.dialogs.is_empty() && model.job.is_none());
}

#[test]
fn late_events_of_an_old_job_are_ignored() {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    let old = job(&reduce(&mut model, Message::Invoke(UiCommand::BASIC_SETTINGS)));
    let cancelled = reduce(&mut model, Message::Close);
    assert!(matches!(cancelled[..], [BackendCommand::Cancel(id)] if id == old));
    let new = job(&reduce(&mut model, Message::Invoke(UiCommand::BASIC_SETTINGS)));
    let settings = Revisioned { revision: RevisionToken::new(9), value: ServerSettings::default() };
    assert!(done(&mut model, old, 0, settings.clone()).is_empty());
    ended(&mut model, old, 1, 0);
    assert!(model.top::<BasicSettingsForm>().unwrap().reading);
    done(&mut model, new, 0, settings);
    assert_eq!(model.top::<BasicSettingsForm>().unwrap().revision, Some(RevisionToken::new(9)));
}

#[test]
fn cancelling_asks_once_more() {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    let id = job(&reduce(&mut model, Message::Invoke(UiCommand::START)));
    assert!(reduce(&mut model, Message::Close).is_empty());
    assert_eq!(model.job.as_ref().unwrap().cancel, CancelState::Asking);
    reduce(&mut model, Message::KeepGoing);
    assert_eq!(model.job.as_ref().unwrap().cancel, CancelState::No);
    reduce(&mut model, Message::Close);
    assert!(matches!(reduce(&mut model, Message::Close)[..], [BackendCommand::Cancel(job)] if job == id));
    assert!(reduce(&mut model, Message::Close).is_empty(), "it is stopping already");
    assert!(model.is_only::<ProcessingDialog>());
}

#[test]
fn a_change_is_confirmed_and_cancel_leads_back_to_the_form() {
    let mut model = model();
    tick(&mut model, &["Paint", "Weld 2"]);
    assert!(reduce(&mut model, Message::Invoke(UiCommand::BASIC_SETTINGS)).is_empty(), "nothing is read for many");
    assert!(reduce(&mut model, Message::Submit).is_empty());
    assert_eq!(open(&model), ["BasicSettingsForm", "ConfirmDialog"]);
    reduce(&mut model, Message::Close);
    assert!(model.is_only::<BasicSettingsForm>());
    reduce(&mut model, Message::Submit);
    let commands = reduce(&mut model, Message::Submit);
    assert!(matches!(&commands[..], [BackendCommand::Run { task, controllers, .. }]
            if task.operation::<SetBasicSettings>().is_some() && controllers.len() == 2));
    assert!(model.is_only::<ProcessingDialog>());
}

#[test]
fn settings_with_a_mistake_are_not_applied() {
    let mut model = model();
    tick(&mut model, &["Paint", "Weld 2"]);
    reduce(&mut model, Message::Invoke(UiCommand::BASIC_SETTINGS));
    let edit = |model: &mut Model, change: &dyn Fn(&mut BasicSettingsForm)| {
        let Some(form) = model.top_mut::<BasicSettingsForm>() else { panic!("no form") };
        change(form);
        form.operation().is_some()
    };
    assert!(!edit(&mut model, &|form| form.port = "80".into()));
    assert!(!edit(&mut model, &|form| (form.port, form.server_log) = ("4840".into(), true)));
    assert!(!edit(&mut model, &|form| form.log_password = "123456".into()));
    reduce(&mut model, Message::Submit);
    assert!(model.is_only::<BasicSettingsForm>());
    assert!(edit(&mut model, &|form| form.log_password = ServerSettings::LOG_PASSWORD.into()));
    assert!(!edit(&mut model, &|form| form.policies.clear()));
}

#[test]
fn a_missing_password_is_asked_for_and_those_controllers_are_tried_again() {
    let mut model = model();
    tick(&mut model, &["Weld 2", "Paint"]);
    let id = job(&reduce(&mut model, Message::Invoke(UiCommand::GET_INFO)));
    fail(&mut model, id, 0, ErrorCode::PasswordMissing);
    done(&mut model, id, 1, NoOutput);
    ended(&mut model, id, 1, 1);
    let Some(form) = model.top_mut::<PasswordDialog>() else { panic!("not asked") };
    assert_eq!(form.names, ["Weld 2"]);
    form.password.0 = "secret".into();
    let commands = reduce(&mut model, Message::Submit);
    let [BackendCommand::Run { controllers, password: Some(_), .. }] = &commands[..] else { panic!("{commands:?}") };
    assert_eq!(controllers.len(), 1);
    assert!(!format!("{commands:?}").contains("secret"));
    assert!(model.is_only::<ProcessingDialog>());
}

#[test]
fn a_controller_is_added_only_after_its_fingerprint_was_agreed_to() {
    let mut model = model();
    reduce(&mut model, Message::Invoke(UiCommand::ADD_CONTROLLER));
    let form = |model: &mut Model| -> AddStage {
        let Some(form) = model.top_mut::<AddControllerForm>() else { panic!("no form") };
        (form.name, form.address) = ("Paint".into(), "10.0.0.77".into());
        form.stage
    };
    form(&mut model);
    assert!(reduce(&mut model, Message::Submit).is_empty(), "the name is taken");
    let Some(open) = model.top_mut::<AddControllerForm>() else { panic!("no form") };
    (open.name, open.address) = ("New".into(), "10.0.0.77".into());
    let [BackendCommand::Probe { job, .. }] = reduce(&mut model, Message::Submit)[..] else { panic!("no probe") };
    let fingerprint = Fingerprint::of(b"new");
    reduce(&mut model, Message::Event(BackendEvent::Probed { job, result: Ok(fingerprint) }));
    let [BackendCommand::Enroll { job, .. }] = reduce(&mut model, Message::Submit)[..] else { panic!("no enrolment") };
    let enrolled = crate::jobs::Enrolled { fingerprint, info: info(), password_not_kept: None };
    reduce(&mut model, Message::Event(BackendEvent::Enrolled { job, result: Ok(Box::new(enrolled)) }));
    assert!(model.dialogs.is_empty());
    let row = model.rows.all().last().unwrap();
    assert_eq!((row.entry.name.as_str(), row.entry.fingerprint), ("New", Some(fingerprint)));
}

#[test]
fn an_attempt_that_was_given_up_adds_nothing() {
    let mut model = model();
    reduce(&mut model, Message::Invoke(UiCommand::ADD_CONTROLLER));
    let Some(open) = model.top_mut::<AddControllerForm>() else { panic!("no form") };
    (open.name, open.address) = ("New".into(), "10.0.0.77".into());
    let [BackendCommand::Probe { job, .. }] = reduce(&mut model, Message::Submit)[..] else { panic!("no probe") };
    assert!(matches!(reduce(&mut model, Message::Close)[..], [BackendCommand::Cancel(id)] if id == job));
    reduce(&mut model, Message::Event(BackendEvent::Probed { job, result: Ok(Fingerprint::of(b"new")) }));
    assert_eq!(model.top::<AddControllerForm>().unwrap().stage, AddStage::Form);
}

#[test]
fn deleting_forgets_the_passwords() {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    reduce(&mut model, Message::Invoke(UiCommand::DELETE_CONTROLLERS));
    let commands = reduce(&mut model, Message::Submit);
    assert!(matches!(&commands[..], [BackendCommand::Save(_), BackendCommand::Forget(gone)] if gone.len() == 1));
    assert_eq!(model.rows.all().len(), 2);
    assert_eq!(model.rows.ticked_count(), 0);
}

#[test]
fn expiry_is_counted_as_time_goes_by() {
    let mut model = model();
    let id = model.rows.at(0).unwrap().id;
    let mut info = info();
    let summary = serde_json::json!({
        "issued_to": "x", "issued_by": "x", "serial_number": "01", "not_before": "2026-01-01T00:00:00Z",
        "not_after": "2026-07-15T00:00:00Z", "thumbprint": "00", "key_bits": 2048, "application_uri": null
    });
    info.certificate = Some(crate::model::ServerCertificate {
        kind: crate::model::CertificateType::SelfSigned,
        summary: serde_json::from_value(summary).unwrap(),
    });
    model.rows.set_info(id, info, now());
    model.rows.rebuild();
    let counts = |model: &Model| (model.rows.expiring_count(), model.rows.expired_count());
    assert_eq!(counts(&model), (0, 0));
    model.set_now(now() + Duration::days(20));
    assert_eq!(counts(&model), (1, 0));
    model.set_now(now() + Duration::days(60));
    assert_eq!(counts(&model), (0, 1));
}

#[test]
fn a_dialogs_debug_output_holds_no_secret() {
    let mut form = AddControllerForm::new();
    form.password.0 = "hunter22".into();
    assert!(!format!("{form:?}").contains("hunter22"));
}

#[test]
fn a_form_is_filled_also_under_a_notice() {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    let id = job(&reduce(&mut model, Message::Invoke(UiCommand::BASIC_SETTINGS)));
    reduce(&mut model, Message::Event(BackendEvent::SaveFailed(ErrorCode::WorkspaceFull.into())));
    let settings = Revisioned { revision: RevisionToken::new(9), value: ServerSettings::default() };
    done(&mut model, id, 0, settings);
    assert_eq!(open(&model), ["BasicSettingsForm", "ErrorDialog"]);
    assert!(!model.dialog::<BasicSettingsForm>().unwrap().reading);
}

#[test]
fn a_form_that_cannot_be_filled_gives_way_to_the_reason() {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    let id = job(&reduce(&mut model, Message::Invoke(UiCommand::USERS)));
    fail(&mut model, id, 0, ErrorCode::TaskRunning);
    ended(&mut model, id, 0, 1);
    assert!(model.is_only::<ErrorDialog>());
    assert_eq!(model.top::<ErrorDialog>().unwrap().0.code, ErrorCode::TaskRunning);
}
