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
    #[error("{} does not exist", .0.display())]
    Missing(PathBuf),
    #[error("{} is there", .0.display())]
    Exists(PathBuf),
    /// A file of the CA cannot be read, or does not hold what it should.
    #[error("{}: {source}", path.display())]
    Damaged { path: PathBuf, source: ErrorSource },
    #[error("the passphrase does not open {}", .0.display())]
    Passphrase(PathBuf),
    #[error(transparent)]
    ShortPassphrase(#[from] PassphraseError),
    #[error("certificate {serial_number}, valid until {not_after}, is for the same key")]
    AlreadySigned { serial_number: String, not_after: DateTime<Utc> },
    #[error("\"{0}\"")]
    UnknownSerial(String),
    #[error("{serial_number} was revoked on {at}")]
    AlreadyRevoked { serial_number: String, at: DateTime<Utc> },
    #[error("the database has {0} certificates, which is the most it holds")]
    Full(usize),
    #[error("{}: {source}", path.display())]
    BackupDamaged { path: PathBuf, source: ErrorSource },
    #[error("the passphrase does not open {}", .0.display())]
    BackupPassphrase(PathBuf),
    #[error("{}: {source}", path.display())]
    Unreadable { path: PathBuf, source: std::io::Error },
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
    #[error(transparent)]
    Pki(#[from] PkiError),
}
