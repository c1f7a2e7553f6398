//! The connection passwords of one command: from files, the vault of the workspace, or the keyring.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::IsTerminal as _;
use std::path::Path;
use std::sync::Arc;

use secrecy::SecretString;
use zeroize::Zeroizing;

use super::CommandContext;
use super::passwords::passphrase;
use super::secret_file::read_secret;
use crate::model::{ControllerName, Credentials, ErrorCode, Problem, text};
use crate::pki::Fingerprint;
use crate::texts::{TextKey, cli as texts};
use crate::workspace::{
    Configuration, MAX_PASSWORD_LIST_BYTES, PasswordError, PasswordList, PasswordPlace, PasswordStore, Passwords,
    SystemKeyring, VaultState,
};

/// What was given on the command line, before what is kept on this computer.
struct CommandPasswords {
    /// Of the list, by the controllers that are registered.
    listed: BTreeMap<Fingerprint, SecretString>,
    /// Of every other controller.
    given: Option<SecretString>,
    store: Arc<PasswordStore>,
}

impl Passwords for CommandPasswords {
    fn get(&self, controller: Fingerprint) -> Result<Option<Credentials>, PasswordError> {
        match self.listed.get(&controller).or(self.given.as_ref()) {
            Some(password) => Ok(Some(password.clone().into())),
            None => self.store.get(controller),
        }
    }

    fn set(&self, controller: Fingerprint, credentials: Credentials) -> Result<(), PasswordError> {
        self.store.set(controller, credentials)
    }

    fn forget(&self, controller: Fingerprint) {
        self.store.forget(controller);
    }

    fn store(&self) -> Option<&PasswordStore> {
        Some(&self.store)
    }
}

impl CommandContext {
    /// Everything that may know a connection password. Made once a command: a passphrase is asked for only once, and
    /// standard input can be read only once.
    pub fn passwords(&self) -> Result<Arc<dyn Passwords>, Problem> {
        if let Some(made) = self.passwords.get() {
            return Ok(made.clone());
        }
        let configuration = self.workspace.load()?.configuration;
        let list = self.password_list()?;
        let listed = list.iter().flat_map(|list| {
            list.iter().filter_map(|(name, password)| Some((configuration.find(name)?.fingerprint?, password.clone())))
        });
        let passwords = CommandPasswords {
            listed: listed.collect(),
            given: self.connection_password_file.as_deref().map(read_secret).transpose()?,
            store: Arc::new(self.store(&configuration)),
        };
        if self.vault_passphrase_file.is_some() {
            passwords.store.open_vault(&self.vault_passphrase(false)?)?;
        } else if passwords.given.is_none() && asks_for_vault(&passwords.store) {
            // An empty passphrase: it was not wanted.
            match self.vault_passphrase(false)? {
                entered if is_empty(&entered) => passwords.store.decline_vault(),
                entered => {
                    passwords.store.open_vault(&entered)?;
                }
            }
        }
        let passwords: Arc<dyn Passwords> = Arc::new(passwords);
        Ok(self.passwords.get_or_init(|| passwords).clone())
    }

    /// The keyring and the vault, which is not opened.
    pub fn store(&self, configuration: &Configuration) -> PasswordStore {
        PasswordStore::new(self.workspace.vault(), configuration.options.passwords, SystemKeyring)
    }

    /// The password of a controller that is met for the first time: of the file for it, of the list, or of the file for
    /// all of them. Without any, the controller has none.
    pub fn first_password(&self, name: &ControllerName, file: Option<&Path>) -> Result<SecretString, Problem> {
        if let Some(file) = file {
            return read_secret(file);
        }
        if let Some(password) = self.password_list()?.and_then(|list| list.get(name.as_str()).cloned()) {
            return Ok(password);
        }
        let given = self.connection_password_file.as_deref().map(read_secret).transpose()?;
        Ok(given.unwrap_or_else(|| SecretString::from("")))
    }

    /// From the file, or asked for on the terminal: twice where it is `chosen`.
    pub fn vault_passphrase(&self, chosen: bool) -> Result<SecretString, Problem> {
        passphrase(
            TextKey::CliAskVaultPassphrase,
            self.vault_passphrase_file.as_deref(),
            chosen,
            self.output.language(),
        )
        .map_err(|problem| match problem.code {
            ErrorCode::NoPassphrase if problem.detail.is_none() => {
                Problem::with_detail(ErrorCode::NoPassphrase, texts::vault_passphrase_option(self.output.language()))
            }
            _ => problem,
        })
    }

    fn password_list(&self) -> Result<Option<PasswordList>, Problem> {
        self.connection_password_list.as_deref().map(read_password_list).transpose()
    }
}

/// Whether there is a vault to be opened, and a person to ask for its passphrase.
fn asks_for_vault(store: &PasswordStore) -> bool {
    let status = store.status();
    let waits = status.place == PasswordPlace::Vault && status.vault == VaultState::Closed;
    waits && std::io::stdin().is_terminal() && std::io::stderr().is_terminal()
}

fn is_empty(secret: &SecretString) -> bool {
    secrecy::ExposeSecret::expose_secret(secret).is_empty()
}

/// Reads a list of passwords, see [`PasswordList`], in an encoding of [`text::decode`].
pub fn read_password_list(path: &Path) -> Result<PasswordList, Problem> {
    let bytes = Zeroizing::new(super::read_bounded(path, MAX_PASSWORD_LIST_BYTES)?);
    match text::decode(&bytes).map_err(|error| Problem::with_detail(ErrorCode::BadPasswordList, error))? {
        Cow::Borrowed(text) => Ok(PasswordList::parse(text)?),
        Cow::Owned(text) => Ok(PasswordList::parse(&Zeroizing::new(text))?),
    }
}
