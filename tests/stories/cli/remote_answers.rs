//! Virtual controllers that answer remote commands, with plain sockets and files as clients.

use std::io::{Read as _, Write};
use std::net::TcpStream;
use std::time::Duration;

use serde_json::Value;

use crate::common::command_line_test::{DONE, assert_error, program};
use crate::common::process::Running;

fn ready(controllers: &mut Running) -> Value {
    serde_json::from_str(&controllers.next_line(DONE)).unwrap()
}

/// Sends a line, and takes what one read brings as the answer.
fn ask(stream: &mut TcpStream, line: &str) -> String {
    stream.write_all(format!("{line}\r\n").as_bytes()).unwrap();
    let mut answer = [0; 1024];
    let length = stream.read(&mut answer).unwrap();
    String::from_utf8(answer[..length].to_vec()).unwrap()
}

fn connect(address: &Value) -> TcpStream {
    let stream = TcpStream::connect(address.as_str().unwrap()).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    stream
}

#[test]
fn each_controller_of_a_fleet_answers_at_its_own_ports() {
    let folder = tempfile::tempdir().unwrap();
    let password = folder.path().join("password");
    std::fs::write(&password, "secret 1\n").unwrap();
    let mut command = program();
    command.args(["virtual", "--count", "2", "--remote-port", "0", "--remote-frames-port", "0"]);
    command.args(["--remote-role", "monitor", "--remote-terminator", "lf", "--remote-password-file"]).arg(&password);
    let mut controllers = Running::start(&mut command).unwrap();
    let lines = [ready(&mut controllers), ready(&mut controllers)];
    assert_ne!(lines[0]["remote"], lines[1]["remote"]);
    assert_ne!(lines[0]["remote"], lines[0]["remote_frames"]);
    for line in &lines {
        assert_eq!(line.get("remote_serial"), None);
        let mut client = connect(&line["remote"]);
        assert_eq!(ask(&mut client, "$Login,secret"), "!Login,13\n");
        assert_eq!(ask(&mut client, "$Login,secret 1"), "#Login,0\n");
        assert_eq!(ask(&mut client, "$GetContNo"), format!("#GetContNo,{}\n", line["serial"].as_str().unwrap()));
        assert_eq!(ask(&mut client, "$Stop"), "!Stop,20\n");
        let mut frames = connect(&line["remote_frames"]);
        frames.write_all(&[4, 2, 0x53, 3, 0x50]).unwrap();
        let mut refused = [0; 6];
        frames.read_exact(&mut refused).unwrap();
        assert_eq!(refused, [0x15, 0x53, b'1', b'1', 3, 0x50]);
    }
}

#[cfg(unix)]
#[test]
fn a_pseudo_terminal_is_a_serial_line_to_the_controller() {
    let mut controllers = Running::start(program().args(["virtual", "--remote-serial", "pty"])).unwrap();
    let line = ready(&mut controllers);
    assert_eq!(line.get("remote"), None);
    let path = line["remote_serial"].as_str().unwrap();
    let mut client = std::fs::OpenOptions::new().read(true).write(true).open(path).unwrap();
    // EOT, Login without a password, GetCurRobot.
    client.write_all(&[4, 2, 0x4C, 3, 0x4F]).unwrap();
    let mut done = [0; 4];
    client.read_exact(&mut done).unwrap();
    assert_eq!(done, [6, 0x4C, 3, 0x4F]);
    client.write_all(&[2, 0x79, 3, 0x7A]).unwrap();
    let mut robot = [0; 5];
    client.read_exact(&mut robot).unwrap();
    assert_eq!(robot, [6, 0x79, 1, 3, 0x7B]);
}

#[test]
fn what_cannot_be_answered_is_said_before_anything_runs() {
    let folder = tempfile::tempdir().unwrap();
    let long = folder.path().join("long");
    std::fs::write(&long, "seventeen letters").unwrap();
    let busy = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = busy.local_addr().unwrap().port().to_string();
    let failed = |arguments: &[&str], code: &str| {
        let finished = Running::start(program().args(["--json", "virtual"]).args(arguments)).unwrap().finish(DONE);
        assert_eq!(finished.code, Some(2), "{}", finished.stderr);
        assert_error(&[serde_json::from_str(&finished.stdout).unwrap()], code);
        finished.stderr
    };
    let told = failed(&["--remote-port", &port], "cannot-listen");
    assert!(told.contains(&format!("127.0.0.1:{port}")), "{told}");
    let told = failed(&["--remote-password-file", &long.display().to_string()], "file-format");
    assert!(told.contains("16 characters") && !told.contains("seventeen"), "{told}");
    failed(&["--count", "2", "--remote-serial", "/dev/ttyS0"], "bad-settings");
    let told = failed(&["--remote-serial", "/dev/no-such-line,115200"], "cannot-listen");
    assert!(told.contains("/dev/no-such-line"), "{told}");
    for wrong in [["--remote-serial", "/dev/ttyS0,1200"], ["--remote-time-out", "-1"], ["--remote-role", "guest"]] {
        let finished = Running::start(program().arg("virtual").args(wrong)).unwrap().finish(DONE);
        assert_eq!(finished.code, Some(2), "{wrong:?}: {}", finished.stderr);
    }
}

/// The server alone, with variables of a file; it ends when it is asked to.
#[test]
fn a_simulated_cell_alone_answers_remote_commands() {
    let folder = tempfile::tempdir().unwrap();
    let variables = folder.path().join("Variables.inc");
    std::fs::write(&variables, "Global Preserve Long g_List(3)\n").unwrap();
    let mut command = program();
    command.args(["remote", "serve", "--remote-port", "0", "--robots", "gx4-a251s", "--variables"]).arg(&variables);
    let mut server = Running::start(&mut command).unwrap();
    let line = ready(&mut server);
    assert_eq!((&line["remote_frames"], &line["remote_serial"]), (&Value::Null, &Value::Null));
    let mut client = connect(&line["remote"]);
    assert_eq!(ask(&mut client, "$Login,"), "#Login,0\r\n");
    assert_eq!(ask(&mut client, "$GetRobotInfo"), "#GetRobotInfo,1,3,GX4-A251S\r\n");
    assert_eq!(ask(&mut client, "$GetVariable,g_List(0),Long,4"), "#GetVariable,0,0,0,0\r\n");
    drop(server);
    std::fs::write(&variables, "nothing\n").unwrap();
    command.arg("--json");
    let finished = Running::start(&mut command).unwrap().finish(DONE);
    assert_eq!(finished.code, Some(2), "{}", finished.stderr);
    assert_error(&[serde_json::from_str(&finished.stdout).unwrap()], "file-format");
}
