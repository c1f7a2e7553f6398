//! Virtual controllers in a process of their own, and what is switched in them from another.

use std::time::{Duration, Instant};

use serde_json::Value;

use crate::common::command_line_test::{CommandLineTest, DONE, assert_error, program};
use crate::common::process::Running;

/// Switches all controllers of the fleet.
fn switch(data: &str, arguments: &[&str]) -> Vec<Value> {
    let mut command = program();
    command.args(["virtual", "switch", "--data", data]).args(arguments);
    let finished = Running::start(&mut command).unwrap().finish(DONE);
    assert_eq!(finished.code, Some(0), "{}", finished.stderr);
    finished.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Repeats a command until it ends as expected: switches are looked at twice a second.
fn until(cli: &CommandLineTest, arguments: &[&str], holds: impl Fn(&Value) -> bool) {
    let end = Instant::now() + Duration::from_secs(60);
    loop {
        // A server that was started before the switch was seen would stay so.
        if arguments[0] == "start" {
            cli.json(&["stop", "cell", "--yes"]);
        }
        let (_, lines) = cli.json(arguments);
        if holds(&lines[0]) {
            return;
        }
        assert!(Instant::now() < end, "{lines:?}");
    }
}

#[test]
fn faults_are_switched_from_another_process() {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("fleet").display().to_string();
    let cli = CommandLineTest::with(1, &["--firmware", "current", "--data", &data]);
    assert_eq!(cli.add(0, "cell").0, Some(0));
    let serial = cli.ready[0]["serial"].as_str().unwrap();
    let names = ["--country", "JP", "--state", "x", "--locality", "x", "--organisation", "x"];
    assert_eq!(cli.json(&[&["cert", "self-signed", "--yes", "cell"][..], &names].concat()).0, Some(0));

    let refused = |code: &'static str| move |line: &Value| line["error"]["code"] == code;
    let shown = switch(&data, &["--task-running", "on", serial]);
    assert_eq!((&shown[0]["serial"], &shown[0]["task_running"]), (&serial.into(), &true.into()));
    until(&cli, &["start", "cell"], refused("task-running"));
    assert_eq!(cli.json(&["info", "cell"]).0, Some(0), "questions are answered");
    switch(&data, &["--task-running", "off", "--teach-pendant", "on", "--all"]);
    until(&cli, &["start", "cell"], refused("teach-pendant-connected"));
    switch(&data, &["--teach-pendant", "off", "--server-error", "on", "--all"]);
    until(&cli, &["start", "cell"], refused("580"));
    until(&cli, &["info", "cell"], |line| line["result"]["error"] == "580" && line["result"]["status"] == "Error");
    assert!(cli.run(&["info", "cell"]).stdout.contains("Error (580)"));
    switch(&data, &["--server-error", "off", "--all"]);
    until(&cli, &["start", "cell"], |line| line["result"]["status"] == "Run");

    assert_eq!(switch(&data, &["--all"])[0]["server_error"], false, "without a switch it shows them");
    let mut unknown = program();
    unknown.args(["virtual", "switch", "--data", &data, "--task-running", "on", "R7A9999999"]);
    let unknown = Running::start(&mut unknown).unwrap().finish(DONE);
    assert_eq!(unknown.code, Some(2), "{}", unknown.stderr);
}

/// Gives commands to the cell of the only controller: the exit code and the state.
fn act(data: &str, arguments: &[&str]) -> (Option<i32>, Value) {
    let mut command = program();
    command.args(["virtual", "cell", "--data", data, "--all"]).args(arguments);
    let finished = Running::start(&mut command).unwrap().finish(DONE);
    (finished.code, serde_json::from_str(&finished.stdout).unwrap_or_else(|_| panic!("{}", finished.stderr)))
}

#[test]
fn the_plant_around_a_virtual_controller_acts_from_another_process() {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("fleet").display().to_string();
    let robots = ["--robots", "C4-A601S,gx4-a251s", "--clock-rate", "50"];
    let cli = CommandLineTest::with(1, &[&["--firmware", "current", "--data", &data][..], &robots].concat());
    let until_flags = |flags: &[&str]| {
        let end = Instant::now() + Duration::from_secs(60);
        loop {
            let (code, state) = act(&data, &[]);
            assert_eq!((code, &state["refused"]), (Some(0), &Value::Null));
            if state["flags"] == serde_json::json!(flags) {
                return state;
            }
            assert!(Instant::now() < end, "{state}");
        }
    };
    let running = until_flags(&["Auto", "Running"]);
    assert_eq!(running["serial"], cli.ready[0]["serial"]);
    assert_eq!(running["robots"][1]["model"], "GX4-A251S");

    let (code, refused) = act(&data, &["--do", "start 0", "--do", "emergency-stop on"]);
    assert_eq!(
        (code, refused["refused"].as_str()),
        (Some(1), Some("the controller is not ready: a task runs or is paused"))
    );
    assert_eq!(refused["emergency_stop"], false, "commands after a refused one are not given");
    let (code, stopped) = act(&data, &["--do", "emergency-stop on", "--do", "door open"]);
    assert_eq!((code, &stopped["emergency_stop"], &stopped["door_open"]), (Some(0), &true.into(), &true.into()));
    until_flags(&["Auto", "Safeguard", "EStop", "Ready"]);
    let again = ["emergency-stop off", "door closed", "reset", "start 1"];
    let again: Vec<&str> = again.into_iter().flat_map(|command| ["--do", command]).collect();
    assert_eq!(act(&data, &again).0, Some(0));
    let home = until_flags(&["Auto", "Ready"]);
    assert_eq!((&home["robots"][0]["at_home"], &home["robots"][1]["at_home"]), (&true.into(), &true.into()));

    let mut unknown = program();
    unknown.args(["virtual", "cell", "--data", &data, "--all", "--do", "dance"]);
    let unknown = Running::start(&mut unknown).unwrap().finish(DONE);
    assert_eq!(unknown.code, Some(2), "{}", unknown.stderr);
    assert!(unknown.stderr.contains("emergency-stop on|off"), "the commands are listed: {}", unknown.stderr);
    drop(cli);
    let mut gone = program();
    gone.args(["--json", "virtual", "cell", "--data", &data, "--all"]);
    let gone = Running::start(&mut gone).unwrap().finish(DONE);
    assert_eq!(gone.code, Some(2), "{}{}", gone.stdout, gone.stderr);
}

#[test]
fn a_busy_management_port_is_named_as_such() {
    let busy = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = busy.local_addr().unwrap().port().to_string();
    let mut command = program();
    command.args(["--json", "virtual", "--management-port", &port]);
    let finished = Running::start(&mut command).unwrap().finish(DONE);
    assert_eq!(finished.code, Some(2), "{}", finished.stderr);
    let line: Value = serde_json::from_str(&finished.stdout).unwrap();
    assert_error(&[line], "cannot-listen");
    assert!(finished.stderr.contains("management protocol cannot listen on 127.0.0.1:"), "{}", finished.stderr);
    assert!(!finished.stderr.contains("OPC UA server"), "{}", finished.stderr);
}

#[test]
fn a_workspace_named_like_a_device_is_refused_on_every_system() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["NUL", "con.old", "plant."] {
        let mut command = program();
        command.arg("--json").arg("--workspace").arg(folder.path().join(name)).args(["backup", "on"]);
        let finished = Running::start(&mut command).unwrap().finish(DONE);
        assert_eq!(finished.code, Some(2), "{}", finished.stderr);
        assert_error(&[serde_json::from_str(&finished.stdout).unwrap()], "bad-file-name");
    }
}
