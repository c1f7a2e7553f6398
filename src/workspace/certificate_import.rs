//! The files of a controller's folders that are imported (manual 2.7.1.4, 2.7.1.5).

use std::path::PathBuf;

use super::import_files::single;
use super::{CertificateFiles, FileError};
use crate::model::SerialNumber;

impl CertificateFiles {
    /// The only `.der` in `CASigned`.
    pub fn find_ca_signed(&self, serial: &SerialNumber) -> Result<PathBuf, FileError> {
        single(&self.ca_signed_folder(serial), "der")
    }

    /// The only `.pfx` in `UserSpecified`.
    pub fn find_user_pfx(&self, serial: &SerialNumber) -> Result<PathBuf, FileError> {
        single(&self.user_specified_folder(serial), "pfx")
    }

    /// The only `.der` and the only `.key` in `UserSpecified`.
    pub fn find_user_pair(&self, serial: &SerialNumber) -> Result<(PathBuf, PathBuf), FileError> {
        let folder = self.user_specified_folder(serial);
        Ok((single(&folder, "der")?, single(&folder, "key")?))
    }
}
