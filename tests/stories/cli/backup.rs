//! Backups of keys and what is left behind, from the command line.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use serde_json::Value;

use crate::common::command_line_test::{CommandLineTest, assert_error, walk};

const SUBJECT: [&str; 8] = ["--country", "jp", "--state", "Nagano", "--locality", "Suwa", "--organisation", "Example"];

impl CommandLineTest {
    /// One legacy controller, "weld".
    fn legacy(more: &[&str]) -> Self {
        let cli = Self::with(1, &[&["--firmware", "legacy"], more].concat());
        assert_eq!(cli.add(0, "weld").0, Some(0));
        cli
    }

    fn done(&self, arguments: &[&str]) -> Value {
        let (code, lines) = self.json(&[&["--yes"], arguments].concat());
        assert_eq!(code, Some(0), "{lines:?}");
        lines[0]["result"].clone()
    }

    fn refused(&self, arguments: &[&str], code: &str) {
        let (exit, lines) = self.json(&[&["--yes"], arguments].concat());
        assert_eq!(exit, Some(1), "{lines:?}");
        assert_error(&lines, code);
    }

    fn thumbprint(&self) -> (Value, Value) {
        let certificate = self.done(&["info", "weld"])["certificate"].clone();
        (certificate["type"].clone(), certificate["thumbprint"].clone())
    }

    fn self_signed(&self) -> Value {
        self.done(&[&["cert", "self-signed"], &SUBJECT[..], &["weld"]].concat())
    }
}

#[cfg(unix)]
fn mode(path: &Path) -> u32 {
    use std::os::unix::fs::PermissionsExt as _;
    fs::metadata(path).unwrap().permissions().mode() & 0o777
}

#[test]
fn a_backup_is_put_back_and_former_files_are_said_to_be_kept() {
    let cli = CommandLineTest::legacy(&["--seed", "3"]);
    cli.run(&["backup", "on"]);
    assert_eq!(cli.self_signed()["moved_aside"], Value::Array(vec![]));
    let first = cli.thumbprint();
    cli.run(&["backup", "off"]);
    cli.self_signed();
    assert_ne!(cli.thumbprint(), first);

    let said = cli.run(&["--yes", "cert", "export", "weld"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let moved: Vec<PathBuf> = walk(&cli.workspace()).into_iter().filter(|path| path.ends_with("1_key.pfx")).collect();
    let [key] = &moved[..] else { panic!("{moved:?}") };
    let line = format!("weld: a former file was moved to {}", key.display());
    assert!(said.stdout.contains(&line), "{}", said.stdout);

    cli.refused(&["cert", "restore", "self-signed", "weld"], "file-not-found");
    let file = key.display().to_string();
    fs::write(cli.folder.path().join("wrong"), "wrong").unwrap();
    let wrong = cli.file("wrong");
    cli.refused(
        &["cert", "restore", "self-signed", "--file", &file, "--password-file", &wrong, "weld"],
        "wrong-key-password",
    );
    let restored = cli.done(&["cert", "restore", "self-signed", "--file", &file, "weld"]);
    assert_eq!(cli.thumbprint(), first);
    assert_eq!(restored["certificate"]["thumbprint"], first.1);

    // A request: backed up, lost, and put back.
    cli.run(&["backup", "on"]);
    let made = cli.done(&[&["cert", "csr"], &SUBJECT[..], &["weld"]].concat());
    let csr = fs::read(made["saved"]["csr"].as_str().unwrap()).unwrap();
    assert!(made["saved"]["key"].as_str().unwrap().ends_with("3_key.pfx"));
    let (code, lines) = cli.json(&["cert", "restore", "ca", "weld"]);
    assert_eq!(code, Some(2), "it is asked first");
    assert_error(&lines, "not-confirmed");
    assert_eq!(cli.done(&["cert", "restore", "ca", "weld"])["certificate"], Value::Null);
    // The CA of the workspace answers the restored request.
    fs::write(cli.folder.path().join("passphrase"), "correct horse").unwrap();
    let passphrase = cli.file("passphrase");
    let init = ["ca", "init", "--cn", "Plant CA", "--organisation", "Example", "--bits", "2048", "--passphrase-file"];
    assert_eq!(cli.run(&[&init[..], &[&passphrase]].concat()).code, Some(0));
    cli.done(&["ca", "sign-controllers", "--passphrase-file", &passphrase, "weld"]);
    assert_eq!(cli.thumbprint().0, "ca-signed");
    assert_eq!(fs::read(made["saved"]["csr"].as_str().unwrap()).unwrap(), csr, "for the request that was restored");
}

#[test]
fn an_empty_connection_password_protects_no_file() {
    let cli = CommandLineTest::with_password("", 1, &["--firmware", "legacy"]);
    assert_eq!(cli.add(0, "weld").0, Some(0));
    cli.refused(&["export-settings", "weld"], "unprotected-file");
    cli.run(&["backup", "on"]);
    let (exit, lines) = cli.json(&[&["--yes", "cert", "self-signed"], &SUBJECT[..], &["weld"]].concat());
    assert_eq!(exit, Some(1));
    assert_error(&lines, "unprotected-file");
    assert!(!walk(&cli.workspace()).iter().any(|path| path.extension().is_some_and(|e| e == "pfx" || e == "json")
        && !path.ends_with("epson_opcua_config.json")));
    fs::write(cli.folder.path().join("passphrase"), "correct horse").unwrap();
    cli.done(&["export-settings", "--passphrase-file", &cli.file("passphrase"), "weld"]);
}

#[test]
fn what_a_killed_program_left_behind_is_removed_by_the_next_command() {
    let data = tempfile::tempdir().unwrap();
    let data = data.path().join("controllers");
    let cli = CommandLineTest::legacy(&["--data", data.to_str().unwrap()]);
    cli.run(&["backup", "on"]);
    cli.self_signed();
    let key = walk(&cli.workspace()).into_iter().find(|path| path.ends_with("1_key.pfx")).unwrap();
    let leave = |name: &str, age: u64| {
        let path = key.with_file_name(name);
        fs::write(&path, "a key").unwrap();
        let file = fs::File::options().write(true).open(&path).unwrap();
        file.set_modified(SystemTime::now() - Duration::from_secs(age)).unwrap();
        (path, file)
    };
    let (old, _) = leave(".writing-abc123", 90);
    let (young, _) = leave(".writing-abc124", 0);
    let (written, lock) = leave(".writing-abc125", 90);
    lock.lock().unwrap();
    cli.done(&["info", "weld"]);
    assert!(!old.exists(), "it can hold a key");
    assert!(young.exists() && written.exists(), "another program may be writing them");
    drop(lock);
    cli.done(&["info", "weld"]);
    assert!(!written.exists());

    #[cfg(unix)]
    {
        for folder in [cli.workspace(), data.clone()] {
            assert_eq!(mode(&folder), 0o700, "{}", folder.display());
            for file in walk(&folder) {
                if file != young {
                    assert_eq!(mode(&file), 0o600, "{}", file.display());
                }
            }
        }
        assert!(data.join(".lock").exists() && cli.workspace().join(".lock").exists());
    }
}
