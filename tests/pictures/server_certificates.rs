//! The certificate dialogs as they look.

use opcua_configurator::jobs::{CertificateChecked, CertificateExported};
use opcua_configurator::model::{
    Base64Bytes, CertificateSummary, CertificateType, ControllerSeries, ErrorCode, KeyLength, Problem, RevisionToken,
    Revisioned, SelfSignedRequest, ServerSettings, StoredServerCertificate, StoredServerCertificates, Subject,
    Validity,
};
use opcua_configurator::pki::{
    Certificate, CertificateFinding, CertificateFlaw, Issuers, KeyUsage, PrivateKey, ServerNames, Severity, self_signed,
};
use opcua_configurator::ui::backend::RecordingBackend;
use opcua_configurator::workspace::SavedFile;

use crate::harness::{SIZE, choose, click, now, type_into, window};
use crate::pictures::{W, assert_shows, chinese, end_job, fail, finish, picture, tick};
use crate::samples::{configuration, info};

/// Of current firmware, and of legacy firmware.
const CURRENT: &str = "Weld 1";
const LEGACY: &str = "Weld 2";

fn open(ticked: &[&str]) -> W {
    let mut window = window(RecordingBackend::default(), configuration(24, now()), SIZE);
    tick(&mut window, ticked);
    window
}

/// A certificate whose visible parts are the same in every picture.
fn certificate() -> Base64Bytes {
    let subject = Subject {
        common_name: "EpsonRC.SN0000123.192.168.010.001".into(),
        country: String::new(),
        state: String::new(),
        locality: String::new(),
        organisation: "Example".into(),
    };
    let key = PrivateKey::generate(KeyLength::Rsa2048).unwrap();
    let validity = Validity::try_from(5).unwrap();
    let request = SelfSignedRequest { subject, key_length: KeyLength::Rsa2048, validity };
    let names = ServerNames { application_uri: "urn:EpsonRC.SN0000123".into(), ips: vec![], dns: vec!["weld".into()] };
    Base64Bytes(self_signed(&request, &names, &key, now()).unwrap().der().to_vec())
}

fn held(kinds: &[CertificateType], selected: CertificateType) -> Revisioned<StoredServerCertificates> {
    let certificate = certificate();
    let held =
        kinds.iter().map(|kind| StoredServerCertificate { kind: *kind, certificate: certificate.clone() }).collect();
    Revisioned { revision: RevisionToken::new(4), value: StoredServerCertificates { selected, held, csr: None } }
}

#[test]
fn type_select() {
    use CertificateType::{CaSigned, SelfSigned};
    let mut window = open(&[CURRENT]);
    choose(&mut window, &["Certificate", "Type select…"]);
    finish(&mut window, vec![Ok(held(&[SelfSigned], SelfSigned))]);
    click(&mut window, "CA signed");
    click(&mut window, "Cancel");
    click(&mut window, &format!("Tick {CURRENT}"));
    for name in [LEGACY, "Weld 10"] {
        click(&mut window, &format!("Tick {name}"));
    }
    choose(&mut window, &["Certificate", "Type select…"]);
    finish(&mut window, vec![Ok(held(&[SelfSigned, CaSigned], CaSigned)), Ok(held(&[SelfSigned], SelfSigned))]);
    click(&mut window, "CA signed");
    assert_shows(&window, "Not stored in Weld 10");
    chinese(&mut window);
    picture(&mut window, "type_select_many_chinese");
}

#[test]
fn export_self_signed() {
    let mut window = open(&[CURRENT]);
    choose(&mut window, &["Certificate", "Export self-signed…"]);
    assert_shows(&window, "SN0000123/Cert/SelfSigned");
    click(&mut window, "Cancel");
    click(&mut window, &format!("Tick {LEGACY}"));
    choose(&mut window, &["Certificate", "Export self-signed…"]);
    click(&mut window, "pem");
    click(&mut window, "Export");
    assert_shows(&window, "they are moved into a folder named after their date");
    click(&mut window, "Export");
    let file = window.state().model.workspace.root().join("SN0000123/Cert/SelfSigned/1_cert.pem");
    let moved_aside = vec![file.with_file_name("20260301_120000").join("1_cert.pem")];
    let exported = CertificateExported { summary: summary(), saved: SavedFile { file, moved_aside } };
    finish(&mut window, vec![Ok(exported), Err(ErrorCode::CertificateNotStored.into())]);
    assert_shows(&window, "Cert/SelfSigned/20260301_120000");
}

#[test]
fn ca_signed() {
    let mut window = open(&[CURRENT]);
    choose(&mut window, &["Certificate", "Create and save", "CA signed…"]);
    assert_shows(&window, "1. Create CSR");
    click(&mut window, "Create CSR…");
    let settings = Revisioned { revision: RevisionToken::new(4), value: ServerSettings::default() };
    finish(&mut window, vec![Ok(settings)]);
    picture(&mut window, "csr");
    click(&mut window, "Create and save");
    assert_shows(&window, "they are moved into a folder named after their date");
    for button in ["Cancel", "Cancel"] {
        click(&mut window, button);
    }
    click(&mut window, "Import…");
    let hosts = CertificateFlaw::HostName { hosts: vec!["192.168.10.1".into()], names: vec!["192.168.0.1".into()] };
    let hosts = CertificateFinding { flaw: hosts, severity: Severity::Warning };
    finish(&mut window, vec![checked(vec![hosts])]);
    assert_shows(&window, "BadCertificateHostNameInvalid");
}

#[test]
fn ca_signed_for_many() {
    let mut window = open(&[CURRENT, LEGACY, "Weld 10", "Paint booth"]);
    choose(&mut window, &["Certificate", "Create and save", "CA signed…"]);
    chinese(&mut window);
    assert_shows(&window, "/home/engineer/EpsonRC80/OPCUA/<控制器序列号>/Cert/CASigned");
    click(&mut window, "导入…");
    let not_after = now() - chrono::Duration::days(3);
    finish(
        &mut window,
        vec![
            checked(vec![]),
            checked(vec![
                CertificateFinding {
                    flaw: CertificateFlaw::Expired { until: not_after, now: now() },
                    severity: Severity::Error,
                },
                CertificateFinding {
                    flaw: CertificateFlaw::KeyUsageLacks { missing: vec![KeyUsage::NonRepudiation] },
                    severity: Severity::Warning,
                },
            ]),
            Err(Problem::with_detail(ErrorCode::FileNotFound, "Cert/CASigned: no .der")),
            Err(ErrorCode::CsrMismatch.into()),
        ],
    );
    picture(&mut window, "import_many_chinese");
}

#[test]
fn user_specified() {
    let mut window = open(&[LEGACY]);
    choose(&mut window, &["Certificate", "Create and save", "User specified…"]);
    assert_shows(&window, "SN0001460/Cert/UserSpecified");
    click(&mut window, "Certificate and key (.der, .key)");
    type_into(&mut window, "Certificate file", "/media/usb/robot.der");
    picture(&mut window, "user_specified_pair");
    type_into(&mut window, "Key file", "/media/usb/robot.key");
    click(&mut window, "Import…");
    fail(&mut window, 0, ErrorCode::KeyMismatch);
    end_job(&mut window, 0, 1, 0);
    assert_shows(&window, "The certificate and the private key are not a pair");
}

#[test]
fn the_chain_before_an_import() {
    let mut window = open(&[CURRENT]);
    choose(&mut window, &["Certificate", "Create and save", "CA signed…"]);
    click(&mut window, "Import…");
    let issuers =
        Issuers { chain: vec![ca("Plant CA", Some("Works root"), 2024), ca("Works root", None, 2020)], complete: true };
    finish(&mut window, vec![checked_with(vec![], Some(issuers.clone()))]);
    picture(&mut window, "import_chain");
    click(&mut window, "Cancel");
    chinese(&mut window);
    click(&mut window, "导入…");
    let issuers = Issuers { chain: issuers.chain[..1].to_vec(), complete: false };
    finish(&mut window, vec![checked_with(vec![], Some(issuers))]);
    assert_shows(&window, "Plant CA，颁发者 Works root");
}

/// A certificate of an authority, valid for five years, whose visible parts are the same in every picture.
#[test]
fn restore() {
    let mut window = open(&[LEGACY]);
    choose(&mut window, &["Certificate", "Restore backup…"]);
    picture(&mut window, "restore");
    click(&mut window, "CSR, its key and the certificate from the CA (3_key.pfx)");
    click(&mut window, "Restore…");
    finish(&mut window, vec![Ok(CertificateChecked { summary: None, findings: vec![], issuers: None })]);
    assert_shows(&window, "CSR and key, without a certificate from the CA");
    click(&mut window, "Cancel");
    click(&mut window, "Cancel");
    click(&mut window, "Tick Palletiser south");
    choose(&mut window, &["Certificate", "Restore backup…"]);
    chinese(&mut window);
    assert_shows(&window, "恢复备份 – 2 台控制器");
}

fn ca(name: &str, by: Option<&str>, from: i32) -> Certificate {
    let params = |name: &str| {
        let mut params = rcgen::CertificateParams::default();
        params.distinguished_name.push(rcgen::DnType::CommonName, name);
        params.not_before = rcgen::date_time_ymd(from, 3, 1);
        params.not_after = rcgen::date_time_ymd(from + 5, 3, 1);
        params
    };
    let key = rcgen::KeyPair::generate().unwrap();
    let made = match by {
        None => params(name).self_signed(&key).unwrap(),
        Some(by) => params(name).signed_by(&key, &rcgen::Issuer::new(params(by), &key)).unwrap(),
    };
    Certificate::from_der(made.der()).unwrap()
}

fn checked(findings: Vec<CertificateFinding>) -> Result<CertificateChecked, Problem> {
    checked_with(findings, None)
}

fn checked_with(findings: Vec<CertificateFinding>, issuers: Option<Issuers>) -> Result<CertificateChecked, Problem> {
    let summary = CertificateSummary { issued_by: "Plant CA".into(), ..summary() };
    Ok(CertificateChecked { summary: Some(summary), findings, issuers })
}

fn summary() -> CertificateSummary {
    info(0, now(), ControllerSeries::Rc800).certificate.expect("a certificate").summary
}
