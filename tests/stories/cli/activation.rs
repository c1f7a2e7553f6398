//! Activation from the command line, with the sample files a newcomer finds.

use std::fs;

use crate::common::command_line_test::{CommandLineTest, DONE, assert_error, program};
use crate::common::process::Running;

/// What the fixtures' keys are for.
const LEGACY: [&str; 3] = ["--firmware", "legacy", "--not-activated"];
const SAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/activation.csv");
const MISTAKES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/activation-with-mistakes.csv");

fn cli(count: usize) -> CommandLineTest {
    let cli = CommandLineTest::with(count, &LEGACY);
    for index in 0..count {
        assert_eq!(cli.add(index, &format!("cell {}", index + 1)).0, Some(0));
    }
    cli
}

#[test]
fn the_sample_file_activates_the_controllers_it_was_made_for() {
    let cli = cli(4);
    let (code, lines) = cli.json(&["activate", "--file", MISTAKES, "--yes", "--all"]);
    assert_eq!(code, Some(1));
    assert_eq!(lines[0]["result"]["activated"], true);
    for line in &lines[1..] {
        assert_error(std::slice::from_ref(line), "not-in-file");
        assert!(line["error"]["detail"].as_str().unwrap().contains("line "), "{line}");
    }
    let people = cli.run(&["activate", "--file", MISTAKES, "--yes", "cell 1"]);
    assert_eq!(people.code, Some(0), "the other lines are not its business");
    assert!(people.stderr.contains("Line 7: it has 1 field;"), "{}", people.stderr);
    assert_eq!(cli.json(&["activate", "--file", SAMPLE, "--yes", "--all"]).0, Some(0));
    let (_, infos) = cli.json(&["info", "--all"]);
    assert!(infos.iter().all(|line| line["result"]["activated"] == true), "{infos:?}");
}

#[test]
fn keys_are_typed_for_one_controller_only() {
    let cli = cli(2);
    let serial = cli.ready[0]["serial"].as_str().unwrap();
    let printed = Running::start(program().args(["virtual", "keys", serial])).unwrap().finish(DONE);
    let line = printed.stdout.lines().nth(1).unwrap();
    let fields: Vec<&str> = line.split(',').collect();
    // As they are pasted.
    let (licence, activation) = (fields[1].replace('-', " ").to_uppercase(), fields[2].to_lowercase());
    let typed = |controllers: &[&str]| {
        let mut arguments = vec!["activate", "--license", &licence, "--activation", &activation, "--yes"];
        arguments.extend(controllers);
        cli.json(&arguments)
    };
    let (code, lines) = typed(&["cell 1", "cell 2"]);
    assert_eq!(code, Some(2));
    assert_error(&lines, "one-controller-only");
    assert_eq!(typed(&["cell 1"]).0, Some(0));
    let (code, lines) = typed(&["cell 2"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "wrong-keys");
}

#[test]
fn what_is_wrong_with_the_request_is_said_before_anything_is_sent() {
    let cli = cli(1);
    let other = cli.file("password");
    let (licence, activation) = ("aaaa-aaaa-aaaa-aaaa", "XXXX-XXXX-XXXX-XXXX-XXXX-XXX");
    for (arguments, code) in [
        (&["activate", "--file", "/nowhere.csv", "--yes", "cell 1"][..], "file-unreadable"),
        (&["activate", "--file", &other, "--yes", "cell 1"], "bad-activation-file"),
        (&["activate", "--license", licence, "--activation", activation, "--yes", "cell 1"], "bad-activation-key"),
        (&["activate", "--file", SAMPLE, "cell 1"], "not-confirmed"),
        (&["activate", "--file", SAMPLE, "--yes", "cell 9"], "unknown-controller"),
    ] {
        let (exit, lines) = cli.json(arguments);
        assert_eq!(exit, Some(2), "{arguments:?} {lines:?}");
        assert_error(&lines, code);
    }
    for arguments in [
        &["activate", "--license", licence, "cell 1"][..],
        &["activate", "--file", SAMPLE, "--license", licence, "--activation", activation, "cell 1"],
        &["activate", "cell 1"],
        &["virtual", "keys"],
        &["virtual", "keys", "no serial"],
        &["virtual", "--count", "1", "keys", "R7A0000001"],
    ] {
        assert_eq!(cli.run(arguments).code, Some(2), "{arguments:?}");
    }
    assert_eq!(cli.json(&["info", "cell 1"]).1[0]["result"]["revision"], 1, "nothing was changed");
}

#[test]
fn the_keys_of_virtual_controllers_make_an_activation_file() {
    let folder = tempfile::tempdir().unwrap();
    let printed = Running::start(program().args(["virtual", "keys", "R7A0010001", "TVT0010002"])).unwrap().finish(DONE);
    let file = folder.path().join("keys.csv");
    fs::write(&file, &printed.stdout).unwrap();
    let parsed = opcua_configurator::model::activation::parse(printed.stdout.as_bytes()).unwrap();
    assert_eq!((parsed.lines().len(), parsed.mistakes().len()), (2, 0));
    assert!(fs::read_to_string(SAMPLE).unwrap().starts_with(printed.stdout.trim_end()));
}
