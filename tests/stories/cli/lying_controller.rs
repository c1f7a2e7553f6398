//! A controller with the right identity that lies: the work ends, memory is bounded, and terminals show text.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use opcua_configurator::model::{ClientList, ErrorCode, Problem};
use opcua_configurator::session::{Connector as _, ControllerSession, ManagementConnector, ManagementTimeouts};
use serde_json::{Value, json};

use crate::common::command_line_test::program;
use crate::common::https;
use crate::common::process::{Finished, Running};

const ESCAPES: &str = "\u{1b}[2J\u{202e}gone\u{9b}31m";

fn info() -> Value {
    json!({
        "name": "liar", "serial": "RC80010001", "series": "RC800", "firmware": "8.0.0", "status": "Stop", "error": null,
        "activated": true, "certificate": null, "application_name": "a", "endpoint": "opc.tcp://127.0.0.1:4840",
        "used_ports": [], "limits": {"trusted": 50, "issuers": 50, "crls": 50}, "clock": "2026-01-01T00:00:00Z",
        "revision": 1
    })
}

fn ok(body: &Value) -> (String, String) {
    ("200 OK".to_owned(), body.to_string())
}

/// A controller that answers `path` as said and everything else as an honest one does.
struct Liar {
    runtime: tokio::runtime::Runtime,
    address: String,
    fingerprint: opcua_configurator::pki::Fingerprint,
    asked: Arc<AtomicUsize>,
}

impl Liar {
    fn new(path: &'static str, lie: impl Fn(&str) -> (String, String) + Send + Sync + 'static) -> Self {
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build().unwrap();
        let asked = Arc::new(AtomicUsize::new(0));
        let counted = asked.clone();
        let (address, identity) = runtime.block_on(https::serve(move |line| {
            let target = line.split(' ').nth(1).unwrap_or_default();
            if target.starts_with(path) {
                counted.fetch_add(1, Ordering::Relaxed);
                return lie(target);
            }
            match target {
                "/v1/login" => ok(&json!({ "token": "t", "idle_secs": 300 })),
                "/v1/logout" => ("204 No Content".to_owned(), String::new()),
                "/v1/info" => ok(&info()),
                _ => ok(&json!({ "revision": 1, "value": [] })),
            }
        }));
        Self { runtime, address: address.to_string(), fingerprint: identity.fingerprint(), asked }
    }

    fn asked(&self) -> usize {
        self.asked.load(Ordering::Relaxed)
    }

    fn session(&self) -> Box<dyn ControllerSession> {
        let timeouts = ManagementTimeouts { connect: DEADLINE, read: DEADLINE, change: DEADLINE };
        let address = self.address.parse().unwrap();
        let connector = ManagementConnector { timeouts };
        let connecting = async { connector.connect(&address, self.fingerprint, &"".into()).await };
        self.runtime.block_on(connecting).unwrap_or_else(|problem| panic!("{problem}"))
    }

    /// Runs the command line against it.
    fn run(&self, arguments: &[&str]) -> Finished {
        let folder = tempfile::tempdir().unwrap();
        let password = folder.path().join("password");
        std::fs::write(&password, "x").unwrap();
        let command = |arguments: &[&str]| {
            let mut command = program();
            command.arg("--workspace").arg(folder.path().join("workspace"));
            command.arg("--connection-password-file").arg(&password).args(arguments);
            Running::start(&mut command).unwrap().finish(DEADLINE)
        };
        let fingerprint = self.fingerprint.to_string();
        let added =
            command(&["controllers", "add", "liar", &self.address, "--series", "RC800", "--fingerprint", &fingerprint]);
        assert_eq!(added.code, Some(0), "{}", added.stderr);
        command(arguments)
    }
}

const DEADLINE: Duration = Duration::from_secs(60);

/// What a terminal would obey.
fn commands(text: &str) -> bool {
    text.chars().any(|c| (c.is_control() && c != '\n') || c == '\u{202e}')
}

#[test]
fn a_log_without_end_is_not_read_without_end() {
    let from = |target: &str| target.rsplit('=').next().and_then(|from| from.parse().ok()).unwrap_or(0_u64);
    let empty = Liar::new("/v1/log?", move |target| {
        let from = from(target);
        ok(&json!({ "size": u64::MAX, "from": from, "next": from + 1, "text": "" }))
    });
    let shown = empty.run(&["log", "show", "liar"]);
    assert_eq!(shown.code, Some(1), "{}", shown.stderr);
    assert_eq!(empty.asked(), 1);

    let drip = Liar::new("/v1/log?", move |target| {
        let from = from(target);
        ok(&json!({ "size": u64::MAX, "from": from, "next": from + 1, "text": "x" }))
    });
    let begin = Instant::now();
    let shown = drip.run(&["log", "show", "liar"]);
    assert_eq!((shown.code, shown.stdout.trim_end().len()), (Some(0), 256), "{}", shown.stderr);
    assert!(shown.stderr.contains("256 of 18446744073709551615 bytes"), "{}", shown.stderr);
    assert!(drip.asked() <= 256 && begin.elapsed() < DEADLINE, "{} {:?}", drip.asked(), begin.elapsed());

    let elsewhere = Liar::new("/v1/log?", |_| ok(&json!({ "size": 9, "from": 7, "next": 3, "text": "x" })));
    assert_eq!(elsewhere.run(&["log", "show", "liar"]).code, Some(1));
}

#[test]
fn a_log_commands_no_terminal_and_keeps_its_bytes_in_json() {
    let text = format!("one {ESCAPES}\r\ntwo\n");
    let size = text.len();
    let liar = Liar::new("/v1/log?", move |_| ok(&json!({ "size": size, "from": 0, "next": size, "text": text })));
    let shown = liar.run(&["log", "show", "liar"]);
    assert_eq!(shown.stdout, "one �[2J�gone�31m\ntwo\n");
    let json = liar.run(&["--json", "log", "show", "liar"]);
    let line: Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(line["result"]["text"], format!("one {ESCAPES}\r\ntwo\n"));
    assert!(!json.stdout.contains('\u{1b}'), "{}", json.stdout);
}

#[test]
fn a_failure_is_one_line_with_an_end() {
    for code in ["refused", "580", "out-of-coffee", "cancelled"] {
        let message = ESCAPES.repeat(100_000);
        let failure = json!({ "code": code, "message": message, "detail": message }).to_string();
        let liar = Liar::new("/v1/settings", move |_| ("400 Bad Request".to_owned(), failure.clone()));
        let shown = liar.run(&["settings", "show", "liar"]);
        assert_eq!(shown.code, Some(1));
        assert!(!commands(&shown.stderr) && !commands(&shown.stdout), "{code} {}", shown.stderr);
        assert!(shown.stderr.len() < 4096 && shown.stderr.lines().count() == 3, "{code} {}", shown.stderr.len());
    }
}

#[test]
fn names_and_reasons_command_no_terminal() {
    let mut named = info();
    for text in ["name", "application_name", "endpoint"] {
        named[text] = format!("a\n{ESCAPES}").into();
    }
    named["error"] = "cancelled".into();
    let liar = Liar::new("/v1/info", move |_| ok(&named));
    let shown = liar.run(&["info", "liar"]);
    assert_eq!(shown.code, Some(0), "{}", shown.stderr);
    assert!(!commands(&shown.stdout), "{}", shown.stdout);
    let read = liar.runtime.block_on(liar.session().info()).unwrap();
    assert_eq!((read.name.as_str(), read.error), ("a �[2J�gone�31m", Some(ErrorCode::ServerError)));
}

fn certificate() -> Value {
    json!({
        "issued_to": ESCAPES, "issued_by": "b", "serial_number": "01", "not_before": "2020-01-01T00:00:00Z",
        "not_after": "9999-12-31T23:59:59Z", "thumbprint": "AB", "key_bits": 2048, "application_uri": null
    })
}

fn listed(summary: &Value, count: usize) -> Value {
    let one = json!({
        "file_name": ESCAPES, "certificate": "", "summary": summary, "added": "2026-01-01T00:00:00Z"
    });
    json!({ "revision": 1, "value": vec![one; count] })
}

fn trusted(answer: Value) -> Result<(String, String), Problem> {
    let liar = Liar::new("/v1/clients", move |_| ok(&answer));
    let read = liar.runtime.block_on(liar.session().clients(ClientList::Trusted))?.value;
    Ok((read[0].file_name.clone(), read[0].summary.issued_to.clone()))
}

#[test]
fn lists_have_an_end_and_times_are_in_the_calendar() {
    let shown = || "�[2J�gone�31m".to_owned();
    assert_eq!(trusted(listed(&certificate(), 1024)), Ok((shown(), shown())));
    let refused = |answer| trusted(answer).unwrap_err().code;
    assert_eq!(refused(listed(&certificate(), 1025)), ErrorCode::NotAController);
    for (member, value) in [
        ("not_after", json!("+262142-12-31T23:59:59Z")),
        ("not_before", json!("-262000-01-01T00:00:00Z")),
        ("issued_by", json!("x".repeat(5000))),
    ] {
        let mut lie = certificate();
        lie[member] = value;
        assert_eq!(refused(listed(&lie, 1)), ErrorCode::NotAController, "{member}");
    }
}

/// The serial number names the folder of everything that is saved for a controller.
#[test]
fn a_serial_number_leads_into_no_other_folder() {
    for serial in ["CA", "configurator", "NUL", "com1", "../x", "a/b", "a.", ""] {
        let mut named = info();
        named["serial"] = serial.into();
        let liar = Liar::new("/v1/info", move |_| ok(&named));
        let refused = liar.runtime.block_on(liar.session().info()).unwrap_err();
        assert_eq!(refused.code, ErrorCode::NotAController, "{serial}");
    }
}

/// An identifier of a list becomes a part of the next request's path.
#[test]
fn a_list_of_crls_without_crls_ends() {
    let crl = |id: &str| {
        json!({
            "file_name": "x.crl",
            "summary": {
                "issuer": "x", "this_update": "2026-01-01T00:00:00Z", "next_update": null, "entries": 0, "number": null,
                "id": id
            },
            "added": "2026-01-01T00:00:00Z"
        })
    };
    for id in ["../info", "a?b", "%00"] {
        let answer = json!({ "revision": 1, "value": [crl(id)] });
        let liar = Liar::new("/v1/crls", move |_| ok(&answer));
        let refused = liar.runtime.block_on(liar.session().crls()).unwrap_err();
        assert_eq!(refused.code, ErrorCode::NotAController, "{id}");
    }
    let many = json!({ "revision": 1, "value": vec![crl("AB"); 1025] });
    let liar = Liar::new("/v1/crls", move |_| ok(&many));
    assert_eq!(liar.run(&["crl", "list", "liar"]).code, Some(1));
    assert_eq!(liar.asked(), 1);
}
