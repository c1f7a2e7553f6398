//! Files and folders that only this account can use.
//!
//! On Unix: mode 0600 for files, 0700 for folders. On Windows: an access control list that inherits nothing and names
//! the account, the file's owner and the system, set when the file is made. File systems without permissions (FAT) keep
//! neither.

use std::fs::File;
use std::io;
use std::path::Path;

/// Makes a folder and its missing parents. Folders that exist keep their permissions.
///
/// On Windows a missing parent directly below a drive's root is made with the permissions it inherits: other programs
/// keep their files there too (`C:\EpsonRC80`).
pub fn create_folder(path: &Path) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::DirBuilderExt as _;
        std::fs::DirBuilder::new().recursive(true).mode(0o700).create(path)
    }
    #[cfg(windows)]
    {
        super::windows::access::create_folder(path)
    }
}

/// Creates a file for reading and writing; [`io::ErrorKind::AlreadyExists`] if there is one.
pub fn create_file(path: &Path) -> io::Result<File> {
    #[cfg(unix)]
    {
        private_options().create_new(true).open(path)
    }
    #[cfg(windows)]
    {
        super::windows::access::open_file(path, super::windows::access::Open::New)
    }
}

/// Opens a file for reading and writing without changing it, such as a lock file; creates it if it is missing.
pub fn open_file(path: &Path) -> io::Result<File> {
    #[cfg(unix)]
    {
        private_options().create(true).truncate(false).open(path)
    }
    #[cfg(windows)]
    {
        super::windows::access::open_file(path, super::windows::access::Open::Any)
    }
}

#[cfg(unix)]
fn private_options() -> std::fs::OpenOptions {
    use std::os::unix::fs::OpenOptionsExt as _;
    let mut options = File::options();
    options.read(true).write(true).mode(0o600);
    options
}

/// Whether a file or folder is as this module makes it. Used by tests.
#[cfg(test)]
pub fn is_private(path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        std::fs::metadata(path).unwrap().permissions().mode() & 0o077 == 0
    }
    #[cfg(windows)]
    {
        super::windows::access::is_private(path).unwrap()
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Read as _, Write as _};

    use super::*;

    #[test]
    fn files_and_folders_are_private() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("焊接/SN 1");
        create_folder(&folder).unwrap();
        create_folder(&folder).unwrap();
        assert!(is_private(&folder) && is_private(folder.parent().unwrap()));
        let path = folder.join("key.pem");
        create_file(&path).unwrap().write_all(b"secret").unwrap();
        assert!(is_private(&path));
        assert_eq!(create_file(&path).unwrap_err().kind(), io::ErrorKind::AlreadyExists);
        let mut text = String::new();
        open_file(&path).unwrap().read_to_string(&mut text).unwrap();
        assert_eq!(text, "secret", "opening changes nothing");
        let lock = folder.join(".lock");
        open_file(&lock).unwrap();
        assert!(is_private(&lock));
        assert!(create_folder(&path).is_err(), "a file is in the way");
        assert!(create_file(&root.path().join("missing/file")).is_err());
    }

    #[test]
    fn paths_longer_than_260_characters_work() {
        let root = tempfile::tempdir().unwrap();
        let folder = (0..4).fold(root.path().to_owned(), |folder, _| folder.join("x".repeat(100)));
        create_folder(&folder).unwrap();
        create_file(&folder.join("file")).unwrap();
        assert!(folder.join("file").is_file());
    }
}
