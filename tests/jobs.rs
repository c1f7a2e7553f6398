//! What jobs do to controllers, and what they leave behind when something goes wrong.

#[path = "common/plant.rs"]
mod plant;

use std::collections::BTreeSet;
use std::time::Duration;

use opcua_configurator::jobs::{
    AddUser, GetInfo, JobEvent, ListUsers, Outcome, RemoveUsers, Report, SelfSigned, SelfSignedFields, SetSettings,
    SettingsChange, StartServer, Step, StopServer, Summary,
};
use opcua_configurator::model::{
    Credential, ErrorCode, KeyLength, SecurityPolicy, ServerStatus, UserPassword, UserTokenPolicy, Validity,
};
use opcua_configurator::virtual_controller::{DropPoint, FleetFirmware};
use opcua_configurator::workspace::{Passwords as _, Workspace};
use plant::Plant;
use tokio_util::sync::CancellationToken;

fn user(name: &str) -> AddUser {
    AddUser {
        credential: Credential { name: name.parse().unwrap(), password: UserPassword::new("Passw0rd1").unwrap() },
        based_on: None,
    }
}

fn certificate() -> SelfSigned {
    SelfSigned {
        fields: SelfSignedFields {
            common_name: None,
            country: "JP".into(),
            state: "Nagano".into(),
            locality: "Suwa".into(),
            organisation: "Example".into(),
            key_length: KeyLength::Rsa2048,
            validity: Validity::try_from(5).unwrap(),
        },
        backup: None,
    }
}

fn policies(list: &[SecurityPolicy]) -> SetSettings {
    let change = SettingsChange {
        security_policies: Some(list.iter().copied().collect()),
        user_tokens: Some(BTreeSet::from([UserTokenPolicy::UserName])),
        ..SettingsChange::default()
    };
    SetSettings { change, ..SetSettings::default() }
}

fn codes(reports: &[Report]) -> Vec<Option<ErrorCode>> {
    reports.iter().map(|r| r.result.as_ref().err().map(|p| p.code)).collect()
}

fn status(report: &Report) -> ServerStatus {
    report.info.as_ref().expect("information").status
}

#[tokio::test(flavor = "multi_thread")]
async fn from_an_empty_controller_to_a_running_server() {
    let plant = Plant::start(3, FleetFirmware::Mixed).await;
    let reports = plant.run(StartServer).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::NoCertificate); 3]);
    assert_eq!(status(&reports[0]), ServerStatus::Error);
    for report in plant.run(certificate()).await {
        let Ok(Outcome::Certificate { summary, .. }) = &report.result else { panic!("{report:?}") };
        let info = report.info.expect("information");
        assert_eq!(summary.issued_to, info.application_name);
        assert_eq!(summary.application_uri, Some(format!("urn:{}", info.application_name)));
        assert_eq!(info.certificate.map(|c| c.summary), Some(summary.clone()));
    }
    assert_eq!(codes(&plant.run(policies(&[SecurityPolicy::Basic256Sha256])).await), [None; 3]);
    assert_eq!(codes(&plant.run(user("operator1")).await), [None; 3]);
    let reports = plant.run(StartServer).await;
    assert!(reports.iter().all(|r| status(r) == ServerStatus::Run), "{reports:?}");
    // A change stops a running server and starts it again.
    let reports = plant.run(user("operator2")).await;
    assert!(reports.iter().all(|r| r.result.is_ok() && status(r) == ServerStatus::Run), "{reports:?}");
    let reports = plant.run(StopServer).await;
    assert!(reports.iter().all(|r| status(r) == ServerStatus::Stop), "{reports:?}");
    let reports = plant.run(RemoveUsers { names: vec!["operator1".parse().unwrap()], based_on: None }).await;
    assert!(reports.iter().all(|r| r.result.is_ok() && status(r) == ServerStatus::Stop), "{reports:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn one_failing_never_stops_the_others() {
    let plant = Plant::start(4, FleetFirmware::Current).await;
    plant.controller(0).faults().update(|f| f.task_running = true);
    plant.controller(1).faults().update(|f| f.teach_pendant_connected = true);
    plant.controller(2).shutdown().await;
    let reports = plant.run(user("operator1")).await;
    assert_eq!(
        codes(&reports),
        [Some(ErrorCode::TaskRunning), Some(ErrorCode::TeachPendantConnected), Some(ErrorCode::Unreachable), None]
    );
    // What could be reached is shown as it is now.
    assert!(reports[0].info.is_some() && reports[2].info.is_none());
}

#[tokio::test(flavor = "multi_thread")]
async fn wrong_and_missing_passwords_and_fingerprints_are_told_apart() {
    let plant = Plant::start(3, FleetFirmware::Current).await;
    plant.passwords.set(plant.controller(0).fingerprint(), "wrong".into()).unwrap();
    plant.passwords.forget(plant.controller(1).fingerprint());
    let mut listed = plant.listed();
    listed[2].fingerprint = Some(plant::nobody());
    plant.passwords.set(plant::nobody(), plant::PASSWORD.into()).unwrap();
    let mut unconfirmed = listed[1].clone();
    unconfirmed.fingerprint = None;
    listed.push(unconfirmed);
    let (reports, summary) = plant::run(listed, GetInfo, plant.context(), CancellationToken::new(), |_| {}).await;
    assert_eq!(
        codes(&reports),
        [
            Some(ErrorCode::WrongPassword),
            Some(ErrorCode::PasswordMissing),
            Some(ErrorCode::FingerprintChanged),
            Some(ErrorCode::FingerprintUnknown)
        ]
    );
    assert_eq!(summary, Summary { done: 0, failed: 4, not_started: 0 });
}

#[tokio::test(flavor = "multi_thread")]
async fn a_connection_lost_before_the_change_leaves_the_controller_as_it_was() {
    let plant = Plant::start(1, FleetFirmware::Legacy).await;
    plant.run(certificate()).await;
    plant.run(StartServer).await;
    let before = plant.controller(0).info();
    plant.controller(0).faults().update(|f| f.drop_next_change = Some(DropPoint::BeforeApply));
    assert_eq!(codes(&plant.run(user("operator1")).await), [Some(ErrorCode::ConnectionLost)]);
    let after = plant.controller(0).info();
    assert_eq!((after.revision, after.status), (before.revision, ServerStatus::Run));
    let users = plant.run(ListUsers).await;
    assert!(matches!(&users[0].result, Ok(Outcome::Users(users)) if users.value.is_empty()), "{users:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_lost_answer_is_said_to_be_lost_and_the_row_shows_what_was_done() {
    let plant = Plant::start(1, FleetFirmware::Current).await;
    let before = plant.controller(0).info().revision;
    plant.controller(0).faults().update(|f| f.drop_next_change = Some(DropPoint::AfterApply));
    let reports = plant.run(user("operator1")).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::ConnectionLost)]);
    assert_eq!(reports[0].info.as_ref().map(|i| i.revision), Some(before + 1));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_second_configurator_is_noticed() {
    let plant = Plant::start(1, FleetFirmware::Current).await;
    let seen = plant.controller(0).info().revision;
    plant.run(user("operator1")).await;
    let mut late = policies(&[SecurityPolicy::Basic256Sha256]);
    late.based_on = Some(seen);
    assert_eq!(codes(&plant.run(late).await), [Some(ErrorCode::ChangedMeanwhile)]);
    assert_eq!(plant.controller(0).info().revision, seen + 1, "nothing was changed");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_full_disk_in_the_controller_changes_nothing() {
    let plant = Plant::start(1, FleetFirmware::Legacy).await;
    plant.run(certificate()).await;
    plant.run(StartServer).await;
    let before = plant.controller(0).info();
    plant.controller(0).faults().update(|f| f.disk_full = true);
    let reports = plant.run(certificate()).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::DiskFull)]);
    let after = plant.controller(0).info();
    assert_eq!((after.certificate, after.status), (before.certificate, ServerStatus::Run));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_port_that_is_taken_is_refused_before_and_after() {
    let plant = Plant::start(1, FleetFirmware::Current).await;
    let used = plant.controller(0).info().used_ports[0];
    let change = SettingsChange { port: Some(used.try_into().unwrap()), ..SettingsChange::default() };
    let operation = SetSettings { change, ..SetSettings::default() };
    assert_eq!(codes(&plant.run(operation.clone()).await), [Some(ErrorCode::PortConflict)], "by the controller");
    let mut listed = plant.listed();
    listed[0].known = Some(plant.controller(0).info());
    plant.controller(0).shutdown().await;
    let (reports, _) = plant::run(listed, operation, plant.context(), CancellationToken::new(), |_| {}).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::PortConflict)], "without asking it");
}

#[tokio::test(flavor = "multi_thread")]
async fn cancel_stops_after_the_step_in_hand() {
    let plant = Plant::start(6, FleetFirmware::Current).await;
    for index in 0..6 {
        plant.controller(index).faults().update(|f| f.latency = Duration::from_millis(150));
    }
    let mut context = plant.context();
    context.parallelism = 2;
    let cancel = CancellationToken::new();
    let stop = cancel.clone();
    let (reports, summary) = plant::run(plant.listed(), user("operator1"), context, cancel, move |event| {
        if matches!(event, JobEvent::Step { step: Step::Apply, .. }) {
            stop.cancel();
        }
    })
    .await;
    assert!(summary.done >= 1 && summary.not_started >= 4 && summary.failed == 0, "{summary:?}");
    for (index, report) in reports.iter().enumerate() {
        let has_user = !plant.controller(index).state().users.is_empty();
        assert_eq!(report.result.is_ok(), has_user, "what is said of controller {index} is what was done");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_slow_controller_does_not_hold_up_the_others() {
    let plant = Plant::start(3, FleetFirmware::Current).await;
    plant.controller(0).faults().update(|f| f.latency = Duration::from_millis(1500));
    let order = std::sync::Arc::new(parking_lot::Mutex::new(Vec::new()));
    let seen = order.clone();
    plant::run(plant.listed(), GetInfo, plant.context(), CancellationToken::new(), move |event| {
        if let JobEvent::Finished { index, .. } = event {
            seen.lock().push(*index);
        }
    })
    .await;
    assert_eq!(order.lock().last(), Some(&0));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_backup_holds_the_certificate_and_for_legacy_firmware_the_key() {
    let plant = Plant::start(2, FleetFirmware::Mixed).await;
    let folder = tempfile::tempdir().unwrap();
    let files = Workspace::new(folder.path()).certificate_files();
    for (index, report) in
        plant.run(SelfSigned { backup: Some(files.clone()), ..certificate() }).await.into_iter().enumerate()
    {
        let Ok(Outcome::Certificate { saved: Some(saved), .. }) = report.result else { panic!("{report:?}") };
        let info = report.info.unwrap();
        assert_eq!(saved.certificate, files.self_signed_folder(&info.serial).join("1_cert.der"));
        let certificate = opcua_configurator::pki::Certificate::from_der(&std::fs::read(saved.certificate).unwrap());
        assert_eq!(Some(certificate.unwrap().summary()), info.certificate.map(|c| c.summary));
        let legacy = plant.controller(index).firmware().to_string().starts_with('7');
        assert_eq!(saved.key.is_some(), legacy);
        if let Some(key) = saved.key {
            let pfx = std::fs::read(&key).unwrap();
            assert!(opcua_configurator::pki::pkcs12_read(&pfx, plant::PASSWORD).is_ok());
            #[cfg(unix)]
            {
                use std::os::unix::fs::PermissionsExt as _;
                assert_eq!(std::fs::metadata(key).unwrap().permissions().mode() & 0o777, 0o600);
            }
        }
    }
}

/// A certificate in use whose backup is missing is what nobody wants: find out first.
#[tokio::test(flavor = "multi_thread")]
async fn a_backup_that_cannot_be_written_stops_before_the_controller_is_changed() {
    let plant = Plant::start(1, FleetFirmware::Legacy).await;
    let folder = tempfile::tempdir().unwrap();
    let in_the_way = folder.path().join("file");
    std::fs::write(&in_the_way, "x").unwrap();
    let files = Workspace::new(&in_the_way).certificate_files();
    let before = plant.controller(0).info().revision;
    let reports = plant.run(SelfSigned { backup: Some(files), ..certificate() }).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::WorkspaceReadOnly)]);
    assert_eq!(plant.controller(0).info().revision, before);
}
