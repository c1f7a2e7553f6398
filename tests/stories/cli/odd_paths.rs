//! Every command in a workspace, with files and for a fleet whose paths are not UTF-8: nothing panics, and what is done
//! is said in whole lines of JSON. On Linux only: other file systems refuse such names.
#![cfg(target_os = "linux")]

use std::ffi::{OsStr, OsString};
use std::fs;
use std::os::unix::ffi::OsStrExt as _;
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

use serde_json::Value;

use crate::common::process::{Finished, Running};

const DONE: Duration = Duration::from_secs(120);
/// What the program says of the folder.
const SHOWN: &str = "/plant ��";

struct Odd {
    folder: tempfile::TempDir,
    ready: Vec<Value>,
    _controllers: Running,
}

impl Odd {
    fn start() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().join(OsStr::from_bytes(b"plant \xff\xfe"));
        fs::create_dir(&root).unwrap();
        for (name, text) in [("password", "plant-password"), ("passphrase", "a long passphrase"), ("user", "Passw0rd1")]
        {
            fs::write(root.join(name), text).unwrap();
        }
        let mut command = program();
        command.args(["virtual", "--count", "2", "--seed", "3", "--password-file"]).arg(root.join("password"));
        command.arg("--data").arg(root.join("fleet"));
        let mut controllers = Running::start(&mut command).unwrap();
        let ready = (0..2).map(|_| serde_json::from_str(&controllers.next_line(DONE)).unwrap()).collect();
        Self { folder, ready, _controllers: controllers }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(OsStr::from_bytes(b"plant \xff\xfe")).join(name)
    }

    /// `@name` is a file in the folder.
    fn run(&self, arguments: &str) -> Finished {
        let mut command = program();
        command.arg("--workspace").arg(self.path("work"));
        command.arg("--connection-password-file").arg(self.path("password"));
        for word in arguments.split(' ') {
            match word.strip_prefix('@') {
                Some(name) => command.arg(self.path(name)),
                None => command.arg(word),
            };
        }
        Running::start(&mut command).unwrap().finish(DONE)
    }

    /// Must succeed. The result of the last line.
    fn done(&self, arguments: &str) -> Value {
        let finished = self.run(&format!("--json --yes {arguments}"));
        assert_eq!(finished.code, Some(0), "{arguments}: {}{}", finished.stdout, finished.stderr);
        let lines: Vec<Value> = finished.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        lines.last().map_or(Value::Null, |line| line["result"].clone())
    }
}

fn program() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_opcua-configurator"));
    command.env_remove("OPCUA_CONFIGURATOR_CONNECTION_PASSWORD_FILE").env_remove("RUST_LOG");
    command.env_remove("DBUS_SESSION_BUS_ADDRESS").env("RUST_BACKTRACE", "0");
    command
}

fn is_said(value: &Value) -> bool {
    value.as_str().is_some_and(|path| path.contains(SHOWN))
}

#[test]
fn every_command_works_in_a_folder_whose_name_is_not_utf_8() {
    let odd = Odd::start();
    for (ready, name) in odd.ready.iter().zip(["old", "new"]) {
        let word = |key: &str| ready[key].as_str().unwrap();
        let (at, series, fingerprint) = (word("management"), word("series"), word("fingerprint"));
        odd.done(&format!("controllers add {name} {at} --series {series} --fingerprint {fingerprint}"));
    }
    odd.done("controllers list");
    odd.done("info --all");
    odd.done("backup on");
    let shown = odd.run("--json backup show");
    let shown: Value = serde_json::from_str(&shown.stdout).unwrap();
    assert!(is_said(&shown["folder"]), "{shown}");
    assert!(odd.run("backup show").stdout.contains(SHOWN));

    const NAMES: &str = "--country JP --state Nagano --locality Suwa --organisation Example";
    let made = odd.done(&format!("cert self-signed {NAMES} old"));
    assert!(is_said(&made["saved"]["certificate"]) && is_said(&made["saved"]["key"]), "{made}");
    let asked = odd.done(&format!("cert csr {NAMES} --format pem old"));
    assert!(is_said(&asked["saved"]["csr"]), "{asked}");
    assert!(is_said(&odd.done("cert export --format pem old")["file"]));

    let ca = odd.done("ca init --cn Plant --bits 2048 --passphrase-file @passphrase");
    assert!(is_said(&ca["folder"]) && is_said(&ca["ca"]["file"]) && is_said(&ca["ca"]["crl"]["file"]), "{ca}");
    odd.done("ca show");
    let signed = odd.done("ca sign-controllers --passphrase-file @passphrase --all");
    assert!(signed["certificate"]["serial_number"].is_string(), "{signed}");
    odd.done("ca crl --out @plant.crl --passphrase-file @passphrase --push --all");
    let again = odd.done("ca crl --out @plant.crl --passphrase-file @passphrase");
    assert!(is_said(&again["saved"][0]), "{again}");
    assert!(is_said(&odd.done("ca backup --out @ca.json --passphrase-file @passphrase")["backup"]));

    odd.done("settings set --tokens anonymous,username --all");
    odd.done("settings show --all");
    odd.done("users add operator1 --password-file @user --all");
    odd.done("start --all");
    let verified = odd.run("--json --yes verify --trust-me --user operator1 --user-password-file @user --all");
    let lines: Vec<Value> = verified.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 2, "{}{}", verified.stdout, verified.stderr);
    assert!(is_said(&lines[0]["result"]["own_certificate"]["file"]), "{}", verified.stderr);
    odd.done("clients list --all");
    odd.done("crl list --all");
    odd.done("log show --all");
    assert!(is_said(&odd.done("export-settings --passphrase-file @passphrase old")["file"]));
    odd.done("import-settings --passphrase-file @passphrase old");
    odd.done("stop --all");
    odd.done("controllers remove new");
}

#[test]
fn files_whose_names_are_not_utf_8_are_read_and_named() {
    let odd = Odd::start();
    let run = |arguments: &[OsString]| {
        let mut command = program();
        command.arg("--workspace").arg(odd.path("work")).args(arguments);
        Running::start(&mut command).unwrap().finish(DONE)
    };
    let words = |text: &str, last: PathBuf| -> Vec<OsString> {
        text.split(' ').map(OsString::from).chain([last.into_os_string()]).collect()
    };
    odd.done("ca init --cn Plant --bits 2048 --passphrase-file @passphrase");
    let ca = odd.path("work").join("CA").join("ca.der");
    let shown = run(&words("pki show", ca.clone()));
    assert_eq!(shown.code, Some(0), "{}", shown.stderr);
    let shown: Value = serde_json::from_str(&shown.stdout).unwrap();
    assert!(is_said(&shown["file"]), "{shown}");
    let judged = run(&words("pki verify --allow-unknown-revocation", ca));
    assert!(matches!(judged.code, Some(0 | 1)), "{}", judged.stderr);
    for arguments in ["pki show", "pki verify", "controllers import", "activate --all --file", "ca restore"] {
        let missing = run(&words(arguments, odd.path("missing")));
        assert_eq!(missing.code, Some(2), "{arguments}: {}", missing.stderr);
        assert!(!missing.stderr.contains("panicked"), "{}", missing.stderr);
    }
}
