//! Connecting as a client, as the window sees it.

use super::*;
use crate::jobs::{
    ConnectRefusal, EndpointVerdict, NotTried, RefusalDetails, TokenOutcome, TokenVerdict, TrustConfigurator, Verify,
    VerifyFinding, VerifyReport,
};
use crate::model::{CertificateStatus, SecurityPolicy};
use crate::pki::client_identity;
use crate::session::opcua_client::{MessageSecurity, TokenKind};
use crate::ui::features::verify::VerifyView;
use crate::workspace::ConfiguratorIdentity;

/// `None` works, and a user name was not tried; `trusted` says whether the encrypted endpoint works as well.
fn report(trusted: bool) -> VerifyReport {
    let token = |kind, verdict| TokenVerdict { kind, verdict };
    let refused = ConnectRefusal::OwnCertificate(Some(RefusalDetails {
        status: CertificateStatus::Untrusted,
        cause: None,
        reason: "nobody trusts it".into(),
    }));
    let encrypted = if trusted { TokenOutcome::Works } else { TokenOutcome::Fails(refused) };
    let endpoint = |policy, mode, tokens| EndpointVerdict { policy: Ok(policy), mode: Some(mode), tokens };
    VerifyReport {
        url: "opc.tcp://10.0.0.1:4840".into(),
        own: ConfiguratorIdentity {
            certificate: client_identity("OPC UA Configurator", "desk", now()).unwrap().certificate,
            certificate_path: "/nowhere/configurator.der".into(),
            key_path: "/nowhere/configurator_key.pem".into(),
        },
        findings: vec![VerifyFinding::WeakPolicy(SecurityPolicy::None)],
        certificate: None,
        endpoints: vec![
            endpoint(
                SecurityPolicy::None,
                MessageSecurity::None,
                vec![
                    token(TokenKind::Anonymous, TokenOutcome::Works),
                    token(TokenKind::UserName, TokenOutcome::NotTried(NotTried::NoPassword)),
                ],
            ),
            endpoint(
                SecurityPolicy::Basic256Sha256,
                MessageSecurity::SignAndEncrypt,
                vec![token(TokenKind::Anonymous, encrypted)],
            ),
        ],
    }
}

fn view(model: &mut Model) -> &mut VerifyView {
    model.dialog::<VerifyView>().expect("reports")
}

fn verifying(names: &[&str]) -> (Model, JobId) {
    let mut model = model();
    tick(&mut model, names);
    let commands = reduce(&mut model, Message::Invoke(UiCommand::VERIFY));
    let [BackendCommand::Run { job, ref task, .. }] = commands[..] else { panic!("{commands:?}") };
    assert!(task.operation::<Verify>().unwrap().login.is_none());
    (model, job)
}

#[test]
fn the_first_report_with_something_wrong_is_shown_first() {
    let (mut model, id) = verifying(&["Weld 10", "Weld 2", "Paint"]);
    done(&mut model, id, 0, report(true));
    assert_eq!(view(&mut model).shown, None, "not before all are there");
    done(&mut model, id, 1, report(false));
    fail(&mut model, id, 2, ErrorCode::Unreachable);
    ended(&mut model, id, 2, 1);
    assert!(model.is_only::<VerifyView>(), "{:?}", model.dialogs);
    let second = view(&mut model).rows[1];
    assert_eq!(view(&mut model).shown, Some(second));
    assert_eq!(view(&mut model).lacking_trust(), [second]);

    assert!(reduce(&mut model, Message::act(Model::trust_configurator)).is_empty(), "asked first");
    let commands = reduce(&mut model, Message::Submit);
    let [BackendCommand::Run { job, ref task, ref controllers, .. }] = commands[..] else { panic!("{commands:?}") };
    assert!(task.operation::<TrustConfigurator>().is_some());
    assert_eq!(controllers.len(), 1);
    done(&mut model, job, 0, NoOutput);
    ended(&mut model, job, 1, 0);
    assert!(model.is_only::<VerifyView>(), "back to the reports, without a click");
}

#[test]
fn a_login_is_used_when_it_is_whole() {
    let (mut model, id) = verifying(&["Paint"]);
    done(&mut model, id, 0, report(true));
    ended(&mut model, id, 1, 0);
    assert!(view(&mut model).asks_for_login());
    view(&mut model).user = "operator1".into();
    assert!(reduce(&mut model, Message::Submit).is_empty(), "half a login");
    view(&mut model).password.0 = "Passw0rd1".into();
    let commands = reduce(&mut model, Message::Submit);
    let [BackendCommand::Run { job, task, .. }] = &commands[..] else { panic!("{commands:?}") };
    let login = task.operation::<Verify>().unwrap().login.as_ref().unwrap();
    assert_eq!((login.name.as_str(), login.password.expose()), ("operator1", "Passw0rd1"));
    assert!(!format!("{commands:?}{:?}", model.dialogs).contains("Passw0rd1"));
    assert!(view(&mut model).running);
    let job = *job;
    done(&mut model, job, 0, report(true));
    ended(&mut model, job, 1, 0);
    assert!(!view(&mut model).running);
}

#[test]
fn a_job_that_was_stopped_leaves_what_it_found() {
    let (mut model, id) = verifying(&["Weld 10", "Weld 2"]);
    done(&mut model, id, 0, report(true));
    fail(&mut model, id, 1, ErrorCode::Cancelled);
    reduce(
        &mut model,
        Message::Event(BackendEvent::JobEnded { job: id, summary: JobSummary { done: 1, failed: 0, not_started: 1 } }),
    );
    assert_eq!(view(&mut model).of.len(), 1);

    let (mut model, id) = verifying(&["Paint"]);
    fail(&mut model, id, 0, ErrorCode::Cancelled);
    reduce(
        &mut model,
        Message::Event(BackendEvent::JobEnded { job: id, summary: JobSummary { done: 0, failed: 0, not_started: 1 } }),
    );
    assert!(model.dialogs.is_empty(), "nothing to look at: {:?}", model.dialogs);
}

#[test]
fn who_lacks_its_password_is_asked_for_it_and_joins_the_others() {
    let (mut model, id) = verifying(&["Weld 10", "Weld 2"]);
    done(&mut model, id, 0, report(true));
    fail(&mut model, id, 1, ErrorCode::PasswordMissing);
    ended(&mut model, id, 1, 1);
    let Some(form) = model.top_mut::<PasswordDialog>() else { panic!("{:?}", model.dialogs) };
    form.password.0 = "plant".into();
    let id = job(&reduce(&mut model, Message::Submit));
    done(&mut model, id, 0, report(true));
    ended(&mut model, id, 1, 0);
    assert!(model.is_only::<VerifyView>(), "{:?}", model.dialogs);
    assert!(view(&mut model).of.values().all(Result::is_ok));

    let (mut model, id) = verifying(&["Paint"]);
    fail(&mut model, id, 0, ErrorCode::PasswordMissing);
    ended(&mut model, id, 0, 1);
    reduce(&mut model, Message::Close);
    assert!(model.is_only::<ErrorDialog>(), "{:?}", model.dialogs);
}

#[test]
fn servers_that_were_started_again_are_verified_by_themselves_if_that_is_wanted() {
    let start = |wanted: bool| {
        let mut model = model();
        reduce(&mut model, Message::SetVerifyAfterChanges(wanted));
        tick(&mut model, &["Paint"]);
        let id = job(&reduce(&mut model, Message::Invoke(UiCommand::START)));
        done(&mut model, id, 0, NoOutput);
        let summary = JobSummary { done: 1, ..JobSummary::default() };
        let commands = reduce(&mut model, Message::Event(BackendEvent::JobEnded { job: id, summary }));
        commands
            .iter()
            .any(|command| matches!(command, BackendCommand::Run { task, .. } if task.operation::<Verify>().is_some()))
    };
    assert!(start(true));
    assert!(!start(false));
}
