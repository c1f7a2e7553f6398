use std::path::PathBuf;

use chrono::{DateTime, Utc};
use thiserror::Error;

use crate::pki::PkiError;
use crate::workspace::{PassphraseError, WorkspaceError};

/// The error of a reader, or a sentence in English.
type ErrorSource = Box<dyn std::error::Error + Send + Sync>;

/// Why the small CA did not do what it was asked for. Holds no secret.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AuthorityError {
    /// The workspace has no CA; holds where it would be.
    #[error("{} does not exist", .0.display())]
    Missing(PathBuf),
    /// The workspace has a CA already; holds where.
    #[error("{} is there", .0.display())]
    Exists(PathBuf),
    /// A file of the CA cannot be read, or does not hold what it should.
    #[error("{}: {source}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: ErrorSource,
    },
    /// The passphrase does not open the key; holds its file.
    #[error("the passphrase does not open {}", .0.display())]
    Passphrase(PathBuf),
    /// A new passphrase is too short.
    #[error(transparent)]
    ShortPassphrase(#[from] PassphraseError),
    /// A certificate for the same key is valid and not revoked.
    #[error("certificate {serial_number}, valid until {not_after}, is for the same key")]
    AlreadySigned {
        /// Its serial number, upper-case hexadecimal.
        serial_number: String,
        /// Last moment of its validity.
        not_after: DateTime<Utc>,
    },
    /// The CA issued no certificate with this serial number; holds the text.
    #[error("\"{0}\"")]
    UnknownSerial(String),
    /// The certificate is revoked already.
    #[error("{serial_number} was revoked on {at}")]
    AlreadyRevoked {
        /// Its serial number, upper-case hexadecimal.
        serial_number: String,
        /// When it was revoked.
        at: DateTime<Utc>,
    },
    /// The database holds no further certificate; holds its limit.
    #[error("the database has {0} certificates, which is the most it holds")]
    Full(usize),
    /// The file is no backup of a CA, or was changed.
    #[error("{}: {source}", path.display())]
    BackupDamaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: ErrorSource,
    },
    /// The passphrase does not open the backup; holds its file.
    #[error("the passphrase does not open {}", .0.display())]
    BackupPassphrase(PathBuf),
    /// A file cannot be read.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// The files cannot be written.
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
    /// A key, certificate or CRL could not be made.
    #[error(transparent)]
    Pki(#[from] PkiError),
}
