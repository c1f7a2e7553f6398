//! Connection passwords on the command line: from the vault of the workspace, and from a list.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::common::command_line_test::{CommandLineTest, DONE, assert_error, program};
use crate::common::process::{Finished, Running};

/// Without a connection password for all controllers.
fn run(cli: &CommandLineTest, arguments: &[&str]) -> Finished {
    Running::start(program().arg("--workspace").arg(cli.workspace()).args(arguments)).unwrap().finish(DONE)
}

/// With `--json`; one value a line, in the order of the controllers' names.
fn lines(cli: &CommandLineTest, arguments: &[&str]) -> (Option<i32>, Vec<Value>) {
    let finished = run(cli, &[&["--json"], arguments].concat());
    let mut lines: Vec<Value> = finished.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    lines.sort_by_key(|line| line["controller"].to_string());
    (finished.code, lines)
}

fn write(cli: &CommandLineTest, name: &str, text: &str) -> String {
    fs::write(cli.folder.path().join(name), text).unwrap();
    cli.file(name)
}

fn assert_refused(cli: &CommandLineTest, arguments: &[&str], code: &str) {
    let (exit, lines) = lines(cli, arguments);
    assert_eq!(exit, Some(2), "{arguments:?} {lines:?}");
    assert_error(&lines, code);
}

#[test]
fn passwords_are_kept_in_the_vault_from_command_to_command() {
    let cli = CommandLineTest::start(2);
    assert_eq!((cli.add(0, "weld").0, cli.add(1, "paint").0), (Some(0), Some(0)));
    let (code, missing) = lines(&cli, &["info", "--all"]);
    assert_eq!(code, Some(1));
    assert_error(&missing, "password-missing");
    assert_refused(&cli, &["vault", "on"], "vault-missing");
    let short = write(&cli, "short", "short");
    assert_refused(&cli, &["vault", "init", "--vault-passphrase-file", &short], "bad-passphrase");
    assert_refused(&cli, &["vault", "init"], "no-passphrase");

    let passphrase = write(&cli, "passphrase", "correct horse\n");
    let vault = ["--vault-passphrase-file", &passphrase];
    let with = |arguments: &[&str]| lines(&cli, &[&vault, arguments].concat());
    assert_eq!(with(&["vault", "status"]).0, Some(2), "there is none to open");
    assert_eq!(with(&["vault", "init"]).0, Some(0));
    assert_refused(&cli, &[&vault[..], &["vault", "init"]].concat(), "vault-exists");
    let list = write(&cli, "list.csv", "\u{feff}Name;Password\r\nweld;plant-password\r\n\"paint\";\"wrong\"\r\n");
    assert_eq!(with(&["vault", "import", &list]).1[0]["result"]["passwords"], 2);
    let (code, read) = with(&["info", "--all"]);
    assert_eq!((code, &read[1]["ok"]), (Some(1), &json!(true)), "{read:?}");
    assert_error(&read, "wrong-password");

    // A password that works replaces the one that does not.
    let ready = &cli.ready[1];
    let word = |key: &str| ready[key].as_str().unwrap();
    let password = cli.file("password");
    let trust = ["controllers", "trust", "paint", "--fingerprint", word("fingerprint"), "--password-file", &password];
    assert_eq!(with(&trust).0, Some(0));
    assert_eq!(with(&["info", "--all"]).0, Some(0));
    assert_eq!(with(&["vault", "status"]).1[0]["result"]["controllers"], json!(["paint", "weld"]));

    let (code, locked) = lines(&cli, &["info", "weld"]);
    assert_eq!(code, Some(1));
    assert_error(&locked, "vault-locked");
    let wrong = write(&cli, "wrong", "correct house");
    assert_refused(&cli, &["--vault-passphrase-file", &wrong, "info", "weld"], "vault-passphrase");

    let new = write(&cli, "new", "battery staple");
    assert_eq!(with(&["vault", "passphrase", "--new-passphrase-file", &new]).0, Some(0));
    assert_refused(&cli, &[&vault[..], &["info", "weld"]].concat(), "vault-passphrase");
    let with = |arguments: &[&str]| lines(&cli, &[&["--vault-passphrase-file", &new], arguments].concat());
    assert_eq!(with(&["info", "weld"]).0, Some(0));
    let forgotten = with(&["vault", "forget", "weld"]);
    assert_eq!((forgotten.0, &forgotten.1[0]["result"]["forgotten"]), (Some(0), &json!(true)));
    assert_eq!(with(&["vault", "forget", "weld"]).1[0]["result"]["forgotten"], false);
    assert_eq!(with(&["vault", "forget", "nobody"]).0, Some(2));
    assert_error(&with(&["info", "weld"]).1, "password-missing");

    // Its name is gone with it, so its fingerprint has to do.
    let removed = run(&cli, &["controllers", "remove", "paint"]);
    assert!(removed.code == Some(0) && removed.stderr.contains("vault forget"), "{}", removed.stderr);
    assert_eq!(with(&["vault", "status"]).1[0]["result"]["unlisted"], json!([word("fingerprint")]));
    assert_eq!(with(&["vault", "forget", word("fingerprint")]).1[0]["result"]["forgotten"], true);
    let state = lines(&cli, &["vault", "off"]).1;
    assert_eq!(state[0]["result"]["passwords_in"], "keyring");
    assert_eq!(lines(&cli, &["vault", "on"]).1[0]["result"]["passwords_in"], "vault");

    let bytes = fs::read(cli.workspace().join("Vault/passwords.vault")).unwrap();
    damage(&cli.workspace().join("Vault/passwords.vault"), &bytes);
    assert_eq!(with(&["info", "weld"]).0, Some(2));
    assert_error(&with(&["info", "weld"]).1, "vault-damaged");
}

fn damage(path: &Path, bytes: &[u8]) {
    fs::write(path, &bytes[..bytes.len() / 2]).unwrap();
}

#[test]
fn one_command_serves_controllers_with_different_passwords() {
    let cli = CommandLineTest::start(2);
    assert_eq!((cli.add(0, "weld").0, cli.add(1, "paint").0), (Some(0), Some(0)));
    let list = write(&cli, "list.csv", "Name,Series,Password\nweld,RC800,plant-password\nother,RC700,x\n");
    let (code, read) = lines(&cli, &["--connection-password-list", &list, "info", "--all"]);
    assert_eq!((code, &read[1]["ok"]), (Some(1), &json!(true)), "{read:?}");
    assert_error(&read, "password-missing");
    // The password for all is for those that the list does not name.
    let (code, read) = cli.json(&["--connection-password-list", &list, "info", "--all"]);
    assert_eq!(code, Some(0), "{read:?}");
    let wrong = write(&cli, "wrong.csv", "Name,Password\nweld,\npaint,wrong\n");
    let (code, read) = cli.json(&["--connection-password-list", &wrong, "info", "--all"]);
    assert_eq!(code, Some(1));
    assert!(read.iter().all(|line| line["error"]["code"] == "wrong-password"), "{read:?}");
    for text in ["weld,plant-password\n", "Name,Password\nweld,a\nweld,b\n", "Name,Password\nweld\n"] {
        let bad = write(&cli, "bad.csv", text);
        let finished = run(&cli, &["--connection-password-list", &bad, "info", "--all"]);
        assert!(finished.code == Some(2) && !finished.stderr.contains("plant-password"), "{}", finished.stderr);
    }
    assert_refused(&cli, &["--connection-password-list", "/nowhere.csv", "info", "--all"], "file-unreadable");
    let bad = write(&cli, "bad.csv", "weld,plant-password\n");
    assert_refused(&cli, &["--connection-password-list", &bad, "info", "--all"], "bad-password-list");
}

#[test]
fn a_controller_is_added_before_it_can_be_reached_and_trusted_later() {
    let cli = CommandLineTest::start(1);
    let ready = &cli.ready[0];
    let word = |key: &str| ready[key].as_str().unwrap();
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let nowhere = listener.local_addr().unwrap().to_string();
    drop(listener);
    let add = ["controllers", "add", "off", &nowhere, "--series", "RC700"];
    let failed = cli.run(&[&add[..], &["--trust-on-first-use"]].concat());
    assert!(failed.code == Some(1) && failed.stderr.contains("--unconfirmed"), "{}", failed.stderr);
    assert_eq!(cli.json(&[&add[..], &["--unconfirmed"]].concat()).0, Some(0));
    assert_refused(&cli, &[&add[..], &["--unconfirmed"]].concat(), "name-taken");
    assert_eq!(cli.json(&[&add[..], &["--unconfirmed", "--trust-on-first-use"]].concat()).0, Some(2));

    let add = ["controllers", "add", "weld", word("management"), "--series", word("series"), "--unconfirmed"];
    assert_eq!(cli.json(&add).0, Some(0));
    let listed = cli.run(&["controllers", "list"]).stdout;
    assert_eq!(listed.matches("Not confirmed").count(), 2, "{listed}");
    let (code, lines) = cli.json(&["info", "weld"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "fingerprint-unknown");
    assert_eq!(cli.json(&["controllers", "trust", "weld", "--fingerprint", word("fingerprint")]).0, Some(0));
    assert_eq!(cli.json(&["info", "weld"]).0, Some(0));
    let listed = cli.run(&["controllers", "list"]).stdout;
    assert_eq!(listed.matches("Not confirmed").count(), 1, "{listed}");
}
