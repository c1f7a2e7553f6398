//! A desk at the command line: a workspace folder, and virtual controllers in a process of their own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use serde_json::Value;

use super::process::{Finished, Running};

pub const DONE: Duration = Duration::from_secs(120);

pub fn program() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_opcua-configurator"));
    for variable in
        ["CONNECTION_PASSWORD_FILE", "CONNECTION_PASSWORD_LIST", "VAULT_PASSPHRASE_FILE", "REMOTE_PASSWORD_FILE"]
    {
        command.env_remove(format!("OPCUA_CONFIGURATOR_{variable}"));
    }
    command.env_remove("RUST_LOG");
    // No keyring of the person who runs the tests.
    command.env_remove("DBUS_SESSION_BUS_ADDRESS").env("RUST_BACKTRACE", "0");
    command
}

/// Virtual controllers in a process of their own, and an empty workspace.
pub struct CommandLineTest {
    pub folder: tempfile::TempDir,
    pub ready: Vec<Value>,
    #[allow(dead_code, reason = "benches ask for its process")]
    pub controllers: Running,
}

impl CommandLineTest {
    pub fn start(count: usize) -> Self {
        Self::with(count, &["--seed", "3"])
    }

    /// `more`: further arguments of `virtual`.
    pub fn with(count: usize, more: &[&str]) -> Self {
        Self::with_password("plant-password", count, more)
    }

    pub fn with_password(password: &str, count: usize, more: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("password"), format!("{password}\r\n")).unwrap();
        fs::write(folder.path().join("user-password"), "Passw0rd1\n").unwrap();
        let mut controllers = Running::start(
            program()
                .args(["virtual", "--count", &count.to_string(), "--password-file"])
                .arg(folder.path().join("password"))
                .args(more),
        )
        .unwrap();
        let ready = (0..count).map(|_| serde_json::from_str(&controllers.next_line(DONE)).unwrap()).collect();
        Self { folder, ready, controllers }
    }

    pub fn workspace(&self) -> PathBuf {
        self.folder.path().join("workspace")
    }

    pub fn command(&self) -> Command {
        let mut command = program();
        command.arg("--workspace").arg(self.workspace());
        command.arg("--connection-password-file").arg(self.folder.path().join("password"));
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Finished {
        Running::start(self.command().args(arguments)).unwrap().finish(DONE)
    }

    /// Runs with `--json`; one value a line.
    pub fn json(&self, arguments: &[&str]) -> (Option<i32>, Vec<Value>) {
        let finished = Running::start(self.command().arg("--json").args(arguments)).unwrap().finish(DONE);
        let mut lines: Vec<Value> = finished.stdout.lines().map(|l| serde_json::from_str(l).unwrap()).collect();
        lines.sort_by_key(|line| line["controller"].to_string());
        (finished.code, lines)
    }

    pub fn file(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }

    pub fn add(&self, index: usize, name: &str) -> (Option<i32>, Vec<Value>) {
        let ready = &self.ready[index];
        let word = |key: &str| ready[key].as_str().unwrap();
        self.json(&[
            "controllers",
            "add",
            name,
            word("management"),
            "--series",
            word("series"),
            "--fingerprint",
            word("fingerprint"),
        ])
    }
}

pub fn assert_error(lines: &[Value], code: &str) {
    let error = &lines[0]["error"];
    assert_eq!(error["code"], code, "{lines:?}");
    for part in ["message", "cause", "remedy"] {
        assert!(error[part].as_str().is_some_and(|text| !text.is_empty()), "{error}");
    }
}

pub fn walk(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { found.extend(walk(&path)) } else { found.push(path) }
    }
    found
}
