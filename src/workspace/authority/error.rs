use std::path::PathBuf;

use chrono::{DateTime, Utc};
use thiserror::Error;

use crate::model::{ErrorCode, Problem};
use crate::pki::PkiError;
use crate::workspace::WorkspaceError;

/// Why the small CA did not do what it was asked for. Holds no secret.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AuthorityError {
    #[error("{} does not exist", .0.display())]
    Missing(PathBuf),
    #[error("{} is there", .0.display())]
    Exists(PathBuf),
    #[error("{}: {reason}", path.display())]
    Damaged { path: PathBuf, reason: String },
    #[error("the passphrase does not open {}", .0.display())]
    Passphrase(PathBuf),
    #[error("a passphrase needs more characters")]
    ShortPassphrase,
    #[error("certificate {serial_number}, valid until {not_after}, is for the same key")]
    AlreadySigned { serial_number: String, not_after: DateTime<Utc> },
    #[error("\"{0}\"")]
    UnknownSerial(String),
    #[error("{serial_number} was revoked on {at}")]
    AlreadyRevoked { serial_number: String, at: DateTime<Utc> },
    #[error("the database has {0} certificates, which is the most it holds")]
    Full(usize),
    #[error("{}: {reason}", path.display())]
    BackupDamaged { path: PathBuf, reason: String },
    #[error("the passphrase does not open {}", .0.display())]
    BackupPassphrase(PathBuf),
    #[error("{}: {source}", path.display())]
    Unreadable { path: PathBuf, source: std::io::Error },
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
    #[error(transparent)]
    Pki(#[from] PkiError),
}

impl From<AuthorityError> for Problem {
    fn from(error: AuthorityError) -> Self {
        let code = match error {
            AuthorityError::Workspace(WorkspaceError::Busy(path)) => {
                return Self::with_detail(ErrorCode::AuthorityBusy, path.display());
            }
            AuthorityError::Workspace(error) => return error.into(),
            AuthorityError::Pki(error) => return error.into(),
            AuthorityError::Missing(_) => ErrorCode::NoAuthority,
            AuthorityError::Exists(_) => ErrorCode::AuthorityExists,
            AuthorityError::Damaged { .. } => ErrorCode::AuthorityDamaged,
            AuthorityError::Passphrase(_) => ErrorCode::AuthorityPassphrase,
            AuthorityError::ShortPassphrase => return ErrorCode::BadPassphrase.into(),
            AuthorityError::AlreadySigned { .. } => ErrorCode::AlreadySigned,
            AuthorityError::UnknownSerial(_) => ErrorCode::UnknownSerial,
            AuthorityError::AlreadyRevoked { .. } => ErrorCode::AlreadyRevoked,
            AuthorityError::Full(_) => ErrorCode::ListFull,
            AuthorityError::BackupDamaged { .. } => ErrorCode::BackupDamaged,
            AuthorityError::BackupPassphrase(_) => ErrorCode::BackupPassphrase,
            AuthorityError::Unreadable { .. } => ErrorCode::FileUnreadable,
        };
        Self::with_detail(code, error)
    }
}
