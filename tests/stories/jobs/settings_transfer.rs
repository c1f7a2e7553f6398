//! Settings exported to the PC and imported again: exactly, whole or not at all, and never into the wrong controller.

use std::collections::BTreeSet;
use std::path::PathBuf;

use opcua_configurator::jobs::{
    AddUser, BasicSettingsChange, ControllerReport, ExportSettings, ImportSettings, SelfSigned, SelfSignedFields,
    SetBasicSettings, SettingsExported, StartServer,
};
use opcua_configurator::model::{
    ErrorCode, KeyLength, SecurityPolicy, ServerPort, ServerSettings, ServerStatus, StartupMode, UserCredential,
    UserPassword, Validity,
};
use opcua_configurator::protocol::SettingsExport;
use opcua_configurator::virtual_controller::{ControllerState, DropPoint, FleetFirmware};
use opcua_configurator::workspace::Workspace;
use secrecy::SecretString;

use crate::common::test_fleet::{self, TestFleet};

fn user(name: &str) -> AddUser {
    AddUser {
        credential: UserCredential { name: name.parse().unwrap(), password: UserPassword::new("Passw0rd1").unwrap() },
        based_on: None,
    }
}

fn set(change: BasicSettingsChange) -> SetBasicSettings {
    SetBasicSettings {
        change,
        log_password: Some(ServerSettings::LOG_PASSWORD.to_owned()),
        ..SetBasicSettings::default()
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

fn codes<O>(reports: &[ControllerReport<O>]) -> Vec<Option<ErrorCode>> {
    reports.iter().map(|r| r.result.as_ref().err().map(|p| p.code)).collect()
}

/// A plant with a workspace to export to.
struct Office {
    fleet: TestFleet,
    folder: tempfile::TempDir,
    passphrase: Option<SecretString>,
}

impl Office {
    async fn new(count: usize, firmware: FleetFirmware) -> Self {
        let fleet = TestFleet::start(count, firmware).await;
        Self { fleet, folder: tempfile::tempdir().unwrap(), passphrase: Some("correct horse".into()) }
    }

    fn export(&self) -> ExportSettings {
        let files = Workspace::new(self.folder.path()).settings_files();
        ExportSettings { files, passphrase: self.passphrase.clone() }
    }

    fn import(&self) -> ImportSettings {
        let ExportSettings { files, passphrase } = self.export();
        ImportSettings { files, passphrase }
    }

    fn file(&self, index: usize) -> PathBuf {
        self.folder.path().join(self.fleet.controller(index).serial().as_str()).join("option.json")
    }

    /// What is exported, without the revision.
    fn exported(&self, index: usize) -> ControllerState {
        ControllerState { revision: 0, ..ControllerState::clone(&self.fleet.controller(index).state()) }
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_round_trip_restores_exactly_and_the_server_runs_again() {
    let office = Office::new(3, FleetFirmware::Legacy).await;
    let fleet = &office.fleet;
    fleet.run(certificate()).await;
    fleet.run(user("operator1")).await;
    fleet.run(user("operator2")).await;
    let change = BasicSettingsChange {
        startup: Some(StartupMode::Auto),
        security_policies: Some(BTreeSet::from([SecurityPolicy::Basic256Sha256])),
        server_log: Some(true),
        ..BasicSettingsChange::default()
    };
    assert_eq!(codes(&fleet.run(set(change)).await), [None; 3]);
    assert_eq!(codes(&fleet.run(StartServer).await), [None; 3]);
    let before: Vec<ControllerState> = (0..3).map(|index| office.exported(index)).collect();
    for (index, report) in fleet.run(office.export()).await.into_iter().enumerate() {
        let Ok(SettingsExported { path }) = report.result else { panic!("{report:?}") };
        assert_eq!(path, office.file(index));
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(!text.contains("operator1") && !text.contains("argon2id"), "{text}");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            assert_eq!(std::fs::metadata(path).unwrap().permissions().mode() & 0o777, 0o600);
        }
        assert_eq!(report.info.unwrap().status, ServerStatus::Run, "an export stops nothing");
    }

    let undo = BasicSettingsChange {
        startup: Some(StartupMode::Manual),
        security_policies: Some(BTreeSet::from([SecurityPolicy::None])),
        server_log: Some(false),
        ..BasicSettingsChange::default()
    };
    fleet.run(set(undo)).await;
    fleet.run(user("operator3")).await;
    let reports = fleet.run(office.import()).await;
    assert_eq!(codes(&reports), [None; 3]);
    for (index, report) in reports.iter().enumerate() {
        assert_eq!(office.exported(index), before[index]);
        assert_eq!(report.info.as_ref().unwrap().status, ServerStatus::Run);
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn without_a_passphrase_the_connection_password_protects_the_file() {
    let mut office = Office::new(1, FleetFirmware::Legacy).await;
    office.passphrase = None;
    office.fleet.run(office.export()).await;
    let export = SettingsExport::from_json(&std::fs::read(office.file(0)).unwrap()).unwrap();
    assert!(export.open(&test_fleet::PASSWORD.into()).is_ok());
    assert_eq!(codes(&office.fleet.run(office.import()).await), [None]);
    office.passphrase = Some("correct horse".into());
    assert_eq!(codes(&office.fleet.run(office.import()).await), [Some(ErrorCode::WrongPassphrase)]);
    office.passphrase = Some("short".into());
    assert_eq!(codes(&office.fleet.run(office.export()).await), [Some(ErrorCode::BadPassphrase)]);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_file_that_is_not_this_controllers_own_changes_nothing() {
    let office = Office::new(2, FleetFirmware::Legacy).await;
    let fleet = &office.fleet;
    let import = async || {
        let reports = fleet.run(office.import()).await;
        assert!((0..2).all(|index| fleet.controller(index).info().revision.number() == 1), "nothing was changed");
        codes(&reports)
    };
    assert_eq!(import().await, [Some(ErrorCode::ExportMissing); 2]);
    fleet.run(office.export()).await;
    let [first, second] = [0, 1].map(|index| std::fs::read(office.file(index)).unwrap());
    let write = |bytes: &[u8]| std::fs::write(office.file(0), bytes).unwrap();

    // Each in the other's folder.
    write(&second);
    std::fs::write(office.file(1), &first).unwrap();
    assert_eq!(import().await, [Some(ErrorCode::ExportOfAnother); 2]);

    let text = String::from_utf8(first.clone()).unwrap();
    write(&first[..first.len() / 2]);
    assert_eq!(import().await[0], Some(ErrorCode::ExportDamaged));
    write(text.replace("\"version\": 1", "\"version\": 2").as_bytes());
    assert_eq!(import().await[0], Some(ErrorCode::ExportVersion));
    let firmware = format!("\"{}\"", fleet.controller(0).firmware());
    write(text.replace(&firmware, "\"7.9.0\"").as_bytes());
    assert_eq!(import().await[0], Some(ErrorCode::ExportDamaged), "changed by hand");

    std::fs::remove_file(office.file(0)).unwrap();
    std::fs::write(office.file(0).with_file_name("option (1).json"), &first).unwrap();
    let reports = fleet.run(office.import()).await;
    let problem = reports[0].result.as_ref().unwrap_err();
    assert_eq!(problem.code, ErrorCode::ExportRenamed);
    assert!(problem.detail.as_ref().unwrap().contains("option (1).json"));
}

#[tokio::test(flavor = "multi_thread")]
async fn current_firmware_has_its_own_backup() {
    let office = Office::new(1, FleetFirmware::Current).await;
    assert_eq!(codes(&office.fleet.run(office.export()).await), [Some(ErrorCode::FirmwareTooNew)]);
    assert_eq!(codes(&office.fleet.run(office.import()).await), [Some(ErrorCode::FirmwareTooNew)]);
    assert!(!office.file(0).exists());
}

#[tokio::test(flavor = "multi_thread")]
async fn an_import_is_whole_or_not_at_all() {
    let office = Office::new(1, FleetFirmware::Legacy).await;
    let fleet = &office.fleet;
    fleet.run(certificate()).await;
    fleet.run(user("operator1")).await;
    fleet.run(StartServer).await;
    fleet.run(office.export()).await;
    let file = std::fs::read(office.file(0)).unwrap();

    fleet.run(user("operator2")).await;
    let port = fleet.controller(0).state().settings.port;
    let blocker = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let free = ServerPort::try_from(blocker.local_addr().unwrap().port()).unwrap();
    drop(blocker);
    fleet.run(set(BasicSettingsChange { port: Some(free), ..BasicSettingsChange::default() })).await;
    let before = fleet.controller(0).state();
    let unchanged = || assert_eq!(fleet.controller(0).state(), before);

    // Another program uses the port of then now, and the server is put back on its own.
    let blocker = std::net::TcpListener::bind(("127.0.0.1", port.get())).unwrap();
    let reports = fleet.run(office.import()).await;
    assert_eq!(codes(&reports), [Some(ErrorCode::PortConflict)]);
    assert_eq!(reports[0].info.as_ref().unwrap().status, ServerStatus::Run);
    unchanged();
    drop(blocker);

    fleet.controller(0).faults().update(|f| f.disk_full = true);
    assert_eq!(codes(&fleet.run(office.import()).await), [Some(ErrorCode::DiskFull)]);
    fleet.controller(0).faults().update(|f| f.disk_full = false);
    unchanged();
    fleet.controller(0).faults().update(|f| f.drop_next_change = Some(DropPoint::BeforeApply));
    assert_eq!(codes(&fleet.run(office.import()).await), [Some(ErrorCode::ConnectionLost)]);
    unchanged();
    fleet.controller(0).faults().update(|f| f.task_running = true);
    assert_eq!(codes(&fleet.run(office.import()).await), [Some(ErrorCode::TaskRunning)]);
    assert_eq!(codes(&fleet.run(office.export()).await), [None], "asking is allowed");
    fleet.controller(0).faults().update(|f| f.task_running = false);
    unchanged();

    std::fs::write(office.file(0), file).unwrap();
    assert_eq!(codes(&fleet.run(office.import()).await), [None]);
    let after = fleet.controller(0).state();
    assert_eq!((after.settings.port, after.users.len()), (port, 1));
}
