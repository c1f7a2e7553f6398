//! What the command line asks a person who sits at a terminal.
#![cfg(unix)]

#[path = "common/ca.rs"]
mod ca;
#[path = "common/desk.rs"]
mod desk;
#[path = "common/process.rs"]
mod process;

use std::fs::{self, File};
use std::io::Write as _;
use std::os::fd::{FromRawFd as _, OwnedFd};
use std::path::PathBuf;
use std::process::Stdio;

use ca::Ca;
use desk::{DONE, Desk, walk};
use opcua_configurator::pki::Csr;
use process::{Finished, Running};
use rcgen::SanType;

/// Both ends of a terminal: the keyboard, and what a program reads from.
fn terminal() -> (File, OwnedFd) {
    let (mut keyboard, mut program) = (-1, -1);
    let (name, settings, size) = (std::ptr::null_mut(), std::ptr::null_mut(), std::ptr::null_mut());
    // SAFETY: both numbers outlive the call, and the other parameters may be null.
    let made = unsafe { libc::openpty(&mut keyboard, &mut program, name, settings, size) };
    assert_eq!(made, 0, "{}", std::io::Error::last_os_error());
    // SAFETY: the call gave them to us alone.
    unsafe { (File::from_raw_fd(keyboard), OwnedFd::from_raw_fd(program)) }
}

impl Desk {
    /// Runs with a terminal on which this is typed.
    fn typing(&self, typed: &str, arguments: &[&str]) -> Finished {
        let (mut keyboard, program) = terminal();
        keyboard.write_all(typed.as_bytes()).unwrap();
        let finished = Running::start_with(self.command().args(arguments), Stdio::from(program)).unwrap().finish(DONE);
        drop(keyboard);
        finished
    }

    fn found(&self, name: &str) -> Option<PathBuf> {
        walk(&self.workspace()).into_iter().find(|path| path.ends_with(name))
    }
}

#[test]
fn warnings_about_a_certificate_are_asked_in_the_persons_language_and_not_demanded_again() {
    let desk = Desk::start(1);
    assert_eq!(desk.add(0, "weld").0, Some(0));
    let subject = ["--country", "jp", "--state", "Nagano", "--locality", "Suwa", "--organisation", "Example"];
    let asked = desk.typing("y\n", &[&["cert", "csr"][..], &subject, &["weld"]].concat());
    assert_eq!(asked.code, Some(0), "{}", asked.stderr);
    let csr = Csr::from_any(&fs::read(desk.found("3_csr.der").unwrap()).unwrap()).unwrap();
    let nowhere = |p: &mut rcgen::CertificateParams| p.subject_alt_names.retain(|n| matches!(n, SanType::URI(_)));
    let file = desk.file("from the CA.der");
    fs::write(&file, Ca::new().sign_changed(&csr, nowhere)).unwrap();
    let import = ["--lang", "zh", "cert", "import-ca", "--file", &file, "weld"];
    let kind = |desk: &Desk| desk.json(&["info", "weld"]).1[0]["result"]["certificate"]["type"].clone();

    let refused = desk.typing("n\n", &import);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("weld: 警告: ") && refused.stderr.contains("Go on? [y/N]"), "{}", refused.stderr);
    assert!(refused.stderr.contains("clients may complain"), "{}", refused.stderr);
    assert_ne!(kind(&desk), "ca-signed");

    // Without a terminal, as ever: nothing is asked.
    let nobody = desk.run(&import[2..]);
    assert_eq!(nobody.code, Some(2), "{}", nobody.stderr);

    let agreed = desk.typing("y\n", &import);
    assert_eq!(agreed.code, Some(0), "{}", agreed.stderr);
    assert!(agreed.stdout.contains("Plant CA"), "{}", agreed.stdout);

    // One that clients would refuse is not asked about.
    let nobody = |p: &mut rcgen::CertificateParams| p.subject_alt_names.retain(|n| !matches!(n, SanType::URI(_)));
    fs::write(&file, Ca::new().sign_changed(&csr, nobody)).unwrap();
    let bad = desk.typing("y\n", &import);
    assert_eq!(bad.code, Some(1), "{}", bad.stderr);
    assert!(bad.stderr.contains("weld: 错误: ") && !bad.stderr.contains("Go on?"), "{}", bad.stderr);
}

#[test]
fn an_import_of_settings_says_that_it_may_replace_the_keys() {
    let desk = Desk::start(1);
    assert_eq!(desk.add(0, "weld").0, Some(0));
    let asked = desk.typing("n\n", &["import-settings", "weld"]);
    assert_eq!(asked.code, Some(2));
    assert!(asked.stderr.contains("activation keys if it holds any"), "{}", asked.stderr);
}

#[test]
fn a_stop_and_a_request_say_that_the_server_stays_stopped() {
    let desk = Desk::with(1, &["--firmware", "legacy"]);
    assert_eq!(desk.add(0, "weld").0, Some(0));
    let stop = desk.typing("n\n", &["stop", "weld"]);
    assert_eq!(stop.code, Some(2));
    assert!(
        stop.stderr.contains("The OPC UA server is stopped.") && !stop.stderr.contains("started again"),
        "{}",
        stop.stderr
    );
    let subject = ["--country", "jp", "--state", "Nagano", "--locality", "Suwa", "--organisation", "Example"];
    let request = desk.typing("n\n", &[&["cert", "csr"][..], &subject, &["weld"]].concat());
    assert!(request.stderr.contains("stays stopped until another certificate"), "{}", request.stderr);
    let chinese = desk.typing("n\n", &["--lang", "zh", "stop", "weld"]);
    assert!(chinese.stderr.contains("将停止 OPC UA 服务器"), "{}", chinese.stderr);
}
