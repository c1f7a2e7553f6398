//! How the small CA looks.

use std::path::PathBuf;

use chrono::Duration;
use opcua_configurator::model::{
    AuthorityRequest, AuthorityValidity, CertificateProfile, ErrorCode, KeyLength, Subject,
};
use opcua_configurator::pki::{
    Certificate, CertificateAuthority, Crl, PrivateKey, RevocationReason, RevokedCertificate,
};
use opcua_configurator::ui::backend::{AuthorityResult, BackendEvent, RecordingBackend};
use opcua_configurator::workspace::authority::{
    AuthorityOverview, IssuedCertificate, IssuedFor, PublishedAuthority, RecordedRevocation,
};

use crate::harness::{SIZE, choose, click, now, type_into, window};
use crate::pictures::{W, assert_shows, chinese, job, picture, tell, tick};
use crate::samples::configuration;

fn open(names: &[&str]) -> W {
    let mut window = window(RecordingBackend::default(), configuration(24, now()), SIZE);
    tick(&mut window, names);
    choose(&mut window, &["Tools", "Certificate authority…"]);
    window
}

fn done(window: &mut W, overview: Option<AuthorityOverview>) {
    let job = job(window);
    let result = Ok(AuthorityResult { overview: overview.map(Box::new), saved: None });
    tell(window, BackendEvent::AuthorityDone { job, result });
}

fn request(common_name: &str, years: u8) -> AuthorityRequest {
    let subject = Subject {
        common_name: common_name.into(),
        country: "JP".into(),
        state: String::new(),
        locality: String::new(),
        organisation: "Example".into(),
    };
    let validity = AuthorityValidity::try_from(years).unwrap();
    AuthorityRequest { subject, key_length: KeyLength::Rsa2048, validity }
}

fn published(certificate: &Certificate, crl: Crl, crl_number: u64) -> PublishedAuthority {
    PublishedAuthority { certificate: certificate.clone(), summary: certificate.summary(), crl, crl_number }
}

fn issued(n: u8, name: &str, profile: CertificateProfile, days_left: i64) -> IssuedCertificate {
    IssuedCertificate {
        serial_number: hex::encode_upper([
            0x40 + n,
            7,
            11 * n,
            0x3c,
            17,
            0xd0 + n,
            9,
            33,
            0x5a,
            2,
            8,
            n,
            0xfe,
            1,
            0,
            n,
        ]),
        issued_to: if name.is_empty() { format!("EpsonRC.SN000{n:04}.192.168.010.{n:03}") } else { name.to_owned() },
        application_uri: None,
        thumbprint: "00".repeat(20),
        key: "00".repeat(32),
        profile,
        not_before: now() - Duration::days(300),
        not_after: now() + Duration::days(days_left),
        issued: now() - Duration::days(300),
        controller: (profile == CertificateProfile::Server)
            .then(|| IssuedFor { name: format!("Weld {n}").parse().unwrap(), serial: "SN0001".parse().unwrap() }),
        revoked: None,
    }
}

/// An intermediate whose CRL is due soon, and certificates in every state.
fn overview() -> AuthorityOverview {
    let key = || PrivateKey::generate(KeyLength::Rsa2048).unwrap();
    let made = now() - Duration::days(345);
    let root = CertificateAuthority::root(&request("Plant 3 root", 20), 1, key(), made).unwrap();
    let ca = root.intermediate(&request("Plant 3 CA", 10), key(), made).unwrap();
    let mut list: Vec<_> =
        (1..=6).map(|n| issued(n, "", CertificateProfile::Server, 400 * i64::from(n) - 390)).collect();
    list.push(issued(7, "SCADA", CertificateProfile::Client, 1500));
    list.push(issued(8, "Panel 2", CertificateProfile::Client, -3));
    list[3].revoked =
        Some(RecordedRevocation { at: now() - Duration::days(2), reason: RevocationReason::KeyCompromise });
    let revoked = [RevokedCertificate {
        serial_number: list[3].serial_number.clone(),
        at: made,
        reason: RevocationReason::KeyCompromise,
    }];
    AuthorityOverview {
        folder: PathBuf::from("/home/engineer/EpsonRC80/OPCUA/CA"),
        signing: published(ca.certificate(), ca.crl(&revoked, 1_750_000_000, made, 365).unwrap(), 1_750_000_000),
        root: Some(published(root.certificate(), root.crl(&[], 1_749_000_000, made, 3000).unwrap(), 1_749_000_000)),
        issued: list,
    }
}

#[test]
fn none_and_creating_one() {
    let mut window = open(&[]);
    done(&mut window, None);
    assert_shows(&window, "This workspace has no certificate authority yet");
    click(&mut window, "Create CA…");
    type_into(&mut window, "Common name", "Plant 3 CA");
    type_into(&mut window, "Passphrase", "short");
    type_into(&mut window, "Passphrase again", "shore");
    assert_shows(&window, "The two passphrases differ");
    chinese(&mut window);
    picture(&mut window, "authority_create_chinese");
}

#[test]
fn what_it_has_issued() {
    let mut window = open(&["Weld 2"]);
    done(&mut window, Some(overview()));
    click(&mut window, "SCADA");
    picture(&mut window, "authority");
}

#[test]
fn signing_for_controllers() {
    let mut window = open(&["Weld 2", "Palletiser south"]);
    done(&mut window, Some(overview()));
    click(&mut window, "Sign ticked controllers…");
    type_into(&mut window, "Passphrase", "correct house");
    click(&mut window, "Sign");
    let asked = job(&window);
    tell(&mut window, BackendEvent::AuthorityDone { job: asked, result: Err(ErrorCode::AuthorityPassphrase.into()) });
    picture(&mut window, "authority_sign");
    chinese(&mut window);
    assert_shows(&window, "证书颁发机构的口令错误");
}

#[test]
fn revoking() {
    let mut window = open(&[]);
    done(&mut window, Some(overview()));
    click(&mut window, "SCADA");
    click(&mut window, "Revoke…");
    assert_shows(&window, "Revoke certificates");
}

#[test]
fn publishing() {
    let mut window = open(&["Weld 2", "Palletiser south"]);
    done(&mut window, Some(overview()));
    click(&mut window, "Publish CRL…");
    assert_shows(&window, "CA: publish CRL");
}

#[test]
fn signing_a_file_in_chinese() {
    let mut window = open(&[]);
    done(&mut window, Some(overview()));
    click(&mut window, "Sign CSR file…");
    chinese(&mut window);
    assert_shows(&window, "签发 CSR 文件");
}
