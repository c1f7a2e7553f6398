//! What a job says of a change whose answer did not come, and of one that was done before the connection broke.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use async_trait::async_trait;
use opcua_configurator::jobs::{
    AddUser, ControllerReport, GetInfo, JobContext, NoOutput, OperationOutput, SelfSigned, SelfSignedFields,
    StartServer, StopServer,
};
use opcua_configurator::model::{
    Address, Capabilities, Changed, ControllerInfo, Credentials, ErrorCode, KeyLength, Problem, RevisionToken,
    ServerStatus, UserCredential, UserName, UserPassword, Validity,
};
use opcua_configurator::pki::Fingerprint;
use opcua_configurator::session::{Connector, ControllerSession, ManagementConnector, ManagementTimeouts};
use opcua_configurator::virtual_controller::FleetFirmware;
use tokio_util::sync::CancellationToken;

use crate::common::test_fleet::{self, TestFleet};

/// What the network loses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Trouble {
    /// The answer to a start or a stop.
    Status,
    /// Every reading on the first session.
    Reading,
    /// Every reading on every session.
    EveryReading,
}

struct Network {
    real: ManagementConnector,
    trouble: Trouble,
    sessions: AtomicUsize,
}

struct Troubled {
    real: Box<dyn ControllerSession>,
    trouble: Trouble,
    first: bool,
    changed: bool,
}

#[async_trait]
impl Connector for Network {
    async fn probe(&self, address: &Address) -> Result<Fingerprint, Problem> {
        self.real.probe(address).await
    }

    async fn connect(
        &self,
        address: &Address,
        fingerprint: Fingerprint,
        credentials: &Credentials,
    ) -> Result<Box<dyn ControllerSession>, Problem> {
        let real = self.real.connect(address, fingerprint, credentials).await?;
        let first = self.sessions.fetch_add(1, Ordering::Relaxed) == 0;
        Ok(Box::new(Troubled { real, trouble: self.trouble, first, changed: false }))
    }
}

impl Troubled {
    fn status(&mut self, done: Result<Changed, Problem>) -> Result<Changed, Problem> {
        self.changed = true;
        if self.trouble == Trouble::Status { Err(ErrorCode::Timeout.into()) } else { done }
    }
}

#[async_trait]
impl ControllerSession for Troubled {
    async fn info(&mut self) -> Result<ControllerInfo, Problem> {
        let lost = match self.trouble {
            Trouble::Status => false,
            Trouble::Reading => self.first && self.changed,
            Trouble::EveryReading => self.changed || !self.first,
        };
        if lost { Err(ErrorCode::ConnectionLost.into()) } else { self.real.info().await }
    }

    async fn capabilities(&mut self) -> Result<Capabilities, Problem> {
        self.real.capabilities().await
    }

    async fn start_server(&mut self) -> Result<Changed, Problem> {
        let done = self.real.start_server().await;
        self.status(done)
    }

    async fn stop_server(&mut self) -> Result<Changed, Problem> {
        let done = self.real.stop_server().await;
        self.status(done)
    }

    async fn users(&mut self) -> Result<opcua_configurator::model::Revisioned<Vec<UserName>>, Problem> {
        self.real.users().await
    }

    async fn add_user(&mut self, based_on: RevisionToken, user: UserCredential) -> Result<Changed, Problem> {
        self.changed = true;
        self.real.add_user(based_on, user).await
    }

    async fn close(&mut self) {
        self.real.close().await;
    }
}

fn user(name: &str) -> AddUser {
    AddUser {
        credential: UserCredential { name: name.parse().unwrap(), password: UserPassword::new("Passw0rd1").unwrap() },
        based_on: None,
    }
}

async fn in_trouble<O: OperationOutput>(
    fleet: &TestFleet,
    trouble: Trouble,
    operation: impl opcua_configurator::jobs::Operation<Output = O> + 'static,
) -> ControllerReport<O> {
    let network = Network { real: fleet.connector, trouble, sessions: AtomicUsize::new(0) };
    let context = JobContext::new(Arc::new(network), fleet.passwords.clone(), 1);
    let (mut reports, _) = test_fleet::run(fleet.listed(), operation, context, CancellationToken::new(), |_| {}).await;
    reports.remove(0)
}

async fn with_certificate() -> TestFleet {
    let fleet = TestFleet::start(1, FleetFirmware::Legacy).await;
    let fields = SelfSignedFields {
        common_name: None,
        country: String::new(),
        state: String::new(),
        locality: String::new(),
        organisation: String::new(),
        key_length: KeyLength::Rsa2048,
        validity: Validity::try_from(1).unwrap(),
    };
    let made = fleet.run(SelfSigned { fields, backup: None }).await;
    assert!(made[0].result.is_ok(), "{made:?}");
    fleet
}

#[tokio::test(flavor = "multi_thread")]
async fn a_start_whose_answer_was_lost_is_done_if_the_server_runs() {
    let fleet = with_certificate().await;
    for (operation, status) in [(true, ServerStatus::Run), (false, ServerStatus::Stop)] {
        let report = if operation {
            in_trouble(&fleet, Trouble::Status, StartServer).await
        } else {
            in_trouble(&fleet, Trouble::Status, StopServer).await
        };
        assert_eq!(report.result, Ok(NoOutput));
        assert_eq!(report.info.map(|info| info.status), Some(status));
    }
    // One that was not done is not said to be.
    fleet.controller(0).faults().update(|faults| faults.refuse = true);
    let report = in_trouble(&fleet, Trouble::Status, StartServer).await;
    assert_eq!(report.result.unwrap_err().code, ErrorCode::Timeout);
    assert_eq!(report.info.map(|info| info.status), Some(ServerStatus::Stop));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_change_that_was_done_is_not_said_to_have_failed_because_nothing_can_be_read_afterwards() {
    let fleet = with_certificate().await;
    let before = fleet.controller(0).info().revision.number();
    let report = in_trouble(&fleet, Trouble::Reading, user("operator1")).await;
    assert_eq!(report.result, Ok(NoOutput));
    assert_eq!(report.info.map(|info| info.revision.number()), Some(before + 1), "read with another session");

    let report = in_trouble(&fleet, Trouble::EveryReading, user("operator2")).await;
    assert_eq!((report.result, report.info), (Ok(NoOutput), None));
    assert_eq!(fleet.controller(0).info().revision.number(), before + 2);
}

#[tokio::test(flavor = "multi_thread")]
async fn information_that_cannot_be_read_is_no_information() {
    let fleet = TestFleet::start(1, FleetFirmware::Legacy).await;
    fleet.controller(0).faults().update(|faults| faults.latency = Duration::from_millis(600));
    let reports = fleet.run(GetInfo).await;
    assert!(reports[0].result.is_ok(), "slow is not silent: {reports:?}");
    let timeouts = ManagementTimeouts { read: Duration::from_millis(300), ..fleet.connector.timeouts };
    let silent = JobContext::new(Arc::new(ManagementConnector { timeouts }), fleet.passwords.clone(), 1);
    let (reports, _) = test_fleet::run(fleet.listed(), GetInfo, silent, CancellationToken::new(), |_| {}).await;
    assert_eq!(reports[0].result.as_ref().unwrap_err().code, ErrorCode::Timeout);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_change_that_was_not_waited_for_is_looked_for() {
    let fleet = TestFleet::start(1, FleetFirmware::Legacy).await;
    let before = fleet.controller(0).info().revision.number();
    fleet.controller(0).faults().update(|faults| faults.latency = Duration::from_millis(700));
    // Readings take their time, a change is given up too early.
    let timeouts = ManagementTimeouts { change: Duration::from_millis(200), ..fleet.connector.timeouts };
    let hasty = JobContext::new(Arc::new(ManagementConnector { timeouts }), fleet.passwords.clone(), 1);
    let (reports, _) =
        test_fleet::run(fleet.listed(), user("operator1"), hasty, CancellationToken::new(), |_| {}).await;
    let problem = reports[0].result.as_ref().unwrap_err();
    let after = fleet.controller(0).info().revision.number();
    // What is said is what is so.
    match problem.code {
        ErrorCode::AnswerLost => assert_eq!(after, before + 1),
        ErrorCode::Timeout => {
            assert_eq!(after, before);
            assert!(problem.detail.as_deref().is_some_and(|detail| detail.contains("not applied")), "{problem:?}");
        }
        other => panic!("{other:?}: {problem:?}"),
    }
    assert_eq!(reports[0].info.as_ref().map(|info| info.revision.number()), Some(after));
}
