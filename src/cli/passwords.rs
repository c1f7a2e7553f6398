use std::io::{IsTerminal as _, Read as _};
use std::path::Path;

use secrecy::{ExposeSecret as _, SecretString};

use crate::model::{ErrorCode, Problem};
use crate::pki::Fingerprint;
use crate::workspace::{KeyringPasswords, Passwords};

/// No password is longer; a wrong file is noticed instead of read.
const MAX_PASSWORD_BYTES: u64 = 1024;

/// Reads a password: the first line of a file, or of standard input for `-`.
pub fn read_secret(path: &Path) -> Result<SecretString, Problem> {
    let unreadable =
        |e: &dyn std::fmt::Display| Problem::with_detail(ErrorCode::FileUnreadable, format!("{}: {e}", path.display()));
    let mut text = zeroize::Zeroizing::new(String::new());
    let read = if path == Path::new("-") {
        std::io::stdin().take(MAX_PASSWORD_BYTES + 1).read_to_string(&mut text)
    } else {
        std::fs::File::open(path).and_then(|file| file.take(MAX_PASSWORD_BYTES + 1).read_to_string(&mut text))
    };
    let bytes = read.map_err(|e| unreadable(&e))?;
    if bytes as u64 > MAX_PASSWORD_BYTES {
        return Err(unreadable(&"too long for a password"));
    }
    Ok(SecretString::from(text.lines().next().unwrap_or_default()))
}

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
