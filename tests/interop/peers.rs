//! The peers: found or plainly skipped, asked, and their answers as values.

use std::collections::BTreeMap;
use std::env;
use std::ffi::OsString;
use std::io::{Write, stderr};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use chrono::NaiveDateTime;
use serde_json::Value;

use crate::common::process::{Finished, Running};

const ANSWER: Duration = Duration::from_secs(90);

/// A key and a certificate that a client made for itself.
pub struct ClientCertificate {
    pub certificate: PathBuf,
    pub key: PathBuf,
}

/// asyncua.
pub struct Python(OsString);

impl Python {
    pub fn find() -> Option<Self> {
        let python = Self(env::var_os("OPCUA_INTEROP_PYTHON").unwrap_or_else(|| "python3".into()));
        found(
            python.peer().arg("--help"),
            "asyncua",
            "`pip install asyncua cryptography`, in a Python that OPCUA_INTEROP_PYTHON names",
        )
        .then_some(python)
    }

    /// A Python with the library that a program beside this file needs.
    pub fn find_with(program: &str, package: &str) -> Option<Self> {
        let python = Self(env::var_os("OPCUA_INTEROP_PYTHON").unwrap_or_else(|| "python3".into()));
        let install = format!("`pip install {package}`, in a Python that OPCUA_INTEROP_PYTHON names");
        found(python.script(program).arg("--help"), package, &install).then_some(python)
    }

    /// The client's application URI is `urn:interop:<name>`.
    pub fn make_certificate(&self, folder: &Path, name: &str) -> ClientCertificate {
        let [certificate, key] = ["der", "pem"].map(|extension| folder.join(format!("{name}.{extension}")));
        let mut peer = self.peer();
        peer.args(["certificate", "--name", name, "--uri", &format!("urn:interop:{name}"), "--certificate"]);
        let made = answer(peer.arg(&certificate).arg("--key").arg(&key));
        assert_eq!(made["ok"], true, "{made}");
        ClientCertificate { certificate, key }
    }

    /// What the server offers; its certificate goes into `save`.
    pub fn endpoints(&self, url: &str, save: Option<&Path>) -> Value {
        let mut peer = self.peer();
        peer.args(["endpoints", "--url", url]);
        if let Some(file) = save {
            peer.arg("--save-certificate").arg(file);
        }
        answer(&mut peer)
    }

    /// A session over Basic256Sha256 SignAndEncrypt with a certificate, over None without; as a user, or anonymous.
    pub fn session(&self, url: &str, certificate: Option<&ClientCertificate>, user: Option<(&str, &str)>) -> Value {
        let mut peer = self.peer();
        peer.args(["session", "--url", url]);
        if let Some(ClientCertificate { certificate, key }) = certificate {
            peer.args(["--policy", "Basic256Sha256", "--certificate"]).arg(certificate).arg("--key").arg(key);
        }
        // Kept until the peer has read it.
        let mut password_file = tempfile::NamedTempFile::new().expect("a temporary file");
        if let Some((user, password)) = user {
            password_file.write_all(password.as_bytes()).expect("the password's file");
            peer.args(["--user", user, "--password-file"]).arg(password_file.path());
        }
        answer(&mut peer)
    }

    fn peer(&self) -> Command {
        self.script("peer.py")
    }

    /// One of the programs beside this file.
    pub fn script(&self, name: &str) -> Command {
        let mut command = Command::new(&self.0);
        command.arg(source(name));
        command
    }
}

/// node-opcua.
pub struct Node(());

impl Node {
    pub fn find() -> Option<Self> {
        found(
            &mut Self(()).peer(),
            "node-opcua",
            "`npm install node-opcua-client`; OPCUA_INTEROP_NODE_MODULES names its node_modules folder",
        )
        .then_some(Self(()))
    }

    /// A Node.js with the library that a program beside this file needs.
    pub fn find_with(program: &str, package: &str) -> Option<Self> {
        let install = format!("`npm install {package}`; OPCUA_INTEROP_NODE_MODULES names its node_modules folder");
        found(&mut Self(()).script(program), package, &install).then_some(Self(()))
    }

    pub fn endpoints(&self, url: &str) -> Value {
        answer(self.peer().arg(url))
    }

    fn peer(&self) -> Command {
        self.script("endpoints.mjs")
    }

    /// One of the programs beside this file.
    pub fn script(&self, name: &str) -> Command {
        let mut command = Command::new("node");
        command.arg(source(name));
        command
    }
}

/// The command line of Wireshark.
pub struct Tshark(());

impl Tshark {
    pub fn find() -> Option<Self> {
        let mut probe = Command::new("tshark");
        found(probe.arg("--version"), "tshark", "`apt-get install tshark`").then_some(Self(()))
    }

    /// Fields of each packet of a capture, in the order of their names.
    pub fn fields(&self, capture: &Path, names: &[&str]) -> Vec<Vec<String>> {
        let mut command = self.command(capture);
        command.args(["-T", "fields", "-E", "separator=;", "-E", "occurrence=f"]);
        for name in names {
            command.args(["-e", name]);
        }
        let lines = self.run(&mut command);
        lines.lines().map(|line| line.split(';').map(str::to_owned).collect()).collect()
    }

    /// Whether something in a capture is malformed.
    pub fn complains(&self, capture: &Path) -> bool {
        !self.run(self.command(capture).args(["-Y", "_ws.malformed"])).trim().is_empty()
    }

    /// Without the settings of the person who runs the tests.
    fn command(&self, capture: &Path) -> Command {
        let mut command = Command::new("tshark");
        command.env("HOME", capture.parent().unwrap_or(capture)).args(["-n", "-r"]).arg(capture);
        command
    }

    fn run(&self, command: &mut Command) -> String {
        let Finished { code, stdout, stderr } = Running::start(command).expect("tshark was found").finish(ANSWER);
        assert_eq!(code, Some(0), "{command:?}\n{stdout}\n{stderr}");
        stdout
    }
}

/// The command line of OpenSSL.
pub struct OpenSsl(());

/// A certificate as OpenSSL reads it.
pub struct Reading {
    pub version: u8,
    pub bits: u16,
    /// One `TYPE=value` each.
    pub subject: Vec<String>,
    pub issuer: Vec<String>,
    pub not_before: NaiveDateTime,
    pub not_after: NaiveDateTime,
    extensions: BTreeMap<String, Vec<String>>,
}

impl Reading {
    /// The parts of an extension, such as the single uses of `Key Usage`.
    pub fn extension(&self, name: &str) -> Vec<&str> {
        let parts = self.extensions.get(name).unwrap_or_else(|| panic!("no {name} in {:?}", self.extensions));
        parts.iter().map(String::as_str).collect()
    }
}

impl OpenSsl {
    pub fn find() -> Option<Self> {
        found(Command::new("openssl").arg("version"), "openssl", "`apt-get install openssl`").then_some(Self(()))
    }

    pub fn read(&self, der: &Path) -> Reading {
        let text = self.run(
            Command::new("openssl")
                .args(["x509", "-inform", "DER", "-noout", "-text", "-subject", "-issuer", "-nameopt", "RFC2253"])
                .args(["-dates", "-dateopt", "iso_8601", "-in"])
                .arg(der),
        );
        let mut extensions = BTreeMap::new();
        let mut lines = text.lines().map(str::trim);
        while let Some(line) = lines.next() {
            if line == "X509v3 extensions:" {
                continue;
            }
            if let Some((name, _)) = line.strip_prefix("X509v3 ").and_then(|rest| rest.split_once(':')) {
                let parts = lines.next().unwrap_or_default().split(", ").map(str::to_owned).collect();
                extensions.insert(name.to_owned(), parts);
            }
        }
        let after = |start: &str| {
            let line = text.lines().map(str::trim).filter_map(|line| line.strip_prefix(start)).next_back();
            line.unwrap_or_else(|| panic!("no {start} in\n{text}"))
        };
        let number = |start: &str| after(start).trim_start_matches('(').split(' ').next().unwrap_or_default();
        let name = |start: &str| after(start).split(',').map(str::to_owned).collect();
        let time = |start: &str| {
            NaiveDateTime::parse_from_str(after(start), "%Y-%m-%d %H:%M:%SZ").expect("a time of openssl x509 -dates")
        };
        Reading {
            version: number("Version: ").parse().expect("a version"),
            bits: number("Public-Key: ").parse().expect("a key length"),
            subject: name("subject="),
            issuer: name("issuer="),
            not_before: time("notBefore="),
            not_after: time("notAfter="),
            extensions,
        }
    }

    /// A self-signed certificate is its own authority: signature, dates, strict form and use as a server must hold.
    pub fn verify(&self, der: &Path) {
        let pem = der.with_extension("pem");
        self.run(Command::new("openssl").args(["x509", "-inform", "DER", "-in"]).arg(der).arg("-out").arg(&pem));
        let verified = self.run(
            Command::new("openssl")
                .args(["verify", "-x509_strict", "-check_ss_sig", "-purpose", "sslserver", "-CAfile"])
                .arg(&pem)
                .arg(&pem),
        );
        assert!(verified.trim_end().ends_with(": OK"), "{verified}");
    }

    /// Runs a command of OpenSSL in a folder, where the files it names are. Panics unless it succeeds.
    pub fn call(&self, folder: &Path, arguments: &[&str]) -> String {
        self.run(Command::new("openssl").current_dir(folder).args(arguments))
    }

    fn run(&self, command: &mut Command) -> String {
        let Finished { code, stdout, stderr } = Running::start(command).expect("openssl was found").finish(ANSWER);
        assert_eq!(code, Some(0), "{command:?}\n{stdout}\n{stderr}");
        stdout
    }
}

/// Whether a peer answers its probe.
fn found(probe: &mut Command, peer: &str, install: &str) -> bool {
    if Running::start(probe).is_ok_and(|running| running.finish(ANSWER).code == Some(0)) {
        return true;
    }
    skip(peer, install);
    false
}

/// Says that something a story needs is missing, where the test harness does not swallow it.
pub fn skip(peer: &str, install: &str) {
    let missing = format!("{peer} not found; install with {install}");
    assert!(env::var_os("OPCUA_INTEROP_REQUIRED").is_none(), "{missing}");
    let _ = writeln!(stderr(), "SKIPPED: {missing}");
}

/// The one line of JSON a peer prints.
pub fn answer(command: &mut Command) -> Value {
    let Finished { code, stdout, stderr } = Running::start(command).expect("the peer was found").finish(ANSWER);
    let last = stdout.lines().last().unwrap_or_default();
    match serde_json::from_str(last) {
        Ok(answer) if code == Some(0) => answer,
        _ => panic!("{command:?} ended with {code:?}\n{stdout}\n{stderr}"),
    }
}

fn source(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/interop").join(name)
}
