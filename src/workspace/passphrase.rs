//! What a passphrase must be to protect a file.

use secrecy::{ExposeSecret as _, SecretString};
use thiserror::Error;

/// Why a passphrase or password does not protect a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PassphraseError {
    /// A new passphrase has fewer than the required characters.
    #[error("a passphrase has at least {MIN_PASSPHRASE_CHARS} characters")]
    TooShort,
    /// A connection password may be empty, but then it protects nothing.
    #[error("an empty password protects no file")]
    Empty,
}

/// Refuses a passphrase shorter than [`MIN_PASSPHRASE_CHARS`].
///
/// # Errors
/// [`PassphraseError::TooShort`].
pub fn check_passphrase(passphrase: &SecretString) -> Result<(), PassphraseError> {
    if passphrase.expose_secret().chars().count() < MIN_PASSPHRASE_CHARS {
        return Err(PassphraseError::TooShort);
    }
    Ok(())
}

/// Refuses to protect a file by a connection password that is empty.
///
/// # Errors
/// [`PassphraseError::Empty`].
pub fn check_protects_files(connection_password: &SecretString) -> Result<(), PassphraseError> {
    if connection_password.expose_secret().is_empty() {
        return Err(PassphraseError::Empty);
    }
    Ok(())
}

/// The shortest passphrase that may protect a file of secrets, in characters.
pub const MIN_PASSPHRASE_CHARS: usize = 8;
