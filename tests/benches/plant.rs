//! Virtual controllers in a process of their own, for benches that look at servers from outside.

use std::path::Path;

use crate::command_line_test::CommandLineTest;

/// Adds every controller as `cell1`, `cell2` and so on, with a certificate, these settings, and a client's certificate
/// in the trusted list, and starts the servers.
pub fn set_up(plant: &CommandLineTest, settings: &[&str], trusted: &Path) {
    for index in 0..plant.ready.len() {
        assert_eq!(plant.add(index, &format!("cell{}", index + 1)).0, Some(0));
    }
    let subject = ["--country", "JP", "--state", "Nagano", "--locality", "Suwa", "--organisation", "Example"];
    let trusted = trusted.display().to_string();
    for command in [
        [&["cert", "self-signed"][..], &subject].concat(),
        [&["settings", "set"][..], settings].concat(),
        vec!["clients", "add", "--list", "trusted", &trusted],
        vec!["start"],
    ] {
        let (code, lines) = plant.json(&[&command[..], &["--yes", "--all"]].concat());
        assert_eq!(code, Some(0), "{command:?}: {lines:?}");
    }
}
