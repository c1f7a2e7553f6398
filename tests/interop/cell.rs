//! One virtual controller and one workspace that knows it, driven by the command line alone.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use serde::Deserialize;
use serde_json::Value;
use tempfile::TempDir;

use super::peers::ClientCertificate;
use crate::common::process::Running;

const NAME: &str = "cell-1";
const CONNECTION_PASSWORD: &str = "interop";
const READY: Duration = Duration::from_secs(60);
/// Making a 4096-bit key on a busy machine takes its time.
const DONE: Duration = Duration::from_secs(180);

/// Dropping it ends the controller and removes every file.
pub struct Cell {
    folder: TempDir,
    ready: Ready,
    _controller: Running,
}

/// The line a virtual controller prints when it is ready.
#[derive(Deserialize)]
struct Ready {
    serial: String,
    series: String,
    management: String,
    fingerprint: String,
    opcua: String,
}

impl Cell {
    /// `firmware` is `current` or `legacy`.
    pub fn start(firmware: &str) -> Self {
        Self::start_with(firmware, &[])
    }

    /// With more arguments of the command `virtual`.
    pub fn start_with(firmware: &str, more: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let password_file = connection_password_file(folder.path());
        fs::write(&password_file, CONNECTION_PASSWORD).expect("the connection password's file");
        let data = folder.path().join("controller");
        let mut controller = Running::start(
            configurator(folder.path())
                .args(["virtual", "--count", "1", "--management-port", "0", "--opcua-port", "0", "--seed", "1"])
                .args(more)
                .args(["--firmware", firmware, "--password-file"])
                .arg(&password_file)
                .arg("--data")
                .arg(&data),
        )
        .expect("the program itself");
        let line = controller.next_line(READY);
        let ready: Ready = serde_json::from_str(&line).unwrap_or_else(|e| panic!("{e} in: {line}"));
        let cell = Self { folder, ready, _controller: controller };
        let Ready { management, series, fingerprint, .. } = &cell.ready;
        cell.run_on_workspace(&[
            "controllers",
            "add",
            NAME,
            management,
            "--series",
            series,
            "--fingerprint",
            fingerprint,
        ]);
        cell
    }

    /// For the files of the story; gone with the cell.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    pub fn workspace(&self) -> PathBuf {
        self.folder().join("workspace")
    }

    pub fn serial(&self) -> &str {
        &self.ready.serial
    }

    pub fn opcua(&self) -> &str {
        &self.ready.opcua
    }

    pub fn info(&self) -> Value {
        self.run(&["info"])
    }

    pub fn set(&self, policies: &str, tokens: &str) {
        self.run(&["settings", "set", "--policies", policies, "--tokens", tokens]);
    }

    pub fn make_certificate(&self, bits: &str, years: u8) {
        let subject = ["--country", "JP", "--state", "Nagano", "--locality", "Suwa", "--organisation", "Example"];
        let years = years.to_string();
        let rest = ["--bits", bits, "--years", years.as_str()];
        self.run(&[&["cert", "self-signed"][..], &subject, &rest].concat());
    }

    /// Makes a signing request, and gives the file it was saved to.
    pub fn make_csr(&self, bits: &str, format: &str) -> PathBuf {
        let subject = ["--country", "JP", "--state", "Nagano", "--locality", "Suwa", "--organisation", "Example"];
        let made = self.run(&[&["cert", "csr"][..], &subject, &["--bits", bits, "--format", format]].concat());
        PathBuf::from(made["saved"]["csr"].as_str().expect("a path"))
    }

    pub fn add_user(&self, name: &str, password: &str) {
        let file = self.folder().join("user-password");
        fs::write(&file, password).expect("the user's password file");
        self.run(&["users", "add", name, "--password-file", utf8(&file)]);
    }

    pub fn trust(&self, client: &ClientCertificate) {
        self.run(&["clients", "add", "--list", "trusted", utf8(&client.certificate)]);
    }

    /// Runs a command on the controller and gives its `result`. Panics unless the controller says it is done.
    pub fn run(&self, command: &[&str]) -> Value {
        let stdout = self.call(&[command, &[NAME]].concat());
        let lines: Vec<Value> = stdout
            .lines()
            .map(|line| serde_json::from_str(line).unwrap_or_else(|e| panic!("{command:?}: {e} in: {line}")))
            .collect();
        match &lines[..] {
            [line] if line["controller"] == NAME && line["ok"] == true => line["result"].clone(),
            _ => panic!("{command:?} did not answer with one line for {NAME}: {stdout}"),
        }
    }

    /// Runs a command that asks no controller.
    pub fn run_on_workspace(&self, command: &[&str]) {
        self.call(command);
    }

    fn call(&self, command: &[&str]) -> String {
        let finished = Running::start(
            configurator(self.folder())
                .arg("--workspace")
                .arg(self.workspace())
                .arg("--connection-password-file")
                .arg(connection_password_file(self.folder()))
                .args(["--json", "--yes"])
                .args(command),
        )
        .expect("the program itself")
        .finish(DONE);
        let (stdout, stderr) = (finished.stdout, finished.stderr);
        assert_eq!(finished.code, Some(0), "{command:?}\n{stdout}\n{stderr}");
        stdout
    }
}

fn connection_password_file(folder: &Path) -> PathBuf {
    folder.join("connection-password")
}

/// The program as on a machine of its own: no display, no session bus and so no keyring, nothing in its home.
fn configurator(home: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_opcua-configurator"));
    for variable in ["DBUS_SESSION_BUS_ADDRESS", "XDG_RUNTIME_DIR", "DISPLAY", "WAYLAND_DISPLAY"] {
        command.env_remove(variable);
    }
    command.env("HOME", home).env("XDG_CONFIG_HOME", OsString::from(home.join("config")));
    command
}

fn utf8(path: &Path) -> &str {
    path.to_str().expect("temporary folders have plain names")
}
