use std::collections::HashMap;

use parking_lot::Mutex;
use secrecy::SecretString;
use thiserror::Error;

use super::{KeyringError, PasswordStore, VaultError};
use crate::model::Credentials;
use crate::pki::Fingerprint;

/// Why a connection password cannot be looked up or kept.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PasswordError {
    /// The keyring failed.
    #[error(transparent)]
    Keyring(#[from] KeyringError),
    /// The vault failed.
    #[error(transparent)]
    Vault(#[from] VaultError),
    /// The vault that may hold the password is not open.
    #[error("the vault is closed")]
    VaultClosed,
    /// The vault was chosen, and the workspace has none.
    #[error("there is no vault")]
    NoVault,
}

/// Keeps the credentials of controllers between jobs.
///
/// Credentials belong to a controller's identity, not to its name or address: they are never offered to another one. An
/// empty password is a password: that of a controller that has none. Calls may block (a keyring may ask the user to
/// unlock it): not for the window's thread.
pub trait Passwords: Send + Sync {
    /// `None`: not known. An error says why it cannot be found out, as [`PasswordError::VaultClosed`] does.
    fn get(&self, controller: Fingerprint) -> Result<Option<Credentials>, PasswordError>;

    /// Remembers credentials at least until the program ends. An error says that they are not kept longer.
    fn set(&self, controller: Fingerprint, credentials: Credentials) -> Result<(), PasswordError>;

    /// Remembers the same credentials for several controllers; of several errors, the last.
    fn set_for(&self, controllers: &[Fingerprint], credentials: &Credentials) -> Result<(), PasswordError> {
        let mut result = Ok(());
        for controller in controllers {
            // One that cannot be kept must not keep the others out.
            result = self.set(*controller, credentials.clone()).and(result);
        }
        result
    }

    /// Drops the password of a controller everywhere.
    fn forget(&self, controller: Fingerprint);

    /// The store with the vault, where this is one.
    fn store(&self) -> Option<&PasswordStore> {
        None
    }
}

/// For the time the program runs only.
#[derive(Default)]
pub struct MemoryPasswords(Mutex<HashMap<Fingerprint, SecretString>>);

impl std::fmt::Debug for MemoryPasswords {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("MemoryPasswords(…)")
    }
}

impl MemoryPasswords {
    pub(super) fn known(&self, controller: Fingerprint) -> Option<SecretString> {
        self.0.lock().get(&controller).cloned()
    }

    pub(super) fn put(&self, controller: Fingerprint, password: SecretString) {
        self.0.lock().insert(controller, password);
    }
}

impl Passwords for MemoryPasswords {
    fn get(&self, controller: Fingerprint) -> Result<Option<Credentials>, PasswordError> {
        Ok(self.known(controller).map(Credentials::ConnectionPassword))
    }

    fn set(&self, controller: Fingerprint, credentials: Credentials) -> Result<(), PasswordError> {
        self.put(controller, credentials.password().clone());
        Ok(())
    }

    fn forget(&self, controller: Fingerprint) {
        self.0.lock().remove(&controller);
    }
}
