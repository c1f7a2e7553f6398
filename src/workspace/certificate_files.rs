use std::fs::File;
use std::path::{Path, PathBuf};

use secrecy::{ExposeSecret as _, SecretString};
use thiserror::Error;

use super::atomic::open_lock_file;
use super::file_sets::replace_set;
use super::import_files::certificate_files_in;
use super::{PassphraseError, WorkspaceError, check_protects_files, read_import_file, write_atomic};
use crate::model::{FileFormat, SerialNumber};
use crate::pki::{
    Certificate, Csr, MAX_CERTIFICATE_FILE_BYTES, MAX_PKCS12_BYTES, PkiError, PrivateKey, pkcs12_read_key,
    pkcs12_write, pkcs12_write_key, read_bundle,
};
use crate::platform::replace;

/// The certificates kept on the PC, one folder a controller (manual appendix B-1).
///
/// A new certificate or request never stands beside a key that is not its own: what was there before and does not belong
/// to it is moved, together, into a folder named after its date (`SelfSigned/20261127_174509`). Nothing is overwritten.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CertificateFiles {
    root: PathBuf,
}

/// What was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SavedCertificate {
    /// The certificate.
    pub certificate: PathBuf,
    /// Its private key, where a backup of it was kept.
    pub key: Option<PathBuf>,
    /// Where the files of the former certificate are now.
    pub moved_aside: Vec<PathBuf>,
}

/// One file that was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SavedFile {
    /// The file that was written.
    pub file: PathBuf,
    /// Where the files of the former certificate are now.
    pub moved_aside: Vec<PathBuf>,
}

/// What was written of a signing request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SavedCsr {
    /// The signing request.
    pub csr: PathBuf,
    /// Its private key, where a backup of it was kept.
    pub key: Option<PathBuf>,
    /// Where the files of the former request are now: the request, its key, and what a CA issued for it.
    pub moved_aside: Vec<PathBuf>,
}

/// Why certificates and keys are not saved on the PC.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SaveError {
    /// The files cannot be written.
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
    /// The connection password protects no key file.
    #[error(transparent)]
    Passphrase(#[from] PassphraseError),
    /// The key file could not be made.
    #[error(transparent)]
    Encoding(#[from] PkiError),
}

impl CertificateFiles {
    pub(super) fn new(root: PathBuf) -> Self {
        Self { root }
    }

    /// `<workspace>/<serial>/Cert/SelfSigned`.
    pub fn self_signed_folder(&self, serial: &SerialNumber) -> PathBuf {
        self.folder(serial, "SelfSigned")
    }

    /// `<workspace>/<serial>/Cert/CSR`.
    pub fn csr_folder(&self, serial: &SerialNumber) -> PathBuf {
        self.folder(serial, "CSR")
    }

    /// `<workspace>/<serial>/Cert/CASigned`, where the CA's certificate is put.
    pub fn ca_signed_folder(&self, serial: &SerialNumber) -> PathBuf {
        self.folder(serial, "CASigned")
    }

    /// `<workspace>/<serial>/Cert/UserSpecified`, where certificates of other tools are put.
    pub fn user_specified_folder(&self, serial: &SerialNumber) -> PathBuf {
        self.folder(serial, "UserSpecified")
    }

    fn folder(&self, serial: &SerialNumber, kind: &str) -> PathBuf {
        self.root.join(serial.folder_name()).join("Cert").join(kind)
    }

    /// Finds out whether a backup could be written, before anything is changed in the controller. `key_password`: the
    /// connection password, if it is to protect a key.
    pub fn check_writable(&self, serial: &SerialNumber, key_password: Option<&SecretString>) -> Result<(), SaveError> {
        key_password.map_or(Ok(()), check_protects_files)?;
        Ok(probe(&self.self_signed_folder(serial))?)
    }

    /// The same for [`CertificateFiles::save_csr`].
    pub fn check_csr_writable(
        &self,
        serial: &SerialNumber,
        key_password: Option<&SecretString>,
    ) -> Result<(), SaveError> {
        key_password.map_or(Ok(()), check_protects_files)?;
        probe(&self.csr_folder(serial))?;
        // Also where there is no key to keep: it is the folder that the CA's answer has to be put into.
        Ok(probe(&self.ca_signed_folder(serial))?)
    }

    /// Saves a signing request as `CSR/3_csr.der` or `.pem`, and with a key `CASigned/3_key.pfx` as its backup,
    /// protected by the connection password.
    ///
    /// What belongs to the former request (its files, its key, what a CA issued for it) is moved aside as one set.
    pub fn save_csr(
        &self,
        serial: &SerialNumber,
        csr: &Csr,
        format: FileFormat,
        key: Option<&PrivateKey>,
        password: &SecretString,
    ) -> Result<SavedCsr, SaveError> {
        let _lock = self.lock(serial)?;
        let (requests, issued) = (self.csr_folder(serial), self.ca_signed_folder(serial));
        let key_path = issued.join(CSR_KEY);
        let files: Vec<PathBuf> = FileFormat::ALL.map(|format| requests.join(csr_name(format))).into();
        let (own, mut former): (Vec<_>, Vec<_>) =
            files.into_iter().filter(|file| file.exists()).partition(|file| read_csr(file).as_ref() == Some(csr));
        let former_csrs: Vec<Csr> = former.iter().filter_map(|file| read_csr(file)).collect();
        former.extend(issued_for(&former_csrs, &issued));
        let is_of_this = || match opened(&key_path, password) {
            Some(key) => csr.is_of(&key),
            None => former.is_empty() && !own.is_empty(),
        };
        if key_path.exists() && (key.is_some() || !is_of_this()) {
            former.insert(0, key_path.clone());
        }
        let pfx = key.map(|key| protected(password, |p| pkcs12_write_key(serial.as_str(), key, p))).transpose()?;
        let encoded = match format {
            FileFormat::Der => csr.der().to_vec(),
            FileFormat::Pem => csr.to_pem().into_bytes(),
        };
        let path = requests.join(csr_name(format));
        let mut new: Vec<(PathBuf, &[u8])> = Vec::new();
        new.extend(pfx.as_deref().map(|pfx| (key_path.clone(), pfx)));
        new.push((path.clone(), &encoded));
        let moved_aside = replace_set(&former, &new)?;
        Ok(SavedCsr { csr: path, key: pfx.is_some().then_some(key_path), moved_aside })
    }

    /// Writes the self-signed certificate of a controller to `SelfSigned/1_cert.der` or `.pem` (manual 2.7.1.3).
    ///
    /// The files of another certificate are moved aside, and so is a key that is not this certificate's, as far as the
    /// connection password opens it.
    pub fn export_self_signed(
        &self,
        serial: &SerialNumber,
        certificate: &Certificate,
        format: FileFormat,
        password: &SecretString,
    ) -> Result<SavedFile, SaveError> {
        let SavedCertificate { certificate: file, moved_aside, .. } =
            self.save(serial, certificate, format, None, password)?;
        Ok(SavedFile { file, moved_aside })
    }

    /// Backup of a self-signed certificate: `1_cert.der`, and `1_key.pfx` where the key exists on the PC. The files of
    /// another certificate are moved aside.
    ///
    /// The key file is protected by the controller's connection password, as the engineer has no other at hand.
    pub fn save_self_signed(
        &self,
        serial: &SerialNumber,
        certificate: &Certificate,
        key: Option<&PrivateKey>,
        password: &SecretString,
    ) -> Result<SavedCertificate, SaveError> {
        self.save(serial, certificate, FileFormat::Der, key, password)
    }

    fn save(
        &self,
        serial: &SerialNumber,
        certificate: &Certificate,
        format: FileFormat,
        key: Option<&PrivateKey>,
        password: &SecretString,
    ) -> Result<SavedCertificate, SaveError> {
        let _lock = self.lock(serial)?;
        let folder = self.self_signed_folder(serial);
        let key_path = folder.join(SELF_SIGNED_KEY);
        let files: Vec<PathBuf> = FileFormat::ALL.map(|format| folder.join(certificate_name(format))).into();
        let (own, mut former): (Vec<_>, Vec<_>) = files
            .into_iter()
            .filter(|file| file.exists())
            .partition(|file| read_certificate(file).as_ref() == Some(certificate));
        let is_of_this = || match opened(&key_path, password) {
            Some(key) => key.matches(certificate),
            None => former.is_empty() && !own.is_empty(),
        };
        if key_path.exists() && (key.is_some() || !is_of_this()) {
            former.insert(0, key_path.clone());
        }
        let write = |key| protected(password, |p| pkcs12_write(serial.as_str(), key, &[certificate], p));
        let pfx = key.map(write).transpose()?;
        let encoded = match format {
            FileFormat::Der => certificate.der().to_vec(),
            FileFormat::Pem => certificate.to_pem().into_bytes(),
        };
        let path = folder.join(certificate_name(format));
        let mut new: Vec<(PathBuf, &[u8])> = Vec::new();
        // The certificate is in the key file as well.
        new.extend(pfx.as_deref().map(|pfx| (key_path.clone(), pfx)));
        new.push((path.clone(), &encoded));
        let moved_aside = replace_set(&former, &new)?;
        Ok(SavedCertificate { certificate: path, key: pfx.is_some().then_some(key_path), moved_aside })
    }

    /// One process at a time replaces the files of a controller. Blocks while another one does.
    fn lock(&self, serial: &SerialNumber) -> Result<File, WorkspaceError> {
        let path = self.root.join(serial.as_str()).join("Cert").join(".lock");
        let file = open_lock_file(&path)?;
        file.lock().map_err(|e| WorkspaceError::writing(&path, e))?;
        Ok(file)
    }
}

/// The key of a self-signed certificate, with that certificate.
pub(super) const SELF_SIGNED_KEY: &str = "1_key.pfx";
/// The key of a signing request.
pub(super) const CSR_KEY: &str = "3_key.pfx";

fn certificate_name(format: FileFormat) -> String {
    format!("1_cert.{}", format.extension())
}

pub(super) fn csr_name(format: FileFormat) -> String {
    format!("3_csr.{}", format.extension())
}

pub(super) fn read_csr(file: &Path) -> Option<Csr> {
    Csr::from_any(&read_import_file(file, MAX_CERTIFICATE_FILE_BYTES).ok()?).ok()
}

fn read_certificate(file: &Path) -> Option<Certificate> {
    Certificate::from_any(&read_import_file(file, MAX_CERTIFICATE_FILE_BYTES).ok()?).ok()
}

/// The key in a PKCS#12, if the password opens it.
fn opened(file: &Path, password: &SecretString) -> Option<PrivateKey> {
    pkcs12_read_key(&read_import_file(file, MAX_PKCS12_BYTES).ok()?, password.expose_secret()).ok()
}

/// The files of a folder with a certificate that was issued for one of these requests.
fn issued_for(requests: &[Csr], folder: &Path) -> Vec<PathBuf> {
    let is_issued = |file: &PathBuf| {
        let bytes = read_import_file(file, MAX_CERTIFICATE_FILE_BYTES).ok();
        let bundle = bytes.and_then(|bytes| read_bundle(&bytes).ok());
        bundle.is_some_and(|b| b.certificates.iter().any(|c| requests.iter().any(|csr| csr.matches(c))))
    };
    if requests.is_empty() { Vec::new() } else { certificate_files_in(folder).into_iter().filter(is_issued).collect() }
}

/// A PKCS#12 that is protected by the connection password, which must not be empty.
fn protected(
    password: &SecretString,
    write: impl FnOnce(&str) -> Result<Vec<u8>, PkiError>,
) -> Result<Vec<u8>, SaveError> {
    check_protects_files(password)?;
    Ok(write(password.expose_secret())?)
}

/// Writes into a folder and cleans up after itself.
fn probe(folder: &Path) -> Result<(), WorkspaceError> {
    let probe = folder.join(".probe");
    write_atomic(&probe, b"")?;
    replace::remove(&probe).map_err(|e| WorkspaceError::writing(&probe, e))
}
