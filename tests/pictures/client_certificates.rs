//! The dialogs about client certificates and CRLs as they look.

use opcua_configurator::jobs::{TrustChange, TrustFile, TrustSnapshot, WatchEvent};
use opcua_configurator::model::{
    CertificateStatus, DisconnectedClient, ErrorCode, FirmwareGeneration, Problem, RevisionToken,
};
use opcua_configurator::pki::{Certificate, read_bundle};
use opcua_configurator::ui::backend::{BackendCommand, BackendEvent, RecordingBackend};
use opcua_configurator::ui::model::{JobId, Message, ReadTrustFile};
use opcua_configurator::ui::reduce;
use opcua_configurator::ui::{DetailsView, TrustAction};
use opcua_configurator::workspace::ThemeChoice;

use crate::authority::{Authority, p7b};
use crate::harness::{SIZE, choose, click, now, settle, type_into, window};
use crate::pictures::{W, assert_shows, chinese, finish, picture, say, tell, tick};
use crate::samples::configuration;
use crate::trust_samples;

/// Of current firmware, and of legacy firmware.
const CURRENT: &str = "Weld 1";
const LEGACY: &str = "Weld 2";

fn open(ticked: &[&str], size: [f32; 2]) -> W {
    let mut window = window(RecordingBackend::default(), configuration(24, now()), size);
    tick(&mut window, ticked);
    window
}

/// The dialog of one controller, which holds this.
fn lists(name: &str, item: [&str; 2], held: TrustSnapshot, size: [f32; 2]) -> W {
    let mut window = open(&[name], size);
    choose(&mut window, &item);
    finish(&mut window, vec![Ok(held)]);
    window
}

const CLIENTS: [&str; 2] = ["Certificate", "Client certificates…"];
const CRLS: [&str; 2] = ["Certificate", "CRL…"];

fn watch(window: &W) -> JobId {
    let watching = |command: &BackendCommand| match command {
        BackendCommand::WatchTrust { job, .. } => Some(*job),
        _ => None,
    };
    window.state().backend.sent.iter().rev().find_map(watching).expect("the lists are watched")
}

/// What a change came to.
fn changed(lists: TrustSnapshot, cut: Vec<DisconnectedClient>) -> TrustChange {
    TrustChange { lists, cut, undo: None }
}

fn cut(n: usize, name: &str, status: CertificateStatus) -> DisconnectedClient {
    let address = format!("192.168.10.{n}:50{n}12");
    DisconnectedClient { address, issued_to: name.to_owned(), thumbprint: trust_samples::thumbprint(n), status }
}

/// A client that tries to connect.
fn newcomer(window: &mut W) {
    let mut held = trust_samples::fleet(now());
    let client =
        trust_samples::refused(14, "Robot cell viewer", "Robot cell viewer", CertificateStatus::Untrusted, 1, 0, now());
    held.rejected.insert(0, client);
    let job = watch(window);
    tell(window, BackendEvent::TrustSeen { job, event: WatchEvent::Lists(Box::new(held)) });
}

#[test]
fn client_certificates() {
    let mut window = lists(CURRENT, CLIENTS, trust_samples::fleet(now()), SIZE);
    assert_shows(&window, "Old visualisation");
    newcomer(&mut window);
    click(&mut window, "Tick Quality station 7");
    assert_shows(&window, "1 new");
    chinese(&mut window);
    say(&mut window, Message::SetTheme(ThemeChoice::Dark));
    picture(&mut window, "trust_newcomer_dark");
}

#[test]
fn client_certificates_in_a_small_window() {
    let mut window = lists(CURRENT, CLIENTS, trust_samples::fleet(now()), [900.0, 500.0]);
    newcomer(&mut window);
    picture(&mut window, "trust_small");
    click(&mut window, "Rejected");
    click(&mut window, "Tick HMI line 1");
    assert_shows(&window, "From 192.168.10.13, 3021 times");
}

#[test]
fn empty_lists() {
    let window = lists(LEGACY, CLIENTS, trust_samples::nothing(FirmwareGeneration::Legacy, now()), SIZE);
    assert_shows(&window, "0 of 10");
}

#[test]
fn no_crls() {
    let window = lists(CURRENT, CRLS, trust_samples::nothing(FirmwareGeneration::Current, now()), SIZE);
    assert_shows(&window, "No CRLs. Without one");
}

#[test]
fn changes() {
    let mut window = lists(CURRENT, CLIENTS, trust_samples::fleet(now()), SIZE);
    click(&mut window, "Tick HMI line 3");
    click(&mut window, "Tick Old visualisation");
    click(&mut window, "Trusted: Delete…");
    assert_shows(&window, "4 of 50, 2 ticked");
    click(&mut window, "Delete");
    let mut held = trust_samples::fleet(now() - chrono::Duration::days(2));
    held.revision = RevisionToken::new(5);
    held.trusted.retain(|listed| listed.summary.issued_to.len() > 17);
    let gone = vec![
        cut(3, "HMI line 3", CertificateStatus::Untrusted),
        cut(4, "Old visualisation", CertificateStatus::Untrusted),
    ];
    finish(&mut window, vec![Ok(changed(held, gone))]);
    let job = watch(&window);
    tell(&mut window, BackendEvent::TrustSeen { job, event: WatchEvent::Lost(ErrorCode::Timeout.into()) });
    assert_shows(&window, "HMI line 3 (192.168.10.3:50312)");
    chinese(&mut window);
    picture(&mut window, "trust_cut_chinese");
}

#[test]
fn crls() {
    let mut window = lists(CURRENT, CRLS, trust_samples::fleet(now()), SIZE);
    click(&mut window, "Tick Plant issuing CA 1");
    assert_shows(&window, "expired, get a new one (covers Plant issuing CA 1)");
    chinese(&mut window);
    picture(&mut window, "crl_chinese");
    click(&mut window, "CRL: 删除…");
    assert_shows(&window, "删除 CRL – Weld 1");
}

/// Files that were chosen.
fn files(window: &mut W, files: &[(&str, &[u8])]) {
    let job = window.state().backend.sent.iter().rev().find_map(|command| match command {
        BackendCommand::ReadTrustFiles { job, .. } => Some(*job),
        _ => None,
    });
    let read = |(name, bytes): &(&str, &[u8])| {
        let bundle = read_bundle(bytes).map(|bundle| TrustFile { file_name: (*name).to_owned(), bundle });
        let result = bundle.map_err(|e| Problem::with_detail(ErrorCode::BadCertificate, e));
        ReadTrustFile { path: format!("/media/usb/{name}").into(), result }
    };
    let files = files.iter().map(read).collect();
    tell(window, BackendEvent::TrustFilesRead { job: job.expect("files are read"), files });
}

struct Pki {
    chain: Vec<u8>,
    issuing: Vec<u8>,
    client: Vec<u8>,
    crl: Vec<u8>,
    root: Vec<u8>,
}

fn pki() -> Pki {
    let root = Authority::root("Plant root CA");
    let issuing = root.authority("Plant issuing CA 2");
    let client = issuing.application("Laptop of the service");
    let at = time::OffsetDateTime::from_unix_timestamp(now().timestamp()).unwrap();
    Pki {
        chain: p7b(&[&client.der, &issuing.der, &root.der]),
        crl: issuing.crl(7, &[&client], at),
        issuing: issuing.der,
        client: client.der,
        root: root.der,
    }
}

#[test]
fn adding() {
    let pki = pki();
    let mut window = lists(CURRENT, CLIENTS, trust_samples::fleet(now()), SIZE);
    click(&mut window, "Trusted: Add…");
    assert_shows(&window, "Add certificates – Weld 1");
    type_into(&mut window, "Files", "/media/usb/service.p7b");
    click(&mut window, "Read file");
    files(&mut window, &[("service.p7b", &pki.chain), ("revoked.crl", &pki.crl), ("holiday.jpg", b"JFIF")]);
    assert_shows(&window, "The file holds no usable certificate");
    click(&mut window, "Leave out: holiday.jpg");
    picture(&mut window, "trust_add_sorted");
}

#[test]
fn adding_to_many() {
    let pki = pki();
    let mut window = open(&[CURRENT, LEGACY], SIZE);
    choose(&mut window, &CLIENTS);
    type_into(&mut window, "Files", "/media/usb/service.p7b");
    click(&mut window, "Read file");
    files(&mut window, &[("service.p7b", &pki.chain)]);
    assert_shows(&window, "Firmware before 8.0.0 has no list of issuers");
    click(&mut window, "Issuers");
    assert_shows(&window, "This function needs firmware 8.0.0 or later");
    click(&mut window, "Trusted");
    click(&mut window, "Add");
    assert_shows(&window, "Nobody is disconnected");
    click(&mut window, "Add certificates");
    let result = changed(trust_samples::fleet(now()), vec![cut(13, "HMI line 1", CertificateStatus::Revoked)]);
    finish(&mut window, vec![Ok(result), Err(Problem::with_detail(ErrorCode::ListFull, "12 > 10"))]);
    assert_shows(&window, "HMI line 1 (192.168.10.13:501312): The authority has revoked it");
    click(&mut window, "Close");
    choose(&mut window, &CRLS);
    chinese(&mut window);
    assert_shows(&window, "添加 CRL – 2 台控制器");
}

/// As far as they are real, so that there is something to look into.
fn real() -> TrustSnapshot {
    let pki = pki();
    let mut held = trust_samples::fleet(now());
    // Its issuer was not sent along, and is not held here.
    let client = &mut held.rejected[1];
    client.certificate.0.clone_from(&pki.client);
    client.status = CertificateStatus::ChainIncomplete;
    client.reason = "its issuer, CN=Plant issuing CA 2, is missing".into();
    let root = &mut held.issuers[0];
    root.certificate.0.clone_from(&pki.root);
    let crl = &mut held.crls[2];
    crl.crl.as_mut().expect("a CRL").0.clone_from(&pki.crl);
    held
}

#[test]
fn details_of_a_certificate() {
    let mut window = lists(CURRENT, CLIENTS, real(), SIZE);
    click(&mut window, "Tick Laptop of the service");
    details(&mut window);
    assert_shows(&window, "missing: add its certificate to Issuers or Trusted");
}

#[test]
fn details_of_a_revoked_certificate_with_its_chain() {
    let (pki, mut held) = (pki(), trust_samples::fleet(now()));
    held.trusted[0].certificate.0.clone_from(&pki.client);
    held.issuers[0].certificate.0.clone_from(&pki.root);
    held.issuers[1].certificate.0.clone_from(&pki.issuing);
    held.issuers[1].summary.issued_to = "Plant issuing CA 2".into();
    let crl = &mut held.crls[1];
    crl.summary.issuer = "Plant issuing CA 2".into();
    crl.crl.as_mut().expect("a CRL").0.clone_from(&pki.crl);
    let mut window = lists(CURRENT, CLIENTS, held, SIZE);
    click(&mut window, "Tick HMI line 3");
    details(&mut window);
    picture(&mut window, "trust_details_chain");
}

#[test]
fn details_of_a_crl() {
    let mut held = real();
    held.crls[2].summary.issuer = "Plant issuing CA 2".into();
    let client = &mut held.rejected[1];
    client.summary.serial_number = Certificate::from_der(&client.certificate.0).expect("whole").summary().serial_number;
    let mut window = lists(CURRENT, CRLS, held, SIZE);
    click(&mut window, "Tick Plant issuing CA 2");
    details(&mut window);
    picture(&mut window, "crl_details");
}

/// Opens the details. Keys are made anew for every picture; what follows from them must not be drawn even once, as that
/// would already change the picture a little.
fn details(window: &mut W) {
    reduce(&mut window.state_mut().model, Message::act(|model| model.trust_action(TrustAction::Details)));
    let Some(view) = window.state_mut().model.top_mut::<DetailsView>() else { panic!("no details are shown") };
    let fields = match view {
        DetailsView::Certificate(view) => &mut view.fields,
        DetailsView::Crl(view) => {
            for (n, entry) in view.entries.iter_mut().enumerate() {
                entry.serial_number = trust_samples::thumbprint(n);
            }
            &mut view.fields
        }
    };
    for field in fields.iter_mut().filter(|field| field.monospace) {
        let length = field.lines[0].len();
        field.lines = vec![trust_samples::thumbprint(1).repeat(2)[..length.min(64)].to_owned()];
    }
    settle(window);
}
