//! `remote …` against peers that answer, refuse, stay silent, hang up and damage bytes.

use std::fs;
use std::time::Instant;

use serde_json::{Value, json};

use crate::common::command_line_test::{CommandLineTest, DONE, assert_error, program};
use crate::common::process::{Finished, Running};
use crate::common::remote_peer::{RemotePeer, accept};

/// Runs `remote …` with a workspace of its own that is empty.
fn remote(arguments: &[&str]) -> Finished {
    let workspace = tempfile::tempdir().unwrap();
    let mut command = program();
    command.arg("--workspace").arg(workspace.path());
    if !arguments.contains(&"--lang") {
        command.args(["--lang", "en"]);
    }
    command.args(arguments);
    Running::start(&mut command).unwrap().finish(DONE)
}

/// The same with `--json` and `--yes`: exit code, and one value a line.
fn remote_json(arguments: &[&str]) -> (Option<i32>, Vec<Value>) {
    let finished = remote(&[&["--json", "--yes", "remote"], arguments].concat());
    (finished.code, finished.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect())
}

const READY: &[u8] = b"#GetStatus,00100000001,0000\r\n";

#[test]
fn every_command_is_sent_and_its_answer_printed() {
    for (arguments, request, answer, result) in [
        (
            &["status"][..],
            "$GetStatus",
            "#GetStatus,00110000010,0517",
            json!({"flags": ["Auto", "Warning", "Running"], "code": 517}),
        ),
        (&["start"], "$Start,0", "#Start,0", json!({"done": "Start"})),
        (&["start", "63"], "$Start,63", "#Start,0", json!({"done": "Start"})),
        (&["stop"], "$Stop", "#Stop,0", json!({"done": "Stop"})),
        (&["pause"], "$Pause", "#Pause,0", json!({"done": "Pause"})),
        (&["continue"], "$Continue", "#Continue,0", json!({"done": "Continue"})),
        (&["reset"], "$Reset", "#Reset,0", json!({"done": "Reset"})),
        (&["abort"], "$Abort", "#Abort,0", json!({"done": "Abort"})),
        (&["motors", "on"], "$SetMotorsOn,0", "#SetMotorsOn,0", json!({"done": "SetMotorsOn"})),
        (&["motors", "off", "--robot", "2"], "$SetMotorsOff,2", "#SetMotorsOff,0", json!({"done": "SetMotorsOff"})),
        (&["home", "3"], "$Home,3", "#Home,0", json!({"done": "Home"})),
        (&["robot"], "$GetCurRobot", "#GetCurRobot,2", json!({"robot": 2})),
        (&["robot", "1"], "$SetCurRobot,1", "#SetCurRobot,0", json!({"done": "SetCurRobot"})),
        (&["io", "get", "1"], "$GetIO,1", "#GetIO,1", json!({"value": true})),
        (&["io", "get", "1", "--as", "byte"], "$GetIOByte,1", "#GetIOByte,0F", json!({"value": 15})),
        (&["io", "get", "1", "--as", "word"], "$GetIOWord,1", "#GetIOWord,010F", json!({"value": 271})),
        (&["io", "set", "1", "on"], "$SetIO,1,1", "#SetIO,0", json!({"done": "SetIO"})),
        (&["io", "set", "1", "0x0F", "--as", "byte"], "$SetIOByte,1,0F", "#SetIOByte,0", json!({"done": "SetIOByte"})),
        (&["io", "set", "1", "271", "--as", "word"], "$SetIOWord,1,010F", "#SetIOWord,0", json!({"done": "SetIOWord"})),
        (&["mem", "get", "7"], "$GetMemIO,7", "#GetMemIO,0", json!({"value": false})),
        (&["mem", "set", "7", "off"], "$SetMemIO,7,0", "#SetMemIO,0", json!({"done": "SetMemIO"})),
        (&["mem", "get", "7", "--as", "word"], "$GetMemIOWord,7", "#GetMemIOWord,FFFF", json!({"value": 65535})),
        (
            &["var", "get", "g_Status", "--type", "integer"],
            "$GetVariable,g_Status,Integer",
            "#GetVariable,-3",
            json!({"value": -3}),
        ),
        (
            &["var", "get", "g_pos(3,0)", "--type", "Real", "--count", "2"],
            "$GetVariable,g_pos(3,0),Real,2",
            "#GetVariable,0.1,-20.002",
            json!({"values": [0.1, -20.002]}),
        ),
        (
            &["var", "set", "g_Status", "-5", "--type", "Integer"],
            "$SetVariable,g_Status,-5,Integer",
            "#SetVariable,0",
            json!({"done": "SetVariable"}),
        ),
        (&["exec", "print here"], "$Execute,\"print here\"", "#Execute,\" X: 1\"", json!({"result": " X: 1"})),
        (&["exec", "Motor On"], "$Execute,\"Motor On\"", "#Execute,0", json!({"result": null})),
        (&["alarms"], "$GetAlm", "#GetAlm,2,1,9", json!({"alarms": [1, 9]})),
        (&["alarms", "--reset", "9"], "$ResetAlm,9", "#ResetAlm,0", json!({"done": "ResetAlm"})),
        (&["raw", "$getio,4"], "$GetIO,4", "#GetIO,0", json!({"value": false})),
    ] {
        let peer = RemotePeer::start(move |listener| {
            let mut line = accept(listener);
            line.log_in();
            line.answer(format!("{request}\r\n").as_bytes(), format!("{answer}\r\n").as_bytes());
            line.expect_end();
        });
        let (code, lines) = remote_json(&[arguments, &["--to", &peer.text()]].concat());
        let expected = json!({"controller": peer.text(), "ok": true, "result": result});
        assert_eq!((code, lines), (Some(0), vec![expected]), "{arguments:?}");
        peer.end();
    }
}

#[test]
fn a_controller_says_who_it_is() {
    let peer = RemotePeer::start(|listener| {
        let mut line = accept(listener);
        line.log_in();
        for (command, answer) in [("GetContName", "#GetContName,Cell 7"), ("GetContNo", "#GetContNo,RC7C0012345")] {
            line.answer(format!("${command}\r\n").as_bytes(), format!("{answer}\r\n").as_bytes());
        }
        // Everything else is unknown to this firmware.
        for command in [
            "GetContType",
            "GetContVer",
            "GetContDev",
            "GetSubnetMask",
            "GetDefaultGateway",
            "GetContMacAdd",
            "GetPrjName",
            "GetCpuLoad",
            "GetHealthCont",
            "GetRobotInfo",
            "GetRobotName,0",
            "GetRobotSerial,0",
            "GetMotor,0",
        ] {
            let name = command.split(',').next().unwrap();
            line.answer(format!("${command}\r\n").as_bytes(), format!("!{name},11\r\n").as_bytes());
        }
        line.expect_end();
    });
    let finished = remote(&["remote", "info", "--to", &peer.text()]);
    assert_eq!(finished.code, Some(0), "{}", finished.stderr);
    assert!(finished.stdout.contains("Cell 7") && finished.stdout.contains("RC7C0012345"), "{}", finished.stdout);
    peer.end();
}

#[test]
fn the_password_comes_from_a_file_and_a_wrong_one_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("password");
    fs::write(&file, "secret\r\n").unwrap();
    let peer = RemotePeer::start(|listener| {
        let mut line = accept(listener);
        line.answer(b"$Login,secret\r\n", b"#Login,0\r\n");
        line.expect_end();
        let mut line = accept(listener);
        line.answer(b"$Login,secret\r\n", b"!Login,13\r\n");
        line.expect_end();
        let mut line = accept(listener);
        line.answer(b"$Login,\r\n", b"!Login,98\r\n");
        line.expect_end();
    });
    let to = peer.text();
    let with_file = ["login-check", "--to", &to, "--remote-password-file", file.to_str().unwrap(), "--trace"];
    let finished = remote(&[&["remote"], &with_file[..]].concat());
    assert_eq!(finished.code, Some(0), "{}", finished.stderr);
    assert!(finished.stdout.contains("login succeeded"), "{}", finished.stdout);
    assert!(finished.stderr.contains("$Login,***") && !finished.stderr.contains("secret"), "{}", finished.stderr);
    let (code, lines) = remote_json(&with_file);
    assert_eq!(code, Some(1));
    assert_error(&lines, "remote-wrong-password");
    let (code, lines) = remote_json(&["login-check", "--to", &to]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "remote-password-required");
    peer.end();
    // No controller can have it: nothing is sent.
    fs::write(&file, "seventeen letters").unwrap();
    let (code, lines) = remote_json(&with_file);
    assert_eq!(code, Some(2));
    assert_error(&lines, "remote-wrong-password");
}

#[test]
fn a_silent_controller_ends_at_the_limit() {
    let peer = RemotePeer::start(|listener| {
        let mut line = accept(listener);
        line.log_in();
        line.expect(b"$GetStatus\r\n");
        line.expect_end();
        let mut line = accept(listener);
        line.expect(b"$Login,\r\n");
        line.expect_end();
    });
    let begun = Instant::now();
    for _ in 0..2 {
        let (code, lines) = remote_json(&["status", "--to", &peer.text(), "--timeout", "1"]);
        assert_eq!(code, Some(1));
        assert_error(&lines, "remote-no-answer");
    }
    assert!(begun.elapsed() < DONE / 4);
    peer.end();
}

#[test]
fn a_lost_answer_of_an_acting_command_is_unknown() {
    let peer = RemotePeer::start(|listener| {
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$GetStatus\r\n", b"#GetStatus,0010");
        drop(line);
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$Start,0\r\n", b"#St");
        drop(line);
        let line = accept(listener);
        drop(line);
    });
    let to = peer.text();
    let (code, lines) = remote_json(&["status", "--to", &to]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "connection-lost");
    let (code, lines) = remote_json(&["start", "--to", &to]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "remote-outcome-unknown");
    let (_, lines) = remote_json(&["status", "--to", &to]);
    assert_error(&lines, "remote-occupied");
    peer.end();
    let (_, lines) = remote_json(&["status", "--to", &to]);
    assert_error(&lines, "unreachable");
}

#[test]
fn a_damaged_frame_is_asked_for_again_only_by_commands_that_read() {
    let peer = RemotePeer::start(|listener| {
        let mut line = accept(listener);
        line.log_in_frames();
        line.answer(b"\x02i\x00\x01\x03\x6b", b"\x06i\x01\x03\x6a");
        line.answer(b"\x02i\x00\x01\x03\x6b", b"\x06i\x01\x03\x6b");
        line.expect_end();
        let mut line = accept(listener);
        line.log_in_frames();
        line.answer(b"\x02I\x00\x01\x01\x03\x4a", b"\x06I\x03\x4b");
        line.expect_end();
        let mut line = accept(listener);
        line.log_in_frames();
        line.answer(b"\x02I\x00\x01\x01\x03\x4a", b"\x15I16\x03\x4d");
        line.expect_end();
    });
    let to = peer.frames();
    let (code, lines) = remote_json(&["io", "get", "1", "--to", &to]);
    assert_eq!((code, &lines[0]["result"]), (Some(0), &json!({"value": true})));
    let (code, lines) = remote_json(&["io", "set", "1", "on", "--to", &to]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "remote-outcome-unknown");
    let (code, lines) = remote_json(&["io", "set", "1", "on", "--to", &to]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "remote-line-disturbed");
    peer.end();
}

#[test]
fn a_refusal_for_the_state_says_what_to_do() {
    let peer = RemotePeer::start(|listener| {
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$Start,0\r\n", b"!Start,20\r\n");
        line.answer(b"$GetStatus\r\n", b"#GetStatus,01000100001,0000\r\n");
        line.expect_end();
    });
    let finished = remote(&["--yes", "remote", "start", "--to", &peer.text()]);
    assert_eq!(finished.code, Some(1));
    for text in ["does not accept", "Auto on: The mode is not AUTO", "Safeguard off: The safeguard is open. Close it."]
    {
        assert!(finished.stderr.contains(text), "{}", finished.stderr);
    }
    peer.end();
}

#[test]
fn what_acts_is_confirmed_before_anything_is_sent() {
    let peer = RemotePeer::start(|listener| {
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$GetStatus\r\n", READY);
        line.expect_end();
    });
    let to = peer.text();
    let finished = remote(&["--json", "remote", "motors", "on", "--to", &to]);
    assert_eq!(finished.code, Some(2));
    assert_error(&[serde_json::from_str(&finished.stdout).unwrap()], "not-confirmed");
    // What reads needs no confirmation.
    let finished = remote(&["--lang", "zh", "remote", "status", "--to", &to]);
    assert_eq!((finished.code, finished.stdout.trim()), (Some(0), "Auto、Ready"));
    peer.end();
}

#[test]
fn a_request_that_cannot_be_sent_is_named() {
    let to = "tcp://127.0.0.1:9";
    for (arguments, why) in [
        (&["io", "set", "1", "perhaps"][..], "perhaps"),
        (&["io", "set", "1", "256", "--as", "byte"], "0x00–0xFF"),
        (&["io", "get", "256", "--as", "word"], "0–255"),
        (&["var", "get", "2fast", "--type", "Byte"], "2fast"),
        (&["var", "get", "g_a(1,2,3,4)", "--type", "Byte"], "name(1,2,3)"),
        (&["var", "get", "g_a(1)", "--type", "Byte", "--count", "101"], "1–100"),
        (&["var", "get", "g_a(1)", "--type", "String"], "Double"),
        (&["var", "set", "g_a", "300", "--type", "Byte"], "300"),
        (&["exec", ""], "too long"),
        (&["raw", "$SetIO,1,2"], "field on, byte 9"),
    ] {
        let (code, lines) = remote_json(&[arguments, &["--to", to]].concat());
        assert_eq!(code, Some(2), "{lines:?}");
        assert_error(&lines, "remote-request-invalid");
        assert!(lines[0]["error"]["detail"].as_str().unwrap().contains(why), "{lines:?}");
    }
    for to in ["weld", "http://127.0.0.1", "raw-tcp://127.0.0.1", "serial:COM1?baud=300"] {
        let (code, lines) = remote_json(&["status", "--to", to]);
        assert_eq!(code, Some(2), "{to}");
        assert_error(&lines, "bad-remote-target");
    }
    let (code, lines) = remote_json(&["status", "--to", "serial:/dev/no-such-port"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "serial-port-unavailable");
}

#[test]
fn a_controller_of_the_list_is_reached_at_its_address() {
    let test = CommandLineTest::start(1);
    assert_eq!(test.add(0, "weld").0, Some(0));
    let (code, lines) = test.json(&["remote", "status", "--to", "weld", "--timeout", "1"]);
    // Whatever answers at port 5000 of this computer is no controller.
    assert_eq!((code, &lines[0]["controller"]), (Some(1), &json!("weld")));
    assert!(
        lines[0]["error"]["detail"].as_str().is_some_and(|detail| detail.contains("tcp://127.0.0.1:5000")),
        "{lines:?}"
    );
}

#[test]
fn values_are_followed_over_a_lost_connection() {
    let peer = RemotePeer::start(|listener| {
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$GetStatus\r\n", READY);
        line.answer(b"$GetStatus\r\n", READY);
        line.answer(b"$GetStatus\r\n", b"#GetStatus,00100000010,0000\r\n");
        line.expect(b"$GetStatus\r\n");
        drop(line);
        let mut line = accept(listener);
        line.log_in();
        line.answer(b"$GetStatus\r\n", READY);
        // Logged out in the controller, and locked: another try changes nothing.
        line.answer(b"$GetStatus\r\n", b"!GetStatus,11\r\n");
        line.expect_end();
    });
    let (code, lines) = remote_json(&["status", "--watch=0.05", "--to", &peer.text()]);
    assert_eq!(code, Some(1));
    let flags: Vec<String> = lines.iter().map(|line| line["result"]["flags"].to_string()).collect();
    let ready = r#"["Auto","Ready"]"#;
    assert_eq!(flags, [ready, r#"["Auto","Running"]"#, "null", ready, "null"]);
    assert_error(&lines[2..], "connection-lost");
    assert_error(&lines[4..], "remote-command-unknown");
    peer.end();
}

#[cfg(unix)]
#[test]
fn a_controller_on_a_serial_line_is_spoken_to() {
    use std::fs::File;
    use std::os::fd::{FromRawFd as _, OwnedFd};

    use crate::common::remote_peer::RemoteLine;

    let (mut controller, mut computer) = (-1, -1);
    let mut name = [0; 128];
    let null = std::ptr::null_mut();
    // SAFETY: the numbers and the name outlive the call, and the other parameters may be null.
    let made =
        unsafe { libc::openpty(&raw mut controller, &raw mut computer, name.as_mut_ptr(), null, std::ptr::null_mut()) };
    assert_eq!(made, 0, "{}", std::io::Error::last_os_error());
    // SAFETY: the call has written a text with its end.
    let name = unsafe { std::ffi::CStr::from_ptr(name.as_ptr()) }.to_str().unwrap().to_owned();
    // SAFETY: the call gave them to us alone. This end stays open, so that the line does not end before it was opened.
    let (mut line, computer) = unsafe { (RemoteLine(File::from_raw_fd(controller)), OwnedFd::from_raw_fd(computer)) };
    let peer = std::thread::spawn(move || {
        line.log_in_frames();
        line.answer(b"\x02w\x01\x03\x75", b"\x06w\x01\x0f\x03\x7a");
        line
    });
    let to = format!("serial:{name}?baud=19200");
    let (code, lines) = remote_json(&["io", "get", "1", "--as", "word", "--to", &to]);
    assert_eq!((code, &lines[0]["result"]), (Some(0), &json!({"value": 271})), "{lines:?}");
    drop(peer.join().unwrap());
    drop(computer);
}

/// Repeats a command until it succeeds: a controller talks to one client, and notices the end of the last one when it reads.
fn done(arguments: &[&str]) -> Value {
    let begun = Instant::now();
    loop {
        let (code, lines) = remote_json(arguments);
        if code == Some(0) {
            return lines[0]["result"].clone();
        }
        let waits = matches!(lines[0]["error"]["code"].as_str(), Some("remote-occupied" | "remote-not-ready"));
        assert!(waits && begun.elapsed() < DONE, "{arguments:?}: {lines:?}");
    }
}

#[test]
fn a_virtual_controller_obeys_in_both_forms() {
    let mut command = program();
    command.args(["virtual", "--remote-port", "0", "--remote-frames-port", "0"]);
    let mut controller = Running::start(&mut command).unwrap();
    let ready: Value = serde_json::from_str(&controller.next_line(DONE)).unwrap();
    let word = |key: &str| ready[key].as_str().unwrap().to_owned();
    for to in [format!("tcp://{}", word("remote")), format!("raw-tcp://{}", word("remote_frames"))] {
        let to = ["--to", to.as_str()];
        let on = |arguments: &[&str]| done(&[arguments, &to].concat());
        on(&["stop"]);
        on(&["motors", "on"]);
        on(&["mem", "set", "40", "on"]);
        assert_eq!(on(&["mem", "get", "5", "--as", "byte"]), json!({"value": 1}));
        on(&["mem", "set", "5", "0", "--as", "byte"]);
        assert_eq!(on(&["mem", "get", "40"]), json!({"value": false}));
        assert_eq!(on(&["robot"]), json!({"robot": 1}));
        assert!(on(&["alarms"])["alarms"].is_array());
        on(&["start"]);
        let (code, lines) = remote_json(&[&["start"], &to[..]].concat());
        assert_eq!(code, Some(1));
        assert_error(&lines, "remote-not-ready");
        assert!(lines[0]["error"]["detail"].as_str().is_some_and(|detail| detail.contains("Ready on")), "{lines:?}");
        on(&["pause"]);
        assert!(on(&["status"])["flags"].as_array().unwrap().contains(&json!("Paused")));
        on(&["stop"]);
    }
    let (code, lines) = remote_json(&["info", "--to", &format!("tcp://{}", word("remote"))]);
    assert_eq!((code, &lines[0]["result"]["serial"]), (Some(0), &ready["serial"]), "{lines:?}");
}
