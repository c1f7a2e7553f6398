//! What an engineer is told after connecting to a controller as an OPC UA client.

use std::net::SocketAddr;
use std::time::{Duration, Instant};

use opcua_configurator::jobs::{
    AddUser, BasicSettingsChange, ConnectRefusal, NotTried, RefusalDetails, SelfSigned, SelfSignedFields,
    SetBasicSettings, StartServer, TokenOutcome, TrustConfigurator, Verify, VerifyFinding, VerifyReport,
};
use opcua_configurator::model::{
    CertificateStatus, KeyLength, SecurityPolicy, ServerStatus, UserCredential, UserPassword, UserTokenPolicy, Validity,
};
use opcua_configurator::session::opcua_client::{ConnectTimeouts, TokenKind};
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::workspace::Workspace;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio_util::sync::CancellationToken;

use crate::common::test_fleet::{self, TestFleet};

fn certificate(bits: KeyLength) -> SelfSigned {
    SelfSigned {
        fields: SelfSignedFields {
            common_name: None,
            country: "JP".into(),
            state: "Nagano".into(),
            locality: "Suwa".into(),
            organisation: "Example".into(),
            key_length: bits,
            validity: Validity::try_from(1).unwrap(),
        },
        backup: None,
    }
}

fn credential(password: &str) -> UserCredential {
    UserCredential { name: "operator1".parse().unwrap(), password: UserPassword::new(password).unwrap() }
}

/// A plant and a desk beside it.
struct Cell {
    fleet: TestFleet,
    folder: tempfile::TempDir,
}

impl Cell {
    /// Running servers with these policies, which let everybody in by both tokens, and a user.
    async fn running(count: usize, firmware: FleetFirmware, policies: &[SecurityPolicy]) -> Self {
        let cell = Self::stopped(count, firmware, policies).await;
        cell.run(StartServer).await;
        cell
    }

    async fn stopped(count: usize, firmware: FleetFirmware, policies: &[SecurityPolicy]) -> Self {
        let cell = Self { fleet: TestFleet::start(count, firmware).await, folder: tempfile::tempdir().unwrap() };
        let change = BasicSettingsChange {
            security_policies: Some(policies.iter().copied().collect()),
            user_tokens: Some(UserTokenPolicy::ALL.into()),
            ..BasicSettingsChange::default()
        };
        cell.run(SetBasicSettings { change, ..SetBasicSettings::default() }).await;
        cell.run(certificate(KeyLength::Rsa2048)).await;
        cell.run(AddUser { credential: credential("Passw0rd1"), based_on: None }).await;
        cell
    }

    async fn run(&self, operation: impl opcua_configurator::jobs::Operation + 'static) {
        for report in self.fleet.run(operation).await {
            assert!(report.result.is_ok(), "{report:?}");
        }
    }

    fn verify(&self, login: Option<&str>) -> Verify {
        Verify {
            identity: Workspace::new(self.folder.path()).own_identity(),
            login: login.map(credential),
            trust_first: false,
            timeouts: ConnectTimeouts { connect: Duration::from_secs(2), attempt: Duration::from_secs(4) },
        }
    }

    async fn reports(&self, login: Option<&str>) -> Vec<VerifyReport> {
        self.fleet.run(self.verify(login)).await.into_iter().map(|report| report.result.unwrap()).collect()
    }

    async fn report(&self, login: Option<&str>) -> VerifyReport {
        self.reports(login).await.remove(0)
    }
}

fn verdict<'a>(report: &'a VerifyReport, endpoint: &str, kind: TokenKind) -> &'a TokenOutcome {
    let endpoint =
        report.endpoints.iter().find(|found| found.name() == endpoint).unwrap_or_else(|| panic!("{report:?}"));
    &endpoint.tokens.iter().find(|token| token.kind == kind).unwrap().verdict
}

#[tokio::test(flavor = "multi_thread")]
async fn without_security_everybody_gets_in_and_is_warned() {
    let cell = Cell::running(2, FleetFirmware::Mixed, &[SecurityPolicy::None]).await;
    for report in cell.reports(Some("Passw0rd1")).await {
        assert!(report.all_works(), "{report:?}");
        assert_eq!(*verdict(&report, "None", TokenKind::Anonymous), TokenOutcome::Works);
        assert_eq!(*verdict(&report, "None", TokenKind::UserName), TokenOutcome::Works);
        assert_eq!(report.findings, [VerifyFinding::WeakPolicy(SecurityPolicy::None)]);
        assert_eq!(report.certificate.unwrap().refused, None);
    }
    let report = cell.report(None).await;
    assert_eq!(*verdict(&report, "None", TokenKind::UserName), TokenOutcome::NotTried(NotTried::NoPassword));
    assert!(report.all_works() && report.lacks_password(), "what was not tried is no fault");
}

#[tokio::test(flavor = "multi_thread")]
async fn an_unknown_configurator_is_refused_at_every_secured_endpoint() {
    let cell = Cell::running(2, FleetFirmware::Mixed, &SecurityPolicy::ALL).await;
    for report in cell.reports(Some("Passw0rd1")).await {
        assert_eq!(report.endpoints.len(), 11);
        assert!(!report.all_works() && report.lacks_trust(), "{report:?}");
        assert_eq!(report.counts().work, 2, "{report:?}");
        for endpoint in report.endpoints.iter().filter(|endpoint| endpoint.name() != "None") {
            for token in &endpoint.tokens {
                let TokenOutcome::Fails(ConnectRefusal::OwnCertificate(Some(RefusalDetails {
                    status, reason, ..
                }))) = &token.verdict
                else {
                    panic!("{token:?}")
                };
                assert_eq!(*status, CertificateStatus::Untrusted, "the server tells its clients less");
                assert!(!reason.is_empty());
            }
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn once_it_is_trusted_the_configurator_gets_in_everywhere() {
    let cell = Cell::running(2, FleetFirmware::Mixed, &SecurityPolicy::ALL).await;
    let timeouts = ConnectTimeouts::default();
    cell.run(TrustConfigurator { identity: Workspace::new(cell.folder.path()).own_identity() }).await;
    for report in cell
        .fleet
        .run(Verify { timeouts, ..cell.verify(Some("Passw0rd1")) })
        .await
        .into_iter()
        .map(|report| report.result.unwrap())
    {
        assert!(report.all_works(), "{report:?}");
        assert_eq!((report.counts().work, report.endpoints.len()), (22, 11));
    }
    let trust_first = Verify { trust_first: true, timeouts, ..cell.verify(None) };
    for report in cell.fleet.run(trust_first).await.into_iter().map(|report| report.result.unwrap()) {
        assert_eq!((report.counts().work, report.counts().not_tried), (11, 11), "trusting twice does no harm");
    }
    assert_eq!(cell.fleet.controller(0).state().trusted.len(), 1);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_wrong_password_is_sent_once() {
    let cell = Cell::running(1, FleetFirmware::Current, &[SecurityPolicy::None]).await;
    for _ in 0..4 {
        let report = cell.report(Some("Passw0rd2")).await;
        assert_eq!(*verdict(&report, "None", TokenKind::UserName), TokenOutcome::Fails(ConnectRefusal::Password));
        assert_eq!(*verdict(&report, "None", TokenKind::Anonymous), TokenOutcome::Works);
    }
    assert!(cell.report(Some("Passw0rd1")).await.all_works(), "four wrong ones lock nobody out");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stopped_server_is_said_to_be_stopped() {
    let cell = Cell::stopped(1, FleetFirmware::Legacy, &[SecurityPolicy::None]).await;
    let report = cell.report(None).await;
    assert_eq!(report.findings, [VerifyFinding::NotRunning { status: ServerStatus::Stop, error: None }]);
    assert!(!report.all_works() && report.endpoints.is_empty() && report.certificate.is_none());
}

#[tokio::test(flavor = "multi_thread")]
async fn another_name_for_the_same_controller_is_noticed() {
    let cell = Cell::running(1, FleetFirmware::Current, &[SecurityPolicy::Basic256Sha256]).await;
    let mut listed = cell.fleet.listed();
    let port = listed[0].address.port();
    listed[0].address = format!("localhost:{port}").parse().unwrap();
    let (mut reports, _) =
        test_fleet::run(listed, cell.verify(None), cell.fleet.context(), CancellationToken::new(), |_| {}).await;
    let report = reports.remove(0).result.unwrap();
    assert!(report.url.starts_with("opc.tcp://localhost:"), "{}", report.url);
    let other = report.findings.iter().find(|finding| matches!(finding, VerifyFinding::OtherAddress { .. }));
    let Some(VerifyFinding::OtherAddress { url, reachable: true }) = other else { panic!("{report:?}") };
    assert!(url.starts_with("opc.tcp://127.0.0.1:"), "{url}");
    let refused = report.certificate.as_ref().unwrap().refused.clone().unwrap();
    assert_eq!(refused.status(), CertificateStatus::HostNameInvalid, "{refused:?}");
    assert!(!report.all_works());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_clock_that_is_wrong_is_noticed_and_named_as_the_reason() {
    let cell = Cell::running(1, FleetFirmware::Current, &[SecurityPolicy::Basic256Sha256]).await;
    cell.run(TrustConfigurator { identity: Workspace::new(cell.folder.path()).own_identity() }).await;
    assert!(cell.report(None).await.all_works());
    cell.fleet.controller(0).faults().update(|faults| faults.clock_offset = chrono::TimeDelta::days(4000));
    let report = cell.report(None).await;
    assert!(report.findings.iter().any(|finding| matches!(finding, VerifyFinding::Clock(_))), "{report:?}");
    let refused = verdict(&report, "Basic256Sha256 – SignAndEncrypt", TokenKind::Anonymous);
    let TokenOutcome::Fails(ConnectRefusal::OwnCertificate(Some(RefusalDetails { status, .. }))) = refused else {
        panic!("{refused:?}")
    };
    assert_eq!(*status, CertificateStatus::TimeInvalid);
    assert!(!report.lacks_trust(), "trusting it once more would not help");
}

#[tokio::test(flavor = "multi_thread")]
async fn an_expired_server_certificate_is_refused() {
    let cell = Cell { fleet: TestFleet::start(1, FleetFirmware::Current).await, folder: tempfile::tempdir().unwrap() };
    // Its clock stands still in the past, so that it takes its own certificate for valid.
    cell.fleet.controller(0).faults().update(|faults| faults.clock_offset = chrono::TimeDelta::days(-800));
    cell.run(certificate(KeyLength::Rsa2048)).await;
    cell.run(StartServer).await;
    let report = cell.report(None).await;
    let refused = report.certificate.as_ref().unwrap().refused.clone().unwrap();
    assert_eq!(refused.status(), CertificateStatus::TimeInvalid, "{refused:?}");
    assert!(!report.all_works());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_short_key_is_refused_by_who_wants_better() {
    let old = [SecurityPolicy::Basic128Rsa15, SecurityPolicy::Basic256];
    let cell = Cell { fleet: TestFleet::start(1, FleetFirmware::Legacy).await, folder: tempfile::tempdir().unwrap() };
    let change = BasicSettingsChange { security_policies: Some(old.into()), ..BasicSettingsChange::default() };
    cell.run(SetBasicSettings { change, ..SetBasicSettings::default() }).await;
    cell.run(certificate(KeyLength::Rsa1024)).await;
    cell.run(StartServer).await;
    let report = cell.report(None).await;
    assert_eq!(report.certificate.as_ref().unwrap().refused, None, "good enough for the old policies");
    let weak = |finding: &&VerifyFinding| matches!(finding, VerifyFinding::WeakPolicy(_));
    assert_eq!(report.findings.iter().filter(weak).count(), 2);
}

/// Lets everything through from an address of another computer.
async fn gateway(at: SocketAddr, to: SocketAddr) -> SocketAddr {
    let listener = TcpListener::bind(at).await.unwrap();
    let address = listener.local_addr().unwrap();
    tokio::spawn(async move {
        while let Ok((mut client, _)) = listener.accept().await {
            tokio::spawn(async move {
                let mut server = TcpStream::connect(to).await?;
                tokio::io::copy_bidirectional(&mut client, &mut server).await
            });
        }
    });
    address
}

fn opcua(fleet: &TestFleet, index: usize) -> SocketAddr {
    fleet.controller(index).endpoint().trim_start_matches("opc.tcp://").parse().unwrap()
}

/// The report about the first controller, known by an address where only its management answers.
async fn through_a_gateway(cell: &Cell, login: Option<&str>) -> VerifyReport {
    let management = gateway("127.0.0.2:0".parse().unwrap(), cell.fleet.controller(0).management_address()).await;
    let mut listed = cell.fleet.listed();
    listed.truncate(1);
    listed[0].address = management.to_string().parse().unwrap();
    let asked = Instant::now();
    let (mut reports, _) =
        test_fleet::run(listed, cell.verify(login), cell.fleet.context(), CancellationToken::new(), |_| {}).await;
    assert!(asked.elapsed() < Duration::from_secs(30), "{:?}", asked.elapsed());
    reports.remove(0).result.unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn who_answers_instead_of_the_server_is_found_out_in_seconds() {
    let cell = Cell::running(1, FleetFirmware::Current, &[SecurityPolicy::None]).await;
    let at = SocketAddr::new("127.0.0.2".parse().unwrap(), opcua(&cell.fleet, 0).port());
    let report = through_a_gateway(&cell, None).await;
    assert!(matches!(report.findings[..], [VerifyFinding::NoAnswer(ConnectRefusal::NotReachable(_))]), "{report:?}");
    for answer in [&b"HTTP/1.1 400 Bad Request\r\n\r\n"[..], b"", b"MSGF\xff\xff\xff\xff"] {
        let listener = TcpListener::bind(at).await.unwrap();
        let impostor = tokio::spawn(async move {
            let mut held = Vec::new();
            while let Ok((mut stream, _)) = listener.accept().await {
                let mut hello = [0; 1024];
                let _ = stream.read(&mut hello).await;
                let _ = stream.write_all(answer).await;
                held.push(stream);
            }
        });
        let report = through_a_gateway(&cell, None).await;
        let [VerifyFinding::NoAnswer(refusal)] = &report.findings[..] else { panic!("{report:?}") };
        assert!(matches!(refusal, ConnectRefusal::NotOpcUa(_) | ConnectRefusal::TimedOut), "{refusal:?}");
        impostor.abort();
        let _ = impostor.await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn another_server_in_the_place_of_the_controllers_gets_no_password() {
    let policies = [SecurityPolicy::None, SecurityPolicy::Basic256Sha256];
    let cell = Cell::running(2, FleetFirmware::Current, &policies).await;
    let at = SocketAddr::new("127.0.0.2".parse().unwrap(), opcua(&cell.fleet, 0).port());
    gateway(at, opcua(&cell.fleet, 1)).await;
    let report = through_a_gateway(&cell, Some("Passw0rd1")).await;
    let refused = report.certificate.as_ref().unwrap().refused.clone().unwrap();
    assert_eq!(refused.status(), CertificateStatus::Untrusted, "{refused:?}");
    let other = TokenOutcome::NotTried(NotTried::OtherCertificate);
    assert_eq!(*verdict(&report, "None", TokenKind::UserName), other);
    assert_eq!(*verdict(&report, "Basic256Sha256 – Sign", TokenKind::Anonymous), other);
    assert!(!report.all_works() && !report.lacks_trust());
}
