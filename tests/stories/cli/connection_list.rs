//! From a connection list to controllers that are talked to.

use std::fs;

use serde_json::Value;

use crate::common::command_line_test::{CommandLineTest, assert_error};

/// A list with the desk's own controllers and the usual lines that are to be left out.
fn list(cli: &CommandLineTest) -> String {
    let address = |index: usize| cli.ready[index]["management"].as_str().unwrap().to_owned();
    format!(
        "Name,Type,Address\nWeld,Ethernet,{}\n涂装,Ethernet,{}\nService,USB,\nSimulator,Virtual,127.0.0.1\n",
        address(0),
        address(1)
    )
}

fn skipped(lines: &[Value]) -> usize {
    lines.iter().filter(|line| line["result"]["skipped"].is_string()).count()
}

#[test]
fn imported_controllers_have_to_be_trusted_before_anything_is_sent() {
    let cli = CommandLineTest::start(2);
    let file = cli.file("list.csv");
    fs::write(&file, list(&cli)).unwrap();
    let (code, lines) = cli.json(&["controllers", "import", &file]);
    assert_eq!((code, lines.len(), skipped(&lines)), (Some(0), 4, 2), "{lines:?}");
    let (code, lines) = cli.json(&["controllers", "import", &file]);
    assert_eq!((code, skipped(&lines)), (Some(0), 4), "all of them are registered by now");

    let (code, lines) = cli.json(&["info", "Weld", "涂装"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "fingerprint-unknown");
    let wrong = "ab".repeat(32);
    let (code, lines) = cli.json(&["controllers", "trust", "Weld", "--fingerprint", &wrong]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "fingerprint-changed");
    let right = cli.ready[0]["fingerprint"].as_str().unwrap();
    assert_eq!(cli.json(&["controllers", "trust", "Weld", "--fingerprint", right]).0, Some(0));
    assert_eq!(cli.json(&["controllers", "trust", "涂装", "--trust-on-first-use"]).0, Some(0));
    let (code, infos) = cli.json(&["info", "Weld", "涂装"]);
    assert_eq!((code, infos.len()), (Some(0), 2), "{infos:?}");
    let (_, listed) = cli.json(&["controllers", "list"]);
    for (listed, ready) in listed.iter().zip(&cli.ready) {
        assert_eq!(listed["result"]["fingerprint"], ready["fingerprint"]);
        assert_eq!(listed["result"]["series"], ready["series"], "what the controller says");
    }

    // What was accepted stays accepted; another one has to be meant.
    assert_eq!(cli.json(&["controllers", "trust", "Weld", "--trust-on-first-use"]).0, Some(0));
    let (code, lines) = cli.json(&["controllers", "trust", "Weld", "--fingerprint", &wrong]);
    assert_eq!(code, Some(2));
    assert_error(&lines, "fingerprint-changed");
    let (code, lines) = cli.json(&["controllers", "trust", "nobody", "--trust-on-first-use"]);
    assert_eq!(code, Some(2));
    assert_error(&lines, "unknown-controller");
}

#[test]
fn a_list_in_the_workspace_is_found_and_its_mistakes_are_told() {
    let cli = CommandLineTest::start(1);
    fs::create_dir_all(cli.workspace()).unwrap();
    let text = "Name,Type,Address\nWeld,Ethernet,10.0.0.1\nPaint,Ethernet,10.0.0.300\nWeld,Ethernet,10.0.0.2\n";
    fs::write(cli.workspace().join("connections.csv"), text).unwrap();
    let (code, lines) = cli.json(&["controllers", "import"]);
    assert_eq!(code, Some(1), "{lines:?}");
    let codes: Vec<&Value> = lines.iter().map(|line| &line["error"]["code"]).collect();
    assert!(codes.contains(&&Value::from("bad-address")) && codes.contains(&&Value::from("name-taken")), "{lines:?}");
    assert_eq!(cli.json(&["controllers", "list"]).1.len(), 1, "the good line was added");
    let other = cli.file("password");
    let (code, lines) = cli.json(&["controllers", "import", &other]);
    assert_eq!(code, Some(2));
    assert_error(&lines, "bad-connection-list");
}
