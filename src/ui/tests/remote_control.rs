//! Remote control: what may be sent when.

use super::*;
use crate::jobs::{RemoteControlEvent, RemoteControlRequest};
use crate::model::{StatusFlag, StatusFlags};
use crate::remote::client::RemoteError;
use crate::remote::{Command, Condition, FunctionNumber, RefusalCode, RemoteStatus, Reply, Request, RobotNumber};
use crate::ui::features::remote_control::{AllowActing, RemoteForm, RemoteLink, RemoteSection, WhyNot};

fn form(model: &mut Model) -> &mut RemoteForm {
    model.dialog::<RemoteForm>().unwrap()
}

fn status(flags: &[StatusFlag]) -> RemoteControlEvent {
    let mut all = StatusFlags::default();
    flags.iter().for_each(|flag| all.set(*flag, true));
    RemoteControlEvent::Status { status: RemoteStatus { flags: all, code: 0 }, message: None }
}

const READY: &[StatusFlag] = &[StatusFlag::Auto, StatusFlag::Ready];

fn seen(model: &mut Model, job: JobId, event: RemoteControlEvent) {
    let commands = reduce(model, Message::Event(BackendEvent::RemoteSeen { job, event }));
    assert!(commands.is_empty(), "{commands:?}");
}

fn opened() -> Model {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    assert!(reduce(&mut model, Message::Invoke(UiCommand::REMOTE_CONTROL)).is_empty(), "it connects on demand");
    model
}

/// Connects with what is typed.
fn connect(model: &mut Model) -> JobId {
    let commands = reduce(model, Message::Submit);
    let watch = commands.iter().find_map(|command| match command {
        BackendCommand::ControlRemotely { job, .. } => Some(*job),
        _ => None,
    });
    watch.unwrap_or_else(|| panic!("{commands:?}"))
}

/// Connected, with a controller that is ready.
fn live() -> (Model, JobId) {
    let mut model = opened();
    let job = connect(&mut model);
    seen(&mut model, job, RemoteControlEvent::Connected);
    seen(&mut model, job, status(READY));
    (model, job)
}

fn allow(model: &mut Model) {
    reduce(model, Message::act(Model::ask_to_allow_remote));
    assert!(model.top::<AllowActing>().is_some(), "what may move is said first");
    reduce(model, Message::Submit);
    assert!(form(model).may_act());
}

/// The command that is sent, if one is.
fn act(model: &mut Model, request: Request) -> Option<Request> {
    let commands = reduce(model, Message::act(move |model| model.act_remotely(request)));
    commands.into_iter().find_map(|command| match command {
        BackendCommand::AskRemote { request: RemoteControlRequest::Do(request), .. } => Some(request),
        _ => None,
    })
}

fn start() -> Request {
    Request::Start { function: FunctionNumber::new(0).unwrap() }
}

#[test]
fn it_connects_to_the_controllers_address_at_the_port_for_remote_commands() {
    let mut model = opened();
    assert_eq!(form(&mut model).target, "tcp://10.0.0.1:5000");
    form(&mut model).password.0 = "x".repeat(17);
    assert_eq!(form(&mut model).typed_connection().err(), Some(TextKey::RemotePasswordRule));
    form(&mut model).password.0 = "secret".into();
    form(&mut model).target = "10.0.0.1".into();
    assert_eq!(form(&mut model).typed_connection().err(), Some(TextKey::RemoteTargetRule));
    assert!(reduce(&mut model, Message::Submit).is_empty());
    form(&mut model).target = "serial:COM3?baud=19200".into();
    connect(&mut model);
    assert!(form(&mut model).password.0.is_empty(), "wiped");
    let (target, password) = form(&mut model).typed_connection().unwrap();
    assert_eq!((target.to_string().as_str(), password.expose()), ("serial:COM3?baud=19200", "secret"), "to try again");
    form(&mut model).target = "tcp://10.0.0.2".into();
    let (_, password) = form(&mut model).typed_connection().unwrap();
    assert_eq!(password.expose(), "", "a password is not sent to another place");
}

#[test]
fn nothing_acts_until_it_is_allowed() {
    let mut model = opened();
    assert_eq!(form(&mut model).why_not(Command::Start), Some(WhyNot::NotConnected));
    reduce(&mut model, Message::act(Model::ask_to_allow_remote));
    assert!(model.top::<AllowActing>().is_none(), "without a connection there is nothing to allow");

    let (mut model, _) = live();
    assert_eq!(form(&mut model).why_not(Command::Stop), Some(WhyNot::MonitoringOnly));
    assert_eq!(act(&mut model, start()), None);
    reduce(&mut model, Message::act(Model::ask_to_allow_remote));
    reduce(&mut model, Message::Close);
    assert!(!form(&mut model).may_act(), "it was not agreed to");
    allow(&mut model);
    assert_eq!(act(&mut model, start()), Some(start()));
    reduce(&mut model, Message::act(Model::forbid_remote_commands));
    assert_eq!(form(&mut model).why_not(Command::Stop), Some(WhyNot::MonitoringOnly));
}

#[test]
fn the_switch_is_off_again_after_every_change_of_the_connection() {
    let (mut model, job) = live();
    allow(&mut model);
    seen(&mut model, job, RemoteControlEvent::Lost(ErrorCode::RemoteNoAnswer.into()));
    assert!(!form(&mut model).may_act());
    seen(&mut model, job, RemoteControlEvent::Connected);
    seen(&mut model, job, status(READY));
    assert_eq!(act(&mut model, start()), None);

    allow(&mut model);
    let commands = reduce(&mut model, Message::act(Model::disconnect_remote));
    assert!(matches!(commands[..], [BackendCommand::Cancel(ended)] if ended == job), "{commands:?}");
    let again = connect(&mut model);
    seen(&mut model, again, RemoteControlEvent::Connected);
    seen(&mut model, again, status(READY));
    assert!(!form(&mut model).may_act());

    allow(&mut model);
    reduce(&mut model, Message::Close);
    reduce(&mut model, Message::Invoke(UiCommand::REMOTE_CONTROL));
    assert!(!form(&mut model).may_act() && form(&mut model).link == RemoteLink::Off);
}

#[test]
fn a_question_that_was_asked_before_the_connection_was_lost_allows_nothing() {
    let (mut model, job) = live();
    reduce(&mut model, Message::act(Model::ask_to_allow_remote));
    seen(&mut model, job, RemoteControlEvent::Lost(ErrorCode::RemoteNoAnswer.into()));
    assert!(model.top::<AllowActing>().is_none());
}

#[test]
fn the_conditions_of_the_controller_are_judged_by_its_last_state() {
    let (mut model, job) = live();
    allow(&mut model);
    seen(&mut model, job, status(&[StatusFlag::Auto, StatusFlag::Running]));
    let why = |model: &mut Model, command| form(model).why_not(command);
    assert_eq!(why(&mut model, Command::Start), Some(WhyNot::Unmet(vec![Condition::Ready])));
    assert_eq!(why(&mut model, Command::Pause), None);
    assert_eq!(why(&mut model, Command::Continue), Some(WhyNot::Unmet(vec![Condition::Paused])));
    let estop = &[StatusFlag::Auto, StatusFlag::Ready, StatusFlag::EStop, StatusFlag::Safeguard];
    seen(&mut model, job, status(estop));
    let unmet = WhyNot::Unmet(vec![Condition::NoEStop, Condition::NoSafeguard]);
    assert_eq!(unmet.text(Language::En).lines().count(), 2);
    assert_eq!(why(&mut model, Command::SetMotorsOn), Some(unmet));
    assert_eq!(why(&mut model, Command::Reset), None);
    form(&mut model).robot = RobotNumber::ALL;
    seen(&mut model, job, status(READY));
    let one = Some(WhyNot::Incomplete(TextKey::RemoteOneRobot));
    assert_eq!(form(&mut model).why_not_one_robot(Command::Home), one);
}

#[test]
fn one_command_is_sent_at_a_time_but_an_execute_can_be_aborted() {
    let (mut model, job) = live();
    allow(&mut model);
    assert!(act(&mut model, start()).is_some());
    assert_eq!(act(&mut model, Request::Stop), None);
    assert_eq!(form(&mut model).why_not(Command::Stop), Some(WhyNot::Waiting(Command::Start)));
    seen(&mut model, job, RemoteControlEvent::Done { request: start(), result: Ok(Reply::Done) });
    assert_eq!(form(&mut model).outcome, Some((Command::Start, Ok(Reply::Done))));

    form(&mut model).section = RemoteSection::Execute;
    form(&mut model).execute.text = "Go P1".into();
    let commands = reduce(&mut model, Message::Submit);
    assert!(matches!(commands[..], [BackendCommand::AskRemote { .. }]), "Enter sends it: {commands:?}");
    assert!(form(&mut model).execute.text.is_empty());
    assert_eq!(form(&mut model).why_not(Command::Start), Some(WhyNot::Waiting(Command::Execute)));
    assert_eq!(act(&mut model, Request::Abort), Some(Request::Abort));
    assert_eq!(act(&mut model, Request::Abort), None, "its answer is outstanding");
}

#[test]
fn a_command_whose_answer_cannot_come_any_more_is_told_as_unknown() {
    let (mut model, _) = live();
    allow(&mut model);
    assert!(act(&mut model, start()).is_some());
    reduce(&mut model, Message::act(Model::disconnect_remote));
    let outcome = form(&mut model).outcome.clone();
    assert!(matches!(outcome, Some((Command::Start, Err(RemoteError::OutcomeUnknown { .. })))), "{outcome:?}");
}

#[test]
fn a_watch_that_ended_by_a_wrong_password_asks_for_another() {
    let mut model = opened();
    form(&mut model).password.0 = "wrong".into();
    let job = connect(&mut model);
    assert!(!form(&mut model).edits_connection);
    seen(&mut model, job, RemoteControlEvent::Ended(ErrorCode::RemoteWrongPassword.into()));
    assert!(form(&mut model).edits_connection);
    let (_, password) = form(&mut model).typed_connection().unwrap();
    assert_eq!(password.expose(), "", "the refused one is not sent again");
    seen(&mut model, job, RemoteControlEvent::Connected);
    assert!(matches!(form(&mut model).link, RemoteLink::Ended(_)), "it is over");
    let commands = reduce(&mut model, Message::Close);
    assert!(commands.is_empty(), "{commands:?}");
}

#[test]
fn only_what_the_tab_shows_is_read() {
    let (mut model, job) = live();
    let turn = |model: &mut Model, section| {
        let commands = reduce(model, Message::act(move |model| model.turn_remote(section)));
        commands.into_iter().find_map(|command| match command {
            BackendCommand::AskRemote { job: of, request: RemoteControlRequest::Show(reads) } if of == job => {
                Some(reads)
            }
            _ => None,
        })
    };
    assert_eq!(turn(&mut model, RemoteSection::Alarms), Some(vec![Request::GetAlm]));
    assert_eq!(turn(&mut model, RemoteSection::Alarms), None, "the same");
    assert_eq!(turn(&mut model, RemoteSection::Io).map(|reads| reads.len()), Some(4));
    assert_eq!(turn(&mut model, RemoteSection::Log), Some(vec![]));
    let refused = RemoteError::Refused { command: Command::GetAlm, code: RefusalCode::SystemError };
    seen(&mut model, job, RemoteControlEvent::Values(vec![(Request::GetAlm, Err(refused.clone()))]));
    assert_eq!(form(&mut model).alarms, Some(Err(refused)));
    seen(&mut model, job, RemoteControlEvent::Values(vec![(Request::GetAlm, Ok(Reply::Alarms(vec![1, 9])))]));
    assert_eq!(form(&mut model).alarms, Some(Ok(vec![1, 9])));
}

#[test]
fn the_log_is_saved_where_the_engineer_says() {
    let (mut model, _) = live();
    reduce(&mut model, Message::act(Model::ask_where_to_save_exchanges));
    let commands = reduce(&mut model, Message::Submit);
    let [BackendCommand::SaveText { path, .. }] = &commands[..] else { panic!("{commands:?}") };
    assert!(path.ends_with("remote-log-20260601T083000Z.txt"), "{path:?}");
    reduce(&mut model, Message::Event(BackendEvent::TextSaved(Ok(path.clone()))));
    assert!(model.status.as_ref().is_some_and(|status| status.starts_with("Saved in")));
    reduce(&mut model, Message::Event(BackendEvent::TextSaved(Err(ErrorCode::WorkspaceReadOnly.into()))));
    assert!(model.top::<ErrorDialog>().is_some());
}
