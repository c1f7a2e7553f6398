//! `fins` from the command line, against simulated PLCs in processes of their own.

use std::time::Duration;

use serde_json::{Value, json};

use crate::common::command_line_test::{DONE, assert_error, program};
use crate::common::process::{Finished, Running};

const BRIDGE: &str = include_str!("../../../fixtures/fins-bridge.toml");

/// A simulated PLC, and where it answers.
struct Plc {
    running: Running,
    to: String,
}

impl Plc {
    fn start(more: &[&str]) -> Self {
        let command = [&["--json", "fins", "serve", "--bind", "127.0.0.1:0"][..], more].concat();
        let mut running = Running::start(program().args(command)).unwrap();
        let ready: Value = serde_json::from_str(&running.next_line(DONE)).unwrap();
        let to = ready["fins"].as_str().unwrap().to_owned();
        Self { running, to }
    }

    fn fins(&self, arguments: &[&str]) -> Finished {
        run(&[&["fins"][..], arguments, &["--to", &self.to]].concat())
    }

    fn json(&self, arguments: &[&str]) -> (Option<i32>, Value) {
        json_of(&[&["fins"][..], arguments, &["--to", &self.to]].concat())
    }

    fn values(&self, arguments: &[&str]) -> Value {
        let (code, line) = self.json(&[&["read"][..], arguments].concat());
        assert_eq!((code, &line["ok"], &line["plc"]), (Some(0), &json!(true), &json!(self.to)), "{line}");
        line["result"]["values"].clone()
    }
}

fn run(arguments: &[&str]) -> Finished {
    Running::start(program().args(arguments)).unwrap().finish(DONE)
}

fn json_of(arguments: &[&str]) -> (Option<i32>, Value) {
    let finished = run(&[&["--json"][..], arguments].concat());
    let line = finished.stdout.lines().last().unwrap_or_else(|| panic!("{}", finished.stderr));
    (finished.code, serde_json::from_str(line).unwrap())
}

#[test]
fn memory_is_written_and_read_over_both_transports() {
    let plc = Plc::start(&["--node", "90", "--set", "D300=123"]);
    let udp = ["--udp", "--server-node", "90"];
    for transport in [&[][..], &udp] {
        let read = |arguments: &[&str]| plc.values(&[arguments, transport].concat());
        let write = |arguments: &[&str]| {
            let (code, line) = plc.json(&[&["write"][..], arguments, transport].concat());
            assert_eq!((code, &line["ok"]), (Some(0), &json!(true)), "{line}");
        };
        write(&["DM", "310", "1", "2", "0xFFFF"]);
        assert_eq!(read(&["D310-312"]), json!([1, 2, 65_535]));
        assert_eq!(read(&["D310", "3", "--type", "i16"]), json!([1, 2, -1]));
        write(&["CIO0.14", "on", "off", "1"]);
        assert_eq!(read(&["CIO", "0.14", "3"]), json!([true, false, true]));
        write(&["E1_0", "-12.5", "0.25", "--type", "f32"]);
        assert_eq!(read(&["E1_0", "2", "--type", "f32"]), json!([-12.5, 0.25]));
        assert_eq!(read(&["E1_0", "--type", "u32", "--word-order", "high-first"]), json!([0x0000_C148]));
        write(&["D400-404", "Weld-1", "--type", "text"]);
        assert_eq!(read(&["D400-404", "--type", "text"]), json!(["Weld-1"]));
        write(&["W0", "9876", "--type", "bcd"]);
        assert_eq!(read(&["W0"]), json!([0x9876]));
    }
    let (_, line) = plc.json(&["read", "D300"]);
    assert_eq!(line["result"], json!({ "area": "DM", "address": 300, "values": [123] }));
    let (_, line) = plc.json(&["read", "D300.03", "2"]);
    assert_eq!(line["result"], json!({ "area": "DM", "address": 300, "bit": 3, "values": [true, true] }));
    let shown = plc.fins(&["read", "D300", "2"]);
    assert_eq!((shown.code, shown.stdout.as_str()), (Some(0), "D300 123\nD301 0\n"), "{}", shown.stderr);
}

#[test]
fn a_plc_says_what_it_is() {
    let plc = Plc::start(&["--node", "90", "--mode", "monitor"]);
    let (code, line) = plc.json(&["status"]);
    let result = &line["result"];
    assert_eq!(code, Some(0), "{line}");
    assert_eq!((&result["model"], &result["mode"]), (&json!("CJ2M-CPU35"), &json!("MONITOR")));
    assert_eq!((&result["server_node"], &result["running"]), (&json!(90), &json!(true)));
    for (language, word) in [("en", "User program"), ("zh", "用户程序"), ("ja", "ユーザープログラム")] {
        let shown = plc.fins(&["status", "--lang", language]);
        assert!(shown.stdout.contains(word), "{}{}", shown.stdout, shown.stderr);
    }
}

#[test]
fn what_goes_wrong_has_its_code() {
    let quick = ["--timeout", "200"];
    for (fault, arguments, code) in [
        ("silent", &["read", "D0"][..], "plc-unreachable"),
        ("loses-answers", &["read", "D0"], "plc-no-answer"),
        ("wrong-node", &["read", "D0"], "plc-no-answer"),
        ("loses-answers", &["write", "D0", "1"], "plc-write-unknown"),
        ("cut=20", &["read", "D0"], "plc-connection-lost"),
        ("cut=30", &["write", "D0", "1"], "plc-write-unknown"),
        ("end-code=2101", &["write", "D0", "1"], "plc-command-refused"),
    ] {
        // A whole answer to a write has 30 bytes.
        let fault = if fault == "cut=30" { "cut=29" } else { fault };
        let plc = Plc::start(&["--fault", fault]);
        let (exit, line) = plc.json(&[arguments, &quick].concat());
        assert_eq!(exit, Some(1), "{fault} {line}");
        assert_error(&[line], code);
    }
    let plc = Plc::start(&["--node", "90"]);
    for (arguments, code) in [
        (&["read", "A5000"][..], "plc-command-refused"),
        (&["read", "D0", "--server-node", "91"], "plc-connection-refused"),
        (&["read", "D0", "--client-node", "90"], "plc-connection-refused"),
    ] {
        let (exit, line) = plc.json(arguments);
        assert_eq!(exit, Some(1), "{line}");
        assert_error(&[line], code);
    }
    for (arguments, code) in [
        (&["read", "X5"][..], "bad-plc-address"),
        (&["read", "W500", "100"], "bad-plc-address"),
        (&["read", "D0", "x"], "bad-plc-value"),
        (&["write", "D0", "70000"], "bad-plc-value"),
        (&["write", "D0-1", "1", "2", "3"], "bad-plc-value"),
        (&["read", "D0", "--type", "u64"], "bad-plc-value"),
    ] {
        let (exit, line) = plc.json(arguments);
        assert_eq!(exit, Some(2), "{line}");
        assert_error(&[line], code);
    }
    let (exit, line) = json_of(&["fins", "read", "D0", "--to", "http://x"]);
    assert_eq!((exit, &line["error"]["code"]), (Some(2), &json!("bad-address")));
    let (exit, line) = json_of(&["fins", "serve", "--bind", &plc.to]);
    assert_eq!(exit, Some(2));
    assert_error(&[line], "plc-cannot-listen");
}

#[test]
fn an_end_code_is_explained_in_every_language() {
    let plc = Plc::start(&[]);
    for (language, text) in [
        ("en", "End code 2101: the area is read-only."),
        ("zh", "结束代码 2101：该区域只读。"),
        ("ja", "終了コード2101：エリアは読み出し専用です。"),
    ] {
        let refused = plc.fins(&["write", "A0", "1", "--lang", language]);
        assert!(refused.code == Some(1) && refused.stderr.contains(text), "{}", refused.stderr);
    }
}

#[test]
fn another_protocol_is_told_from_fins() {
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let to = listener.local_addr().unwrap().to_string();
    std::thread::spawn(move || {
        use std::io::{Read as _, Write as _};
        while let Ok((mut stream, _)) = listener.accept() {
            let _ = stream.write_all(b"SSH-2.0-OpenSSH_9.2\r\n");
            // Until the client has enough: closed earlier, the line might never arrive.
            while stream.read(&mut [0; 64]).is_ok_and(|read| read > 0) {}
        }
    });
    let (exit, line) = json_of(&["fins", "status", "--to", &to]);
    assert_eq!(exit, Some(1));
    assert_error(&[line], "not-fins");
}

#[cfg(unix)]
#[test]
fn watching_shows_changes_until_ctrl_c() {
    let plc = Plc::start(&[]);
    let command = ["--json", "fins", "watch", "D0", "2", "--interval", "20", "--to", &plc.to];
    let mut watching = Running::start(program().args(command)).unwrap();
    let mut next = || -> Value { serde_json::from_str(&watching.next_line(DONE)).unwrap() };
    assert_eq!(next()["result"]["values"], json!([0, 0]));
    plc.fins(&["write", "D1", "7"]);
    assert_eq!(next()["result"]["values"], json!([0, 7]));
    watching.signal(libc::SIGINT);
    assert_eq!(watching.finish(DONE).code, Some(0));
    plc.running.signal(libc::SIGINT);
    assert_eq!(plc.running.finish(DONE).code, Some(0));
}

#[cfg(unix)]
#[test]
fn the_sample_bridge_runs_until_ctrl_c() {
    let folder = tempfile::tempdir().unwrap();
    let map = folder.path().join("map.toml");
    let plc = Plc::start(&["--set", "D300=1,2,3,4,5"]);
    std::fs::write(&map, BRIDGE.replace("127.0.0.1:9600", &plc.to)).unwrap();
    let command = ["--json", "fins", "bridge", map.to_str().unwrap()];
    let mut bridge = Running::start(program().args(command)).unwrap();
    let row: Value = serde_json::from_str(&bridge.next_line(DONE)).unwrap();
    assert_eq!((&row["row"], &row["result"]["values"]), (&json!("product"), &json!([1, 2, 3, 4, 5])));
    assert_eq!(plc.values(&["D310-314"]), json!([1, 2, 3, 4, 5]));
    bridge.signal(libc::SIGINT);
    let ended = bridge.finish(Duration::from_secs(30));
    let summary: Value = serde_json::from_str(ended.stdout.lines().last().unwrap()).unwrap();
    assert_eq!((ended.code, &summary["ok"]), (Some(0), &json!(true)), "{summary}");
    assert!(summary["result"]["rows"][0]["copied"].as_u64().unwrap() >= 1, "{summary}");
    let counted = run(&["fins", "bridge", map.to_str().unwrap(), "--cycles", "3"]);
    assert!(counted.code == Some(0) && counted.stdout.contains("D310"), "{}{}", counted.stdout, counted.stderr);
}

#[test]
fn a_map_that_cannot_be_used_is_refused_before_anything_is_sent() {
    let folder = tempfile::tempdir().unwrap();
    let map = folder.path().join("map.toml");
    let bridge = |text: &str| {
        std::fs::write(&map, text).unwrap();
        let (exit, line) = json_of(&["fins", "bridge", map.to_str().unwrap()]);
        assert_eq!(exit, Some(2), "{line}");
        line
    };
    let line = bridge("not = a map");
    assert_error(&[line], "bad-bridge-map");
    let line = bridge(&BRIDGE.replace("\"D310\"", "\"X310\""));
    assert!(line["error"]["detail"].as_str().unwrap().contains("row 1: \"X310\" names no memory area"), "{line}");
    assert_eq!(json_of(&["fins", "bridge", "missing.toml"]).1["error"]["code"], "file-not-found");
}
