use keyring::{Entry as KeyringEntry, Error};
use secrecy::{ExposeSecret as _, SecretString};

use crate::pki::Fingerprint;

/// Why the keyring did not answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum KeyringError {
    /// The computer has no keyring.
    #[error("there is no keyring")]
    None,
    /// The keyring is locked, or cannot be reached.
    #[error("{0}")]
    Failed(#[source] Error),
}

/// The operating system's keyring. Calls may block for as long as the user is asked to unlock it.
pub trait Keyring: Send + Sync {
    /// `None`: the keyring works and has no password of this controller.
    fn get(&self, controller: Fingerprint) -> Result<Option<SecretString>, KeyringError>;
    /// Stores or replaces the password of a controller.
    fn set(&self, controller: Fingerprint, password: &SecretString) -> Result<(), KeyringError>;
    /// Deletes the password of a controller; nothing to do if there is none.
    fn forget(&self, controller: Fingerprint) -> Result<(), KeyringError>;
}

/// Credential Manager on Windows, Keychain on macOS, the Secret Service of the desktop elsewhere.
#[derive(Debug, Default, Clone, Copy)]
pub struct SystemKeyring;

impl SystemKeyring {
    const SERVICE: &str = "opcua-configurator";

    fn entry(controller: Fingerprint) -> Result<KeyringEntry, KeyringError> {
        KeyringEntry::new(Self::SERVICE, &controller.to_string()).map_err(KeyringError::Failed)
    }
}

impl Keyring for SystemKeyring {
    fn get(&self, controller: Fingerprint) -> Result<Option<SecretString>, KeyringError> {
        match Self::entry(controller)?.get_password() {
            Ok(password) => Ok(Some(SecretString::from(password))),
            Err(Error::NoEntry) => Ok(None),
            Err(error) => Err(KeyringError::Failed(error)),
        }
    }

    fn set(&self, controller: Fingerprint, password: &SecretString) -> Result<(), KeyringError> {
        Self::entry(controller)?.set_password(password.expose_secret()).map_err(KeyringError::Failed)
    }

    fn forget(&self, controller: Fingerprint) -> Result<(), KeyringError> {
        match Self::entry(controller)?.delete_credential() {
            Ok(()) | Err(Error::NoEntry) => Ok(()),
            Err(error) => Err(KeyringError::Failed(error)),
        }
    }
}

/// A PC without a keyring.
#[derive(Debug, Default, Clone, Copy)]
pub struct NoKeyring;

impl Keyring for NoKeyring {
    fn get(&self, _: Fingerprint) -> Result<Option<SecretString>, KeyringError> {
        Err(KeyringError::None)
    }

    fn set(&self, _: Fingerprint, _: &SecretString) -> Result<(), KeyringError> {
        Err(KeyringError::None)
    }

    fn forget(&self, _: Fingerprint) -> Result<(), KeyringError> {
        Err(KeyringError::None)
    }
}
