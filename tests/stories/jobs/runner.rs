//! What jobs do to controllers, and what they leave behind when something goes wrong.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use async_trait::async_trait;
use opcua_configurator::jobs::{
    AddUser, BasicSettingsChange, CertificateMade, ControllerReport, GetInfo, JobContext, JobController, JobEvent,
    JobStep, JobSummary, ListUsers, RemoveUsers, SelfSigned, SelfSignedFields, SetBasicSettings, StartServer,
    StopServer,
};
use opcua_configurator::model::{
    Address, Capabilities, ConnectionKind, ControllerInfo, Credentials, ErrorCode, KeyLength, Problem, SecurityPolicy,
    ServerStatus, UserCredential, UserPassword, UserTokenPolicy, Validity,
};
use opcua_configurator::pki::Fingerprint;
use opcua_configurator::session::{Connector, ControllerSession};
use opcua_configurator::virtual_controller::{DropPoint, FleetFirmware};
use opcua_configurator::workspace::{MemoryPasswords, PasswordError, Passwords, Workspace};
use parking_lot::Mutex;
use tokio_util::sync::CancellationToken;

use crate::common::test_fleet::{self, TestFleet};

fn user(name: &str) -> AddUser {
    AddUser {
        credential: UserCredential { name: name.parse().unwrap(), password: UserPassword::new("Passw0rd1").unwrap() },
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

fn policies(list: &[SecurityPolicy]) -> SetBasicSettings {
    let change = BasicSettingsChange {
        security_policies: Some(list.iter().copied().collect()),
        user_tokens: Some(BTreeSet::from([UserTokenPolicy::UserName])),
        ..BasicSettingsChange::default()
    };
    SetBasicSettings { change, ..SetBasicSettings::default() }
}

fn codes<O>(reports: &[ControllerReport<O>]) -> Vec<Option<ErrorCode>> {
    reports.iter().map(|r| r.result.as_ref().err().map(|p| p.code)).collect()
}

fn status<O>(report: &ControllerReport<O>) -> ServerStatus {
    report.info.as_ref().expect("information").status
}

#[tokio::test(flavor = "multi_thread")]
async fn from_an_empty_controller_to_a_running_server() {
    let fleet = TestFleet::start(3, FleetFirmware::Mixed).await;
    let reports = fleet.run(StartServer).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::NoCertificate); 3]);
    assert_eq!(status(&reports[0]), ServerStatus::Error);
    for report in fleet.run(certificate()).await {
        let Ok(CertificateMade { summary, .. }) = &report.result else { panic!("{report:?}") };
        let info = report.info.expect("information");
        assert_eq!(summary.issued_to, info.application_name);
        assert_eq!(summary.application_uri, Some(format!("urn:{}", info.application_name)));
        assert_eq!(info.certificate.map(|c| c.summary), Some(summary.clone()));
    }
    assert_eq!(codes(&fleet.run(policies(&[SecurityPolicy::Basic256Sha256])).await), [None; 3]);
    assert_eq!(codes(&fleet.run(user("operator1")).await), [None; 3]);
    let reports = fleet.run(StartServer).await;
    assert!(reports.iter().all(|r| status(r) == ServerStatus::Run), "{reports:?}");
    // A change stops a running server and starts it again.
    let reports = fleet.run(user("operator2")).await;
    assert!(reports.iter().all(|r| r.result.is_ok() && status(r) == ServerStatus::Run), "{reports:?}");
    let reports = fleet.run(StopServer).await;
    assert!(reports.iter().all(|r| status(r) == ServerStatus::Stop), "{reports:?}");
    let reports = fleet.run(RemoveUsers { names: vec!["operator1".parse().unwrap()], based_on: None }).await;
    assert!(reports.iter().all(|r| r.result.is_ok() && status(r) == ServerStatus::Stop), "{reports:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn one_failing_never_stops_the_others() {
    let fleet = TestFleet::start(4, FleetFirmware::Current).await;
    fleet.controller(0).faults().update(|f| f.task_running = true);
    fleet.controller(1).faults().update(|f| f.teach_pendant_connected = true);
    fleet.controller(2).shutdown().await;
    let reports = fleet.run(user("operator1")).await;
    assert_eq!(
        codes(&reports),
        [Some(ErrorCode::TaskRunning), Some(ErrorCode::TeachPendantConnected), Some(ErrorCode::Unreachable), None]
    );
    // What could be reached is shown as it is now.
    assert!(reports[0].info.is_some() && reports[2].info.is_none());
}

#[tokio::test(flavor = "multi_thread")]
async fn wrong_and_missing_passwords_and_fingerprints_are_told_apart() {
    let fleet = TestFleet::start(3, FleetFirmware::Current).await;
    fleet.passwords.set(fleet.controller(0).fingerprint(), "wrong".into()).unwrap();
    fleet.passwords.forget(fleet.controller(1).fingerprint());
    let mut listed = fleet.listed();
    listed[2].fingerprint = Some(test_fleet::nobody());
    fleet.passwords.set(test_fleet::nobody(), test_fleet::PASSWORD.into()).unwrap();
    let mut unconfirmed = listed[1].clone();
    unconfirmed.fingerprint = None;
    listed.push(unconfirmed);
    let (reports, summary) = test_fleet::run(listed, GetInfo, fleet.context(), CancellationToken::new(), |_| {}).await;
    assert_eq!(
        codes(&reports),
        [
            Some(ErrorCode::WrongPassword),
            Some(ErrorCode::PasswordMissing),
            Some(ErrorCode::FingerprintChanged),
            Some(ErrorCode::FingerprintUnknown)
        ]
    );
    assert_eq!(summary, JobSummary { done: 0, failed: 4, not_started: 0 });
}

#[tokio::test(flavor = "multi_thread")]
async fn a_connection_lost_before_the_change_leaves_the_controller_as_it_was() {
    let fleet = TestFleet::start(1, FleetFirmware::Legacy).await;
    fleet.run(certificate()).await;
    fleet.run(StartServer).await;
    let before = fleet.controller(0).info();
    fleet.controller(0).faults().update(|f| f.drop_next_change = Some(DropPoint::BeforeApply));
    let reports = fleet.run(user("operator1")).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::ConnectionLost)]);
    let detail = reports[0].result.as_ref().unwrap_err().detail.clone().unwrap();
    assert!(detail.contains("not applied when it was read again"), "{detail}");
    let after = fleet.controller(0).info();
    assert_eq!((after.revision, after.status), (before.revision, ServerStatus::Run));
    let users = fleet.run(ListUsers).await;
    assert!(matches!(&users[0].result, Ok(users) if users.value.is_empty()), "{users:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_lost_answer_is_said_to_be_lost_and_the_row_shows_what_was_done() {
    let fleet = TestFleet::start(1, FleetFirmware::Current).await;
    let before = fleet.controller(0).info().revision.number();
    fleet.controller(0).faults().update(|f| f.drop_next_change = Some(DropPoint::AfterApply));
    let reports = fleet.run(user("operator1")).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::AnswerLost)]);
    assert_eq!(reports[0].info.as_ref().map(|i| i.revision.number()), Some(before + 1));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_key_the_security_policies_do_not_allow_keeps_the_server_from_starting() {
    let fleet = TestFleet::start(1, FleetFirmware::Legacy).await;
    let fields = SelfSignedFields { key_length: KeyLength::Rsa4096, ..certificate().fields };
    assert_eq!(codes(&fleet.run(policies(&[SecurityPolicy::Basic256Sha256])).await), [None]);
    assert_eq!(codes(&fleet.run(SelfSigned { fields, backup: None }).await), [None]);
    assert_eq!(codes(&fleet.run(policies(&[SecurityPolicy::Basic128Rsa15])).await), [None]);
    assert_eq!(codes(&fleet.run(StartServer).await), [Some(ErrorCode::InvalidParameter)]);
    assert_eq!(fleet.controller(0).info().error, Some(ErrorCode::InvalidParameter));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_second_configurator_is_noticed() {
    let fleet = TestFleet::start(1, FleetFirmware::Current).await;
    let seen = fleet.controller(0).info().revision;
    fleet.run(user("operator1")).await;
    let mut late = policies(&[SecurityPolicy::Basic256Sha256]);
    late.based_on = Some(seen);
    assert_eq!(codes(&fleet.run(late).await), [Some(ErrorCode::ChangedMeanwhile)]);
    assert_eq!(fleet.controller(0).info().revision.number(), seen.number() + 1, "nothing was changed");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_full_disk_in_the_controller_changes_nothing() {
    let fleet = TestFleet::start(1, FleetFirmware::Legacy).await;
    fleet.run(certificate()).await;
    fleet.run(StartServer).await;
    let before = fleet.controller(0).info();
    fleet.controller(0).faults().update(|f| f.disk_full = true);
    let reports = fleet.run(certificate()).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::DiskFull)]);
    let after = fleet.controller(0).info();
    assert_eq!((after.certificate, after.status), (before.certificate, ServerStatus::Run));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_port_that_is_taken_is_refused_before_and_after() {
    let fleet = TestFleet::start(1, FleetFirmware::Current).await;
    let used = fleet.controller(0).info().used_ports[0];
    let change = BasicSettingsChange { port: Some(used.try_into().unwrap()), ..BasicSettingsChange::default() };
    let operation = SetBasicSettings { change, ..SetBasicSettings::default() };
    assert_eq!(codes(&fleet.run(operation.clone()).await), [Some(ErrorCode::PortConflict)], "by the controller");
    let mut listed = fleet.listed();
    listed[0].known = Some(fleet.controller(0).info());
    fleet.controller(0).shutdown().await;
    let (reports, _) = test_fleet::run(listed, operation, fleet.context(), CancellationToken::new(), |_| {}).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::PortConflict)], "without asking it");
}

#[tokio::test(flavor = "multi_thread")]
async fn cancel_stops_after_the_step_in_hand() {
    let fleet = TestFleet::start(6, FleetFirmware::Current).await;
    for index in 0..6 {
        fleet.controller(index).faults().update(|f| f.latency = Duration::from_millis(150));
    }
    let mut context = fleet.context();
    context.parallelism = 2;
    let cancel = CancellationToken::new();
    let stop = cancel.clone();
    let (reports, summary) = test_fleet::run(fleet.listed(), user("operator1"), context, cancel, move |event| {
        if matches!(event, JobEvent::Step { step: JobStep::Apply, .. }) {
            stop.cancel();
        }
    })
    .await;
    assert!(summary.done >= 1 && summary.not_started >= 4 && summary.failed == 0, "{summary:?}");
    for (index, report) in reports.iter().enumerate() {
        let has_user = !fleet.controller(index).state().users.is_empty();
        assert_eq!(report.result.is_ok(), has_user, "what is said of controller {index} is what was done");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_slow_controller_does_not_hold_up_the_others() {
    let fleet = TestFleet::start(3, FleetFirmware::Current).await;
    fleet.controller(0).faults().update(|f| f.latency = Duration::from_millis(1500));
    let order = std::sync::Arc::new(parking_lot::Mutex::new(Vec::new()));
    let seen = order.clone();
    test_fleet::run(fleet.listed(), GetInfo, fleet.context(), CancellationToken::new(), move |event| {
        if let JobEvent::Finished { index, .. } = event {
            seen.lock().push(*index);
        }
    })
    .await;
    assert_eq!(order.lock().last(), Some(&0));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_backup_holds_the_certificate_and_for_legacy_firmware_the_key() {
    let fleet = TestFleet::start(2, FleetFirmware::Mixed).await;
    let folder = tempfile::tempdir().unwrap();
    let files = Workspace::new(folder.path()).certificate_files();
    for (index, report) in
        fleet.run(SelfSigned { backup: Some(files.clone()), ..certificate() }).await.into_iter().enumerate()
    {
        let Ok(CertificateMade { saved: Some(saved), .. }) = report.result else { panic!("{report:?}") };
        let info = report.info.unwrap();
        assert_eq!(saved.certificate, files.self_signed_folder(&info.serial).join("1_cert.der"));
        let certificate = opcua_configurator::pki::Certificate::from_der(&std::fs::read(saved.certificate).unwrap());
        assert_eq!(Some(certificate.unwrap().summary()), info.certificate.map(|c| c.summary));
        let legacy = fleet.controller(index).firmware().to_string().starts_with('7');
        assert_eq!(saved.key.is_some(), legacy);
        if let Some(key) = saved.key {
            let pfx = std::fs::read(&key).unwrap();
            assert!(opcua_configurator::pki::pkcs12_read(&pfx, test_fleet::PASSWORD).is_ok());
            #[cfg(unix)]
            {
                use std::os::unix::fs::PermissionsExt as _;
                assert_eq!(std::fs::metadata(key).unwrap().permissions().mode() & 0o777, 0o600);
            }
        }
    }
}

/// No certificate is in use without its backup: the folder is checked first.
#[tokio::test(flavor = "multi_thread")]
async fn a_backup_that_cannot_be_written_stops_before_the_controller_is_changed() {
    let fleet = TestFleet::start(1, FleetFirmware::Legacy).await;
    let folder = tempfile::tempdir().unwrap();
    let in_the_way = folder.path().join("file");
    std::fs::write(&in_the_way, "x").unwrap();
    let files = Workspace::new(&in_the_way).certificate_files();
    let before = fleet.controller(0).info().revision.number();
    let reports = fleet.run(SelfSigned { backup: Some(files), ..certificate() }).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::WorkspaceReadOnly)]);
    assert_eq!(fleet.controller(0).info().revision.number(), before);
}

/// Stands in for every controller: sessions whose information and goodbye the test decides.
struct Stand {
    info: Result<ControllerInfo, Problem>,
    /// Addresses in the order in which they were connected to.
    met: Arc<Mutex<Vec<String>>>,
    /// A goodbye waits until so many controllers were met.
    goodbye_after: usize,
    closing: Arc<AtomicUsize>,
    most_closing: Arc<AtomicUsize>,
}

impl Stand {
    fn new(info: Result<ControllerInfo, Problem>) -> Self {
        let (met, closing, most_closing) = Default::default();
        Self { info, met, goodbye_after: 0, closing, most_closing }
    }

    fn context(self: &Arc<Self>, parallelism: usize) -> JobContext {
        let passwords = MemoryPasswords::default();
        passwords.set(test_fleet::nobody(), "".into()).unwrap();
        JobContext::new(Arc::new(StandIn(self.clone())), Arc::new(passwords), parallelism)
    }
}

/// `count` controllers at 10.0.0.1, 10.0.0.2, …
fn crowd(count: usize) -> Vec<JobController> {
    let nth = |n| JobController {
        name: format!("cell {n}").parse().unwrap(),
        address: format!("10.0.0.{n}").parse().unwrap(),
        connection: ConnectionKind::Management,
        fingerprint: Some(test_fleet::nobody()),
        known: None,
    };
    (1..=count).map(nth).collect()
}

/// As the connector and as a session.
struct StandIn(Arc<Stand>);

#[async_trait]
impl Connector for StandIn {
    async fn probe(&self, _: &Address) -> Result<Fingerprint, Problem> {
        unreachable!("a job does not probe")
    }

    async fn connect(
        &self,
        address: &Address,
        _: Fingerprint,
        _: &Credentials,
    ) -> Result<Box<dyn ControllerSession>, Problem> {
        self.0.met.lock().push(address.to_string());
        Ok(Box::new(StandIn(self.0.clone())))
    }
}

#[async_trait]
impl ControllerSession for StandIn {
    async fn info(&mut self) -> Result<ControllerInfo, Problem> {
        self.0.info.clone()
    }

    async fn capabilities(&mut self) -> Result<Capabilities, Problem> {
        Ok(Capabilities::all())
    }

    async fn close(&mut self) {
        let closing = self.0.closing.fetch_add(1, Ordering::SeqCst) + 1;
        self.0.most_closing.fetch_max(closing, Ordering::SeqCst);
        while self.0.met.lock().len() < self.0.goodbye_after {
            tokio::time::sleep(Duration::from_millis(1)).await;
        }
        tokio::time::sleep(Duration::from_millis(5)).await;
        self.0.closing.fetch_sub(1, Ordering::SeqCst);
    }
}

async fn some_info() -> ControllerInfo {
    TestFleet::start(1, FleetFirmware::Current).await.controller(0).info()
}

#[tokio::test(flavor = "multi_thread")]
async fn controllers_have_their_turns_in_list_order() {
    let stand = Arc::new(Stand::new(Ok(some_info().await)));
    let (_, summary) = test_fleet::run(crowd(200), GetInfo, stand.context(1), CancellationToken::new(), |_| {}).await;
    assert_eq!(summary.done, 200);
    let in_order: Vec<String> = crowd(200).iter().map(|c| c.address.to_string()).collect();
    assert_eq!(*stand.met.lock(), in_order);
}

/// What went wrong is said, not merely that something did.
#[tokio::test]
async fn information_that_cannot_be_read_is_explained() {
    for problem in [ErrorCode::Timeout.into(), Problem::with_detail(ErrorCode::NotAController, "line 1")] {
        let stand = Arc::new(Stand::new(Err(problem.clone())));
        let (reports, _) =
            test_fleet::run(crowd(1), GetInfo, stand.context(16), CancellationToken::new(), |_| {}).await;
        assert_eq!(reports[0].result, Err(problem));
    }
}

/// Logging out is nothing an engineer should wait for; but no more say goodbye at once than have their turn.
#[tokio::test(flavor = "multi_thread")]
async fn the_next_turn_begins_before_the_last_goodbye_is_said() {
    let info = some_info().await;
    let stand = Arc::new(Stand { goodbye_after: 2, ..Stand::new(Ok(info.clone())) });
    let (reports, _) = test_fleet::run(crowd(2), GetInfo, stand.context(1), CancellationToken::new(), |_| {}).await;
    assert_eq!(codes(&reports), [None; 2]);
    let stand = Arc::new(Stand::new(Ok(info)));
    test_fleet::run(crowd(100), GetInfo, stand.context(4), CancellationToken::new(), |_| {}).await;
    assert!((1..=4).contains(&stand.most_closing.load(Ordering::SeqCst)), "{:?}", stand.most_closing);
    assert_eq!(stand.closing.load(Ordering::SeqCst), 0, "the job ends with the last goodbye");
}

/// Asks the user to unlock it, and the user has gone home.
struct LockedKeyring(Mutex<std::sync::mpsc::Receiver<()>>);

impl Passwords for LockedKeyring {
    fn get(&self, _: Fingerprint) -> Result<Option<Credentials>, PasswordError> {
        let _gone = self.0.lock().recv();
        Ok(None)
    }
    fn set(&self, _: Fingerprint, _: Credentials) -> Result<(), PasswordError> {
        unreachable!("a job keeps no password by itself")
    }
    fn forget(&self, _: Fingerprint) {}
}

#[tokio::test(flavor = "multi_thread")]
async fn a_cancel_does_not_wait_for_a_locked_keyring() {
    let (home, keyring) = std::sync::mpsc::channel();
    let stand = Arc::new(Stand::new(Err(ErrorCode::Internal.into())));
    let context = JobContext::new(Arc::new(StandIn(stand)), Arc::new(LockedKeyring(Mutex::new(keyring))), 16);
    let cancel = CancellationToken::new();
    let stop = cancel.clone();
    tokio::spawn(async move {
        tokio::time::sleep(Duration::from_millis(50)).await;
        stop.cancel();
    });
    let job = test_fleet::run(crowd(3), GetInfo, context, cancel, |_| {});
    let (reports, summary) = tokio::time::timeout(Duration::from_secs(20), job).await.expect("cancelled");
    for report in &reports {
        assert_eq!(report.result.as_ref().unwrap_err().code, ErrorCode::Cancelled);
    }
    assert_eq!(summary, JobSummary { not_started: 3, ..JobSummary::default() });
    drop(home);
}
