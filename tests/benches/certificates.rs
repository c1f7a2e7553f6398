//! Self-signed certificates with 2048-bit keys, against a shell that calls `openssl` for each, both on every core.
//!
//! `cargo bench --bench certificates -- [CERTIFICATES]`; 100 without an argument.

mod report;

use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use chrono::Utc;
use opcua_configurator::model::{KeyLength, SelfSignedRequest, Subject, Validity};
use opcua_configurator::pki::{self, PrivateKey, ServerNames};
use report::{Spread, line};

const TARGET: f64 = 2.0;
const ROUNDS: usize = 3;

fn main() {
    let benching = report::is_benching();
    let count = report::number(0).unwrap_or(if benching { 100 } else { 2 });
    let (mut here, mut openssl) = (Vec::new(), Vec::new());
    // In turns, so that a busy machine is as unfair to the one as to the other.
    for _ in 0..report::rounds_when(benching, ROUNDS) {
        here.push(timed(count, make_here));
        if has_openssl() {
            openssl.push(timed(count, make_with_openssl));
        }
    }
    println!("{count} self-signed certificates with 2048-bit keys, {} cores", report::cores());
    let ratios =
        Spread::of(here.iter().zip(&openssl).map(|(here, openssl)| openssl.as_secs_f64() / here.as_secs_f64()));
    let here = Spread::seconds(&here);
    line("opcua-configurator (s)", &here);
    if openssl.is_empty() {
        println!("  There is no `openssl` on this machine to compare with.");
        return;
    }
    let openssl = Spread::seconds(&openssl);
    line("shell and openssl (s)", &openssl);
    line("times as fast", format!("{:.2} by the medians; target: at least {TARGET}", openssl.median() / here.median()));
    line("round by round", ratios);
}

fn timed(count: usize, make: fn(usize, &Path)) -> Duration {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let start = Instant::now();
    make(count, folder.path());
    let time = start.elapsed();
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), count, "not every certificate is there");
    time
}

/// As a job makes them for legacy controllers: as many at once as there are cores.
fn make_here(count: usize, folder: &Path) {
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..report::cores() {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count {
                        break;
                    }
                    std::fs::write(folder.join(format!("{index}.der")), certificate()).expect("the folder is writable");
                }
            });
        }
    });
}

fn certificate() -> Vec<u8> {
    let request = SelfSignedRequest {
        subject: Subject {
            common_name: "x".to_owned(),
            country: String::new(),
            state: String::new(),
            locality: String::new(),
            organisation: String::new(),
        },
        key_length: KeyLength::Rsa2048,
        validity: Validity::try_from(1).expect("a year"),
    };
    let names = ServerNames { application_uri: "urn:x".to_owned(), ips: Vec::new(), dns: vec!["x".to_owned()] };
    let key = PrivateKey::generate(request.key_length).expect("a key");
    pki::self_signed(&request, &names, &key, Utc::now()).expect("a certificate").der().to_vec()
}

fn make_with_openssl(count: usize, folder: &Path) {
    let script = format!(
        "seq {count} | xargs -P {} -I{{}} openssl req -x509 -newkey rsa:2048 -nodes -keyout /dev/null -out {{}}.pem \
         -days 365 -subj /CN=x",
        report::cores()
    );
    let ended =
        Command::new("sh").args(["-c", &script]).current_dir(folder).stderr(Stdio::null()).status().expect("a shell");
    assert!(ended.success(), "openssl failed: {ended}");
}

fn has_openssl() -> bool {
    Command::new("openssl")
        .arg("version")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|s| s.success())
}
