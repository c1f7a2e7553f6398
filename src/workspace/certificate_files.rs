use std::path::PathBuf;

use secrecy::{ExposeSecret as _, SecretString};

use super::{WorkspaceError, write_atomic};
use crate::model::{ErrorCode, Problem, SerialNumber};
use crate::pki::{Certificate, PrivateKey, pkcs12_write};

/// The certificates kept on the PC, one folder a controller (manual appendix B-1).
#[derive(Debug, Clone)]
pub struct CertificateFiles {
    root: PathBuf,
}

/// What was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SavedCertificate {
    pub certificate: PathBuf,
    pub key: Option<PathBuf>,
}

impl CertificateFiles {
    pub(super) fn new(root: PathBuf) -> Self {
        Self { root }
    }

    /// `<workspace>/<serial>/Cert/SelfSigned`.
    pub fn self_signed_folder(&self, serial: &SerialNumber) -> PathBuf {
        self.root.join(serial.as_str()).join("Cert").join("SelfSigned")
    }

    /// Finds out whether a backup could be written, before anything is changed in the controller.
    pub fn check_writable(&self, serial: &SerialNumber) -> Result<(), WorkspaceError> {
        let probe = self.self_signed_folder(serial).join(".probe");
        write_atomic(&probe, b"")?;
        std::fs::remove_file(&probe).map_err(|e| WorkspaceError::writing(&probe, e))
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
        let key_file = match key {
            None => None,
            Some((key, password)) => {
                let pfx = pkcs12_write(serial.as_str(), key, &[certificate], password.expose_secret())
                    .map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?;
                let path = folder.join("1_key.pfx");
                write_atomic(&path, &pfx)?;
                Some(path)
            }
        };
        let path = folder.join("1_cert.der");
        write_atomic(&path, certificate.der())?;
        Ok(SavedCertificate { certificate: path, key: key_file })
    }
}
