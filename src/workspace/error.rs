use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why the workspace folder could not be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WorkspaceError {
    /// The folder, or a file in it, cannot be written.
    #[error("{}: {source}", path.display())]
    NotWritable {
        /// The file or folder.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The disk or the quota is full, or the file system takes no file of that size.
    #[error("{}: {source}", path.display())]
    Full {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// Another process holds the lock of the folder.
    #[error("{} is in use", .0.display())]
    Busy(PathBuf),
    /// Another program keeps a file open; the source says which.
    #[error("{0}")]
    Held(#[source] io::Error),
    /// A file cannot be read.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// See [`is_reserved`](crate::model::file_names::is_reserved).
    #[error("{}: \"{name}\" is a name that Windows keeps for itself", path.display())]
    ReservedName {
        /// The folder or file.
        path: PathBuf,
        /// The part of the path that Windows reserves.
        name: String,
    },
}

impl WorkspaceError {
    pub(super) fn writing(path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        match source.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge => {
                Self::Full { path, source }
            }
            io::ErrorKind::ResourceBusy => Self::Held(source),
            _ => Self::NotWritable { path, source },
        }
    }
}

/// Why a file that was chosen, or is looked for in a controller's folder, cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FileError {
    /// The file does not exist.
    #[error("{}: {source}", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// No file in the folder has the extension; or there is no such folder.
    #[error("{}: no .{extension}", folder.display())]
    NoneOfKind {
        /// The folder that was searched.
        folder: PathBuf,
        /// The extension, without its dot.
        extension: &'static str,
    },
    /// Several files in the folder have the extension, where one is expected.
    #[error("{}: {count} .{extension} files", folder.display())]
    SeveralOfKind {
        /// The folder that was searched.
        folder: PathBuf,
        /// The extension, without its dot.
        extension: &'static str,
        /// How many there are.
        count: usize,
    },
    /// The name has other characters than letters, digits and underscores (manual 6.2), or Windows keeps it for itself.
    #[error("{}", .0.display())]
    BadName(PathBuf),
    /// The file exists and cannot be read.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The file has more bytes than any of its kind.
    #[error("{}: more than {max} bytes", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Greatest size in bytes.
        max: usize,
    },
}

impl FileError {
    pub(super) fn reading(path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        match source.kind() {
            io::ErrorKind::NotFound => Self::Missing { path, source },
            _ => Self::Unreadable { path, source },
        }
    }
}
