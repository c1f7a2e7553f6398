//! Sets of files that belong together, such as a certificate and its key: a new set takes the place of the former one,
//! and the former one is kept, together.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use chrono::{DateTime, Utc};

use super::WorkspaceError;
use super::atomic::{StagedFile, create_folder, sync_folder};
use crate::platform::replace;

/// Writes files that belong together, after the files of the former set were moved aside. Returns where those are now.
///
/// Each file of `former` moves into a folder beside it, named after the date of the set: the last change of the newest
/// of its files, in UTC, as `20261127_174509`, with `_2` and so on where that folder exists. `former` is moved in its
/// order and `new` written in its order, so a key should be the first in both: a key is of use alone, a certificate
/// without its key is not.
///
/// Errors: the former files are back in their places, unless the first of `new` was written already.
///
/// A program that is killed in between leaves every former file in one of both places, and no file of the former set
/// beside one of the new set.
pub(super) fn replace_set(former: &[PathBuf], new: &[(PathBuf, &[u8])]) -> Result<Vec<PathBuf>, WorkspaceError> {
    let staged = new.iter().map(|(path, bytes)| StagedFile::new(path, bytes)).collect::<Result<Vec<_>, _>>()?;
    let mut moved = MovedFiles::default();
    let date = unused_date(former);
    for file in former {
        moved.aside(file, &date)?;
    }
    for (index, file) in staged.into_iter().enumerate() {
        file.persist()?;
        if index == 0 {
            moved.replaced = true;
        }
    }
    moved.replaced = true;
    Ok(moved.files.iter().map(|(_, to)| to.clone()).collect())
}

/// What was moved, and is moved back when this is dropped before the first of the new files is in place.
#[derive(Default)]
struct MovedFiles {
    /// From where, to where.
    files: Vec<(PathBuf, PathBuf)>,
    /// The new files take over from here.
    replaced: bool,
}

impl MovedFiles {
    fn aside(&mut self, file: &Path, date: &str) -> Result<(), WorkspaceError> {
        let failed = |e| WorkspaceError::writing(file, e);
        let (Some(parent), Some(name)) = (file.parent(), file.file_name()) else { return Ok(()) };
        let folder = parent.join(date);
        create_folder(&folder)?;
        let to = folder.join(name);
        replace::rename(file, &to).map_err(failed)?;
        self.files.push((file.to_owned(), to));
        sync_folder(&folder).and_then(|()| sync_folder(parent)).map_err(failed)
    }
}

impl Drop for MovedFiles {
    fn drop(&mut self) {
        if self.replaced {
            return;
        }
        for (from, to) in self.files.iter().rev() {
            if let Err(error) = replace::rename(to, from) {
                tracing::warn!(file = %to.display(), %error, "a file that was moved aside could not be put back");
            } else if let Some(folder) = to.parent() {
                // Only if it is empty.
                let _not_empty = fs::remove_dir(folder);
            }
        }
    }
}

/// The name for the folders of a former set: none of them exists.
fn unused_date(former: &[PathBuf]) -> String {
    let changed = former.iter().filter_map(|file| fs::metadata(file).ok()?.modified().ok());
    let date = date_of(changed.max().unwrap_or_else(SystemTime::now));
    let is_free = |name: &String| !former.iter().any(|file| file.with_file_name(name).exists());
    let numbered = (2u32..).map(|number| format!("{date}_{number}"));
    std::iter::once(date.clone()).chain(numbered).find(is_free).unwrap_or(date)
}

/// A time no calendar has is taken for 1970.
fn date_of(time: SystemTime) -> String {
    let seconds = time.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let date = i64::try_from(seconds).ok().and_then(|seconds| DateTime::<Utc>::from_timestamp(seconds, 0));
    date.unwrap_or_default().format("%Y%m%d_%H%M%S").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    const OLD: &str = "20010909_014640";

    /// Files with the same old date.
    fn write(folder: &Path, names: &[&str]) -> Vec<PathBuf> {
        let write = |name: &&str| {
            let path = folder.join(name);
            create_folder(path.parent().unwrap()).unwrap();
            fs::write(&path, format!("old {name}")).unwrap();
            let file = fs::File::options().write(true).open(&path).unwrap();
            file.set_modified(UNIX_EPOCH + Duration::from_secs(1_000_000_000)).unwrap();
            path
        };
        names.iter().map(write).collect()
    }

    fn files(folder: &Path) -> Vec<String> {
        let mut found = Vec::new();
        let mut folders = vec![folder.to_owned()];
        while let Some(next) = folders.pop() {
            for entry in fs::read_dir(next).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path);
                } else {
                    let name = path.strip_prefix(folder).unwrap().to_str().unwrap().replace('\\', "/");
                    found.push(format!("{name}: {}", fs::read_to_string(&path).unwrap()));
                }
            }
        }
        found.sort();
        found
    }

    #[test]
    fn a_former_set_is_kept_together_under_its_date() {
        let root = tempfile::tempdir().unwrap();
        for round in ["", "_2"] {
            let former = write(root.path(), &["keys/key", "requests/request"]);
            let new = [(root.path().join("requests/request"), b"new".as_slice())];
            let moved = replace_set(&former, &new).unwrap();
            let date = OLD.replace("014640", &format!("014640{round}"));
            let expected = ["keys", "requests"].map(|folder| root.path().join(folder).join(&date));
            assert_eq!(moved, [expected[0].join("key"), expected[1].join("request")]);
        }
        assert_eq!(
            files(root.path()),
            [
                format!("keys/{OLD}/key: old keys/key"),
                format!("keys/{OLD}_2/key: old keys/key"),
                format!("requests/{OLD}/request: old requests/request"),
                format!("requests/{OLD}_2/request: old requests/request"),
                "requests/request: new".to_owned(),
            ]
        );
    }

    #[test]
    fn a_failure_puts_everything_back() {
        let root = tempfile::tempdir().unwrap();
        let former = write(root.path(), &["key", "certificate"]);
        let before = files(root.path());
        // One that cannot even be staged, and one whose name is taken by a folder.
        fs::create_dir(root.path().join("folder")).unwrap();
        for bad in [root.path().join("key/below a file"), root.path().join("folder")] {
            let new = [(bad, b"new".as_slice()), (root.path().join("certificate"), b"new".as_slice())];
            replace_set(&former, &new).unwrap_err();
            assert_eq!(files(root.path()), before);
        }
        // One of the former files is not there.
        let missing = [former.clone(), vec![root.path().join("missing")]].concat();
        replace_set(&missing, &[(root.path().join("key"), b"new".as_slice())]).unwrap_err();
        assert_eq!(files(root.path()), before);
        assert!(!root.path().join(OLD).exists(), "no empty folder is left");
    }

    #[test]
    fn a_program_that_is_killed_in_between_loses_and_mixes_nothing() {
        for (moved_before, written_before) in [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2)] {
            let root = tempfile::tempdir().unwrap();
            let former = write(root.path(), &["key", "certificate"]);
            let new = ["key", "certificate"].map(|name| (root.path().join(name), b"new".as_slice()));
            // The steps of `replace_set`, up to there. A process that is killed runs no destructor.
            let staged: Vec<_> = new.iter().map(|(path, bytes)| StagedFile::new(path, bytes).unwrap()).collect();
            let (mut moved, date) = (MovedFiles::default(), unused_date(&former));
            former.iter().take(moved_before).for_each(|file| moved.aside(file, &date).unwrap());
            std::mem::forget(moved);
            for (index, file) in staged.into_iter().enumerate() {
                if index < written_before {
                    file.persist().unwrap();
                }
            }
            let found = files(root.path());
            for old in ["old key", "old certificate"] {
                assert_eq!(found.iter().filter(|file| file.ends_with(old)).count(), 1, "{found:?}");
            }
            let has = |file: &str| found.iter().any(|found| found == file);
            assert!(!(has("key: old key") && has("certificate: new")), "{found:?}");
            assert!(!(has("key: new") && has("certificate: old certificate")), "{found:?}");
            // The next one goes on from there.
            let left: Vec<PathBuf> = former.into_iter().filter(|file| file.exists()).collect();
            replace_set(&left, &new).unwrap();
            let found = files(root.path());
            assert!(["key: new", "certificate: new"].iter().all(|file| found.contains(&(*file).to_owned())));
        }
    }

    #[test]
    fn any_time_of_a_file_is_a_name() {
        assert_eq!(date_of(UNIX_EPOCH - Duration::from_secs(5)), "19700101_000000");
        if let Some(late) = UNIX_EPOCH.checked_add(Duration::from_secs(i64::MAX as u64 / 2)) {
            assert_eq!(date_of(late), "19700101_000000");
        }
    }
}
