//! Server certificates from elsewhere: asked for, signed, looked at, imported, selected and exported.

use std::fs;
use std::path::Path;

use opcua_configurator::jobs::{
    CaSignedSource, CertificateChecked, CertificateExported, CertificateImported, CheckCaSigned, CheckUserSpecified,
    ControllerReport, CreateCsr, CsrFields, CsrSaved, ExportSelfSigned, ImportCaSigned, ImportUserSpecified,
    ListCertificates, NoOutput, SelectCertificateType, SelfSigned, SelfSignedFields, StartServer, UserSpecifiedFiles,
};
use opcua_configurator::model::{
    CertificateType, ErrorCode, FileFormat, KeyLength, ServerStatus, StoredServerCertificates, Validity,
};
use opcua_configurator::pki::{
    Certificate, CertificateFinding, CertificateFlaw, Csr, PrivateKey, Severity, pkcs12_read_key, pkcs12_write,
};
use opcua_configurator::virtual_controller::{DropPoint, FleetFirmware};
use opcua_configurator::workspace::{CertificateFiles, Workspace};
use rcgen::{CertificateParams, ExtendedKeyUsagePurpose, KeyUsagePurpose, SanType};
use time::{Duration, OffsetDateTime};

use crate::common::ca::Ca;
use crate::common::test_fleet::{self, TestFleet};

fn files(folder: &Path) -> CertificateFiles {
    Workspace::new(folder).certificate_files()
}

fn csr(files: &CertificateFiles) -> CreateCsr {
    CreateCsr {
        fields: CsrFields {
            common_name: None,
            country: "JP".into(),
            state: "Nagano".into(),
            locality: "Suwa".into(),
            organisation: "Example".into(),
            key_length: KeyLength::Rsa2048,
        },
        format: FileFormat::Der,
        files: files.clone(),
        backup: false,
    }
}

fn self_signed() -> SelfSigned {
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

fn import(files: &CertificateFiles) -> ImportCaSigned {
    ImportCaSigned { source: CaSignedSource::Folder(files.clone()), accept_warnings: false }
}

fn codes<O>(reports: &[ControllerReport<O>]) -> Vec<Option<ErrorCode>> {
    reports.iter().map(|r| r.result.as_ref().err().map(|p| p.code)).collect()
}

fn saved_csr(report: &ControllerReport<CsrSaved>) -> Csr {
    let Ok(CsrSaved { saved, .. }) = &report.result else { panic!("{report:?}") };
    Csr::from_any(&fs::read(&saved.csr).unwrap()).unwrap()
}

/// Puts a certificate where the import looks for it.
fn put<O>(files: &CertificateFiles, report: &ControllerReport<O>, certificate: &[u8]) {
    let folder = files.ca_signed_folder(&report.info.as_ref().unwrap().serial);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("from_ca.der"), certificate).unwrap();
}

async fn held(fleet: &TestFleet) -> Vec<StoredServerCertificates> {
    fleet.run(ListCertificates).await.into_iter().map(|report| report.result.unwrap().value).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn from_a_csr_to_a_running_server_with_a_ca_signed_certificate() {
    let fleet = TestFleet::start(3, FleetFirmware::Mixed).await;
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    assert_eq!(codes(&fleet.run(import(&files)).await), [Some(ErrorCode::FileNotFound); 3], "nothing there");
    let (ca, reports) = (Ca::new(), fleet.run(csr(&files)).await);
    for report in &reports {
        let Ok(CsrSaved { common_name, saved }) = &report.result else { panic!("{report:?}") };
        let info = report.info.as_ref().unwrap();
        assert_eq!((common_name, &saved.key), (&info.application_name, &None));
        assert_eq!(saved.csr, folder.path().join(info.serial.as_str()).join("Cert/CSR/3_csr.der"));
        put(&files, report, &ca.sign(&saved_csr(report)));
    }
    for report in fleet.run(import(&files)).await {
        let Ok(CertificateImported { summary, findings, .. }) = &report.result else { panic!("{report:?}") };
        assert_eq!((summary.issued_by.as_str(), findings.as_slice()), ("Plant CA", &[][..]));
        let in_use = report.info.unwrap().certificate.unwrap();
        assert_eq!((in_use.kind, &in_use.summary), (CertificateType::CaSigned, summary));
    }
    let reports = fleet.run(StartServer).await;
    assert!(reports.iter().all(|r| r.info.as_ref().unwrap().status == ServerStatus::Run), "{reports:?}");

    // The CA renews for the same key, and the server takes it over as it runs.
    for report in &reports {
        let path = files.csr_folder(&report.info.as_ref().unwrap().serial).join("3_csr.der");
        put(&files, report, &ca.sign(&Csr::from_any(&fs::read(path).unwrap()).unwrap()));
    }
    let renewed = fleet.run(import(&files)).await;
    assert!(renewed.iter().all(|r| r.result.is_ok() && r.info.as_ref().unwrap().status == ServerStatus::Run));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_new_csr_leaves_the_certificate_alone_on_current_firmware_and_takes_it_away_on_legacy() {
    for (firmware, legacy) in [(FleetFirmware::Current, false), (FleetFirmware::Legacy, true)] {
        let fleet = TestFleet::start(1, firmware).await;
        let folder = tempfile::tempdir().unwrap();
        let files = files(folder.path());
        let ca = Ca::new();
        let first = &fleet.run(csr(&files)).await[0];
        let former = ca.sign(&saved_csr(first));
        put(&files, first, &former);
        assert_eq!(codes(&fleet.run(import(&files)).await), [None]);
        fleet.run(StartServer).await;

        // A change that breaks off leaves both as they were.
        fleet.controller(0).faults().update(|f| f.disk_full = true);
        assert_eq!(codes(&fleet.run(csr(&files)).await), [Some(ErrorCode::DiskFull)]);
        fleet.controller(0).faults().update(|f| f.disk_full = false);
        fleet.controller(0).faults().update(|f| f.drop_next_change = Some(DropPoint::BeforeApply));
        assert_eq!(codes(&fleet.run(csr(&files)).await), [Some(ErrorCode::ConnectionLost)]);
        assert_eq!(fleet.controller(0).info().status, ServerStatus::Run);
        assert!(held(&fleet).await[0].of(CertificateType::CaSigned).is_some());

        let second = &fleet.run(csr(&files)).await[0];
        let held = &held(&fleet).await[0];
        let info = second.info.as_ref().unwrap();
        assert_eq!(held.of(CertificateType::CaSigned).is_none(), legacy);
        assert_eq!(held.csr.as_ref().map(|c| c.0.as_slice()), Some(saved_csr(second).der()));
        assert_eq!(info.status, if legacy { ServerStatus::Stop } else { ServerStatus::Run });
        let expected = if legacy { Some(ErrorCode::NoCertificate) } else { None };
        assert_eq!(codes(&fleet.run(StartServer).await), [expected]);
        // The former certificate was moved aside with its request. It does not fit the new key.
        assert_eq!(codes(&fleet.run(import(&files)).await), [Some(ErrorCode::FileNotFound)]);
        put(&files, second, &former);
        assert_eq!(codes(&fleet.run(import(&files)).await), [Some(ErrorCode::CsrMismatch)]);
        put(&files, second, &ca.sign(&saved_csr(second)));
        assert_eq!(codes(&fleet.run(import(&files)).await), [None]);
        assert_eq!(codes(&fleet.run(StartServer).await), [None]);
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_csr_is_saved_in_the_format_asked_for_and_the_key_only_for_legacy_firmware_with_backup() {
    let fleet = TestFleet::start(2, FleetFirmware::Mixed).await;
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    fleet.run(csr(&files)).await;
    let pem = CreateCsr { format: FileFormat::Pem, backup: true, ..csr(&files) };
    for (index, report) in fleet.run(pem).await.iter().enumerate() {
        let Ok(CsrSaved { saved, .. }) = &report.result else { panic!("{report:?}") };
        let in_folder = fs::read_dir(saved.csr.parent().unwrap()).unwrap().map(|e| e.unwrap().path());
        let files: Vec<_> = in_folder.filter(|path| path.is_file()).collect();
        assert_eq!(files, std::slice::from_ref(&saved.csr), "the former request made room");
        let [former] = &saved.moved_aside[..] else { panic!("{saved:?}") };
        assert!(former.is_file() && former.ends_with("3_csr.der") && !former.ends_with("CSR/3_csr.der"));
        assert!(fs::read_to_string(&saved.csr).unwrap().starts_with("-----BEGIN CERTIFICATE REQUEST-----\n"));
        let legacy = fleet.controller(index).firmware().to_string().starts_with('7');
        assert_eq!(saved.key.is_some(), legacy);
        if let Some(key) = &saved.key {
            assert!(key.ends_with("Cert/CASigned/3_key.pfx"));
            let key = pkcs12_read_key(&fs::read(key).unwrap(), test_fleet::PASSWORD).unwrap();
            assert!(saved_csr(report).is_of(&key));
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn the_wrong_certificate_for_a_csr_is_refused_with_its_reason() {
    let fleet = TestFleet::start(2, FleetFirmware::Mixed).await;
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let ca = Ca::new();
    let before = fleet.run(csr(&files)).await;
    let csrs: Vec<Csr> = before.iter().map(saved_csr).collect();
    for (index, report) in before.iter().enumerate() {
        put(&files, report, &ca.sign(&csrs[1 - index]));
    }
    assert_eq!(codes(&fleet.run(import(&files)).await), [Some(ErrorCode::CsrMismatch); 2], "the other's");

    type Change = fn(&mut CertificateParams);
    let uri = |p: &mut CertificateParams| p.subject_alt_names.retain(|name| !matches!(name, SanType::URI(_)));
    let client = |p: &mut CertificateParams| p.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth];
    let usage = |p: &mut CertificateParams| p.key_usages = vec![KeyUsagePurpose::DigitalSignature];
    let past = |p: &mut CertificateParams| p.not_after = OffsetDateTime::now_utc() - Duration::minutes(1);
    let future = |p: &mut CertificateParams| p.not_before = OffsetDateTime::now_utc() + Duration::days(3);
    let changes: [(Change, ErrorCode, &str); 5] = [
        (uri, ErrorCode::Preflight, "BadCertificateUriInvalid"),
        (client, ErrorCode::Preflight, "not for servers"),
        (usage, ErrorCode::Preflight, "keyEncipherment, dataEncipherment"),
        (past, ErrorCode::CertificateExpired, "valid until"),
        (future, ErrorCode::Preflight, "BadCertificateTimeInvalid"),
    ];
    for (change, code, detail) in changes {
        for (report, csr) in before.iter().zip(&csrs) {
            put(&files, report, &ca.sign_changed(csr, change));
        }
        for report in fleet.run(ImportCaSigned { accept_warnings: true, ..import(&files) }).await {
            let problem = report.result.unwrap_err();
            assert_eq!(problem.code, code, "{problem}");
            assert!(problem.detail.as_ref().unwrap().contains(detail), "{problem}");
        }
    }
    for junk in [&b"hello"[..], b"", csrs[0].der()] {
        before.iter().for_each(|report| put(&files, report, junk));
        assert_eq!(codes(&fleet.run(import(&files)).await), [Some(ErrorCode::FileFormat); 2]);
    }
    for (report, index) in before.iter().zip(0..) {
        assert_eq!(fleet.controller(index).info().revision, report.info.as_ref().unwrap().revision, "nothing changed");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn what_clients_may_complain_about_is_asked_first() {
    let fleet = TestFleet::start(1, FleetFirmware::Current).await;
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let ca = Ca::new();
    let made = &fleet.run(csr(&files)).await[0];
    let nowhere = |p: &mut CertificateParams| p.subject_alt_names.retain(|name| matches!(name, SanType::URI(_)));
    put(&files, made, &ca.sign_changed(&saved_csr(made), nowhere));
    let checked = &fleet.run(CheckCaSigned(CaSignedSource::Folder(files.clone()))).await[0];
    let Ok(CertificateChecked { findings, .. }) = &checked.result else { panic!("{checked:?}") };
    let [CertificateFinding { flaw: CertificateFlaw::HostName { .. }, severity: Severity::Warning }] = &findings[..]
    else {
        panic!("{findings:?}")
    };

    let refused = &fleet.run(import(&files)).await[0];
    let problem = refused.result.as_ref().unwrap_err();
    assert_eq!(problem.code, ErrorCode::PreflightWarnings);
    assert!(problem.detail.as_ref().unwrap().contains("BadCertificateHostNameInvalid"), "{problem}");
    assert_eq!(fleet.controller(0).info().certificate, None, "nothing was sent");

    let accepted = &fleet.run(ImportCaSigned { accept_warnings: true, ..import(&files) }).await[0];
    assert!(
        matches!(&accepted.result, Ok(CertificateImported { findings, .. }) if findings.len() == 1),
        "{accepted:?}"
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn a_certificate_without_a_csr_and_too_many_files_are_refused() {
    let fleet = TestFleet::start(1, FleetFirmware::Current).await;
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let made = &fleet.run(self_signed()).await[0];
    let serial = &made.info.as_ref().unwrap().serial;
    let certificate = fleet.controller(0).state().certificates[&CertificateType::SelfSigned].certificate.0.clone();
    put(&files, made, &certificate);
    assert_eq!(codes(&fleet.run(import(&files)).await), [Some(ErrorCode::NoCsr)]);
    fs::write(files.ca_signed_folder(serial).join("another.der"), &certificate).unwrap();
    assert_eq!(codes(&fleet.run(import(&files)).await), [Some(ErrorCode::SeveralFiles)]);
    fs::remove_file(files.ca_signed_folder(serial).join("another.der")).unwrap();
    let plain = files.ca_signed_folder(serial).join("from_ca.der");
    fs::rename(&plain, plain.with_file_name("from ca.der")).unwrap();
    assert_eq!(codes(&fleet.run(import(&files)).await), [Some(ErrorCode::BadFileName)]);
    // A chosen file may have any name, and be PEM.
    let pem = folder.path().join("证书 1.crt");
    fs::write(&pem, Certificate::from_der(&certificate).unwrap().to_pem()).unwrap();
    let source = CaSignedSource::File(pem);
    assert_eq!(codes(&fleet.run(ImportCaSigned { source, ..import(&files) }).await), [Some(ErrorCode::NoCsr)]);
}

#[tokio::test(flavor = "multi_thread")]
async fn only_a_type_that_is_held_can_be_selected() {
    let fleet = TestFleet::start(2, FleetFirmware::Mixed).await;
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    fleet.run(self_signed()).await;
    fleet.run(StartServer).await;
    let select = |kind| fleet.run(SelectCertificateType(kind));
    assert_eq!(codes(&select(CertificateType::CaSigned).await), [Some(ErrorCode::CertificateNotStored); 2]);
    for (index, code) in codes(&select(CertificateType::UserSpecified).await).into_iter().enumerate() {
        let legacy = fleet.controller(index).firmware().to_string().starts_with('7');
        let expected = if legacy { ErrorCode::CertificateNotStored } else { ErrorCode::FirmwareTooNew };
        assert_eq!(code, Some(expected));
    }
    let ca = Ca::new();
    for report in fleet.run(csr(&files)).await {
        put(&files, &report, &ca.sign(&saved_csr(&report)));
    }
    fleet.run(import(&files)).await;
    for kind in [CertificateType::SelfSigned, CertificateType::CaSigned, CertificateType::SelfSigned] {
        for report in select(kind).await {
            assert_eq!(report.result, Ok(NoOutput));
            let info = report.info.unwrap();
            assert_eq!((info.certificate.unwrap().kind, info.status), (kind, ServerStatus::Run));
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_self_signed_certificate_is_exported_in_both_formats() {
    let fleet = TestFleet::start(2, FleetFirmware::Mixed).await;
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let export = |format| ExportSelfSigned { format, files: files.clone() };
    assert_eq!(codes(&fleet.run(export(FileFormat::Der)).await), [Some(ErrorCode::CertificateNotStored); 2]);
    fleet.run(self_signed()).await;
    for format in FileFormat::ALL {
        for report in fleet.run(export(format)).await {
            let Ok(CertificateExported { summary, saved }) = &report.result else { panic!("{report:?}") };
            let info = report.info.unwrap();
            let expected = format!("{}/Cert/SelfSigned/1_cert.{}", info.serial, format.extension());
            assert_eq!(saved.file, folder.path().join(expected));
            assert!(saved.moved_aside.is_empty(), "the same certificate in another format");
            assert_eq!(&Certificate::from_any(&fs::read(&saved.file).unwrap()).unwrap().summary(), summary);
            assert_eq!(info.certificate.unwrap().summary, *summary);
        }
    }
}

/// A certificate made with another tool, for what the controller is called.
fn made_elsewhere(fleet: &TestFleet, key: &PrivateKey, change: impl FnOnce(&mut CertificateParams)) -> Certificate {
    let mut params = CertificateParams::default();
    let uri = format!("urn:{}", fleet.controller(0).info().application_name);
    let address = SanType::IpAddress("127.0.0.1".parse().unwrap());
    params.subject_alt_names = vec![SanType::URI(uri.try_into().unwrap()), address];
    params.key_usages = vec![
        KeyUsagePurpose::DigitalSignature,
        KeyUsagePurpose::ContentCommitment,
        KeyUsagePurpose::KeyEncipherment,
        KeyUsagePurpose::DataEncipherment,
    ];
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth];
    params.not_before = OffsetDateTime::now_utc() - Duration::hours(1);
    params.not_after = OffsetDateTime::now_utc() + Duration::days(365);
    change(&mut params);
    Certificate::from_der(params.self_signed(key).unwrap().der()).unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn key_and_certificate_of_another_tool_are_imported_from_one_file_or_two() {
    let fleet = TestFleet::start(1, FleetFirmware::Legacy).await;
    let folder = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let serial = fleet.controller(0).serial();
    let key = PrivateKey::generate(KeyLength::Rsa2048).unwrap();
    let certificate = made_elsewhere(&fleet, &key, |_| {});
    let pfx = pkcs12_write("robot", &key, &[&certificate], "Größe 1").unwrap();
    assert_eq!(UserSpecifiedFiles::pfx_in(&files, &serial).unwrap_err().code, ErrorCode::FileNotFound);
    let inbox = files.user_specified_folder(&serial);
    fs::create_dir_all(&inbox).unwrap();
    fs::write(inbox.join("robot_7.pfx"), pfx).unwrap();
    fs::write(inbox.join("robot_7.der"), certificate.der()).unwrap();
    fs::write(inbox.join("robot_7.key"), &*key.to_pkcs8_der().unwrap()).unwrap();
    let from_pfx = ImportUserSpecified {
        files: UserSpecifiedFiles::pfx_in(&files, &serial).unwrap(),
        password: Some("Größe 1".into()),
        accept_warnings: false,
    };
    let pair = UserSpecifiedFiles::pair_in(&files, &serial).unwrap();
    let from_pair = ImportUserSpecified { files: pair, password: None, accept_warnings: false };
    fleet.run(self_signed()).await;
    fleet.run(StartServer).await;
    for operation in [from_pfx.clone(), from_pair] {
        fleet.run(SelectCertificateType(CertificateType::SelfSigned)).await;
        let report = &fleet.run(operation).await[0];
        let Ok(CertificateImported { findings, .. }) = &report.result else { panic!("{report:?}") };
        let info = report.info.clone().unwrap();
        let in_use = info.certificate.unwrap();
        assert_eq!((in_use.kind, in_use.summary), (CertificateType::UserSpecified, certificate.summary()));
        assert_eq!((info.status, findings.as_slice()), (ServerStatus::Run, &[][..]));
    }
    let current = TestFleet::start(1, FleetFirmware::Current).await;
    assert_eq!(codes(&current.run(from_pfx).await), [Some(ErrorCode::FirmwareTooNew)]);
}

#[tokio::test(flavor = "multi_thread")]
async fn every_mistake_with_another_tools_files_has_its_own_message() {
    let fleet = TestFleet::start(1, FleetFirmware::Legacy).await;
    let folder = tempfile::tempdir().unwrap();
    let key = PrivateKey::generate(KeyLength::Rsa2048).unwrap();
    let short = PrivateKey::generate(KeyLength::Rsa1024).unwrap();
    let good = made_elsewhere(&fleet, &key, |_| {});
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    let pfx_of = |name: &str, key: &PrivateKey, certificate: &Certificate| {
        UserSpecifiedFiles::Pfx(file(name, &pkcs12_write("robot", key, &[certificate], "right").unwrap()))
    };
    let pair = |certificate: &Certificate| UserSpecifiedFiles::Pair {
        certificate: file("a.der", certificate.der()),
        key: file("a.key", &key.to_pkcs8_der().unwrap()),
    };
    let whole = pkcs12_write("robot", &key, &[&good], "right").unwrap();
    let expired = made_elsewhere(&fleet, &key, |p| p.not_after = OffsetDateTime::now_utc() - Duration::minutes(1));
    let stranger = made_elsewhere(&fleet, &key, |p| drop(p.subject_alt_names.remove(0)));
    let before = fleet.controller(0).info().revision;
    for (files, password, code) in [
        (pfx_of("wrong.pfx", &key, &good), "wrong", ErrorCode::WrongKeyPassword),
        (UserSpecifiedFiles::Pfx(file("cut.pfx", &whole[..whole.len() - 9])), "right", ErrorCode::FileFormat),
        (UserSpecifiedFiles::Pfx(file("no.pfx", good.der())), "right", ErrorCode::FileFormat),
        (UserSpecifiedFiles::Pfx(folder.path().join("nowhere.pfx")), "right", ErrorCode::FileNotFound),
        (pair(&made_elsewhere(&fleet, &short, |_| {})), "", ErrorCode::KeyMismatch),
        (pfx_of("expired.pfx", &key, &expired), "right", ErrorCode::CertificateExpired),
        (pfx_of("short.pfx", &short, &made_elsewhere(&fleet, &short, |_| {})), "right", ErrorCode::KeyLengthNotAllowed),
        (pfx_of("stranger.pfx", &key, &stranger), "right", ErrorCode::Preflight),
    ] {
        let operation = ImportUserSpecified {
            files: files.clone(),
            password: Some(password.to_owned().into()),
            accept_warnings: true,
        };
        let problem = fleet.run(operation).await.remove(0).result.unwrap_err();
        assert_eq!(problem.code, code, "{files:?}: {problem}");
        assert!(!problem.to_string().contains("right"), "a password in {problem}");
    }
    assert_eq!(fleet.controller(0).info().revision, before, "nothing was sent");

    let files = pfx_of("stranger.pfx", &key, &stranger);
    let checked = fleet.run(CheckUserSpecified { files, password: Some("right".into()) }).await.remove(0);
    let Ok(CertificateChecked { findings, .. }) = &checked.result else { panic!("{checked:?}") };
    assert!(
        matches!(&findings[..], [CertificateFinding { flaw: CertificateFlaw::UriMissing { .. }, .. }]),
        "{findings:?}"
    );
}
