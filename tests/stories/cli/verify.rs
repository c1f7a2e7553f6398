//! `verify` from the command line.

use crate::common::command_line_test::{CommandLineTest, assert_error};

fn cli() -> CommandLineTest {
    let cli = CommandLineTest::with(2, &["--seed", "3"]);
    for (index, name) in ["cell1", "cell2"].into_iter().enumerate() {
        assert_eq!(cli.add(index, name).0, Some(0));
    }
    let subject = ["--country", "JP", "--state", "Nagano", "--locality", "Suwa", "--organisation", "Example"];
    let make = [&["cert", "self-signed"][..], &subject, &["--yes", "--all"]].concat();
    assert_eq!(cli.json(&make).0, Some(0));
    let set =
        ["settings", "set", "--policies", "None,Basic256Sha256", "--tokens", "anonymous,username", "--yes", "--all"];
    assert_eq!(cli.json(&set).0, Some(0));
    cli
}

#[test]
fn what_works_and_why_not_is_said_to_scripts_and_to_people() {
    let cli = cli();
    let password = cli.file("user-password");
    assert_eq!(cli.json(&["users", "add", "operator1", "--password-file", &password, "--yes", "--all"]).0, Some(0));
    let (code, lines) = cli.json(&["verify", "--all"]);
    assert_eq!(code, Some(1), "nothing runs");
    assert_error(&lines, "verify-failed");
    assert_eq!(lines[0]["result"]["findings"][0]["code"], "not-running", "{lines:?}");

    assert_eq!(cli.json(&["start", "--all"]).0, Some(0));
    let (code, lines) = cli.json(&["verify", "cell1"]);
    assert_eq!((code, &lines[0]["ok"]), (Some(1), &false.into()));
    let endpoints = lines[0]["result"]["endpoints"].as_array().unwrap();
    assert_eq!(endpoints.len(), 3, "{lines:?}");
    assert_eq!(endpoints[0]["tokens"][0]["result"], "works");
    let sign = &endpoints[1]["tokens"][0];
    assert_eq!((&sign["result"], &sign["status"]), (&"fails".into(), &"BadCertificateUntrusted".into()), "{sign}");
    assert_eq!(lines[0]["result"]["server_certificate"]["status"], "Good");
    let told = cli.run(&["verify", "cell1"]);
    assert_eq!(told.code, Some(1));
    for words in ["cell1: opc.tcp://127.0.0.1:", "Basic256Sha256 – Sign ", "✗ The server does not trust", "--trust-me"]
    {
        assert!(told.stdout.contains(words), "{words}\n{}", told.stdout);
    }
    assert!(told.stderr.is_empty(), "{}", told.stderr);

    let trusted = ["verify", "--trust-me", "--user", "operator1", "--user-password-file", &password, "--all"];
    let (code, lines) = cli.json(&trusted);
    assert_eq!(code, Some(0), "{lines:?}");
    let own = &lines[0]["result"]["own_certificate"];
    assert_eq!(own, &lines[1]["result"]["own_certificate"]);
    let (_, lists) = cli.json(&["clients", "list", "cell2"]);
    assert!(lists[0].to_string().contains(own["thumbprint"].as_str().unwrap()), "{lists:?}");
    let der = std::fs::read(own["file"].as_str().unwrap()).unwrap();
    assert_eq!(der[0], 0x30, "to be handed to whoever keeps the trusted list");
    let told = cli.run(&["--lang", "zh", "verify", "cell2"]);
    assert_eq!(told.code, Some(0), "{}", told.stdout);
    assert!(told.stdout.contains("客户端可接受服务器证书") && told.stdout.contains("未尝试"), "{}", told.stdout);
}

#[test]
fn a_login_is_checked_before_anything_is_sent() {
    let cli = cli();
    let password = cli.file("user-password");
    let (code, lines) = cli.json(&["verify", "--user", "o", "--user-password-file", &password, "cell1"]);
    assert_eq!(code, Some(2));
    assert_error(&lines, "bad-credential");
    assert_eq!(cli.run(&["verify", "--user", "operator1", "cell1"]).code, Some(2));
}
