//! What the command line asks a person who sits at a terminal.
#![cfg(unix)]

use std::fs::{self, File};
use std::io::{Read as _, Write as _};
use std::os::fd::{AsRawFd as _, FromRawFd as _, OwnedFd};
use std::path::PathBuf;
use std::process::Stdio;
use std::sync::Arc;
use std::time::{Duration, Instant};

use opcua_configurator::pki::Csr;
use parking_lot::Mutex;
use rcgen::SanType;

use crate::common::ca::Ca;
use crate::common::command_line_test::{CommandLineTest, DONE, program, walk};
use crate::common::process::{Finished, Running};

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

/// Whether the terminal shows what is typed.
fn echoes(terminal: &File) -> bool {
    let mut settings = std::mem::MaybeUninit::<libc::termios>::uninit();
    // SAFETY: the descriptor is open, and the call fills in what it is given.
    let read = unsafe { libc::tcgetattr(terminal.as_raw_fd(), settings.as_mut_ptr()) };
    assert_eq!(read, 0, "{}", std::io::Error::last_os_error());
    // SAFETY: the call succeeded.
    unsafe { settings.assume_init() }.c_lflag & libc::ECHO != 0
}

impl CommandLineTest {
    /// Runs with a terminal on which this is typed.
    fn typing(&self, typed: &str, arguments: &[&str]) -> Finished {
        let (mut keyboard, program) = terminal();
        keyboard.write_all(typed.as_bytes()).unwrap();
        let finished = Running::start_with(self.command().args(arguments), Stdio::from(program)).unwrap().finish(DONE);
        drop(keyboard);
        finished
    }

    /// Runs with a terminal for input and messages, and no connection password. Each answer is typed once its question
    /// is there and what is typed is not shown any more. Returns what the terminal showed.
    fn answering(&self, answers: &[(&str, &str)], arguments: &[&str]) -> (Option<i32>, String) {
        let (mut keyboard, screen) = terminal();
        let mut command = program();
        command.arg("--workspace").arg(self.workspace()).args(arguments);
        command.stdin(screen.try_clone().unwrap()).stderr(screen).stdout(Stdio::null());
        let mut child = command.spawn().unwrap();
        // Holds the other end of the terminal.
        drop(command);
        let shown = Arc::new(Mutex::new(String::new()));
        let reader = {
            let (mut screen, shown) = (keyboard.try_clone().unwrap(), shown.clone());
            std::thread::spawn(move || {
                let mut bytes = [0; 1024];
                // Fails once no program has the terminal any more.
                while let Ok(count @ 1..) = screen.read(&mut bytes) {
                    shown.lock().push_str(&String::from_utf8_lossy(&bytes[..count]));
                }
            })
        };
        let until = Instant::now() + DONE;
        for (question, answer) in answers {
            while !shown.lock().contains(question) || echoes(&keyboard) {
                assert!(Instant::now() < until, "not asked: {question}; {}", shown.lock());
                std::thread::sleep(Duration::from_millis(5));
            }
            keyboard.write_all(format!("{answer}\n").as_bytes()).unwrap();
        }
        let code = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break status.code();
            }
            if Instant::now() > until {
                child.kill().unwrap();
            }
            std::thread::sleep(Duration::from_millis(5));
        };
        reader.join().unwrap();
        let shown = shown.lock().clone();
        (code, shown)
    }

    fn found(&self, name: &str) -> Option<PathBuf> {
        walk(&self.workspace()).into_iter().find(|path| path.ends_with(name))
    }
}

#[test]
fn warnings_about_a_certificate_are_asked_in_the_persons_language_and_not_demanded_again() {
    let cli = CommandLineTest::start(1);
    assert_eq!(cli.add(0, "weld").0, Some(0));
    let subject = ["--country", "jp", "--state", "Nagano", "--locality", "Suwa", "--organisation", "Example"];
    let asked = cli.typing("y\n", &[&["cert", "csr"][..], &subject, &["weld"]].concat());
    assert_eq!(asked.code, Some(0), "{}", asked.stderr);
    let csr = Csr::from_any(&fs::read(cli.found("3_csr.der").unwrap()).unwrap()).unwrap();
    let nowhere = |p: &mut rcgen::CertificateParams| p.subject_alt_names.retain(|n| matches!(n, SanType::URI(_)));
    let file = cli.file("from the CA.der");
    fs::write(&file, Ca::new().sign_changed(&csr, nowhere)).unwrap();
    let import = ["--lang", "zh", "cert", "import-ca", "--file", &file, "weld"];
    let kind = |cli: &CommandLineTest| cli.json(&["info", "weld"]).1[0]["result"]["certificate"]["type"].clone();

    let refused = cli.typing("n\n", &import);
    assert_eq!(refused.code, Some(2));
    assert!(
        refused.stderr.contains("weld: 警告: ") && refused.stderr.contains("是否继续？[y/N]"),
        "{}",
        refused.stderr
    );
    assert!(refused.stderr.contains("客户端可能对以上各项发出警告"), "{}", refused.stderr);
    assert_ne!(kind(&cli), "ca-signed");

    // Without a terminal, as ever: nothing is asked.
    let nobody = cli.run(&import[2..]);
    assert_eq!(nobody.code, Some(2), "{}", nobody.stderr);

    let agreed = cli.typing("y\n", &import);
    assert_eq!(agreed.code, Some(0), "{}", agreed.stderr);
    assert!(agreed.stdout.contains("Plant CA"), "{}", agreed.stdout);

    // One that clients would refuse is not asked about.
    let nobody = |p: &mut rcgen::CertificateParams| p.subject_alt_names.retain(|n| !matches!(n, SanType::URI(_)));
    fs::write(&file, Ca::new().sign_changed(&csr, nobody)).unwrap();
    let bad = cli.typing("y\n", &import);
    assert_eq!(bad.code, Some(1), "{}", bad.stderr);
    assert!(bad.stderr.contains("weld: 错误: ") && !bad.stderr.contains("是否继续"), "{}", bad.stderr);
}

#[test]
fn an_import_of_settings_says_that_it_may_replace_the_keys() {
    let cli = CommandLineTest::start(1);
    assert_eq!(cli.add(0, "weld").0, Some(0));
    let asked = cli.typing("n\n", &["import-settings", "weld"]);
    assert_eq!(asked.code, Some(2));
    assert!(asked.stderr.contains("activation keys if it holds any"), "{}", asked.stderr);
}

#[test]
fn a_stop_and_a_request_say_that_the_server_stays_stopped() {
    let cli = CommandLineTest::with(1, &["--firmware", "legacy"]);
    assert_eq!(cli.add(0, "weld").0, Some(0));
    let stop = cli.typing("n\n", &["stop", "weld"]);
    assert_eq!(stop.code, Some(2));
    assert!(
        stop.stderr.contains("The OPC UA server is stopped.") && !stop.stderr.contains("started again"),
        "{}",
        stop.stderr
    );
    let subject = ["--country", "jp", "--state", "Nagano", "--locality", "Suwa", "--organisation", "Example"];
    let request = cli.typing("n\n", &[&["cert", "csr"][..], &subject, &["weld"]].concat());
    assert!(request.stderr.contains("stays stopped until another certificate"), "{}", request.stderr);
    let chinese = cli.typing("n\n", &["--lang", "zh", "stop", "weld"]);
    assert!(chinese.stderr.contains("将停止 OPC UA 服务器"), "{}", chinese.stderr);
}

#[test]
fn the_passphrase_of_the_vault_is_asked_for_and_not_shown() {
    let cli = CommandLineTest::start(1);
    assert_eq!(cli.add(0, "weld").0, Some(0));
    let (first, again) = ("Passphrase of the vault: ", "The same again: ");
    let (code, shown) = cli.answering(&[(first, "correct horse"), (again, "correct house")], &["vault", "init"]);
    assert!(code == Some(2) && shown.contains("differ"), "{shown}");
    let (code, shown) = cli.answering(&[(first, "correct horse"), (again, "correct horse")], &["vault", "init"]);
    assert!(code == Some(0) && !shown.contains("horse"), "{shown}");
    fs::write(cli.folder.path().join("list.csv"), "Name,Password\nweld,plant-password\n").unwrap();
    let list = cli.file("list.csv");
    assert_eq!(cli.answering(&[(first, "correct horse")], &["vault", "import", &list]).0, Some(0));

    let (code, shown) = cli.answering(&[(first, "correct horse")], &["info", "weld"]);
    assert_eq!(code, Some(0), "{shown}");
    let (code, shown) = cli.answering(&[(first, "correct house")], &["info", "weld"]);
    assert!(code == Some(2) && shown.contains("does not open the vault"), "{shown}");
    // Who has no passphrase presses Enter.
    let (code, shown) = cli.answering(&[(first, "")], &["info", "weld"]);
    assert!(code == Some(1) && shown.contains("connection password is not known"), "{shown}");
}
