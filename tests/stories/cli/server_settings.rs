//! The server log, and settings exported and imported, from the command line.

use std::fs;

use crate::common::command_line_test::{CommandLineTest, assert_error};

const MAKE: [&str; 12] = [
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

fn cli(count: usize, more: &[&str]) -> CommandLineTest {
    let cli = CommandLineTest::with(count, more);
    for index in 0..count {
        assert_eq!(cli.add(index, &format!("cell{}", index + 1)).0, Some(0));
    }
    cli
}

#[test]
fn a_log_is_shown_and_deleted() {
    let cli = cli(2, &["--seed", "3"]);
    assert_eq!(cli.json(&MAKE).0, Some(0));
    let (_, lines) = cli.json(&["log", "show", "--all"]);
    assert_eq!((&lines[0]["result"]["text"], &lines[0]["result"]["size"]), (&"".into(), &0.into()));
    let (code, lines) = cli.json(&["settings", "set", "--server-log", "on", "--yes", "cell1"]);
    assert_eq!(code, Some(2), "the password is asked for");
    assert_error(&lines, "log-password");
    assert!(lines[0]["error"]["remedy"].as_str().unwrap().contains("199532"), "{lines:?}");
    let log = |password: &str| {
        fs::write(cli.file("log-password"), password).unwrap();
        let file = cli.file("log-password");
        cli.json(&["settings", "set", "--server-log", "on", "--log-password-file", &file, "--yes", "cell1"]).0
    };
    assert_eq!((log("199533"), log("199532\n")), (Some(2), Some(0)));
    assert_eq!(cli.json(&["start", "--all"]).0, Some(0));
    let (_, infos) = cli.json(&["info", "--all"]);
    assert_eq!((&infos[0]["result"]["status"], &infos[0]["result"]["error"]), (&"Run".into(), &"581".into()));
    assert!(infos[1]["result"]["error"].is_null());
    assert!(cli.run(&["info", "cell1"]).stdout.contains("Run (581)"));

    let one = cli.run(&["log", "show", "cell1"]);
    assert!(one.stdout.lines().next().unwrap().contains("INFO server started: opc.tcp://"), "{}", one.stdout);
    let both = cli.run(&["log", "show", "--end", "--all"]);
    assert!(both.stdout.starts_with("==> cell1 <==\n") && both.stdout.contains("==> cell2 <=="), "{}", both.stdout);
    let (code, lines) = cli.json(&["log", "delete", "cell1"]);
    assert_eq!(code, Some(2));
    assert_error(&lines, "not-confirmed");
    assert_eq!(cli.json(&["log", "delete", "--yes", "cell2"]).0, Some(0), "there is none, which is what was wanted");
    assert_eq!(cli.json(&["stop", "cell1", "--yes"]).0, Some(0));
    assert_eq!(cli.json(&["log", "delete", "--yes", "cell1"]).0, Some(0));
    assert_eq!(cli.run(&["log", "show", "cell1"]).stdout, "");
}

#[test]
fn settings_are_exported_and_imported_again() {
    let cli = cli(2, &["--seed", "3", "--firmware", "legacy"]);
    let passphrase = cli.file("passphrase");
    fs::write(&passphrase, "correct horse\n").unwrap();
    let user_password = cli.file("user-password");
    let add = ["users", "add", "operator1", "--password-file", &user_password, "--yes", "--all"];
    assert_eq!(cli.json(&add).0, Some(0));
    let (code, lines) = cli.json(&["export-settings", "--all"]);
    assert_eq!(code, Some(2));
    assert_error(&lines, "not-confirmed");
    let (code, lines) = cli.json(&["export-settings", "--passphrase-file", &passphrase, "--yes", "--all"]);
    assert_eq!(code, Some(0), "{lines:?}");
    let file = lines[0]["result"]["file"].as_str().unwrap();
    assert!(file.ends_with(&format!("{}/option.json", cli.ready[0]["serial"].as_str().unwrap())), "{file}");

    assert_eq!(cli.json(&["users", "remove", "operator1", "--yes", "--all"]).0, Some(0));
    let (code, lines) = cli.json(&["import-settings", "--yes", "cell1"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "wrong-passphrase");
    let import = ["import-settings", "--passphrase-file", &passphrase, "--yes", "--all"];
    assert_eq!(cli.json(&import).0, Some(0));
    let (_, users) = cli.json(&["users", "list", "--all"]);
    assert!(users.iter().all(|line| line["result"]["users"][0] == "operator1"), "{users:?}");

    fs::write(&passphrase, "short").unwrap();
    let (code, lines) = cli.json(&["export-settings", "--passphrase-file", &passphrase, "--yes", "--all"]);
    assert_eq!(code, Some(2));
    assert_error(&lines, "bad-passphrase");
    fs::remove_file(file).unwrap();
    let (code, lines) = cli.json(&["import-settings", "--yes", "cell1"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "export-missing");
}
