use std::fmt;

use secrecy::SecretString;

use crate::model::{Changed, DisconnectedClient, ServerSettings};

/// New basic settings (manual 2.6.1).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SettingsUpdate {
    /// The settings as a whole: what is not to be changed has the value that was read.
    pub settings: ServerSettings,
    /// Deletes the server log as well.
    pub delete_log: bool,
    /// Needed when the server log goes from off to on ([`ServerSettings::LOG_PASSWORD`]).
    pub log_password: Option<String>,
}

/// A private key, with or without its certificate, as PKCS#12 for one transfer.
pub struct SealedKey {
    /// PKCS#12, encrypted with a password of its own.
    pub pkcs12: Vec<u8>,
    /// The password of `pkcs12`, made for this transfer only.
    pub password: SecretString,
}

impl fmt::Debug for SealedKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "SealedKey({} bytes)", self.pkcs12.len())
    }
}

/// A signing request and its key, made on the PC now or earlier (a backup).
///
/// The controller has room for one such key: its CA-signed certificate is removed unless it is for the same key, and a server
/// that used it stops.
#[derive(Debug)]
pub struct CsrImport {
    /// DER.
    pub csr: Vec<u8>,
    /// The key of `csr`, without a certificate.
    pub key: SealedKey,
    /// The certificate that a CA issued for `csr`, in DER: installed and selected in the same change.
    pub certificate: Option<Vec<u8>>,
}

/// A server certificate was installed and selected.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InstalledCertificate {
    /// The server's state and the new revision.
    pub changed: Changed,
    /// DER.
    pub certificate: Vec<u8>,
}

/// The controller has a new signing request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoredCsr {
    /// The server's state and the new revision.
    pub changed: Changed,
    /// DER.
    pub csr: Vec<u8>,
}

/// Client lists and CRLs were changed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TrustEdited {
    /// The server's state and the new revision.
    pub changed: Changed,
    /// The clients whose open connections the controller ended because of the change.
    pub cut: Vec<DisconnectedClient>,
}
