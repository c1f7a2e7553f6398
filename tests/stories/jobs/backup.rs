//! Keys on the PC: a certificate never stands beside a key that is not its own, and every backup can be put back.

use std::fs;
use std::path::{Path, PathBuf};

use opcua_configurator::jobs::{
    BackupRestored, CaSignedSource, CheckBackup, ControllerReport, CreateCsr, CsrFields, ExportSelfSigned,
    ExportSettings, ImportCaSigned, Operation, OperationOutput, RestoreBackup, SelectCertificateType, SelfSigned,
    SelfSignedFields, StartServer,
};
use opcua_configurator::model::{CertificateType, ErrorCode, FileFormat, KeyLength, ServerStatus, Validity};
use opcua_configurator::pki::{Certificate, Csr, pkcs12_read, pkcs12_read_key};
use opcua_configurator::session::Connector as _;
use opcua_configurator::virtual_controller::{DropPoint, FleetFirmware};
use opcua_configurator::workspace::{BackupKind, CertificateFiles, KeyBackupSource, Workspace};
use secrecy::SecretString;

use crate::common::ca::Ca;
use crate::common::test_fleet::{PASSWORD, TestFleet};

/// One controller, and the folder its files go to.
struct Bench {
    fleet: TestFleet,
    folder: tempfile::TempDir,
}

impl Bench {
    async fn new(firmware: FleetFirmware) -> Self {
        Self { fleet: TestFleet::start(1, firmware).await, folder: tempfile::tempdir().unwrap() }
    }

    fn files(&self) -> CertificateFiles {
        Workspace::new(self.folder.path()).certificate_files()
    }

    async fn run<O: OperationOutput>(&self, operation: impl Operation<Output = O> + 'static) -> ControllerReport<O> {
        self.fleet.run(operation).await.remove(0)
    }

    async fn done<O: OperationOutput>(&self, operation: impl Operation<Output = O> + 'static) -> O {
        self.run(operation).await.result.unwrap()
    }

    async fn refused(&self, operation: impl Operation + 'static) -> ErrorCode {
        self.run(operation).await.result.unwrap_err().code
    }

    fn self_signed(&self, backup: bool) -> SelfSigned {
        let fields = SelfSignedFields {
            common_name: None,
            country: "JP".into(),
            state: "Nagano".into(),
            locality: "Suwa".into(),
            organisation: "Example".into(),
            key_length: KeyLength::Rsa2048,
            validity: Validity::try_from(5).unwrap(),
        };
        SelfSigned { fields, backup: backup.then(|| self.files()) }
    }

    fn csr(&self, backup: bool) -> CreateCsr {
        let fields = CsrFields {
            common_name: None,
            country: "JP".into(),
            state: "Nagano".into(),
            locality: "Suwa".into(),
            organisation: "Example".into(),
            key_length: KeyLength::Rsa2048,
        };
        CreateCsr { fields, format: FileFormat::Der, files: self.files(), backup }
    }

    fn export(&self, format: FileFormat) -> ExportSelfSigned {
        ExportSelfSigned { format, files: self.files() }
    }

    fn import(&self) -> ImportCaSigned {
        ImportCaSigned { source: CaSignedSource::Folder(self.files()), accept_warnings: false }
    }

    fn restore(&self, kind: BackupKind) -> RestoreBackup {
        let source = KeyBackupSource { files: self.files(), kind, chosen: None };
        RestoreBackup { source, password: None, accept_warnings: false }
    }

    fn restore_from(&self, kind: BackupKind, file: &Path) -> RestoreBackup {
        let mut restore = self.restore(kind);
        restore.source.chosen = Some(file.to_owned());
        restore
    }

    /// A file below the controller's `Cert`.
    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(self.fleet.controller(0).serial().as_str()).join("Cert").join(name)
    }

    /// The files below the controller's `Cert`, dates of folders left out.
    fn listing(&self) -> Vec<String> {
        let mut found = Vec::new();
        let mut folders = vec![self.path("")];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path);
                } else {
                    let name = path.strip_prefix(self.path("")).unwrap().to_str().unwrap().to_owned();
                    let parts = name.split('/').map(|part| if part.starts_with("20") { "DATE" } else { part });
                    found.push(parts.collect::<Vec<_>>().join("/"));
                }
            }
        }
        found.retain(|name| name != ".lock");
        found.sort();
        found
    }

    /// Has the request signed, and the certificate imported.
    async fn sign(&self, ca: &Ca, name: &str) -> Vec<u8> {
        let csr = Csr::from_any(&fs::read(self.path("CSR/3_csr.der")).unwrap()).unwrap();
        let issued = ca.sign(&csr);
        fs::create_dir_all(self.path("CASigned")).unwrap();
        fs::write(self.path("CASigned").join(name), &issued).unwrap();
        self.done(self.import()).await;
        issued
    }

    fn in_use(&self) -> Option<(CertificateType, Vec<u8>)> {
        let state = self.fleet.controller(0).state();
        state.selected_certificate().map(|pair| (state.selected, pair.certificate.0.clone()))
    }

    fn status(&self) -> ServerStatus {
        self.fleet.controller(0).info().status
    }
}

fn moved(output: &impl OperationOutput) -> Vec<PathBuf> {
    output.facts().moved_aside.to_vec()
}

/// A key file holds the key of the certificate beside it.
fn is_pair(key: &Path, certificate: &Path) -> bool {
    let (_, chain) = pkcs12_read(&fs::read(key).unwrap(), PASSWORD).unwrap();
    chain[0] == Certificate::from_any(&fs::read(certificate).unwrap()).unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_new_certificate_never_stands_beside_the_old_key() {
    let bench = Bench::new(FleetFirmware::Legacy).await;
    assert!(moved(&bench.done(bench.self_signed(true)).await).is_empty());
    bench.done(bench.export(FileFormat::Pem)).await;
    let all = ["SelfSigned/1_cert.der", "SelfSigned/1_cert.pem", "SelfSigned/1_key.pfx"];
    assert_eq!(bench.listing(), all, "both formats of the same certificate, and its key");
    let first = bench.in_use().unwrap().1;

    // Backup off: the next certificate is exported only, in one format.
    bench.done(bench.self_signed(false)).await;
    assert_eq!(bench.listing(), all);
    let aside = moved(&bench.done(bench.export(FileFormat::Pem)).await);
    assert_eq!(aside.len(), 3);
    assert!(aside.iter().all(|file| file.is_file() && file.parent() == aside[0].parent()), "{aside:?}");
    assert!(aside[0].ends_with("1_key.pfx") && is_pair(&aside[0], &aside[0].with_file_name("1_cert.der")));
    let former = all.map(|name| name.replace("SelfSigned/", "SelfSigned/DATE/"));
    assert_eq!(bench.listing(), [&["SelfSigned/1_cert.pem".to_owned()], &former[..]].concat());
    assert!(moved(&bench.done(bench.export(FileFormat::Der)).await).is_empty(), "the same certificate");

    // Backup on again: the certificate without key makes room, and the old pair stays what it is.
    let aside_too = moved(&bench.done(bench.self_signed(true)).await);
    assert_eq!(aside_too.len(), 2);
    assert_ne!(aside_too[0].parent(), aside[0].parent());
    assert!(is_pair(&bench.path("SelfSigned/1_key.pfx"), &bench.path("SelfSigned/1_cert.der")));

    // The old pair is put back from its folder.
    bench.done(bench.restore_from(BackupKind::SelfSigned, &aside[0])).await;
    assert_eq!(bench.in_use(), Some((CertificateType::SelfSigned, first)));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_key_of_another_certificate_is_found_out_by_opening_it() {
    let bench = Bench::new(FleetFirmware::Legacy).await;
    bench.done(bench.self_signed(true)).await;
    let key = fs::read(bench.path("SelfSigned/1_key.pfx")).unwrap();
    bench.done(bench.self_signed(false)).await;
    bench.done(bench.export(FileFormat::Der)).await;
    // As earlier versions left them.
    fs::write(bench.path("SelfSigned/1_key.pfx"), &key).unwrap();
    let aside = moved(&bench.done(bench.export(FileFormat::Der)).await);
    assert!(matches!(&aside[..], [key] if key.ends_with("1_key.pfx")), "{aside:?}");
    // One that the connection password does not open stays with the certificate it stands beside.
    fs::write(bench.path("SelfSigned/1_key.pfx"), "sealed").unwrap();
    assert!(moved(&bench.done(bench.export(FileFormat::Der)).await).is_empty());
    fs::remove_file(bench.path("SelfSigned/1_cert.der")).unwrap();
    assert_eq!(moved(&bench.done(bench.export(FileFormat::Der)).await).len(), 1, "beside no certificate");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_new_request_never_stands_beside_the_old_key_or_certificate() {
    for firmware in [FleetFirmware::Legacy, FleetFirmware::Current] {
        let legacy = firmware == FleetFirmware::Legacy;
        let bench = Bench::new(firmware).await;
        let ca = Ca::new();
        bench.done(bench.csr(true)).await;
        let first = bench.sign(&ca, "from_ca.der").await;
        // Of no request that was made here.
        let other = Bench::new(firmware).await;
        other.done(other.csr(false)).await;
        let stranger = other.sign(&ca, "other.der").await;
        fs::write(bench.path("CASigned/stranger.cer"), stranger).unwrap();

        let aside = moved(&bench.done(bench.csr(false)).await);
        let mut former = vec!["CASigned/DATE/from_ca.der", "CSR/DATE/3_csr.der"];
        if legacy {
            former.insert(1, "CASigned/DATE/3_key.pfx");
        }
        assert_eq!(aside.len(), former.len());
        former.extend(["CASigned/stranger.cer", "CSR/3_csr.der"]);
        former.sort_unstable();
        assert_eq!(bench.listing(), former);
        bench.sign(&ca, "from_ca.der").await;
        assert!(moved(&bench.done(bench.csr(true)).await).len() >= 2, "a former one without a key");
        if legacy {
            let key = fs::read(bench.path("CASigned/3_key.pfx")).unwrap();
            let csr = Csr::from_any(&fs::read(bench.path("CSR/3_csr.der")).unwrap()).unwrap();
            assert!(csr.is_of(&pkcs12_read_key(&key, PASSWORD).unwrap()));
            // The old pair is put back from its folder, with the certificate that was issued for it.
            bench.done(bench.restore_from(BackupKind::CaSigned, &aside[0])).await;
            assert_eq!(bench.in_use(), Some((CertificateType::CaSigned, first)));
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn every_backup_of_a_key_is_put_back_as_what_it_was_made_as() {
    let bench = Bench::new(FleetFirmware::Legacy).await;
    bench.done(bench.self_signed(true)).await;
    bench.done(bench.csr(true)).await;
    let (self_signed, ca) = (bench.in_use().unwrap(), Ca::new());
    let issued = bench.sign(&ca, "from_ca.der").await;
    bench.done(StartServer).await;

    // The controller loses both: other keys, made without backup.
    bench.done(bench.self_signed(false)).await;
    assert_ne!(bench.in_use(), Some(self_signed.clone()));
    let elsewhere = tempfile::tempdir().unwrap();
    let files = Workspace::new(elsewhere.path()).certificate_files();
    bench.done(CreateCsr { files, ..bench.csr(false) }).await;
    assert_eq!(bench.refused(SelectCertificateType(CertificateType::CaSigned)).await, ErrorCode::CertificateNotStored);

    let checked = bench.done(CheckBackup { source: bench.restore(BackupKind::SelfSigned).source, password: None });
    assert!(checked.await.summary.is_some());
    let restored = bench.done(bench.restore(BackupKind::SelfSigned)).await;
    let BackupRestored { summary: Some(summary), findings } = restored else { panic!("{restored:?}") };
    assert_eq!(findings, []);
    assert_eq!(bench.in_use(), Some(self_signed.clone()), "type 1, and in use");
    assert_eq!(summary, Certificate::from_der(&self_signed.1).unwrap().summary());
    assert_eq!(bench.status(), ServerStatus::Run);

    bench.done(bench.restore(BackupKind::CaSigned)).await;
    assert_eq!(bench.in_use(), Some((CertificateType::CaSigned, issued.clone())));
    assert_eq!(bench.status(), ServerStatus::Run, "in one change");
    // Key and request are there as well: the CA renews for them.
    bench.sign(&ca, "from_ca.der").await;

    // A request that no CA has answered yet comes back too, and its certificate can be imported.
    fs::remove_file(bench.path("CASigned/from_ca.der")).unwrap();
    let elsewhere = tempfile::tempdir().unwrap();
    bench.done(CreateCsr { files: Workspace::new(elsewhere.path()).certificate_files(), ..bench.csr(false) }).await;
    let restored = bench.done(bench.restore(BackupKind::CaSigned)).await;
    assert!(restored.summary.is_none());
    bench.sign(&ca, "from_ca.der").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_request_restored_for_the_same_key_leaves_the_certificate_in_use() {
    let bench = Bench::new(FleetFirmware::Legacy).await;
    bench.done(bench.csr(true)).await;
    let issued = bench.sign(&Ca::new(), "from_ca.der").await;
    bench.done(StartServer).await;
    fs::remove_file(bench.path("CASigned/from_ca.der")).unwrap();
    bench.done(bench.restore(BackupKind::CaSigned)).await;
    assert_eq!(bench.in_use(), Some((CertificateType::CaSigned, issued)));
    assert_eq!(bench.status(), ServerStatus::Run);
}

#[tokio::test(flavor = "multi_thread")]
async fn what_cannot_be_put_back_changes_nothing() {
    let bench = Bench::new(FleetFirmware::Legacy).await;
    let kinds = [BackupKind::SelfSigned, BackupKind::CaSigned];
    for kind in kinds {
        assert_eq!(bench.refused(bench.restore(kind)).await, ErrorCode::FileNotFound);
    }
    bench.done(bench.self_signed(true)).await;
    bench.done(bench.csr(true)).await;
    bench.done(StartServer).await;
    let before = bench.fleet.controller(0).state();
    for kind in kinds {
        let wrong = RestoreBackup { password: Some("wrong".into()), ..bench.restore(kind) };
        assert_eq!(bench.refused(wrong).await, ErrorCode::WrongKeyPassword);
    }
    // Each under the other's type.
    let keys = ["SelfSigned/1_key.pfx", "CASigned/3_key.pfx"].map(|name| bench.path(name));
    assert_eq!(bench.refused(bench.restore_from(kinds[0], &keys[1])).await, ErrorCode::BadCertificate);
    assert_eq!(bench.refused(bench.restore_from(kinds[1], &keys[0])).await, ErrorCode::FileNotFound);
    // That of another controller.
    let other = TestFleet::start(2, FleetFirmware::Legacy).await;
    let of_second = RestoreBackup { source: bench.restore_from(kinds[0], &keys[0]).source, ..bench.restore(kinds[0]) };
    let report = &other.run(of_second).await[1];
    assert_eq!(report.result.as_ref().unwrap_err().code, ErrorCode::Preflight, "{report:?}");

    let faults = bench.fleet.controller(0).faults();
    faults.update(|f| f.disk_full = true);
    for kind in kinds {
        assert_eq!(bench.refused(bench.restore(kind)).await, ErrorCode::DiskFull);
    }
    faults.update(|f| f.disk_full = false);
    faults.update(|f| f.drop_next_change = Some(DropPoint::BeforeApply));
    assert_eq!(bench.refused(bench.restore(BackupKind::CaSigned)).await, ErrorCode::ConnectionLost);
    assert_eq!(bench.fleet.controller(0).state(), before);
    assert_eq!(bench.status(), ServerStatus::Run);

    let current = Bench::new(FleetFirmware::Current).await;
    for kind in kinds {
        assert_eq!(current.refused(current.restore(kind)).await, ErrorCode::FirmwareTooNew);
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn an_empty_connection_password_protects_no_file() {
    let bench = Bench {
        fleet: TestFleet::without_password(1, FleetFirmware::Legacy).await,
        folder: tempfile::tempdir().unwrap(),
    };
    let revision = bench.fleet.controller(0).info().revision;
    let files = Workspace::new(bench.folder.path()).settings_files();
    let export = |passphrase| ExportSettings { files: files.clone(), passphrase };
    assert_eq!(bench.refused(bench.self_signed(true)).await, ErrorCode::UnprotectedFile);
    assert_eq!(bench.refused(bench.csr(true)).await, ErrorCode::UnprotectedFile);
    assert_eq!(bench.refused(export(None)).await, ErrorCode::UnprotectedFile);
    assert_eq!(bench.fleet.controller(0).info().revision, revision, "nothing was changed");
    assert!(!bench.folder.path().join(bench.fleet.controller(0).serial().as_str()).exists());

    // What needs no protection, or has another, is done.
    bench.done(bench.self_signed(false)).await;
    bench.done(bench.export(FileFormat::Der)).await;
    bench.done(bench.csr(false)).await;
    bench.done(export(Some("correct horse".into()))).await;

    // The controller seals nothing under an empty passphrase either.
    let listed = &bench.fleet.listed()[0];
    let (fingerprint, empty) = (listed.fingerprint.unwrap(), SecretString::default());
    let mut session = bench.fleet.connector.connect(&listed.address, fingerprint, &empty.clone().into()).await.unwrap();
    let refused = session.export_settings(empty).await.unwrap_err();
    assert_eq!(refused.code, ErrorCode::BadPassphrase);
    session.close().await;

    // Keys of current firmware do not come to the PC, so there is nothing to protect.
    let current = Bench {
        fleet: TestFleet::without_password(1, FleetFirmware::Current).await,
        folder: tempfile::tempdir().unwrap(),
    };
    current.done(current.self_signed(true)).await;
    current.done(current.csr(true)).await;
    assert_eq!(current.listing(), ["CSR/3_csr.der", "SelfSigned/1_cert.der"]);
}
