//! Showing a folder in the desktop's file manager.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::model::{ErrorCode, Problem};

/// The programs to try, in order: each gets the folder as its last argument, and no shell reads it.
#[cfg(windows)]
const OPENERS: &[&[&str]] = &[&["explorer.exe"]];
#[cfg(target_os = "macos")]
const OPENERS: &[&[&str]] = &[&["/usr/bin/open"]];
#[cfg(not(any(windows, target_os = "macos")))]
const OPENERS: &[&[&str]] = &[&["xdg-open"], &["gio", "open"]];

/// One that is still running then has a folder to show.
const WAIT_LIMIT: Duration = Duration::from_secs(3);
const POLL: Duration = Duration::from_millis(50);

pub fn open(folder: &Path) -> Result<(), Problem> {
    open_with(folder, OPENERS)
}

fn open_with(folder: &Path, openers: &[&[&str]]) -> Result<(), Problem> {
    let failed = |why: &dyn std::fmt::Display| {
        Problem::with_detail(ErrorCode::FolderNotOpened, format!("{}: {why}", folder.display()))
    };
    // Absolute, so that no name can pass for an option.
    let absolute = std::path::absolute(folder).map_err(|e| failed(&e))?;
    if !absolute.is_dir() {
        return Err(failed(&"there is no such folder"));
    }
    let mut last = None;
    for opener in openers {
        match start(opener, &absolute) {
            Ok(()) => return Ok(()),
            Err(why) => last = Some(why),
        }
    }
    Err(last.map_or_else(|| failed(&"no program for it"), |why| failed(&why)))
}

fn start(opener: &[&str], folder: &PathBuf) -> io::Result<()> {
    let [program, arguments @ ..] = opener else { return Err(io::ErrorKind::InvalidInput.into()) };
    let mut command = Command::new(program);
    command.args(arguments).arg(folder);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let child = command.spawn().map_err(|e| io::Error::new(e.kind(), format!("{program}: {e}")))?;
    wait(child, program)
}

/// Until it ends, which says whether it found a file manager, or has run for a while.
fn wait(mut child: Child, program: &str) -> io::Result<()> {
    let until = Instant::now() + WAIT_LIMIT;
    while Instant::now() < until {
        match child.try_wait()? {
            // Explorer returns 1 in every case.
            Some(status) if status.success() || cfg!(windows) => return Ok(()),
            Some(status) => return Err(io::Error::other(format!("{program}: {status}"))),
            None => std::thread::sleep(POLL),
        }
    }
    // A program that is not waited for stays behind as a zombie process.
    std::thread::Builder::new().name("file manager".into()).spawn(move || child.wait())?;
    Ok(())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    /// A program that writes its arguments into a file, one a line, and ends like this.
    fn opener(folder: &Path, name: &str, ends: &str) -> String {
        use std::os::unix::fs::PermissionsExt as _;
        let (path, told) = (folder.join(name), folder.join("told"));
        let script = format!("#!/bin/sh\nprintf '%s\\n' \"$@\" >> '{}'\n{ends}\n", told.display());
        std::fs::write(&path, script).unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o700)).unwrap();
        path.display().to_string()
    }

    fn told(folder: &Path) -> String {
        std::fs::read_to_string(folder.join("told")).unwrap_or_default()
    }

    #[test]
    fn a_folder_is_one_argument_whatever_its_name() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("-a $(touch pwned) `id` ; 机器人 \"x\" & y");
        std::fs::create_dir(&folder).unwrap();
        let opener = opener(root.path(), "open", "exit 0");
        open_with(&folder, &[&[&opener, "open"]]).unwrap();
        assert_eq!(told(root.path()), format!("open\n{}\n", folder.display()));
    }

    #[test]
    fn the_next_program_is_tried_and_the_last_failure_told_with_the_path() {
        let root = tempfile::tempdir().unwrap();
        let (bad, good) = (opener(root.path(), "bad", "exit 3"), opener(root.path(), "good", "exit 0"));
        open_with(root.path(), &[&["/nowhere/at/all"], &[&bad], &[&good]]).unwrap();
        assert_eq!(told(root.path()).lines().count(), 2);
        let problem = open_with(root.path(), &[&["/nowhere/at/all"], &[&bad]]).unwrap_err();
        assert_eq!(problem.code, ErrorCode::FolderNotOpened);
        let detail = problem.detail.unwrap();
        assert!(detail.contains(&root.path().display().to_string()) && detail.contains('3'), "{detail}");
        let missing = open_with(&root.path().join("missing"), &[&[&good]]).unwrap_err();
        assert_eq!(missing.code, ErrorCode::FolderNotOpened);
    }

    #[test]
    fn a_program_that_goes_on_running_has_opened_it() {
        let root = tempfile::tempdir().unwrap();
        let slow = opener(root.path(), "slow", "exec sleep 4");
        open_with(root.path(), &[&[&slow]]).unwrap();
        assert_eq!(told(root.path()).lines().count(), 1);
    }
}
