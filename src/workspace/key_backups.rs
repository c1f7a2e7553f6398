//! The backups of keys in a workspace, and what is in them.

use std::fs;
use std::path::{Path, PathBuf};

use secrecy::{ExposeSecret as _, SecretString};
use thiserror::Error;

use super::certificate_files::{CSR_KEY, SELF_SIGNED_KEY, csr_name, read_csr};
use super::{CertificateFiles, FileError, certificate_files_beside, read_import_file};
use crate::model::{FileFormat, SerialNumber};
use crate::pki::{Certificate, Csr, MAX_PKCS12_BYTES, PkiError, PrivateKey, pkcs12_read, pkcs12_read_key, read_bundle};

/// What a backup is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BackupKind {
    /// `SelfSigned/1_key.pfx`: a self-signed certificate and its key.
    SelfSigned,
    /// `CASigned/3_key.pfx`: the key of a signing request. The request is `CSR/3_csr`, and what a CA issued for it is
    /// beside the key.
    CaSigned,
}

/// Which backup.
#[derive(Debug, Clone)]
pub struct KeyBackupSource {
    /// The folders with the backups.
    pub files: CertificateFiles,
    /// What the backup is of.
    pub kind: BackupKind,
    /// This key file, for one controller; `None`: the one in each controller's folder that is not moved aside.
    pub chosen: Option<PathBuf>,
}

/// What was in a backup. The key belongs to what is beside it here.
#[derive(Debug)]
pub enum KeyBackup {
    /// A self-signed certificate with its key.
    SelfSigned {
        /// The private key.
        key: PrivateKey,
        /// Its certificate.
        certificate: Certificate,
    },
    /// A signing request with its key.
    CaSigned {
        /// The private key.
        key: PrivateKey,
        /// The signing request.
        csr: Csr,
        /// What a CA issued for the request, if it is on the PC.
        certificate: Option<Certificate>,
    },
}

impl KeyBackup {
    /// `None`: a request, and no CA has issued anything for it, or that was not saved.
    pub const fn certificate(&self) -> Option<&Certificate> {
        match self {
            Self::SelfSigned { certificate, .. } => Some(certificate),
            Self::CaSigned { certificate, .. } => certificate.as_ref(),
        }
    }
}

/// Why a key cannot be put back.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum KeyBackupError {
    /// The chosen file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The controller has no key file on the PC. `moved_aside`: the newest of those that a later one replaced.
    #[error("{}{}", path.display(), moved(moved_aside.as_ref()))]
    NoKey {
        /// The file that is missing.
        path: PathBuf,
        /// The newest key file that a later one replaced.
        moved_aside: Option<PathBuf>,
    },
    /// No signing request of the key is in this folder or beside the key.
    #[error("{}: no 3_csr.der or 3_csr.pem of this key", .0.display())]
    NoRequest(PathBuf),
    /// The file is damaged, of another kind, or the password does not open it.
    #[error("{}: {source}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: PkiError,
    },
}

fn moved(aside: Option<&PathBuf>) -> String {
    aside.map_or_else(String::new, |path| format!("; one that was moved aside: {}", path.display()))
}

impl KeyBackupSource {
    /// Finds and reads the backup for a controller. Blocks while the password is hashed.
    ///
    /// # Errors
    /// [`KeyBackupError::NoKey`] and [`KeyBackupError::NoRequest`] for what is missing, [`KeyBackupError::Content`] with a
    /// wrong password and for files that are damaged or of another kind.
    pub fn read(&self, serial: &SerialNumber, password: &SecretString) -> Result<KeyBackup, KeyBackupError> {
        let path = self.path(serial)?;
        let bytes = read_import_file(&path, MAX_PKCS12_BYTES)?;
        let password = password.expose_secret();
        match self.kind {
            BackupKind::SelfSigned => {
                let (key, certificate) = match pkcs12_read(&bytes, password) {
                    Ok((key, chain)) => (key, chain.into_iter().next()),
                    // Other tools leave it out.
                    Err(PkiError::NoCertificate) => {
                        let key = pkcs12_read_key(&bytes, password).map_err(|e| at(&path, e))?;
                        let beside = newest(certificates_beside(&path).into_iter().filter(|c| key.matches(c)));
                        (key, beside)
                    }
                    Err(error) => return Err(at(&path, error)),
                };
                let certificate = certificate.ok_or_else(|| at(&path, PkiError::NoCertificate))?;
                Ok(KeyBackup::SelfSigned { key, certificate })
            }
            BackupKind::CaSigned => {
                let key = pkcs12_read_key(&bytes, password).map_err(|e| at(&path, e))?;
                let csr = request_of(&key, &path)?;
                let certificate = newest(certificates_beside(&path).into_iter().filter(|c| csr.matches(c)));
                Ok(KeyBackup::CaSigned { key, csr, certificate })
            }
        }
    }

    /// The key file of a controller.
    fn path(&self, serial: &SerialNumber) -> Result<PathBuf, KeyBackupError> {
        if let Some(chosen) = &self.chosen {
            return Ok(chosen.clone());
        }
        let (folder, name) = self.folder_and_name(serial);
        let path = folder.join(name);
        if path.is_file() {
            return Ok(path);
        }
        let moved_aside = moved_aside(&folder, name).pop();
        Err(KeyBackupError::NoKey { path, moved_aside })
    }

    fn folder_and_name(&self, serial: &SerialNumber) -> (PathBuf, &'static str) {
        match self.kind {
            BackupKind::SelfSigned => (self.files.self_signed_folder(serial), SELF_SIGNED_KEY),
            BackupKind::CaSigned => (self.files.ca_signed_folder(serial), CSR_KEY),
        }
    }
}

/// The key files of former sets, the newest last.
fn moved_aside(folder: &Path, name: &str) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut found: Vec<PathBuf> =
        entries.flatten().map(|entry| entry.path().join(name)).filter(|path| path.is_file()).collect();
    found.sort();
    found
}

/// The request of a key: in the folder of requests that goes with the key's, or beside the key.
fn request_of(key: &PrivateKey, path: &Path) -> Result<Csr, KeyBackupError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let requests = folder.with_file_name("CSR");
    // A key that was moved aside is one folder further down, and its request in a folder of the same name.
    let above = folder.parent().map(|issued| issued.with_file_name("CSR"));
    let former = above.as_ref().and_then(|requests| Some(requests.join(folder.file_name()?)));
    let folders = [Some(requests.clone()), former, above, Some(folder.to_owned())].into_iter().flatten();
    let mut files = folders.flat_map(|f| FileFormat::ALL.map(|format| f.join(csr_name(format))));
    let found = files.find_map(|file| read_csr(&file).filter(|csr| csr.is_of(key)));
    found.ok_or(KeyBackupError::NoRequest(requests))
}

fn certificates_beside(path: &Path) -> Vec<Certificate> {
    let bundles = certificate_files_beside(path);
    bundles.iter().filter_map(|bytes| read_bundle(bytes).ok()).flat_map(|bundle| bundle.certificates).collect()
}

fn newest(certificates: impl Iterator<Item = Certificate>) -> Option<Certificate> {
    certificates.max_by_key(Certificate::not_after)
}

fn at(path: &Path, source: PkiError) -> KeyBackupError {
    KeyBackupError::Content { path: path.to_owned(), source }
}
