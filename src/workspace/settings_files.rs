use std::path::{Path, PathBuf};
use std::{fs, io};

use thiserror::Error;

use super::{FileError, WorkspaceError, read_bounded, read_import_file, write_atomic};
use crate::model::SerialNumber;
use crate::protocol::{ExportError, MAX_EXPORT_BYTES, SettingsExport};

/// The settings exports kept on the PC, one a controller: `<workspace>/<serial>/option.json` (manual 2.6.4, 2.6.5,
/// appendix B-1).
#[derive(Debug, Clone)]
pub struct SettingsFiles {
    root: PathBuf,
    /// Loaded instead of the controller's own.
    chosen: Option<PathBuf>,
}

/// Why a controller's export cannot be loaded.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SettingsFileError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is not a whole export.
    #[error(transparent)]
    Content(#[from] ExportError),
    /// The export has another name than the one expected (manual 2.6.5).
    #[error("{}", .0.display())]
    Renamed(PathBuf),
    /// There is no export of the controller.
    #[error("{}", .0.display())]
    Missing(PathBuf),
}

const FILE: &str = "option.json";

impl SettingsFiles {
    pub(super) fn new(root: PathBuf) -> Self {
        Self { root, chosen: None }
    }

    /// Loads this file instead, under any name. An export of another controller is still refused.
    pub fn of_file(self, file: PathBuf) -> Self {
        Self { chosen: Some(file), ..self }
    }

    /// Where the export of this controller is, whether it exists or not.
    pub fn path(&self, serial: &SerialNumber) -> PathBuf {
        self.root.join(serial.folder_name()).join(FILE)
    }

    /// The path for a person to read when it is not about one controller.
    pub fn any_path(&self) -> PathBuf {
        self.root.join("<serial>").join(FILE)
    }

    /// Replaces the controller's former export.
    pub fn save(&self, serial: &SerialNumber, export: &SettingsExport) -> Result<PathBuf, WorkspaceError> {
        let path = self.path(serial);
        write_atomic(&path, &export.to_json())?;
        Ok(path)
    }

    /// The controller's export and its file, whole, but of whom and whether it opens is still to be seen. An export
    /// under another name is not looked for, but said to be there (manual 2.6.5).
    pub fn load(&self, serial: &SerialNumber) -> Result<(SettingsExport, PathBuf), SettingsFileError> {
        if let Some(file) = &self.chosen {
            return Ok((SettingsExport::from_json(&read_import_file(file, MAX_EXPORT_BYTES)?)?, file.clone()));
        }
        let path = self.path(serial);
        match read(&path) {
            Ok(bytes) => Ok((SettingsExport::from_json(&bytes)?, path)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => match renamed(&path) {
                Some(found) => Err(SettingsFileError::Renamed(found)),
                None => Err(SettingsFileError::Missing(path)),
            },
            Err(source) => Err(FileError::Unreadable { path, source }.into()),
        }
    }
}

fn read(path: &Path) -> io::Result<Vec<u8>> {
    read_bounded(path, MAX_EXPORT_BYTES as u64)
}

/// A file beside `path` that is an export under another name.
fn renamed(path: &Path) -> Option<PathBuf> {
    let files = fs::read_dir(path.parent()?).ok()?.filter_map(Result::ok).map(|entry| entry.path());
    files
        .filter(|file| file.is_file())
        .take(MAX_LOOKED_AT)
        .find(|file| read(file).is_ok_and(|bytes| SettingsExport::from_json(&bytes).is_ok()))
}

const MAX_LOOKED_AT: usize = 100;
