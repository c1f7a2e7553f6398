use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Component, Path};
use std::time::{Duration, SystemTime};

use super::WorkspaceError;
use crate::model::file_names::is_reserved;
use crate::platform::{private, replace};

/// Refuses a path with a part that Windows could not have; on every system, so that a workspace can be moved.
fn check_names(path: &Path) -> Result<(), WorkspaceError> {
    let names = path.components().filter_map(|part| match part {
        Component::Normal(name) => Some(name.to_string_lossy()),
        _ => None,
    });
    match names.into_iter().find(|name| is_reserved(name)) {
        Some(name) => Err(WorkspaceError::ReservedName { path: path.to_owned(), name: name.into_owned() }),
        None => Ok(()),
    }
}

/// Makes a folder and its parents, open to their owner only.
///
/// # Errors
/// [`WorkspaceError::ReservedName`] if a part of the path is one that Windows keeps for itself.
pub(super) fn create_folder(path: &Path) -> Result<(), WorkspaceError> {
    check_names(path)?;
    private::create_folder(path).map_err(|e| WorkspaceError::writing(path, e))
}

/// Writes a file whole or not at all: temporary name in the same folder, flush, rename, flush the folder.
///
/// The file is readable by its owner only (0600); missing folders are made. A file that another program has open is
/// [`WorkspaceError::Held`] after up to 2 s.
pub fn write_atomic(path: &Path, bytes: &[u8]) -> Result<(), WorkspaceError> {
    StagedFile::new(path, bytes)?.persist()
}

/// Opens a lock file, readable by its owner only; makes it, and its folder, if they are missing.
pub(super) fn open_lock_file(path: &Path) -> Result<File, WorkspaceError> {
    if let Some(folder) = path.parent() {
        create_folder(folder)?;
    }
    private::open_file(path).map_err(|e| WorkspaceError::writing(path, e))
}

/// Makes renames in a folder outlive a power cut. Windows does so by itself.
pub(super) fn sync_folder(folder: &Path) -> std::io::Result<()> {
    #[cfg(unix)]
    File::open(folder)?.sync_all()?;
    #[cfg(not(unix))]
    let _ = folder;
    Ok(())
}

/// A file that is whole on the disk and has only to take its name; removed if it does not.
pub(super) struct StagedFile<'a> {
    path: &'a Path,
    folder: &'a Path,
    file: tempfile::NamedTempFile<File>,
}

impl<'a> StagedFile<'a> {
    pub(super) fn new(path: &'a Path, bytes: &[u8]) -> Result<Self, WorkspaceError> {
        check_names(path)?;
        // A bare name is in the current folder.
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        create_folder(folder)?;
        let failed = |e| WorkspaceError::writing(path, e);
        let mut file =
            tempfile::Builder::new().prefix(TEMPORARY).make_in(folder, private::create_file).map_err(failed)?;
        // Tells other processes that it is being written. Not every file system has locks.
        let locked = file.as_file().try_lock().is_ok();
        file.write_all(bytes).map_err(failed)?;
        file.as_file().sync_all().map_err(failed)?;
        if locked && let Err(error) = file.as_file().unlock() {
            // Wine cannot unlock a file that was written to meanwhile. The lock ends with the handle at the latest.
            tracing::debug!(path = %path.display(), %error, "the file stays locked until it takes its name");
        }
        Ok(Self { path, folder, file })
    }

    pub(super) fn persist(self) -> Result<(), WorkspaceError> {
        let failed = |e| WorkspaceError::writing(self.path, e);
        // The temporary name is removed if it is still there.
        let (file, temporary) = self.file.into_parts();
        drop(file);
        replace::rename(&temporary, self.path).map_err(failed)?;
        sync_folder(self.folder).map_err(failed)
    }
}

/// Removes temporary files that a program which was killed left under a folder: only files, only under the names
/// [`write_atomic`] gives them, and none that another process is writing. Returns how many.
///
/// A file that is being written is locked, or younger than [`YOUNG`]. Where the file system has no locks, a file is left
/// alone for [`NEVER_WRITTEN_FOR`].
pub(super) fn remove_leftovers(root: &Path, now: SystemTime) -> usize {
    let mut removed = 0;
    let mut folders = vec![(root.to_owned(), 0)];
    while let Some((folder, depth)) = folders.pop() {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        for entry in entries.take(MAX_ENTRIES).flatten() {
            // Of the entry itself: a link leads out of the workspace.
            let Ok(meta) = entry.metadata() else { continue };
            if meta.is_dir() && depth < MAX_DEPTH {
                folders.push((entry.path(), depth + 1));
            }
            let age = meta.modified().ok().and_then(|modified| now.duration_since(modified).ok());
            let is_leftover = meta.is_file()
                && entry.file_name().to_str().is_some_and(is_temporary_name)
                && age.is_some_and(|age| age > YOUNG && (age > NEVER_WRITTEN_FOR || is_unlocked(&entry.path())));
            if is_leftover && fs::remove_file(entry.path()).is_ok() {
                removed += 1;
            }
        }
    }
    removed
}

fn is_unlocked(path: &Path) -> bool {
    File::options().write(true).open(path).is_ok_and(|file| file.try_lock().is_ok())
}

fn is_temporary_name(name: &str) -> bool {
    let random = |rest: &str| rest.len() == 6 && rest.bytes().all(|byte| byte.is_ascii_alphanumeric());
    name.strip_prefix(TEMPORARY).is_some_and(random)
}

const TEMPORARY: &str = ".writing-";
/// From making a file to locking it, and from unlocking it to renaming it, a process takes far less.
const YOUNG: Duration = Duration::from_secs(60);
/// No process takes so long to write a file.
const NEVER_WRITTEN_FOR: Duration = Duration::from_secs(60 * 60);
/// `<workspace>/<serial>/Cert/<kind>`.
const MAX_DEPTH: usize = 3;
const MAX_ENTRIES: usize = 20_000;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_windows_keeps_for_itself_is_refused_everywhere() {
        let folder = tempfile::tempdir().unwrap();
        for reserved in ["CON", "nul.txt", "COM1/a.der", "a/LPT3.x/b.der", "name.", "x /a.der"] {
            let refused = write_atomic(&folder.path().join(reserved), b"x");
            assert!(matches!(refused, Err(WorkspaceError::ReservedName { .. })), "{reserved}");
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "nothing was made");
        write_atomic(&folder.path().join("CONTROL/name.x"), b"x").unwrap();
    }

    #[test]
    fn a_file_is_replaced_and_private() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a/b/c.txt");
        write_atomic(&path, b"one").unwrap();
        write_atomic(&path, b"two").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1, "no temporary file is left");
        assert!(private::is_private(&path) && private::is_private(path.parent().unwrap()));
    }

    #[test]
    fn only_old_files_of_our_own_are_leftovers() {
        let root = tempfile::tempdir().unwrap();
        let deep = root.path().join("SN1/Cert/SelfSigned");
        fs::create_dir_all(deep.join(".writing-folder")).unwrap();
        let outside = tempfile::tempdir().unwrap();
        fs::write(outside.path().join(".writing-abc123"), "x").unwrap();
        for name in [".writing-abc123", ".writing-abc", ".writing-../x", "writing-abc123", ".writing-abc123.json"] {
            fs::write(deep.join(name.replace('/', "_")), "x").unwrap();
        }
        fs::write(root.path().join(".writing-Zz09aA"), "x").unwrap();
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(outside.path(), root.path().join("link")).unwrap();
            std::os::unix::fs::symlink(outside.path(), root.path().join(".writing-linked")).unwrap();
        }
        assert_eq!(remove_leftovers(root.path(), SystemTime::now()), 0, "too young");
        let later = SystemTime::now() + YOUNG + Duration::from_secs(1);
        let writing = File::options().write(true).open(root.path().join(".writing-Zz09aA")).unwrap();
        writing.lock().unwrap();
        assert_eq!(remove_leftovers(root.path(), later), 1, "the other one is being written");
        drop(writing);
        assert_eq!(remove_leftovers(root.path(), later), 1);
        assert!(!deep.join(".writing-abc123").exists() && outside.path().join(".writing-abc123").exists());
        assert_eq!(fs::read_dir(&deep).unwrap().count(), 5);
    }
}
