use std::path::{Path, PathBuf};

use secrecy::{ExposeSecret as _, SecretString};

use super::{WorkspaceError, write_atomic, write_pair_atomic};
use crate::model::{ErrorCode, FileFormat, Problem, SerialNumber};
use crate::pki::{Certificate, Csr, PrivateKey, pkcs12_write, pkcs12_write_key};

/// The certificates kept on the PC, one folder a controller (manual appendix B-1).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CertificateFiles {
    root: PathBuf,
}

/// What was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SavedCertificate {
    pub certificate: PathBuf,
    pub key: Option<PathBuf>,
}

/// What was written of a signing request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SavedCsr {
    pub csr: PathBuf,
    pub key: Option<PathBuf>,
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
        self.root.join(serial.as_str()).join("Cert").join(kind)
    }

    /// Finds out whether a backup could be written, before anything is changed in the controller.
    pub fn check_writable(&self, serial: &SerialNumber) -> Result<(), WorkspaceError> {
        probe(&self.self_signed_folder(serial))
    }

    /// The same for [`CertificateFiles::save_csr`].
    pub fn check_csr_writable(&self, serial: &SerialNumber, with_key: bool) -> Result<(), WorkspaceError> {
        probe(&self.csr_folder(serial))?;
        if with_key { probe(&self.ca_signed_folder(serial)) } else { Ok(()) }
    }

    /// Saves a signing request as `CSR/3_csr.der` or `.pem`; one in the other format is of an older key, and removed.
    ///
    /// With a key, `CASigned/3_key.pfx` is its backup, protected as that of a self-signed certificate.
    pub fn save_csr(
        &self,
        serial: &SerialNumber,
        csr: &Csr,
        format: FileFormat,
        key: Option<(&PrivateKey, &SecretString)>,
    ) -> Result<SavedCsr, Problem> {
        let key_file = match key {
            None => None,
            Some((key, password)) => {
                let pfx = pkcs12_write_key(serial.as_str(), key, password.expose_secret())
                    .map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?;
                let path = self.ca_signed_folder(serial).join("3_key.pfx");
                write_atomic(&path, &pfx)?;
                Some(path)
            }
        };
        let path = |format: FileFormat| self.csr_folder(serial).join(format!("3_csr.{}", format.extension()));
        match format {
            FileFormat::Der => write_atomic(&path(format), csr.der())?,
            FileFormat::Pem => write_atomic(&path(format), csr.to_pem().as_bytes())?,
        }
        for other in FileFormat::ALL.into_iter().filter(|other| *other != format) {
            let stale = path(other);
            match std::fs::remove_file(&stale) {
                Err(e) if e.kind() != std::io::ErrorKind::NotFound => {
                    return Err(WorkspaceError::writing(&stale, e).into());
                }
                _ => {}
            }
        }
        Ok(SavedCsr { csr: path(format), key: key_file })
    }

    /// Writes the self-signed certificate of a controller to `SelfSigned/1_cert.der` or `.pem` (manual 2.7.1.3).
    pub fn export_self_signed(
        &self,
        serial: &SerialNumber,
        certificate: &Certificate,
        format: FileFormat,
    ) -> Result<PathBuf, Problem> {
        let path = self.self_signed_folder(serial).join(format!("1_cert.{}", format.extension()));
        match format {
            FileFormat::Der => write_atomic(&path, certificate.der())?,
            FileFormat::Pem => write_atomic(&path, certificate.to_pem().as_bytes())?,
        }
        Ok(path)
    }

    /// Backup of a self-signed certificate: `1_cert.der`, and `1_key.pfx` where the key exists on the PC.
    ///
    /// The key file is protected by the controller's connection password, as the engineer has no other at hand; with
    /// an empty one it is protected by its file mode alone.
    pub fn save_self_signed(
        &self,
        serial: &SerialNumber,
        certificate: &Certificate,
        key: Option<(&PrivateKey, &SecretString)>,
    ) -> Result<SavedCertificate, Problem> {
        let folder = self.self_signed_folder(serial);
        let path = folder.join("1_cert.der");
        let key_file = match key {
            None => {
                write_atomic(&path, certificate.der())?;
                None
            }
            Some((key, password)) => {
                let pfx = pkcs12_write(serial.as_str(), key, &[certificate], password.expose_secret())
                    .map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?;
                let key_path = folder.join("1_key.pfx");
                // The certificate is in the key file as well.
                write_pair_atomic((&key_path, &pfx), (&path, certificate.der()))?;
                Some(key_path)
            }
        };
        Ok(SavedCertificate { certificate: path, key: key_file })
    }
}

/// Writes into a folder and cleans up after itself.
fn probe(folder: &Path) -> Result<(), WorkspaceError> {
    let probe = folder.join(".probe");
    write_atomic(&probe, b"")?;
    std::fs::remove_file(&probe).map_err(|e| WorkspaceError::writing(&probe, e))
}
