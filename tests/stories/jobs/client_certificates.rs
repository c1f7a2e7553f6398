//! Client certificate lists and CRLs: jobs against virtual controllers whose OPC UA servers let in real clients, or do
//! not.

use std::time::{Duration, Instant};

use opcua_configurator::jobs::{
    AddTrust, BasicSettingsChange, ControllerReport, Destination, ListTrust, MoveClients, RemoveClients, RemoveCrls,
    SelfSigned, SelfSignedFields, SetBasicSettings, StartServer, TrustChange, TrustFile, TrustSnapshot, TrustUndo,
    UndoTrust, WatchEvent, watch_trust,
};
use opcua_configurator::model::{
    CertificateStatus, ClientList, ErrorCode, KeyLength, ListLimits, ServerStatus, UserTokenPolicy, Validity,
};
use opcua_configurator::pki::{Bundle, Certificate, Crl, CrlDates, CrlIssuer, read_bundle};
use opcua_configurator::virtual_controller::{DropPoint, FaultSwitches, FleetFirmware};
use opcua_configurator::workspace::Passwords as _;
use tokio::sync::mpsc::{UnboundedReceiver, unbounded_channel};
use tokio_util::sync::CancellationToken;

use crate::common::clients::{self, Authority, Client, TestApplication};
use crate::common::test_fleet::{self, TestFleet};

fn file(certificates: &[&Certificate], crls: &[&Crl]) -> TrustFile {
    let certificates = certificates.iter().copied().cloned().collect();
    let crls = crls.iter().copied().cloned().collect();
    TrustFile { file_name: "file.pem".to_owned(), bundle: Bundle { certificates, crls } }
}

fn add(destination: Destination, files: Vec<TrustFile>) -> AddTrust {
    AddTrust { files: files.into(), destination, based_on: None }
}

fn trust(client: &TestApplication) -> AddTrust {
    add(Destination::Trusted, vec![file(&[&client.certificate], &[])])
}

fn remove(thumbprint: String) -> RemoveClients {
    RemoveClients { list: None, thumbprints: vec![thumbprint], based_on: None }
}

fn undo(fleet: &TestFleet, index: usize, undo: TrustUndo) -> UndoTrust {
    UndoTrust([(fleet.listed()[index].name.clone(), undo)].into())
}

fn code<O: std::fmt::Debug>(report: &ControllerReport<O>) -> ErrorCode {
    report.result.as_ref().expect_err("a failure").code
}

fn changed(report: &ControllerReport<TrustChange>) -> &TrustChange {
    report.result.as_ref().unwrap()
}

async fn lists(fleet: &TestFleet) -> TrustSnapshot {
    fleet.run(ListTrust).await.remove(0).result.unwrap()
}

fn counts(lists: &TrustSnapshot) -> [usize; 4] {
    [lists.trusted.len(), lists.issuers.len(), lists.rejected.len(), lists.crls.len()]
}

/// A running OPC UA server in every controller.
async fn running(count: usize, firmware: FleetFirmware) -> TestFleet {
    let fleet = TestFleet::start(count, firmware).await;
    let fields = SelfSignedFields {
        common_name: None,
        country: "JP".into(),
        state: String::new(),
        locality: String::new(),
        organisation: String::new(),
        key_length: KeyLength::Rsa2048,
        validity: Validity::try_from(1).unwrap(),
    };
    for report in fleet.run(SelfSigned { fields, backup: None }).await {
        report.result.unwrap();
    }
    let change = BasicSettingsChange {
        user_tokens: Some([UserTokenPolicy::Anonymous].into()),
        ..BasicSettingsChange::default()
    };
    for report in fleet.run(SetBasicSettings { change, ..SetBasicSettings::default() }).await {
        report.result.unwrap();
    }
    for report in fleet.run(StartServer).await {
        assert_eq!(report.info.unwrap().status, ServerStatus::Run);
    }
    fleet
}

#[tokio::test(flavor = "multi_thread")]
async fn a_chain_and_its_crl_go_where_they_belong_and_back_again() {
    let fleet = TestFleet::start(2, FleetFirmware::Mixed).await;
    let ca = Authority::new("Plant CA");
    let client = ca.client("line-1", 7);
    let crl = ca.crl(1, &[]);
    let p7b = clients::p7b(&Bundle {
        certificates: vec![client.certificate.clone(), ca.certificate.clone()],
        crls: vec![crl.clone()],
    });
    let chain = TrustFile { file_name: "chain.p7b".to_owned(), bundle: read_bundle(&p7b).unwrap() };
    let reports = fleet.run(add(Destination::ByKind, vec![chain])).await;
    for report in &reports {
        let legacy = report.info.as_ref().unwrap().limits
            == ListLimits::of(opcua_configurator::model::FirmwareGeneration::Legacy);
        let change = changed(report);
        assert_eq!(counts(&change.lists), if legacy { [2, 0, 0, 1] } else { [1, 1, 0, 1] });
        assert_eq!(change.lists.trusted[0].certificate.0, client.certificate.der());
        assert_eq!(change.lists.crls[0].summary, crl.summary());
        assert_eq!(change.lists.crls[0].file_name, "chain_3.crl");
        let health = &change.lists.health;
        assert_eq!(health.crls[0].issuer, CrlIssuer::Held { thumbprint: ca.certificate.thumbprint_sha1() });
        assert_eq!((health.crls[0].dates, health.without_crl.len()), (CrlDates::Current, 0));
        assert_eq!(report.info.as_ref().unwrap().revision.number(), 2, "one change");
    }

    let undos =
        fleet.listed().into_iter().map(|c| c.name).zip(reports.iter().map(|r| changed(r).undo.clone().unwrap()));
    let undone = fleet.run(UndoTrust(undos.collect())).await;
    assert!(undone.iter().all(|report| counts(&changed(report).lists) == [0; 4]));
    let again = fleet.run(undo(&fleet, 1, changed(&undone[1]).undo.clone().unwrap())).await;
    assert_eq!(code(&again[0]), ErrorCode::Refused, "nothing was done there");
    let (before, after) = (&changed(&reports[1]).lists, &changed(&again[1]).lists);
    assert_eq!(counts(after), counts(before));
    assert_eq!(after.trusted[0].file_name, before.trusted[0].file_name);
}

#[tokio::test(flavor = "multi_thread")]
async fn limits_and_doubles_are_found_before_anything_is_sent() {
    for (firmware, limit) in [(FleetFirmware::Legacy, 10), (FleetFirmware::Current, 50)] {
        let fleet = TestFleet::start(1, firmware).await;
        let ca = Authority::new("Plant CA");
        let one = TestApplication::new("one");
        assert_eq!(counts(&changed(&fleet.run(trust(&one)).await[0]).lists), [1, 0, 0, 0]);
        assert_eq!(code(&fleet.run(trust(&one)).await[0]), ErrorCode::DuplicateCertificate);
        // Many, cheaply: what the authority says of itself in a year's time is another certificate.
        let many: Vec<TrustFile> = (0..limit)
            .map(|serial| {
                let mut der = one.certificate.der().to_vec();
                let end = der.len();
                der[end - 2..].copy_from_slice(&u16::to_be_bytes(serial));
                file(&[&Certificate::from_der(&der).unwrap()], &[])
            })
            .collect();
        let full = add(Destination::Trusted, many[1..].to_vec());
        assert_eq!(code(&fleet.run(add(Destination::Trusted, many.clone())).await[0]), ErrorCode::ListFull);
        assert_eq!(fleet.controller(0).info().revision.number(), 2, "nothing was sent");
        assert_eq!(changed(&fleet.run(full).await[0]).lists.trusted.len(), usize::from(limit));
        let mut known = fleet.listed();
        known[0].known = Some(fleet.controller(0).info());
        fleet.controller(0).faults().update(|faults| faults.refuse = true);
        let over = add(Destination::Trusted, many.iter().cloned().chain([file(&[&ca.certificate], &[])]).collect());
        let (reports, _) = test_fleet::run(known, over, fleet.context(), CancellationToken::new(), |_| {}).await;
        assert_eq!((code(&reports[0]), reports[0].info.is_none()), (ErrorCode::ListFull, true), "not even connected");
        fleet.controller(0).faults().update(|faults| *faults = FaultSwitches::default());
        let issuers = &fleet.run(add(Destination::Issuers, vec![file(&[&ca.certificate], &[])])).await[0];
        match firmware {
            FleetFirmware::Legacy => assert_eq!(code(issuers), ErrorCode::FirmwareTooOld),
            _ => assert_eq!(changed(issuers).lists.issuers.len(), 1),
        }
        let leaf = &fleet
            .run(add(Destination::Issuers, vec![file(&[&TestApplication::new("leaf").certificate], &[])]))
            .await[0];
        let expected =
            if firmware == FleetFirmware::Legacy { ErrorCode::FirmwareTooOld } else { ErrorCode::NotAnAuthority };
        assert_eq!(code(leaf), expected);
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stranger_shows_at_once_is_let_in_by_a_move_and_thrown_out_by_the_next() {
    let fleet = running(1, FleetFirmware::Current).await;
    let endpoint = fleet.controller(0).endpoint();
    let mut watch = Watch::start(&fleet);
    assert_eq!(counts(&watch.lists().await), [0; 4]);

    let stranger = TestApplication::new("stranger");
    assert!(Client::connect(&endpoint, &stranger).await.is_err());
    let knocked = Instant::now();
    let seen = watch.lists().await;
    assert!(knocked.elapsed() < Duration::from_secs(20), "{:?}", knocked.elapsed());
    let [refused] = &seen.rejected[..] else { panic!("{seen:?}") };
    assert_eq!((refused.status, refused.address.as_str()), (CertificateStatus::Untrusted, "127.0.0.1"));
    assert_eq!((refused.summary.thumbprint.clone(), refused.count >= 1), (stranger.thumbprint(), true));

    let (from, to) = (ClientList::Rejected, ClientList::Trusted);
    let thumbprints = vec![stranger.thumbprint()];
    let welcome =
        MoveClients { from, to, thumbprints: thumbprints.clone(), accept_notes: false, based_on: Some(seen.revision) };
    let moved = fleet.run(welcome.clone()).await.remove(0);
    assert_eq!(counts(&changed(&moved).lists), [1, 0, 0, 0]);
    assert_eq!(changed(&moved).lists.trusted[0].file_name, "stranger.der");
    assert_eq!(code(&fleet.run(welcome).await[0]), ErrorCode::NotInList);
    let inside = Client::connect(&endpoint, &stranger).await.expect("trusted now");
    assert_eq!(fleet.controller(0).info().status, ServerStatus::Run);

    let away = MoveClients { from: to, to: from, thumbprints, accept_notes: false, based_on: None };
    let report = fleet.run(away).await.remove(0);
    let TrustChange { lists, cut, undo: back } = changed(&report);
    assert_eq!(counts(lists), [0, 0, 1, 0]);
    let [cut] = &cut[..] else { panic!("{cut:?}") };
    assert_eq!((cut.issued_to.as_str(), cut.status), ("stranger", CertificateStatus::Untrusted));
    assert!(cut.address.starts_with("127.0.0.1:"), "{}", cut.address);
    inside.ended().await;
    assert!(Client::connect(&endpoint, &stranger).await.is_err());

    let undone = fleet.run(undo(&fleet, 0, back.clone().unwrap())).await.remove(0);
    assert_eq!(counts(&changed(&undone).lists), [1, 0, 0, 0]);
    Client::connect(&endpoint, &stranger).await.expect("trusted again").close().await;
    watch.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_crl_throws_out_whom_it_revokes_and_an_older_one_is_refused() {
    let fleet = running(1, FleetFirmware::Current).await;
    let endpoint = fleet.controller(0).endpoint();
    let ca = Authority::new("Plant CA");
    let (good, bad) = (ca.client("good", 7), ca.client("bad", 8));
    let (first, second) = (ca.crl(1, &[]), ca.crl(2, &[&bad]));
    let anchors = add(Destination::Trusted, vec![file(&[&ca.certificate], &[])]);
    let report = fleet.run(anchors).await.remove(0);
    assert_eq!(changed(&report).lists.health.without_crl, [ca.certificate.thumbprint_sha1()]);
    assert!(Client::connect(&endpoint, &good).await.is_err(), "nobody knows whether it was revoked");
    assert_eq!(lists(&fleet).await.rejected[0].status, CertificateStatus::RevocationUnknown);

    let crl = |crl: &Crl| add(Destination::Crls, vec![file(&[], &[crl])]);
    let report = fleet.run(crl(&first)).await.remove(0);
    assert_eq!(changed(&report).lists.health.without_crl.len(), 0);
    let good_inside = Client::connect(&endpoint, &good).await.expect("not revoked");
    let bad_inside = Client::connect(&endpoint, &bad).await.expect("not revoked yet");

    let report = fleet.run(crl(&second)).await.remove(0);
    let TrustChange { lists: now, cut, undo: back } = changed(&report);
    assert_eq!(now.crls.iter().map(|held| held.summary.id.clone()).collect::<Vec<_>>(), [second.id()]);
    assert_eq!(cut.iter().map(|cut| cut.status).collect::<Vec<_>>(), [CertificateStatus::Revoked]);
    bad_inside.ended().await;
    assert_eq!(code(&fleet.run(crl(&first)).await[0]), ErrorCode::CrlOutdated);
    assert_eq!(code(&fleet.run(crl(&second)).await[0]), ErrorCode::DuplicateCrl);

    let undone = fleet.run(undo(&fleet, 0, back.clone().unwrap())).await.remove(0);
    assert_eq!(changed(&undone).lists.crls[0].summary, first.summary());
    Client::connect(&endpoint, &bad).await.expect("as before").close().await;

    let gone = fleet.run(RemoveCrls { ids: vec![first.id()], based_on: None }).await.remove(0);
    let statuses: Vec<_> = changed(&gone).cut.iter().map(|cut| (cut.issued_to.as_str(), cut.status)).collect();
    assert_eq!(statuses, [("good", CertificateStatus::RevocationUnknown)]);
    good_inside.ended().await;
    let missing = fleet.run(RemoveCrls { ids: vec![first.id()], based_on: None }).await.remove(0);
    assert_eq!(code(&missing), ErrorCode::NotInList);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_dialog_that_shows_what_is_no_more_changes_nothing() {
    let fleet = TestFleet::start(1, FleetFirmware::Current).await;
    let (one, two) = (TestApplication::new("one"), TestApplication::new("two"));
    let shown = lists(&fleet).await.revision;
    changed(&fleet.run(trust(&one)).await[0]);
    let late = AddTrust { based_on: Some(shown), ..trust(&two) };
    assert_eq!(code(&fleet.run(late).await[0]), ErrorCode::ChangedMeanwhile);
    let late = RemoveClients { based_on: Some(shown), ..remove(one.thumbprint()) };
    assert_eq!(code(&fleet.run(late).await[0]), ErrorCode::ChangedMeanwhile);
    assert_eq!(code(&fleet.run(remove(two.thumbprint())).await[0]), ErrorCode::NotInList);
    assert_eq!(counts(&lists(&fleet).await), [1, 0, 0, 0]);
    let removed = fleet.run(remove(one.thumbprint())).await.remove(0);
    let undone = fleet.run(undo(&fleet, 0, changed(&removed).undo.clone().unwrap())).await.remove(0);
    assert_eq!(changed(&undone).lists.trusted[0].file_name, "file.pem");
}

#[tokio::test(flavor = "multi_thread")]
async fn one_controller_failing_does_not_stop_the_others() {
    let fleet = TestFleet::start(3, FleetFirmware::Current).await;
    fleet.controller(0).faults().update(|faults| faults.task_running = true);
    fleet.controller(1).faults().update(|faults| faults.drop_next_change = Some(DropPoint::BeforeApply));
    let one = TestApplication::new("one");
    let reports = fleet.run(trust(&one)).await;
    assert_eq!((code(&reports[0]), code(&reports[1])), (ErrorCode::TaskRunning, ErrorCode::ConnectionLost));
    assert_eq!(changed(&reports[2]).lists.trusted.len(), 1);
    assert_eq!(fleet.controller(1).state().trusted, []);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_watch_outlives_its_session_and_ends_where_trying_again_is_no_use() {
    let fleet = running(1, FleetFirmware::Current).await;
    let mut watch = Watch::start(&fleet);
    watch.lists().await;
    // Others can do their work meanwhile, and what they do shows.
    changed(&fleet.run(trust(&TestApplication::new("one"))).await[0]);
    assert_eq!(watch.lists().await.trusted.len(), 1);
    let asked = Instant::now();
    watch.stop().await;
    assert!(asked.elapsed() < Duration::from_secs(20), "{:?}", asked.elapsed());

    fleet.passwords.set(fleet.controller(0).fingerprint(), "wrong".into()).unwrap();
    let mut watch = Watch::start(&fleet);
    match watch.event().await {
        WatchEvent::Ended(problem) => assert_eq!(problem.code, ErrorCode::WrongPassword),
        other => panic!("{other:?}"),
    }
    watch.task.await.unwrap();
    fleet.passwords.set(fleet.controller(0).fingerprint(), test_fleet::PASSWORD.into()).unwrap();
    let mut watch = Watch::start(&fleet);
    watch.lists().await;
    fleet.controller(0).shutdown().await;
    match watch.event().await {
        WatchEvent::Lost(_) => {}
        other => panic!("{other:?}"),
    }
    watch.stop().await;
}

struct Watch {
    events: UnboundedReceiver<WatchEvent>,
    cancel: CancellationToken,
    task: tokio::task::JoinHandle<()>,
}

impl Watch {
    fn start(fleet: &TestFleet) -> Self {
        let (sender, events) = unbounded_channel();
        let cancel = CancellationToken::new();
        let watch = watch_trust(fleet.listed().remove(0), fleet.context(), cancel.clone(), move |event| {
            let _ = sender.send(event);
        });
        Self { events, cancel, task: tokio::spawn(watch) }
    }

    async fn event(&mut self) -> WatchEvent {
        tokio::time::timeout(Duration::from_secs(20), self.events.recv()).await.expect("an event").expect("a watch")
    }

    async fn lists(&mut self) -> TrustSnapshot {
        match self.event().await {
            WatchEvent::Lists(lists) => *lists,
            other => panic!("{other:?}"),
        }
    }

    async fn stop(self) {
        self.cancel.cancel();
        self.task.await.unwrap();
    }
}
