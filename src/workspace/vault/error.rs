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
    /// The workspace has no vault; holds where it would be.
    #[error("{} is not there", .0.display())]
    Missing(PathBuf),
    /// The workspace has a vault already; holds where.
    #[error("{} is there already", .0.display())]
    Exists(PathBuf),
    /// The file is not a vault, or was changed.
    #[error("{}: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The vault was written by a later version of this program.
    #[error("{}: version {version}; this program knows version {}", path.display(), VERSION)]
    Version {
        /// The file.
        path: PathBuf,
        /// The version of its format.
        version: u32,
    },
    /// The passphrase does not open the vault; holds its file.
    #[error("the passphrase does not open {}", .0.display())]
    WrongPassphrase(PathBuf),
    /// Another process has changed the passphrase since the vault was opened.
    #[error("the passphrase of {} was changed meanwhile", .0.display())]
    PassphraseChanged(PathBuf),
    /// The vault holds no further password.
    #[error("a vault holds at most {MAX_VAULT_PASSWORDS} passwords")]
    TooMany,
    /// The password is longer than a vault holds.
    #[error("a password in a vault has at most {MAX_VAULT_PASSWORD_BYTES} bytes")]
    PasswordTooLong,
    /// A new passphrase that is too short.
    #[error(transparent)]
    Passphrase(#[from] PassphraseError),
    /// A secret cannot be encrypted.
    #[error("{0}")]
    Seal(#[source] SealError),
    /// The file cannot be read or written.
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
}
