//! The peers that show certificates, or judge them: what they try, and what came of it.

use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde::Serialize;
use serde_json::Value;

use super::authority::Application;
use super::peers::{Node, Python};
use crate::common::process::Running;

/// Security policies and message modes, as the peers name them.
pub const NONE: [&str; 2] = ["None", "None"];
pub const ENCRYPTED: [&str; 2] = ["Basic256Sha256", "SignAndEncrypt"];
pub const NEWEST: [&str; 2] = ["Aes256Sha256RsaPss", "Sign"];
pub const ALL: [[&str; 2]; 5] =
    [NONE, ["Basic256Sha256", "Sign"], ENCRYPTED, NEWEST, ["Aes256Sha256RsaPss", "SignAndEncrypt"]];

/// A session to be opened.
#[derive(Debug, Clone, Serialize)]
pub struct Attempt {
    pub name: String,
    pub url: String,
    pub policy: &'static str,
    pub mode: &'static str,
    pub certificate: Option<PathBuf>,
    pub key: Option<PathBuf>,
    /// Sent along, the direct issuer first.
    pub chain: Vec<PathBuf>,
    /// What the client says in CreateSession.
    pub uri: String,
    /// How the client judges the server; not at all if there is nothing here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub judge: Option<ClientsLists>,
}

/// Folders with what a client trusts.
#[derive(Debug, Clone, Serialize)]
pub struct ClientsLists {
    pub trusted: PathBuf,
    pub crls: PathBuf,
}

impl Attempt {
    pub fn new(url: &str, client: &Application, [policy, mode]: [&'static str; 2]) -> Self {
        Self {
            name: client.name.clone(),
            url: url.to_owned(),
            policy,
            mode,
            certificate: Some(client.files.certificate.clone()),
            key: Some(client.files.key.clone()),
            chain: Vec::new(),
            uri: client.uri(),
            judge: None,
        }
    }

    /// Without security, and without a certificate at hand.
    pub fn bare(url: &str) -> Self {
        Self {
            name: "bare".to_owned(),
            url: url.to_owned(),
            policy: "None",
            mode: "None",
            certificate: None,
            key: None,
            chain: Vec::new(),
            uri: "urn:interop:bare".to_owned(),
            judge: None,
        }
    }
}

/// A server to be run by asyncua, which takes any client.
#[derive(Debug, Serialize)]
pub struct Server<'a> {
    pub name: &'a str,
    pub uri: String,
    pub certificate: PathBuf,
    pub key: PathBuf,
    /// As asyncua names them.
    pub policies: &'a [&'a str],
}

/// A peer that runs, does one thing after the other, and tells what happens.
pub struct Peer {
    pub name: &'static str,
    /// What it makes of all that a server tells a client whose certificate it does not take: BadSecurityChecksFailed.
    pub refusal: &'static str,
    running: Running,
}

impl Peer {
    /// Those that are installed, started; `None` if there is none.
    pub fn found() -> Option<Vec<Self>> {
        let node = Node::find()
            .map(|node| Self::start("node-opcua", "rejected by server", &mut node.script("trust_peer.mjs")));
        let peers: Vec<_> = Python::find().as_ref().map(Self::asyncua).into_iter().chain(node).collect();
        (!peers.is_empty()).then_some(peers)
    }

    pub fn asyncua(python: &Python) -> Self {
        Self::start("asyncua", "BadSecurityChecksFailed", &mut python.script("trust_peer.py"))
    }

    fn start(name: &'static str, refusal: &'static str, command: &mut Command) -> Self {
        let running = Running::start_with(command, Stdio::piped()).expect("the peer was found");
        Self { name, refusal, running }
    }

    /// Opens a session and closes it again; the name of the status it was refused with, or `None` if it got in.
    pub fn attempt(&mut self, attempt: &Attempt) -> Option<String> {
        let answer = self.ask("attempt", &attempt.name, attempt);
        match answer["ok"].as_bool().unwrap_or_else(|| panic!("{}: {answer}", self.name)) {
            true => {
                assert_eq!(answer["state"], "Running", "{}: {answer}", self.name);
                None
            }
            false => Some(answer["error"].as_str().unwrap_or_default().to_owned()),
        }
    }

    /// Opens a session that stays open.
    pub fn hold(&mut self, attempt: &Attempt) {
        let answer = self.ask("hold", &attempt.name, attempt);
        assert_eq!(answer["connected"], true, "{}: {answer}", self.name);
    }

    /// When the named session, and no other, was found to be ended by its server.
    pub fn lost(&mut self, name: &str) -> Instant {
        let answer = self.next(name);
        let heard = Instant::now();
        assert_eq!(answer["lost"], true, "{}: {answer}", self.name);
        heard
    }

    /// Runs a server until this value is dropped; its port.
    pub fn serve(&mut self, server: &Server<'_>) -> u16 {
        let answer = self.ask("serve", server.name, server);
        answer["port"].as_u64().and_then(|port| port.try_into().ok()).unwrap_or_else(|| panic!("{answer}"))
    }

    fn ask(&mut self, order: &str, name: &str, what: &impl Serialize) -> Value {
        let mut line = serde_json::to_value(what).expect("plain values");
        line["order"] = order.into();
        self.running.write_line(&line.to_string());
        self.next(name)
    }

    fn next(&mut self, name: &str) -> Value {
        let line = self.running.next_line(ANSWER);
        let answer: Value = serde_json::from_str(&line).unwrap_or_else(|e| panic!("{}: {e} in: {line}", self.name));
        assert_eq!(answer["name"], name, "{}: {answer}", self.name);
        answer
    }
}

const ANSWER: Duration = Duration::from_secs(60);
