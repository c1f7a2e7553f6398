//! Whom a controller trusts.

use std::path::PathBuf;

use super::*;
use crate::jobs::{Destination, TrustChange, TrustFile, TrustSnapshot, WatchEvent};
use crate::model::{
    Base64Bytes, Capabilities, CertificateStatus, CertificateSummary, DisconnectedClient, ListLimits,
    ListedCertificate, RevisionToken,
};
use crate::pki::{Bundle, RejectedClient, TrustHealth};
use crate::ui::features::client_certificates::{
    AddTrustForm, DeleteTrust, Freshness, LastTrustChange, MAX_TRUST_FILES, MoveTrust, PaneKind, TrustAction,
    TrustColumn, TrustForm, ValidityState,
};
use crate::ui::model::ReadTrustFile;

fn summary(name: &str, days: i64) -> CertificateSummary {
    CertificateSummary {
        issued_to: name.to_owned(),
        issued_by: "Plant CA".to_owned(),
        serial_number: "01".to_owned(),
        not_before: now() - Duration::days(1),
        not_after: now() + Duration::days(days),
        thumbprint: format!("{name} thumbprint"),
        key_bits: 2048,
        application_uri: None,
    }
}

fn listed(name: &str, days: i64) -> ListedCertificate {
    let (certificate, summary) = (Base64Bytes(vec![]), summary(name, days));
    ListedCertificate { file_name: format!("{name}.der"), certificate, summary, added: now() }
}

fn refused(name: &str, count: u64) -> RejectedClient {
    RejectedClient {
        certificate: Base64Bytes(vec![]),
        chain: vec![],
        summary: summary(name, 100),
        status: CertificateStatus::Untrusted,
        cause: None,
        reason: String::new(),
        address: "10.0.0.77".into(),
        first_seen: now(),
        last_seen: now(),
        count,
    }
}

fn held(revision: u64) -> TrustSnapshot {
    TrustSnapshot {
        revision: RevisionToken::new(revision),
        capabilities: Capabilities::all(),
        limits: ListLimits { trusted: 3, issuers: 3, crls: 3 },
        clock: now(),
        trusted: vec![listed("b", 100), listed("a", 10), listed("c", -1)],
        rejected: vec![refused("knocker", 2)],
        issuers: vec![],
        crls: vec![],
        health: TrustHealth::default(),
    }
}

fn form(model: &mut Model) -> &mut TrustForm {
    model.dialog::<TrustForm>().unwrap()
}

fn adding(model: &Model) -> &AddTrustForm {
    model.top::<AddTrustForm>().unwrap()
}

fn act(model: &mut Model, action: TrustAction) -> Vec<BackendCommand> {
    reduce(model, Message::act(move |model| model.trust_action(action)))
}

/// The lists of one controller are shown, and watched by this job.
fn opened() -> (Model, JobId) {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    let id = job(&reduce(&mut model, Message::Invoke(UiCommand::CLIENT_CERTIFICATES)));
    let commands = done(&mut model, id, 0, held(4));
    ended(&mut model, id, 1, 0);
    let Some(BackendCommand::WatchTrust { job, .. }) = commands.last() else { panic!("{commands:?}") };
    (model, *job)
}

fn seen(model: &mut Model, job: JobId, event: WatchEvent) {
    reduce(model, Message::Event(BackendEvent::TrustSeen { job, event }));
}

fn names(model: &mut Model, kind: PaneKind) -> Vec<String> {
    let pane = form(model).pane(kind).unwrap();
    (0..pane.shown()).filter_map(|at| pane.at(at)).map(|entry| entry.issued_to.clone()).collect()
}

#[test]
fn lists_are_sorted_filtered_and_ticked() {
    let (mut model, _) = opened();
    assert_eq!(names(&mut model, PaneKind::Trusted), ["a", "b", "c"]);
    let lists = form(&mut model);
    let pane = lists.pane_mut(PaneKind::Trusted).unwrap();
    let lives: Vec<ValidityState> = (0..3).map(|at| pane.at(at).unwrap().life).collect();
    assert_eq!(lives, [ValidityState::Soon { days: 10 }, ValidityState::Good, ValidityState::Past]);
    assert!(pane.is_full());
    pane.sort_by(TrustColumn::ValidUntil);
    assert_eq!(pane.at(0).unwrap().issued_to, "c");
    pane.toggle(0, false);
    pane.toggle(2, true);
    assert_eq!(pane.ticked_count(), 3, "a range");
    pane.toggle(1, false);
    lists.filter = "B.DER".into();
    lists.find();
    assert_eq!(names(&mut model, PaneKind::Trusted), ["b"]);
    let pane = form(&mut model).pane(PaneKind::Trusted).unwrap();
    assert_eq!((pane.ticked_count(), pane.ticked_hidden()), (2, 1));
    assert_eq!(pane.chosen().len(), 2, "what is hidden keeps its tick");
}

#[test]
fn the_cursor_stays_on_its_line_and_goes_to_the_next_when_that_is_gone() {
    let (mut model, watch) = opened();
    let lists = form(&mut model);
    lists.focused_mut().unwrap().move_cursor(0);
    lists.focused_mut().unwrap().move_cursor(1);
    assert_eq!(lists.focused().unwrap().cursor_entry().unwrap().issued_to, "b");
    let mut newer = held(5);
    newer.trusted.push(listed("0", 5));
    seen(&mut model, watch, WatchEvent::Lists(Box::new(newer.clone())));
    assert_eq!(form(&mut model).focused().unwrap().cursor_entry().unwrap().issued_to, "b");
    newer.trusted.remove(0);
    seen(&mut model, watch, WatchEvent::Lists(Box::new(newer)));
    assert_eq!(form(&mut model).focused().unwrap().cursor_entry().unwrap().issued_to, "c");
}

#[test]
fn who_tries_to_connect_is_new_until_somebody_looks() {
    let (mut model, watch) = opened();
    let new = |model: &mut Model| form(model).pane(PaneKind::Rejected).unwrap().new_ones();
    assert_eq!(new(&mut model), 0, "it was there before the dialog");
    let mut newer = held(4);
    newer.rejected = vec![refused("other", 1), refused("knocker", 3), refused("put here by a person", 0)];
    seen(&mut model, watch, WatchEvent::Lists(Box::new(newer.clone())));
    assert_eq!(new(&mut model), 2, "one more, and one that came again");
    seen(&mut model, watch, WatchEvent::Lists(Box::new(newer)));
    assert_eq!(new(&mut model), 2);
    let at = names(&mut model, PaneKind::Rejected).iter().position(|name| name == "other").unwrap();
    form(&mut model).pane_mut(PaneKind::Rejected).unwrap().place_cursor(at);
    assert_eq!(new(&mut model), 1);
}

#[test]
fn a_change_is_made_without_asking_and_its_answer_is_newer_than_what_was_being_read() {
    let (mut model, watch) = opened();
    form(&mut model).pane_mut(PaneKind::Rejected).unwrap().toggle(0, false);
    let move_it = || TrustAction::Move { from: PaneKind::Rejected, to: PaneKind::Trusted };
    let id = job(&act(&mut model, move_it()));
    assert!(act(&mut model, move_it()).is_empty(), "one change at a time");
    assert!(act(&mut model, TrustAction::Undo).is_empty());
    let mut lists = held(5);
    lists.clock = now() + Duration::seconds(2);
    lists.rejected.clear();
    let client = DisconnectedClient {
        address: "10.0.0.77:5000".into(),
        issued_to: "x".into(),
        thumbprint: "y".into(),
        status: CertificateStatus::Revoked,
    };
    let change = TrustChange { lists, cut: vec![client.clone()], undo: None };
    done(&mut model, id, 0, change);
    ended(&mut model, id, 1, 0);
    let done = LastTrustChange::Moved { from: PaneKind::Rejected, to: PaneKind::Trusted, count: 1 };
    let lists = form(&mut model);
    assert_eq!((lists.done.as_ref(), lists.cut.as_slice()), (Some(&done), &[client][..]));
    assert!(lists.is_ready() && lists.undoable() == 0);
    assert!(names(&mut model, PaneKind::Rejected).is_empty());
    seen(&mut model, watch, WatchEvent::Lists(Box::new(held(4))));
    assert!(names(&mut model, PaneKind::Rejected).is_empty(), "that was read before the change");
}

#[test]
fn a_client_that_is_never_let_in_is_trusted_only_after_asking() {
    use crate::jobs::MoveClients;
    let (mut model, _) = opened();
    let der = include_bytes!("../../../tests/cases/15-never-admitted/self-ec.der");
    let certificate = crate::pki::Certificate::from_der(der).unwrap();
    let lists = form(&mut model);
    let mut held = lists.held.as_deref().unwrap().clone();
    held.rejected[0].certificate = Base64Bytes(der.to_vec());
    held.rejected[0].summary = certificate.summary();
    lists.fill(Box::new(held), now());
    lists.pane_mut(PaneKind::Rejected).unwrap().toggle(0, false);
    let move_it = || TrustAction::Move { from: PaneKind::Rejected, to: PaneKind::Trusted };
    assert!(act(&mut model, move_it()).is_empty());
    let asked = model.top::<MoveTrust>().unwrap();
    let [(name, notes)] = &asked.notes[..] else { panic!("{asked:?}") };
    let flaw = crate::pki::CertificateFlaw::KeyNotRsa;
    assert_eq!((name.as_str(), &notes[0]), ("ec", &crate::jobs::TrustNote::NeverAccepted { authority: false, flaw }));
    let commands = reduce(&mut model, Message::Submit);
    let [BackendCommand::Run { task, .. }] = &commands[..] else { panic!("{commands:?}") };
    assert!(task.operation::<MoveClients>().unwrap().accept_notes);
}

#[test]
fn a_change_that_failed_leaves_everything_as_it_was() {
    let (mut model, _) = opened();
    form(&mut model).pane_mut(PaneKind::Trusted).unwrap().toggle(0, false);
    act(&mut model, TrustAction::Delete(PaneKind::Trusted));
    assert_eq!(model.top::<DeleteTrust>().unwrap().what.len(), 1);
    let id = job(&reduce(&mut model, Message::Submit));
    fail(&mut model, id, 0, ErrorCode::TaskRunning);
    ended(&mut model, id, 0, 1);
    assert_eq!(open(&model), ["TrustForm", "ErrorDialog"]);
    assert_eq!(model.top::<ErrorDialog>().unwrap().0.code, ErrorCode::TaskRunning);
    reduce(&mut model, Message::Close);
    assert_eq!(names(&mut model, PaneKind::Trusted).len(), 3);
    assert_eq!(form(&mut model).pane(PaneKind::Trusted).unwrap().ticked_count(), 1, "to be tried again");
    assert_eq!(form(&mut model).done, None);
}

#[test]
fn a_lost_connection_is_said_and_a_given_up_one_can_be_tried_again() {
    let (mut model, watch) = opened();
    seen(&mut model, watch, WatchEvent::Lost(ErrorCode::Timeout.into()));
    assert!(matches!(form(&mut model).link, Freshness::Lost(_)));
    seen(&mut model, watch, WatchEvent::Lists(Box::new(held(4))));
    assert_eq!(form(&mut model).link, Freshness::Live);
    seen(&mut model, watch, WatchEvent::Ended(ErrorCode::WrongPassword.into()));
    let id = job(&act(&mut model, TrustAction::Reconnect));
    fail(&mut model, id, 0, ErrorCode::WrongPassword);
    ended(&mut model, id, 0, 1);
    assert!(model.top::<PasswordDialog>().unwrap().wrong);
    reduce(&mut model, Message::Close);
    assert!(matches!(form(&mut model).link, Freshness::Ended(_)), "what was read is still shown");
    let id = job(&act(&mut model, TrustAction::Reconnect));
    let commands = done(&mut model, id, 0, held(4));
    ended(&mut model, id, 1, 0);
    let Some(BackendCommand::WatchTrust { job, .. }) = commands.last() else { panic!("{commands:?}") };
    assert_ne!(*job, watch);
    let closed = reduce(&mut model, Message::Close);
    assert!(closed.iter().any(|command| matches!(command, BackendCommand::Cancel(cancelled) if cancelled == job)));
    assert!(model.dialogs.is_empty());
}

#[test]
fn without_lists_there_is_no_dialog() {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    let id = job(&reduce(&mut model, Message::Invoke(UiCommand::CRL)));
    fail(&mut model, id, 0, ErrorCode::Unreachable);
    ended(&mut model, id, 0, 1);
    assert!(model.is_only::<ErrorDialog>());
}

#[test]
fn the_clock_of_the_controller_counts_and_is_pointed_out_when_it_is_wrong() {
    let (mut model, watch) = opened();
    assert_eq!(form(&mut model).clock_off, None);
    let behind = TrustSnapshot { clock: now() - Duration::days(3), revision: RevisionToken::new(5), ..held(5) };
    seen(&mut model, watch, WatchEvent::Lists(Box::new(behind)));
    let lists = form(&mut model);
    assert_eq!(lists.clock_off, Some(-Duration::days(3)));
    let pane = lists.pane(PaneKind::Trusted).unwrap();
    assert_eq!(pane.at(2).unwrap().life, ValidityState::NotYet, "by that clock");
}

fn read(model: &mut Model, files: Vec<ReadTrustFile>) {
    let job = adding(model).reading.expect("files are being read");
    reduce(model, Message::Event(BackendEvent::TrustFilesRead { job, files }));
}

fn file(name: &str, good: bool) -> ReadTrustFile {
    let key = rcgen::KeyPair::generate().unwrap();
    let made = rcgen::CertificateParams::default().self_signed(&key).unwrap();
    let bundle = crate::pki::read_bundle(made.der()).unwrap();
    let result = if good {
        Ok(TrustFile { file_name: name.into(), bundle })
    } else {
        Err(Problem::from(ErrorCode::BadCertificate))
    };
    ReadTrustFile { path: name.into(), result }
}

#[test]
fn files_wait_for_agreement_and_one_that_cannot_be_used_stops_all() {
    let (mut model, watch) = opened();
    let paths: Vec<PathBuf> = vec!["good.der".into(), "bad.der".into()];
    reduce(&mut model, Message::Dropped(paths));
    assert_eq!(adding(&model).destination, Destination::ByKind);
    assert!(reduce(&mut model, Message::Submit).is_empty(), "they are still being read");
    read(&mut model, vec![file("good.der", true), file("bad.der", false)]);
    assert!(!adding(&model).is_complete());
    assert!(reduce(&mut model, Message::Submit).is_empty());
    act(&mut model, TrustAction::LeaveOut(1));
    // The sample fits nowhere: the list of trusted certificates is full.
    assert_eq!(adding(&model).refused.as_ref().map(|problem| problem.code), Some(ErrorCode::ListFull));
    let mut roomier = held(5);
    roomier.trusted.pop();
    seen(&mut model, watch, WatchEvent::Lists(Box::new(roomier)));
    assert!(adding(&model).is_complete(), "somebody made room");
    let commands = reduce(&mut model, Message::Submit);
    assert!(matches!(&commands[..], [BackendCommand::Run { .. }]));
    assert!(form(&mut model).busy);
}

#[test]
fn too_many_files_are_not_even_read() {
    let (mut model, _) = opened();
    let paths = (0..=MAX_TRUST_FILES).map(|n| format!("{n}.der").into()).collect();
    assert!(reduce(&mut model, Message::Dropped(paths)).is_empty());
    assert!(adding(&model).too_many);
}

#[test]
fn several_controllers_are_asked_about_once_and_each_reports() {
    let mut model = model();
    tick(&mut model, &["Paint", "Weld 2"]);
    reduce(&mut model, Message::Invoke(UiCommand::CLIENT_CERTIFICATES));
    act(&mut model, TrustAction::ChooseFiles);
    let picking = adding(&model).picking.unwrap();
    let result = Ok(vec![PathBuf::from("a.der")]);
    reduce(&mut model, Message::Event(BackendEvent::FilesPicked { job: picking, result }));
    let empty = ReadTrustFile {
        path: "empty.der".into(),
        result: Ok(TrustFile { file_name: "empty.der".into(), bundle: Bundle::default() }),
    };
    read(&mut model, vec![file("a.der", true), empty]);
    assert_eq!(adding(&model).count(), 1);
    reduce(&mut model, Message::Submit);
    assert_eq!(model.top::<ConfirmDialog>().unwrap().rows.len(), 2);
    reduce(&mut model, Message::Submit);
    assert!(model.is_only::<ProcessingDialog>());
}
