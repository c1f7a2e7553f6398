//! Replaces and removes files, although another program may have them open.
//!
//! Windows refuses both while a virus scanner, a backup or a spreadsheet has the file open. Most let go within
//! milliseconds, so the refused step is repeated for a moment. If that does not help, the error names the file and, as
//! far as Windows knows them, the programs.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use thiserror::Error;

/// Another program has the file open and does not let go of it. Inside an [`io::Error`] of the kind
/// [`io::ErrorKind::ResourceBusy`].
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{} is open in {}", path.display(), programs(holders))]
pub struct FileHeld {
    /// The file that is open elsewhere.
    pub path: PathBuf,
    /// Programs with their process number; empty if the system does not know them.
    pub holders: Vec<String>,
}

fn programs(holders: &[String]) -> String {
    if holders.is_empty() { "another program".to_owned() } else { holders.join(", ") }
}

/// Gives a file another name in the same folder; a file that has this name is replaced. Blocks up to 2 s.
pub fn rename(from: &Path, to: &Path) -> io::Result<()> {
    persistently(to, is_held, sleep, || fs::rename(from, to))
}

/// Removes a file. Blocks up to 2 s.
pub fn remove(path: &Path) -> io::Result<()> {
    persistently(path, is_held, sleep, || fs::remove_file(path))
}

/// As [`remove`]; a missing file is no error.
pub fn remove_if_there(path: &Path) -> io::Result<()> {
    match remove(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        result => result,
    }
}

/// How a failed step may be explained.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Held {
    /// Not by another program.
    No,
    /// By another program or by missing permission: Windows gives the same answer.
    Perhaps,
    Yes,
}

/// Repeats `attempt` while another program holds `path`: 11 times within 2 s.
fn persistently(
    path: &Path,
    is_held: impl Fn(&io::Error) -> Held,
    mut wait: impl FnMut(Duration),
    mut attempt: impl FnMut() -> io::Result<()>,
) -> io::Result<()> {
    for delay in DELAYS {
        match attempt() {
            Err(error) if is_held(&error) != Held::No => wait(Duration::from_millis(delay)),
            result => return result,
        }
    }
    let Err(error) = attempt() else { return Ok(()) };
    let held = is_held(&error);
    if held == Held::No || (held == Held::Perhaps && !is_open_elsewhere(path)) {
        return Err(error);
    }
    let holders = holders(path);
    Err(io::Error::new(io::ErrorKind::ResourceBusy, FileHeld { path: path.to_owned(), holders }))
}

#[cfg(windows)]
fn is_held(error: &io::Error) -> Held {
    use windows_sys::Win32::Foundation::{
        ERROR_ACCESS_DENIED, ERROR_LOCK_VIOLATION, ERROR_SHARING_VIOLATION, ERROR_USER_MAPPED_FILE,
    };
    match error.raw_os_error().map(i32::cast_unsigned) {
        Some(ERROR_SHARING_VIOLATION | ERROR_LOCK_VIOLATION | ERROR_USER_MAPPED_FILE) => Held::Yes,
        Some(ERROR_ACCESS_DENIED) => Held::Perhaps,
        _ => Held::No,
    }
}

#[cfg(not(windows))]
fn is_held(error: &io::Error) -> Held {
    if error.kind() == io::ErrorKind::ResourceBusy { Held::Yes } else { Held::No }
}

#[cfg(windows)]
use super::windows::holders::{holders, is_open_elsewhere};

/// Other systems let files be replaced that are open.
#[cfg(not(windows))]
fn holders(_path: &Path) -> Vec<String> {
    Vec::new()
}

#[cfg(not(windows))]
fn is_open_elsewhere(_path: &Path) -> bool {
    false
}

/// Milliseconds before each further attempt.
const DELAYS: [u64; 10] = [5, 10, 20, 40, 75, 150, 300, 400, 500, 500];

#[cfg(test)]
mod tests {
    use super::*;

    fn busy(_: &io::Error) -> Held {
        Held::Yes
    }

    /// A step that is refused so many times, and how long it was waited for.
    fn refused(times: usize, is_held: fn(&io::Error) -> Held) -> (io::Result<()>, Duration) {
        let (mut left, mut waited) = (times, Duration::ZERO);
        let result = persistently(
            Path::new("a.csv"),
            is_held,
            |delay| waited += delay,
            || {
                if left == 0 {
                    return Ok(());
                }
                left -= 1;
                Err(io::Error::from(io::ErrorKind::PermissionDenied))
            },
        );
        (result, waited)
    }

    #[test]
    fn a_file_that_is_held_for_a_moment_is_replaced() {
        assert_eq!(refused(0, busy).1, Duration::ZERO);
        for times in [1, 5, 10] {
            let (result, waited) = refused(times, busy);
            assert!(result.is_ok() && waited > Duration::ZERO && waited <= Duration::from_secs(2), "{waited:?}");
        }
    }

    #[test]
    fn a_file_that_stays_held_is_named() {
        let (result, waited) = refused(usize::MAX, busy);
        let error = result.unwrap_err();
        assert_eq!((error.kind(), waited), (io::ErrorKind::ResourceBusy, Duration::from_secs(2)));
        assert_eq!(error.to_string(), "a.csv is open in another program");
        let held = FileHeld { path: "a.csv".into(), holders: vec!["EXCEL.EXE (4242)".to_owned()] };
        assert_eq!(held.to_string(), "a.csv is open in EXCEL.EXE (4242)");
    }

    #[test]
    fn a_missing_permission_stays_what_it_is() {
        let (result, waited) = refused(usize::MAX, |_| Held::No);
        assert_eq!((result.unwrap_err().kind(), waited), (io::ErrorKind::PermissionDenied, Duration::ZERO));
        let (result, _) = refused(usize::MAX, |_| Held::Perhaps);
        assert_eq!(result.unwrap_err().kind(), io::ErrorKind::PermissionDenied);
    }

    #[test]
    fn files_are_renamed_over_others_and_removed() {
        let folder = tempfile::tempdir().unwrap();
        let (old, new) = (folder.path().join("old"), folder.path().join("new"));
        fs::write(&old, "1").unwrap();
        fs::write(&new, "2").unwrap();
        rename(&new, &old).unwrap();
        assert_eq!(fs::read(&old).unwrap(), b"2");
        assert_eq!(rename(&new, &old).unwrap_err().kind(), io::ErrorKind::NotFound);
        remove(&old).unwrap();
        assert_eq!(remove(&old).unwrap_err().kind(), io::ErrorKind::NotFound);
        remove_if_there(&old).unwrap();
    }

    #[cfg(windows)]
    #[test]
    fn a_file_that_another_handle_holds_is_replaced_once_it_is_closed() {
        use std::os::windows::fs::OpenOptionsExt as _;
        let folder = tempfile::tempdir().unwrap();
        let (held, new) = (folder.path().join("held.csv"), folder.path().join("new"));
        fs::write(&held, "old").unwrap();
        fs::write(&new, "new").unwrap();
        // As a spreadsheet opens it: others may read.
        let open = || fs::File::options().read(true).write(true).share_mode(1).open(&held).unwrap();
        let file = open();
        let error = rename(&new, &held).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::ResourceBusy, "{error}");
        assert!(error.to_string().contains("held.csv is open in"), "{error}");
        drop(file);
        let file = open();
        std::thread::scope(|scope| {
            scope.spawn(move || {
                sleep(Duration::from_millis(300));
                drop(file);
            });
            rename(&new, &held).unwrap();
        });
        assert_eq!(fs::read(&held).unwrap(), b"new");
    }
}
