//! Finding and reading the files an engineer puts into a controller's folders for import (manual 2.7.1.4, 2.7.1.5).

use std::path::{Path, PathBuf};
use std::{fs, io};

use super::{FileError, read_bounded};
use crate::model::file_names::is_reserved;
use crate::pki::MAX_CERTIFICATE_FILE_BYTES;

/// Reads a file of at most `max` bytes that was chosen by a person. Blocks.
///
/// # Errors
/// [`FileError::Missing`], [`FileError::Unreadable`]; [`FileError::TooLarge`]: a file of the expected kind has not more
/// than `max` bytes.
pub fn read_import_file(path: &Path, max: usize) -> Result<Vec<u8>, FileError> {
    let bytes = read_bounded(path, max as u64).map_err(|source| FileError::reading(path, source))?;
    if bytes.len() > max { Err(FileError::TooLarge { path: path.to_owned(), max }) } else { Ok(bytes) }
}

/// The contents of the other certificate files in the folder of one, of at most 50. One that cannot be read
/// is left out without an error. Blocks.
pub fn certificate_files_beside(path: &Path) -> Vec<Vec<u8>> {
    let Some(folder) = path.parent() else { return Vec::new() };
    let files = certificate_files_in(folder).into_iter().filter(|file| file != path);
    files.take(MAX_BESIDE).filter_map(|file| read_import_file(&file, MAX_CERTIFICATE_FILE_BYTES).ok()).collect()
}

/// The files of a folder that are certificates by their extension, sorted. Blocks.
pub(super) fn certificate_files_in(folder: &Path) -> Vec<PathBuf> {
    let Ok(files) = fs::read_dir(folder) else { return Vec::new() };
    let is_certificate = |file: &PathBuf| {
        let extension = file.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        CERTIFICATE_EXTENSIONS.iter().any(|known| extension.eq_ignore_ascii_case(known))
    };
    let mut files: Vec<PathBuf> =
        files.take(MAX_LISTED).filter_map(|entry| Some(entry.ok()?.path())).filter(is_certificate).collect();
    files.sort();
    files
}

const CERTIFICATE_EXTENSIONS: [&str; 6] = ["der", "cer", "crt", "pem", "p7b", "p7c"];
const MAX_BESIDE: usize = 50;
/// A folder such as that of downloads may hold any number of other files.
const MAX_LISTED: usize = 10_000;

/// The only file with this extension in a folder, with a name as the manual wants it (6.2). Other files do not matter.
pub(super) fn single(folder: &Path, extension: &'static str) -> Result<PathBuf, FileError> {
    let missing = || FileError::NoneOfKind { folder: folder.to_owned(), extension };
    let unreadable = |source: io::Error| match FileError::reading(folder, source) {
        FileError::Missing { .. } => missing(),
        other => other,
    };
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension)) && path.is_file() {
            found.push(path);
        }
    }
    match found.as_slice() {
        [] => Err(missing()),
        [path] if has_plain_name(path) => Ok(path.clone()),
        [path] => Err(FileError::BadName(path.clone())),
        several => Err(FileError::SeveralOfKind { folder: folder.to_owned(), extension, count: several.len() }),
    }
}

/// Half-width letters, digits and underscores before the extension, and no name that Windows keeps for itself.
fn has_plain_name(path: &Path) -> bool {
    path.file_stem().and_then(|stem| stem.to_str()).is_some_and(|stem| {
        !stem.is_empty() && stem.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_') && !is_reserved(stem)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::SerialNumber;
    use crate::model::{ErrorCode, Problem};
    use crate::workspace::Workspace;

    fn code_of(error: FileError) -> ErrorCode {
        Problem::from(error).code
    }

    #[test]
    fn exactly_one_file_with_a_plain_name_is_found() {
        let root = tempfile::tempdir().unwrap();
        let files = Workspace::new(root.path().join("my workspace")).certificate_files();
        let serial: SerialNumber = "SN0000123".parse().unwrap();
        let code = || files.find_ca_signed(&serial).map_err(code_of);
        assert_eq!(code(), Err(ErrorCode::FileNotFound), "no folder");
        let folder = files.ca_signed_folder(&serial);
        fs::create_dir_all(folder.join("folder.der")).unwrap();
        fs::write(folder.join("3_key.pfx"), "x").unwrap();
        assert_eq!(code(), Err(ErrorCode::FileNotFound), "something else");
        for name in ["CON.der", "com1.der", "robot 7.der", "robot-7.der", "机器人.der", "robot.7.der"] {
            fs::write(folder.join(name), "x").unwrap();
            assert_eq!(code(), Err(ErrorCode::BadFileName), "{name}");
            fs::remove_file(folder.join(name)).unwrap();
        }
        fs::write(folder.join("Robot_7.DER"), "x").unwrap();
        assert_eq!(code(), Ok(folder.join("Robot_7.DER")));
        fs::write(folder.join("other.der"), "x").unwrap();
        assert_eq!(code(), Err(ErrorCode::SeveralFiles));
    }

    #[test]
    fn a_pair_is_two_files_and_a_pfx_is_one() {
        let root = tempfile::tempdir().unwrap();
        let files = Workspace::new(root.path()).certificate_files();
        let serial: SerialNumber = "SN0000123".parse().unwrap();
        let folder = files.user_specified_folder(&serial);
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("ccc.der"), "x").unwrap();
        assert_eq!(code_of(files.find_user_pair(&serial).unwrap_err()), ErrorCode::FileNotFound);
        fs::write(folder.join("ddd.key"), "x").unwrap();
        assert_eq!(files.find_user_pair(&serial).unwrap(), (folder.join("ccc.der"), folder.join("ddd.key")));
        assert_eq!(code_of(files.find_user_pfx(&serial).unwrap_err()), ErrorCode::FileNotFound);
        fs::write(folder.join("eee.pfx"), "x").unwrap();
        assert_eq!(files.find_user_pfx(&serial).unwrap(), folder.join("eee.pfx"));
    }

    #[test]
    fn certificates_beside_one_are_found_by_their_extension() {
        let root = tempfile::tempdir().unwrap();
        for name in ["own.der", "Root.CER", "sub.pem", "key.key", "notes.txt"] {
            fs::write(root.path().join(name), name).unwrap();
        }
        fs::create_dir(root.path().join("folder.pem")).unwrap();
        fs::write(root.path().join("large.crt"), vec![0; MAX_CERTIFICATE_FILE_BYTES + 1]).unwrap();
        let found = certificate_files_beside(&root.path().join("own.der"));
        assert_eq!(found, [b"Root.CER".to_vec(), b"sub.pem".to_vec()]);
        assert!(certificate_files_beside(&root.path().join("missing/own.der")).is_empty());
    }

    #[test]
    fn a_file_is_read_within_its_limit() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("x");
        let code = |max| read_import_file(&path, max).map_err(code_of);
        assert_eq!(code(3), Err(ErrorCode::FileNotFound));
        fs::write(&path, "abc").unwrap();
        assert_eq!(code(3), Ok(b"abc".to_vec()));
        assert_eq!(code(2), Err(ErrorCode::FileFormat));
        assert_eq!(code_of(read_import_file(root.path(), 2).unwrap_err()), ErrorCode::FileUnreadable);
    }
}
