//! The main job through the real command line, and what it says when something is wrong.

use std::fs;
use std::process::Command;
use std::time::Duration;

use serde_json::Value;

use crate::common::command_line_test::{CommandLineTest, DONE, assert_error, program, walk};
use crate::common::process::Running;

#[test]
fn from_an_empty_workspace_to_three_running_servers() {
    let cli = CommandLineTest::start(3);
    for (index, name) in ["weld", "paint", "码垛"].iter().enumerate() {
        assert_eq!(cli.add(index, name).0, Some(0));
    }
    let listed = cli.run(&["controllers", "list"]);
    assert!(listed.stdout.contains("码垛") && listed.code == Some(0), "{}", listed.stdout);
    let (code, made) = cli.json(&[
        "cert",
        "self-signed",
        "--country",
        "jp",
        "--state",
        "Nagano",
        "--locality",
        "Suwa",
        "--organisation",
        "Example",
        "--bits",
        "2048",
        "--years",
        "5",
        "--yes",
        "--all",
    ]);
    assert_eq!((code, made.len()), (Some(0), 3), "{made:?}");
    let user_password = cli.file("user-password");
    for arguments in [
        &["settings", "set", "--policies", "Basic256Sha256", "--tokens", "username", "--yes", "--all"][..],
        &["users", "add", "operator1", "--password-file", &user_password, "--yes", "--all"],
        &["start", "--all"],
    ] {
        let (code, lines) = cli.json(arguments);
        assert_eq!(code, Some(0), "{lines:?}");
    }
    let (_, infos) = cli.json(&["info", "--all"]);
    assert!(infos.iter().all(|line| line["result"]["status"] == "Run"), "{infos:?}");
    let (_, users) = cli.json(&["users", "list", "weld"]);
    assert_eq!(users[0]["result"]["users"][0], "operator1");
    let (_, settings) = cli.json(&["settings", "show", "weld"]);
    assert_eq!(settings[0]["result"]["security_policies"], serde_json::json!(["Basic256Sha256"]));
    let table = cli.run(&["info", "weld", "paint"]);
    assert!(table.stdout.lines().next().unwrap().starts_with("NAME "), "{}", table.stdout);
    assert_eq!(table.stdout.lines().count(), 3);
    let (code, removed) = cli.json(&["users", "remove", "operator1", "weld", "paint", "--yes"]);
    assert_eq!((code, removed.len()), (Some(0), 2));
    assert_eq!(cli.json(&["stop", "--yes", "--all"]).0, Some(0));
    assert_eq!(cli.json(&["controllers", "remove", "paint"]).0, Some(0));
    assert_eq!(cli.json(&["controllers", "list"]).1.len(), 2);
}

#[test]
fn a_request_that_is_wrong_sends_nothing_and_ends_with_2() {
    let cli = CommandLineTest::start(2);
    assert_eq!((cli.add(0, "weld").0, cli.add(1, "paint").0), (Some(0), Some(0)));
    let user_password = cli.file("user-password");
    for (arguments, code) in [
        (&["start", "wled"][..], "unknown-controller"),
        (&["settings", "set", "--port", "80", "--yes", "weld"], "bad-port"),
        (&["settings", "set", "--port", "70000", "--yes", "weld"], "bad-port"),
        (&["settings", "set", "--policies", "Basic512", "--yes", "weld"], "bad-settings"),
        (&["settings", "set", "--yes", "weld"], "nothing-to-change"),
        (&["controllers", "add", "x", "10.0.0.1", "--series", "RC9", "--trust-on-first-use"], "unknown-series"),
        (&["licences", "no-such-crate"], "unknown-component"),
        (&["users", "add", "op", "--password-file", &user_password, "--yes", "weld"], "bad-credential"),
        (&["users", "add", "operator1", "--password-file", "/nowhere", "--yes", "weld"], "file-unreadable"),
        (&["stop", "weld"], "not-confirmed"),
        (&["cert", "import-ca", "--file", "/nowhere.der", "--yes", "weld"], "file-not-found"),
        (&["cert", "import-ca", "--file", &user_password, "--yes", "weld"], "file-format"),
        (&["cert", "import-ca", "--file", &user_password, "--yes", "weld", "paint"], "one-controller-only"),
        (&["cert", "import-user", "/nowhere.pfx", "--yes", "weld"], "file-not-found"),
        (&["cert", "import-user", &user_password, "--yes", "weld"], "file-format"),
        (&["cert", "import-user", "a", "b", "c", "--yes", "weld"], "several-files"),
        (&["cert", "export", "weld"], "not-confirmed"),
        (&["clients", "add", "--list", "trusted", "/nowhere.der", "weld"], "file-unreadable"),
        (&["clients", "add", "--list", "trusted", &user_password, "weld"], "bad-certificate"),
        (&["controllers", "add", "weld", "10.0.0.1", "--series", "RC90", "--trust-on-first-use"], "name-taken"),
        (&["controllers", "add", "x", "10.0.0.999", "--series", "RC90", "--trust-on-first-use"], "bad-address"),
        (&["controllers", "add", "x", "10.0.0.1", "--series", "RC90", "--fingerprint", "12"], "bad-fingerprint"),
        (&["controllers", "remove", "nobody"], "unknown-controller"),
    ] {
        let (exit, lines) = cli.json(arguments);
        assert_eq!(exit, Some(2), "{arguments:?} {lines:?}");
        assert_error(&lines, code);
    }
    assert_eq!(cli.run(&["no-such-command"]).code, Some(2));
    assert_eq!(cli.json(&["info", "weld"]).1[0]["result"]["revision"], 1, "nothing was changed");
}

#[test]
fn a_controller_that_fails_ends_with_1_and_says_why() {
    let cli = CommandLineTest::start(1);
    assert_eq!(cli.add(0, "weld").0, Some(0));
    let (code, lines) = cli.json(&["start", "weld"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "7931");
    for (arguments, error) in [
        (&["cert", "select", "ca", "--yes", "weld"][..], "certificate-not-stored"),
        (&["cert", "export", "--yes", "weld"], "certificate-not-stored"),
        (&["cert", "import-ca", "--yes", "weld"], "file-not-found"),
    ] {
        let (code, lines) = cli.json(arguments);
        assert_eq!(code, Some(1), "{arguments:?} {lines:?}");
        assert_error(&lines, error);
    }
    let people = cli.run(&["--lang", "zh", "start", "weld"]);
    assert!(people.stderr.contains("未配置服务器证书"), "{}", people.stderr);
    let table = cli.run(&["info", "weld", "--lang", "zh"]).stdout;
    assert!(table.contains("状态") && table.contains("错误 (7931)") && !table.contains("STATUS"), "{table}");
    let help = cli.run(&["--lang", "zh", "settings", "set", "--help"]).stdout;
    assert!(help.contains("用法：") && help.contains("删除控制器中的服务器日志"), "{help}");
    fs::write(cli.folder.path().join("password"), "wrong").unwrap();
    let (code, lines) = cli.json(&["info", "weld"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "wrong-password");
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let nowhere = listener.local_addr().unwrap().to_string();
    drop(listener);
    let add = ["controllers", "add", "x", &nowhere, "--series", "RC90", "--trust-on-first-use"];
    let (code, lines) = cli.json(&add);
    assert_eq!(code, Some(1));
    assert_error(&lines, "unreachable");
}

#[test]
fn a_password_is_read_from_standard_input_and_shown_nowhere() {
    let cli = CommandLineTest::start(1);
    let ready = &cli.ready[0];
    let mut child = program()
        .arg("--workspace")
        .arg(cli.workspace())
        .args(["-vvv", "controllers", "add", "weld", ready["management"].as_str().unwrap(), "--series", "RC800"])
        .args(["--trust-on-first-use", "--password-file", "-"])
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), b"plant-password\n").unwrap();
    let output = child.wait_with_output().unwrap();
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{err}");
    assert!(!err.is_empty() && !out.contains("plant-password") && !err.contains("plant-password"));
    for entry in walk(&cli.workspace()) {
        let text = String::from_utf8_lossy(&fs::read(&entry).unwrap()).into_owned();
        assert!(!text.contains("plant-password"), "{}", entry.display());
    }
}

#[test]
fn a_damaged_configuration_is_kept_and_said_so() {
    let cli = CommandLineTest::start(1);
    fs::create_dir_all(cli.workspace()).unwrap();
    let file = cli.workspace().join("epson_opcua_config.json");
    fs::write(&file, "{\"version\":1,\"controllers\":[{").unwrap();
    let finished = cli.run(&["controllers", "list"]);
    assert_eq!(finished.code, Some(0));
    assert!(finished.stderr.contains("configuration file was damaged"), "{}", finished.stderr);
    assert_eq!(cli.add(0, "weld").0, Some(0));
    let kept = walk(&cli.workspace()).into_iter().find(|p| p.to_string_lossy().contains("damaged")).unwrap();
    assert_eq!(fs::read_to_string(kept).unwrap(), "{\"version\":1,\"controllers\":[{");
}

/// `ulimit -f` makes every write beyond so many blocks fail, as a full disk does.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_the_configuration_as_it_was() {
    let cli = CommandLineTest::start(2);
    assert_eq!(cli.add(0, "weld").0, Some(0));
    let file = cli.workspace().join("epson_opcua_config.json");
    let before = fs::read(&file).unwrap();
    let ready = &cli.ready[1];
    let finished = Running::start(
        Command::new("sh")
            .args(["-c", "trap '' XFSZ; ulimit -f 1; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_opcua-configurator")])
            .env("RUST_BACKTRACE", "0")
            .arg("--workspace")
            .arg(cli.workspace())
            .args(["--json", "controllers", "add", "paint", ready["management"].as_str().unwrap()])
            .args(["--series", "RC800", "--trust-on-first-use", "--password-file", &cli.file("password")]),
    )
    .unwrap()
    .finish(DONE);
    let line: Value = serde_json::from_str(finished.stdout.lines().next().unwrap()).unwrap();
    assert_error(&[line], "workspace-full");
    assert_eq!(fs::read(&file).unwrap(), before);
    assert_eq!(cli.json(&["controllers", "list"]).1.len(), 1);
}

#[test]
fn an_app_killed_in_mid_job_leaves_pc_and_controllers_whole() {
    let cli = CommandLineTest::start(3);
    for index in 0..3 {
        assert_eq!(cli.add(index, &format!("cell{index}")).0, Some(0));
    }
    assert_eq!(cli.run(&["backup", "on"]).code, Some(0));
    let make = [
        "cert",
        "self-signed",
        "--country",
        "JP",
        "--state",
        "Nagano",
        "--locality",
        "Suwa",
        "--organisation",
        "Example",
        "--yes",
        "--all",
    ];
    for milliseconds in [50, 150, 300, 600] {
        let job = Running::start(cli.command().args(make)).unwrap();
        std::thread::sleep(Duration::from_millis(milliseconds));
        drop(job);
        let (code, infos) = cli.json(&["info", "--all"]);
        assert_eq!((code, infos.len()), (Some(0), 3), "{infos:?}");
        for file in walk(&cli.workspace()).iter().filter(|f| f.extension().is_some_and(|e| e == "der")) {
            let whole = opcua_configurator::pki::Certificate::from_der(&fs::read(file).unwrap());
            assert!(whole.is_ok(), "{} is half-written", file.display());
        }
    }
    // A controller may still be at the change of the killed job, and then says that it was changed meanwhile.
    let (_, lines) = cli.json(&make);
    for line in lines.iter().filter(|line| line["ok"] == false) {
        assert_error(std::slice::from_ref(line), "changed-meanwhile");
    }
    let (code, lines) = cli.json(&make);
    assert_eq!(code, Some(0), "the job can simply be repeated: {lines:?}");
}

/// The controllers themselves must survive the same.
#[test]
fn controllers_killed_in_mid_change_come_back_whole() {
    let folder = tempfile::tempdir().unwrap();
    let password = folder.path().join("password");
    fs::write(&password, "plant-password").unwrap();
    let data = folder.path().join("data");
    let start = || {
        let mut controllers = Running::start(
            program().args(["virtual", "--count", "1", "--password-file"]).arg(&password).arg("--data").arg(&data),
        )
        .unwrap();
        let ready: Value = serde_json::from_str(&controllers.next_line(DONE)).unwrap();
        (controllers, ready)
    };
    let (first, ready) = start();
    let fingerprint = ready["fingerprint"].clone();
    drop(first);
    let mut revision = 0;
    for round in 0..4 {
        let (controllers, ready) = start();
        assert_eq!(ready["fingerprint"], fingerprint, "the same controller");
        let workspace = folder.path().join(format!("workspace{round}"));
        let run = |arguments: &[&str]| {
            let mut command = program();
            command.args(["--json", "--yes", "--workspace"]).arg(&workspace);
            command.arg("--connection-password-file").arg(&password).args(arguments);
            Running::start(&mut command).unwrap()
        };
        let management = ready["management"].as_str().unwrap();
        let add = ["controllers", "add", "weld", management, "--series", "RC800", "--trust-on-first-use"];
        assert_eq!(run(&add).finish(DONE).code, Some(0));
        let info: Value = serde_json::from_str(&run(&["info", "weld"]).finish(DONE).stdout).unwrap();
        let now = info["result"]["revision"].as_u64().unwrap();
        assert!(now >= revision, "a change that was answered is not forgotten");
        let change = run(&["settings", "set", "--port", &(20_000 + round).to_string(), "weld"]);
        if round % 2 == 0 {
            assert_eq!(change.finish(DONE).code, Some(0));
            revision = now + 1;
        } else {
            std::thread::sleep(Duration::from_millis(30));
            drop(controllers);
            drop(change);
            revision = now;
        }
    }
}

#[test]
fn one_workspace_is_for_one_program_at_a_time() {
    let cli = CommandLineTest::start(1);
    assert_eq!(cli.add(0, "weld").0, Some(0));
    let held = opcua_configurator::workspace::Workspace::new(cli.workspace()).lock().unwrap();
    let (exit, lines) = cli.json(&["controllers", "remove", "weld"]);
    assert_eq!(exit, Some(2));
    assert_error(&lines, "workspace-busy");
    drop(held);
    assert_eq!(cli.json(&["controllers", "remove", "weld"]).0, Some(0));
}

#[test]
#[cfg(target_os = "linux")]
fn a_window_without_a_display_says_so() {
    let cli = CommandLineTest::start(1);
    let mut command = cli.command();
    command.arg("--json").env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
    let finished = Running::start(&mut command).unwrap().finish(DONE);
    assert_eq!(finished.code, Some(2), "{}", finished.stderr);
    let line: Value = serde_json::from_str(&finished.stdout).unwrap();
    let detail = line["error"]["detail"].as_str().unwrap();
    assert!(detail.contains("DISPLAY") && !detail.contains(".rs"), "{detail}");
    assert!(line["error"]["remedy"].as_str().unwrap().contains("remote desktop"));
    assert_error(&[line], "no-display");
}

/// Ctrl-C, a service manager, and the terminal that is closed.
#[test]
#[cfg(unix)]
fn virtual_controllers_end_properly_when_they_are_asked_to() {
    for signal in [libc::SIGINT, libc::SIGTERM, libc::SIGHUP] {
        let mut controllers = Running::start(program().args(["virtual", "--count", "1"])).unwrap();
        let ready: Value = serde_json::from_str(&controllers.next_line(DONE)).unwrap();
        controllers.signal(signal);
        let finished = controllers.finish(DONE);
        assert_eq!(finished.code, Some(0), "signal {signal}: {}", finished.stderr);
        assert!(std::net::TcpStream::connect(ready["management"].as_str().unwrap()).is_err());
    }
}
