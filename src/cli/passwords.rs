use std::io::IsTerminal as _;
use std::path::Path;

use secrecy::{ExposeSecret as _, SecretString};

use super::secret_file::read_secret;
use crate::model::{ErrorCode, Problem};
use crate::pki::Fingerprint;
use crate::workspace::{KeyringPasswords, Passwords};

/// The passphrase of the small CA: from a file, or asked for on the terminal, twice where it is chosen.
pub fn ca_passphrase(file: Option<&Path>, chosen: bool) -> Result<SecretString, Problem> {
    if let Some(file) = file {
        return read_secret(file);
    }
    let terminal = console::Term::stderr();
    if !terminal.is_term() || !std::io::stdin().is_terminal() {
        return Err(ErrorCode::NoPassphrase.into());
    }
    let ask = |question: &str| {
        eprint!("{question}: ");
        terminal.read_secure_line().map(SecretString::from).map_err(|e| Problem::with_detail(ErrorCode::Internal, e))
    };
    let passphrase = ask("Passphrase of the CA")?;
    if chosen && ask("The same again")?.expose_secret() != passphrase.expose_secret() {
        return Err(Problem::with_detail(ErrorCode::NoPassphrase, "the two entries differ"));
    }
    Ok(passphrase)
}

/// One connection password for every controller of this command, or the keyring.
#[derive(Debug, Default)]
pub struct CommandPasswords {
    given: Option<SecretString>,
    keyring: KeyringPasswords,
}

impl CommandPasswords {
    pub fn new(file: Option<&Path>) -> Result<Self, Problem> {
        Ok(Self { given: file.map(read_secret).transpose()?, keyring: KeyringPasswords::default() })
    }
}

impl Passwords for CommandPasswords {
    fn get(&self, controller: Fingerprint) -> Option<SecretString> {
        self.given.clone().or_else(|| self.keyring.get(controller))
    }

    fn set(&self, controller: Fingerprint, password: SecretString) -> Result<(), Problem> {
        self.keyring.set(controller, password)
    }

    fn forget(&self, controller: Fingerprint) {
        self.keyring.forget(controller);
    }
}
