//! The values of an OPC UA server.

use super::*;
use crate::jobs::{
    IoGroupPoints, IoSignalPoint, LiveEvent, LiveLayout, LivePoint, LiveRequest, NodeDetails, RobotPoints,
};
use crate::model::opcua::{DataValue, NodeClass, NodeId, NodeReference, QualifiedName, Quality, Value};
use crate::ui::features::live_values::{EditValue, LiveConnection, LiveForm, LiveSection};

fn node(number: u32) -> NodeId {
    NodeId::numeric(1, number)
}

fn point(number: u32) -> LivePoint {
    LivePoint { node: node(number), name: format!("point {number}"), unit: None, range: None }
}

fn layout() -> LiveLayout {
    let signal = |number: u32| IoSignalPoint { point: point(100 + number), number };
    let group = |name: &str, numbers: [u32; 2]| IoGroupPoints {
        system: "Standard".into(),
        name: name.into(),
        signals: numbers.map(signal).into(),
    };
    LiveLayout {
        robots: vec![RobotPoints { name: "Robot".into(), speed_override: Some(point(1)), ..RobotPoints::default() }],
        io: vec![group("Inputs", [0, 1]), group("Outputs", [10, 11])],
        ..LiveLayout::default()
    }
}

fn form(model: &mut Model) -> &mut LiveForm {
    model.dialog::<LiveForm>().unwrap()
}

/// The dialog is open and its watch has begun.
fn opened() -> (Model, JobId) {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    let id = job(&reduce(&mut model, Message::Invoke(UiCommand::LIVE_VALUES)));
    let commands = done(&mut model, id, 0, NoOutput);
    ended(&mut model, id, 1, 0);
    let Some(BackendCommand::WatchValues { job, .. }) = commands.last() else { panic!("{commands:?}") };
    (model, *job)
}

fn seen(model: &mut Model, job: JobId, event: LiveEvent) -> Vec<LiveRequest> {
    asked(reduce(model, Message::Event(BackendEvent::LiveSeen { job, event })))
}

fn asked(commands: Vec<BackendCommand>) -> Vec<LiveRequest> {
    let request = |command| match command {
        BackendCommand::AskValues { request, .. } => Some(request),
        _ => None,
    };
    commands.into_iter().filter_map(request).collect()
}

fn open(model: &mut Model, section: LiveSection) -> Vec<LiveRequest> {
    form(model).section = section;
    asked(reduce(model, Message::act(Model::live_section_changed)))
}

fn value(number: f64) -> DataValue {
    DataValue { value: Value::Double(number), ..DataValue::default() }
}

#[test]
fn only_what_the_tab_shows_and_what_is_plotted_is_asked_for() {
    let (mut model, job) = opened();
    let show = |numbers: &[u32]| vec![LiveRequest::Show(numbers.iter().copied().map(node).collect())];
    assert_eq!(seen(&mut model, job, LiveEvent::Connected(Box::new(layout()))), show(&[1]));
    assert_eq!(open(&mut model, LiveSection::Io), show(&[100, 101]));
    form(&mut model).io_group = 1;
    assert_eq!(asked(reduce(&mut model, Message::act(Model::live_section_changed))), show(&[110, 111]));
    assert_eq!(asked(reduce(&mut model, Message::act(|model| model.live_plot(point(1))))), show(&[1, 110, 111]));
    assert_eq!(open(&mut model, LiveSection::Plot), show(&[1]));
    assert_eq!(open(&mut model, LiveSection::Robot), [], "the same");
    assert_eq!(asked(reduce(&mut model, Message::act(|model| model.live_unplot(None)))), []);
    assert_eq!(open(&mut model, LiveSection::Variables), show(&[]));
}

#[test]
fn the_last_values_stay_while_the_connection_is_lost() {
    let (mut model, job) = opened();
    seen(&mut model, job, LiveEvent::Connected(Box::new(layout())));
    seen(&mut model, job, LiveEvent::Values(vec![(node(1), value(50.0))]));
    let lost = Problem::from(ErrorCode::OpcUaConnectionFailed);
    seen(&mut model, job, LiveEvent::Lost(lost.clone()));
    assert_eq!(form(&mut model).link, LiveConnection::Lost(lost));
    assert_eq!(form(&mut model).value(&node(1)), Some(&value(50.0)));
    assert_eq!(seen(&mut model, job, LiveEvent::Connected(Box::new(layout()))), [], "the watch knows what to show");
    assert!(form(&mut model).is_live() && form(&mut model).value(&node(1)).is_some());

    let other = LiveLayout { robots: vec![], ..layout() };
    seen(&mut model, job, LiveEvent::Connected(Box::new(other)));
    assert_eq!(form(&mut model).value(&node(1)), None, "it may be another node now");
}

#[test]
fn a_watch_that_is_over_reports_nothing_more() {
    let (mut model, job) = opened();
    seen(&mut model, job, LiveEvent::Ended(ErrorCode::ConfiguratorNotTrusted.into()));
    assert!(
        matches!(&form(&mut model).link, LiveConnection::Ended(problem) if problem.code == ErrorCode::ConfiguratorNotTrusted)
    );
    seen(&mut model, job, LiveEvent::Connected(Box::new(layout())));
    assert!(form(&mut model).layout.is_none());
    let commands = reduce(&mut model, Message::Close);
    assert!(!commands.iter().any(|command| matches!(command, BackendCommand::Cancel(_))), "{commands:?}");
}

#[test]
fn closing_ends_the_watch() {
    let (mut model, job) = opened();
    let commands = reduce(&mut model, Message::Close);
    assert!(matches!(commands[..], [BackendCommand::Cancel(ended)] if ended == job), "{commands:?}");
}

#[test]
fn a_refused_login_asks_for_another_and_a_password_is_kept_for_the_next_try() {
    let (mut model, job) = opened();
    seen(&mut model, job, LiveEvent::Ended(ErrorCode::OpcUaLoginRefused.into()));
    assert!(form(&mut model).asks_for_login);
    form(&mut model).user = "operator1".into();
    assert!(form(&mut model).typed_login().is_err(), "half a login");
    form(&mut model).password.0 = "Passw0rd1".into();
    let id = super::job(&reduce(&mut model, Message::Submit));
    assert!(form(&mut model).password.0.is_empty(), "wiped");
    let commands = done(&mut model, id, 0, NoOutput);
    ended(&mut model, id, 1, 0);
    let Some(BackendCommand::WatchValues { login, .. }) = commands.last() else { panic!("{commands:?}") };
    assert_eq!(login.user.as_ref().map(|user| user.name.as_str()), Some("operator1"));
    assert!(form(&mut model).typed_login().is_ok(), "to try again");
}

#[test]
fn a_controller_that_cannot_be_asked_is_tried_again_on_demand() {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    let id = job(&reduce(&mut model, Message::Invoke(UiCommand::LIVE_VALUES)));
    fail(&mut model, id, 0, ErrorCode::Unreachable);
    ended(&mut model, id, 0, 1);
    assert!(matches!(&form(&mut model).link, LiveConnection::Ended(problem) if problem.code == ErrorCode::Unreachable));
    let commands = reduce(&mut model, Message::act(Model::reconnect_live));
    assert!(matches!(commands[..], [BackendCommand::Run { .. }]), "{commands:?}");
}

/// The variable DataNum is selected in the tree; `name`: its BrowseName.
fn selected(name: &str) -> (Model, JobId) {
    let (mut model, job) = opened();
    seen(&mut model, job, LiveEvent::Connected(Box::new(layout())));
    let requests = open(&mut model, LiveSection::Nodes);
    assert!(requests.contains(&LiveRequest::Children(NodeId::ROOT_FOLDER)), "{requests:?}");
    let child = NodeReference {
        reference_type: NodeId::numeric(0, 35),
        is_forward: true,
        node: node(20_313),
        browse_name: QualifiedName::new(1, name),
        display_name: name.to_owned(),
        node_class: NodeClass::Variable,
        type_definition: None,
    };
    seen(&mut model, job, LiveEvent::Children { of: NodeId::ROOT_FOLDER, children: Ok(vec![child]) });
    let requests = asked(reduce(&mut model, Message::act(|model| model.live_select(1))));
    assert_eq!(requests, [LiveRequest::Inspect(node(20_313))]);
    (model, job)
}

fn details(is_consumed_by_reading: bool) -> LiveEvent {
    let details = NodeDetails {
        browse_name: QualifiedName::new(1, "DataNum"),
        attributes: vec![],
        is_writable: true,
        is_consumed_by_reading,
        data_type: Some("UInt16".into()),
    };
    LiveEvent::Inspected { node: node(20_313), details: Ok(Box::new(details)) }
}

#[test]
fn the_value_of_a_node_that_reading_consumes_is_not_asked_for() {
    let (mut model, job) = selected("Data");
    assert_eq!(seen(&mut model, job, details(true)), []);
    let (mut model, job) = selected("DataNum");
    assert_eq!(seen(&mut model, job, details(false)), [LiveRequest::Show(vec![node(20_313)])]);
}

#[test]
fn a_value_is_written_on_purpose_and_a_refusal_stays_on_the_screen() {
    let (mut model, job) = selected("DataNum");
    seen(&mut model, job, details(false));
    let number = DataValue { value: Value::UInt16(0), ..DataValue::default() };
    seen(&mut model, job, LiveEvent::Values(vec![(node(20_313), number)]));
    reduce(&mut model, Message::act(Model::edit_live_value));
    let edit = |model: &mut Model, text: &str| model.dialog::<EditValue>().unwrap().text = text.into();
    edit(&mut model, "many");
    assert_eq!(asked(reduce(&mut model, Message::Submit)), [], "no number");
    edit(&mut model, "300");
    let write = LiveRequest::Write { node: node(20_313), value: Value::UInt16(300) };
    assert_eq!(asked(reduce(&mut model, Message::Submit)), [write]);
    assert_eq!(asked(reduce(&mut model, Message::Submit)), [], "it is being written");
    let refused = Ok(Quality::Bad { name: "BadOutOfRange".into() });
    seen(&mut model, job, LiveEvent::Written { node: node(20_313), quality: refused });
    assert!(model.top::<EditValue>().is_some_and(|edit| edit.refusal.is_some() && !edit.is_writing));
    edit(&mut model, "200");
    reduce(&mut model, Message::Submit);
    seen(&mut model, job, LiveEvent::Written { node: node(20_313), quality: Ok(Quality::Good) });
    assert!(model.top::<EditValue>().is_none() && model.top::<LiveForm>().is_some());
    assert_eq!(model.status.as_deref(), Some("The value was written"));

    reduce(&mut model, Message::act(Model::edit_live_value));
    edit(&mut model, "100");
    reduce(&mut model, Message::Submit);
    seen(&mut model, job, LiveEvent::Lost(ErrorCode::OpcUaConnectionFailed.into()));
    let edit = model.top::<EditValue>().unwrap();
    assert!(matches!(&edit.refusal, Some(Err(problem)) if problem.code == ErrorCode::AnswerLost));
}
