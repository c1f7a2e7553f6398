use keyring::{Entry, Error};
use secrecy::{ExposeSecret as _, SecretString};

use crate::model::{ErrorCode, Problem};
use crate::pki::Fingerprint;

/// The operating system's keyring. Calls may block for as long as the user is asked to unlock it.
///
/// Errors: [`ErrorCode::KeyringUnavailable`] where there is no keyring, or it is locked.
pub trait Keyring: Send + Sync {
    /// `None`: the keyring works and has no password of this controller.
    fn get(&self, controller: Fingerprint) -> Result<Option<SecretString>, Problem>;
    fn set(&self, controller: Fingerprint, password: &SecretString) -> Result<(), Problem>;
    fn forget(&self, controller: Fingerprint) -> Result<(), Problem>;
}

/// Credential Manager on Windows, Keychain on macOS, the Secret Service of the desktop elsewhere.
#[derive(Debug, Default, Clone, Copy)]
pub struct SystemKeyring;

impl SystemKeyring {
    const SERVICE: &str = "opcua-configurator";

    fn entry(controller: Fingerprint) -> Result<Entry, Problem> {
        Entry::new(Self::SERVICE, &controller.to_string()).map_err(unavailable)
    }
}

impl Keyring for SystemKeyring {
    fn get(&self, controller: Fingerprint) -> Result<Option<SecretString>, Problem> {
        match Self::entry(controller)?.get_password() {
            Ok(password) => Ok(Some(SecretString::from(password))),
            Err(Error::NoEntry) => Ok(None),
            Err(error) => Err(unavailable(error)),
        }
    }

    fn set(&self, controller: Fingerprint, password: &SecretString) -> Result<(), Problem> {
        Self::entry(controller)?.set_password(password.expose_secret()).map_err(unavailable)
    }

    fn forget(&self, controller: Fingerprint) -> Result<(), Problem> {
        match Self::entry(controller)?.delete_credential() {
            Ok(()) | Err(Error::NoEntry) => Ok(()),
            Err(error) => Err(unavailable(error)),
        }
    }
}

fn unavailable(error: Error) -> Problem {
    Problem::with_detail(ErrorCode::KeyringUnavailable, error)
}

/// A PC without a keyring.
#[derive(Debug, Default, Clone, Copy)]
pub struct NoKeyring;

impl Keyring for NoKeyring {
    fn get(&self, _: Fingerprint) -> Result<Option<SecretString>, Problem> {
        Err(ErrorCode::KeyringUnavailable.into())
    }

    fn set(&self, _: Fingerprint, _: &SecretString) -> Result<(), Problem> {
        Err(ErrorCode::KeyringUnavailable.into())
    }

    fn forget(&self, _: Fingerprint) -> Result<(), Problem> {
        Err(ErrorCode::KeyringUnavailable.into())
    }
}
