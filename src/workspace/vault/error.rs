use std::path::PathBuf;

use thiserror::Error;

use super::file::VERSION;
use super::limits::{MAX_VAULT_PASSWORD_BYTES, MAX_VAULT_PASSWORDS};
use crate::pki::SealError;
use crate::workspace::{PassphraseError, WorkspaceError};

/// Why a vault cannot be used. Nothing of what is in the file is lost with any of these.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum VaultError {
    #[error("{} is not there", .0.display())]
    Missing(PathBuf),
    #[error("{} is there already", .0.display())]
    Exists(PathBuf),
    #[error("{}: {reason}", path.display())]
    Damaged { path: PathBuf, reason: String },
    #[error("{}: version {version}; this program knows version {}", path.display(), VERSION)]
    Version { path: PathBuf, version: u32 },
    #[error("the passphrase does not open {}", .0.display())]
    WrongPassphrase(PathBuf),
    /// Another process has changed the passphrase since the vault was opened.
    #[error("the passphrase of {} was changed meanwhile", .0.display())]
    PassphraseChanged(PathBuf),
    #[error("a vault holds at most {MAX_VAULT_PASSWORDS} passwords")]
    TooMany,
    #[error("a password in a vault has at most {MAX_VAULT_PASSWORD_BYTES} bytes")]
    PasswordTooLong,
    /// A new passphrase that is too short.
    #[error(transparent)]
    Passphrase(#[from] PassphraseError),
    /// A secret cannot be encrypted.
    #[error("{0}")]
    Seal(#[source] SealError),
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
}
