use std::collections::HashMap;

use parking_lot::Mutex;
use secrecy::{ExposeSecret as _, SecretString};

use crate::model::{ErrorCode, Problem};
use crate::pki::Fingerprint;

/// Where connection passwords are kept between jobs.
///
/// A password belongs to a controller's identity, not to its name or address: it is never offered to anybody else.
/// Calls may block (a keyring may ask the user to unlock it): not for the window's thread.
pub trait Passwords: Send + Sync {
    fn get(&self, controller: Fingerprint) -> Option<SecretString>;

    /// Remembers a password at least until the program ends. An error says that it will not outlive that.
    fn set(&self, controller: Fingerprint, password: SecretString) -> Result<(), Problem>;

    fn forget(&self, controller: Fingerprint);
}

/// The shortest passphrase that may protect a file of secrets, in characters.
pub const MIN_PASSPHRASE_CHARS: usize = 8;

/// Refuses a passphrase shorter than [`MIN_PASSPHRASE_CHARS`].
pub fn check_passphrase(passphrase: &SecretString) -> Result<(), Problem> {
    if passphrase.expose_secret().chars().count() < MIN_PASSPHRASE_CHARS {
        return Err(ErrorCode::BadPassphrase.into());
    }
    Ok(())
}

/// Refuses to protect a file by a connection password that is empty ([`ErrorCode::UnprotectedFile`]).
pub fn check_protects_files(connection_password: &SecretString) -> Result<(), Problem> {
    if connection_password.expose_secret().is_empty() {
        return Err(ErrorCode::UnprotectedFile.into());
    }
    Ok(())
}

/// For the time the program runs only.
#[derive(Default)]
pub struct MemoryPasswords(Mutex<HashMap<Fingerprint, SecretString>>);

impl std::fmt::Debug for MemoryPasswords {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("MemoryPasswords(…)")
    }
}

impl Passwords for MemoryPasswords {
    fn get(&self, controller: Fingerprint) -> Option<SecretString> {
        self.0.lock().get(&controller).cloned()
    }

    fn set(&self, controller: Fingerprint, password: SecretString) -> Result<(), Problem> {
        self.0.lock().insert(controller, password);
        Ok(())
    }

    fn forget(&self, controller: Fingerprint) {
        self.0.lock().remove(&controller);
    }
}

/// The operating system's keyring; memory where there is none.
#[derive(Debug, Default)]
pub struct KeyringPasswords {
    memory: MemoryPasswords,
}

impl KeyringPasswords {
    const SERVICE: &str = "opcua-configurator";

    fn entry(controller: Fingerprint) -> keyring::Result<keyring::Entry> {
        keyring::Entry::new(Self::SERVICE, &controller.to_string())
    }
}

impl Passwords for KeyringPasswords {
    fn get(&self, controller: Fingerprint) -> Option<SecretString> {
        if let Some(password) = self.memory.get(controller) {
            return Some(password);
        }
        match Self::entry(controller).and_then(|entry| entry.get_password()) {
            Ok(password) => {
                let password = SecretString::from(password);
                // Reading from memory cannot fail, and asking the keyring once per start is enough.
                self.memory.set(controller, password.clone()).ok()?;
                Some(password)
            }
            Err(error) => {
                tracing::debug!(%error, "no password in the keyring");
                None
            }
        }
    }

    fn set(&self, controller: Fingerprint, password: SecretString) -> Result<(), Problem> {
        let kept = Self::entry(controller).and_then(|entry| entry.set_password(password.expose_secret()));
        self.memory.set(controller, password)?;
        kept.map_err(|e| Problem::with_detail(ErrorCode::KeyringUnavailable, e))
    }

    fn forget(&self, controller: Fingerprint) {
        self.memory.forget(controller);
        if let Err(error) = Self::entry(controller).and_then(|entry| entry.delete_credential()) {
            tracing::debug!(%error, "no password to delete from the keyring");
        }
    }
}
