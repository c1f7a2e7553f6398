use std::collections::BTreeSet;

use parking_lot::Mutex;
use secrecy::SecretString;
use serde::{Deserialize, Serialize};

use super::vault::{Vault, VaultError, VaultFiles};
use super::{Keyring, MemoryPasswords, PasswordError, Passwords};
use crate::model::Credentials;
use crate::pki::Fingerprint;

/// Where connection passwords are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PasswordPlace {
    /// The operating system's keyring; where there is none, the vault of the workspace if it has one.
    #[default]
    Keyring,
    /// The vault of the workspace.
    Vault,
}

/// What the vault is like in this run of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VaultState {
    /// The workspace has none.
    None,
    /// There is a vault, and its passphrase was not given yet.
    Closed,
    /// The passphrase was asked for and not given: passwords are asked for instead.
    Declined,
    /// The vault is open.
    Open {
        /// How many passwords it holds.
        passwords: usize,
    },
}

/// What the store is like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StoreStatus {
    /// Where passwords are to be kept.
    pub place: PasswordPlace,
    /// The keyring was asked and failed.
    pub keyring_fails: bool,
    /// What the vault is like.
    pub vault: VaultState,
}

impl StoreStatus {
    /// Whether a password that is entered now is still known the next time the program starts, as far as is known.
    pub fn keeps(&self) -> bool {
        match self.vault {
            VaultState::Open { .. } if self.uses_vault() => true,
            _ => self.place == PasswordPlace::Keyring && !self.keyring_fails,
        }
    }

    fn uses_vault(&self) -> bool {
        self.place == PasswordPlace::Vault || self.keyring_fails
    }
}

/// The passwords of a workspace: in the keyring, or in the vault where that was chosen or there is no keyring. What can
/// be kept in neither is known until the program ends.
///
/// A password is [`PasswordError::VaultClosed`] while the vault that may hold it is closed; once its passphrase was
/// declined, it is merely not known.
pub struct PasswordStore {
    vault: VaultFiles,
    keyring: Box<dyn Keyring>,
    /// Of the keyring, and what could not be kept.
    memory: MemoryPasswords,
    state: Mutex<StoreState>,
}

struct StoreState {
    place: PasswordPlace,
    keyring_fails: bool,
    access: StoreAccess,
    /// To be taken out of the vault once it is open.
    to_forget: BTreeSet<Fingerprint>,
    /// In memory, to be put into the vault once it is open.
    to_keep: BTreeSet<Fingerprint>,
}

enum StoreAccess {
    Closed,
    Declined,
    Open(Box<Vault>),
}

impl std::fmt::Debug for PasswordStore {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PasswordStore").field("status", &self.status()).finish_non_exhaustive()
    }
}

impl PasswordStore {
    /// A store over the vault of a workspace and a keyring. Neither is opened yet.
    pub fn new(vault: VaultFiles, place: PasswordPlace, keyring: impl Keyring + 'static) -> Self {
        let state = StoreState {
            place,
            keyring_fails: false,
            access: StoreAccess::Closed,
            to_forget: BTreeSet::new(),
            to_keep: BTreeSet::new(),
        };
        Self { vault, keyring: Box::new(keyring), memory: MemoryPasswords::default(), state: Mutex::new(state) }
    }

    /// Asks neither the keyring nor the user.
    pub fn status(&self) -> StoreStatus {
        let state = self.state.lock();
        let vault = match &state.access {
            StoreAccess::Open(vault) => VaultState::Open { passwords: vault.len() },
            StoreAccess::Closed | StoreAccess::Declined if !self.vault.exists() => VaultState::None,
            StoreAccess::Closed => VaultState::Closed,
            StoreAccess::Declined => VaultState::Declined,
        };
        StoreStatus { place: state.place, keyring_fails: state.keyring_fails, vault }
    }

    /// Changes where passwords are kept from now on. Passwords stay where they are.
    pub fn use_place(&self, place: PasswordPlace) {
        self.state.lock().place = place;
    }

    /// Makes a vault and uses it from now on. The passwords of these controllers are taken over from the keyring, as
    /// far as it has them, and so is what could not be kept before. Returns how many there are.
    pub fn create_vault(&self, passphrase: &SecretString, controllers: &[Fingerprint]) -> Result<usize, PasswordError> {
        // Asked first: a keyring that waits for its user must not hold up others.
        let found: Vec<_> = controllers.iter().filter_map(|c| Some((*c, self.ask_keyring(*c)?))).collect();
        let mut vault = self.vault.create(passphrase)?;
        vault.set_all(found)?;
        Ok(self.opened(vault, true))
    }

    /// Opens the vault for the rest of the run, or until it is closed. Returns how many passwords are in it. What was
    /// entered and deleted while it was closed follows.
    pub fn open_vault(&self, passphrase: &SecretString) -> Result<usize, PasswordError> {
        Ok(self.opened(self.vault.open(passphrase)?, false))
    }

    fn opened(&self, mut vault: Vault, chosen: bool) -> usize {
        let mut state = self.state.lock();
        let forget: Vec<_> = state.to_forget.iter().copied().collect();
        let keep: Vec<_> = state.to_keep.iter().filter_map(|c| Some((*c, self.memory.known(*c)?))).collect();
        match vault.forget(&forget).and_then(|_| vault.set_all(keep)) {
            Ok(()) => {
                state.to_forget.clear();
                for controller in std::mem::take(&mut state.to_keep) {
                    self.memory.forget(controller);
                }
            }
            // It can be read; the rest is tried again when it is opened the next time.
            Err(error) => tracing::warn!(%error, "what was entered before is not in the vault"),
        }
        if chosen {
            state.place = PasswordPlace::Vault;
        }
        let passwords = vault.len();
        state.access = StoreAccess::Open(Box::new(vault));
        passwords
    }

    /// Seals the vault under another passphrase, if the present one is right. It is open afterwards.
    pub fn change_passphrase(&self, present: &SecretString, new: &SecretString) -> Result<(), PasswordError> {
        let mut vault = self.vault.open(present)?;
        vault.change_passphrase(new)?;
        self.opened(vault, false);
        Ok(())
    }

    /// Wipes what is known of the vault.
    pub fn close_vault(&self) {
        self.state.lock().access = StoreAccess::Closed;
    }

    /// From now on passwords are asked for instead of the passphrase.
    pub fn decline_vault(&self) {
        let mut state = self.state.lock();
        if matches!(state.access, StoreAccess::Closed) {
            state.access = StoreAccess::Declined;
        }
    }

    /// The controllers whose password is in the open vault; `None` while it is not open.
    pub fn in_vault(&self) -> Option<Vec<Fingerprint>> {
        match &self.state.lock().access {
            StoreAccess::Open(vault) => Some(vault.controllers().collect()),
            StoreAccess::Closed | StoreAccess::Declined => None,
        }
    }

    /// Takes passwords out of the open vault; how many of them were there.
    pub fn forget_in_vault(&self, controllers: &[Fingerprint]) -> Result<usize, PasswordError> {
        self.with_vault(|vault| vault.forget(controllers))
    }

    /// Puts passwords into the open vault, all of them or none.
    pub fn put_into_vault(&self, passwords: Vec<(Fingerprint, SecretString)>) -> Result<(), PasswordError> {
        self.with_vault(|vault| vault.set_all(passwords))
    }

    /// [`PasswordError::VaultClosed`] unless it is open, or [`PasswordError::NoVault`].
    fn with_vault<T>(&self, work: impl FnOnce(&mut Vault) -> Result<T, VaultError>) -> Result<T, PasswordError> {
        let mut state = self.state.lock();
        let StoreAccess::Open(vault) = &mut state.access else {
            return Err(if self.vault.exists() { PasswordError::VaultClosed } else { PasswordError::NoVault });
        };
        let done = work(vault);
        if matches!(done, Err(VaultError::PassphraseChanged(_))) {
            state.access = StoreAccess::Closed;
        }
        Ok(done?)
    }

    /// Whether the vault holds passwords, or would.
    fn uses_vault(&self) -> bool {
        let state = self.state.lock();
        state.place == PasswordPlace::Vault || (state.keyring_fails && self.vault.exists())
    }

    fn is_declined(&self) -> bool {
        matches!(self.state.lock().access, StoreAccess::Declined)
    }

    fn ask_keyring(&self, controller: Fingerprint) -> Option<SecretString> {
        match self.keyring.get(controller) {
            Ok(password) => password,
            Err(error) => {
                tracing::debug!(%error, "no password from the keyring");
                self.state.lock().keyring_fails = true;
                None
            }
        }
    }

    /// It has to do until the program ends, or the vault is open.
    fn keep_for_now(&self, controllers: &[Fingerprint], password: &SecretString) {
        let mut state = self.state.lock();
        for controller in controllers {
            self.memory.put(*controller, password.clone());
            state.to_keep.insert(*controller);
            state.to_forget.remove(controller);
        }
    }

    fn password(&self, controller: Fingerprint) -> Result<Option<SecretString>, PasswordError> {
        if let Some(password) = self.memory.known(controller) {
            return Ok(Some(password));
        }
        if !self.uses_vault()
            && let Some(password) = self.ask_keyring(controller)
        {
            // Asking the keyring once per start is enough.
            self.memory.put(controller, password.clone());
            return Ok(Some(password));
        }
        // The keyring may have turned out to fail just now.
        if !self.uses_vault() || self.is_declined() || !self.vault.exists() {
            return Ok(None);
        }
        self.with_vault(|vault| vault.get(controller))
    }
}

impl Passwords for PasswordStore {
    fn get(&self, controller: Fingerprint) -> Result<Option<Credentials>, PasswordError> {
        Ok(self.password(controller)?.map(Credentials::ConnectionPassword))
    }

    fn set(&self, controller: Fingerprint, credentials: Credentials) -> Result<(), PasswordError> {
        self.set_for(&[controller], &credentials)
    }

    fn set_for(&self, controllers: &[Fingerprint], credentials: &Credentials) -> Result<(), PasswordError> {
        let password = credentials.password();
        let mut result = Ok(());
        if !self.uses_vault() {
            for controller in controllers {
                // One that cannot be kept must not keep the others out.
                result = self.keyring.set(*controller, password).map_err(PasswordError::from).and(result);
                self.memory.put(*controller, password.clone());
            }
            if result.is_ok() {
                return Ok(());
            }
            self.state.lock().keyring_fails = true;
        }
        if self.uses_vault() {
            result = self.with_vault(|vault| vault.set(controllers, password));
        }
        match &result {
            // Now the vault has it, and closing that forgets it.
            Ok(()) => controllers.iter().for_each(|controller| self.memory.forget(*controller)),
            Err(_) => self.keep_for_now(controllers, password),
        }
        result
    }

    /// A closed vault forgets it when it is opened, if that is within this run of the program.
    fn forget(&self, controller: Fingerprint) {
        self.memory.forget(controller);
        self.state.lock().to_keep.remove(&controller);
        if self.with_vault(|vault| vault.forget(&[controller])).is_err() {
            self.state.lock().to_forget.insert(controller);
        }
        if let Err(error) = self.keyring.forget(controller) {
            tracing::debug!(%error, "no password deleted from the keyring");
        }
    }

    fn store(&self) -> Option<&PasswordStore> {
        Some(self)
    }
}

#[cfg(test)]
mod tests {
    use secrecy::ExposeSecret as _;

    use super::*;
    use crate::model::{ErrorCode, Problem};
    use crate::workspace::{KeyringError, NoKeyring, Workspace};

    const PASSPHRASE: &str = "correct horse";

    /// A keyring that works.
    #[derive(Default)]
    struct WorkingKeyring(MemoryPasswords);

    impl Keyring for WorkingKeyring {
        fn get(&self, controller: Fingerprint) -> Result<Option<SecretString>, KeyringError> {
            Ok(self.0.known(controller))
        }
        fn set(&self, controller: Fingerprint, password: &SecretString) -> Result<(), KeyringError> {
            self.0.put(controller, password.clone());
            Ok(())
        }
        fn forget(&self, controller: Fingerprint) -> Result<(), KeyringError> {
            self.0.forget(controller);
            Ok(())
        }
    }

    fn code(error: PasswordError) -> ErrorCode {
        Problem::from(error).code
    }

    struct TestPc(tempfile::TempDir);

    impl TestPc {
        fn new() -> Self {
            Self(tempfile::tempdir().unwrap())
        }

        fn start(&self, place: PasswordPlace, keyring: impl Keyring + 'static) -> PasswordStore {
            PasswordStore::new(Workspace::new(self.0.path()).vault(), place, keyring)
        }
    }

    fn id(name: &str) -> Fingerprint {
        Fingerprint::of(name.as_bytes())
    }

    fn get(store: &PasswordStore, name: &str) -> Result<Option<String>, ErrorCode> {
        let credentials = store.get(id(name)).map_err(code)?;
        Ok(credentials.map(|credentials| credentials.password().expose_secret().to_owned()))
    }

    fn set(store: &PasswordStore, name: &str, password: &str) -> Result<(), ErrorCode> {
        store.set(id(name), password.into()).map_err(code)
    }

    #[test]
    fn without_keyring_and_vault_a_password_is_known_until_the_end() {
        let pc = TestPc::new();
        let store = pc.start(PasswordPlace::Keyring, NoKeyring);
        assert!(store.status().keeps(), "nothing is known against it yet");
        assert_eq!(get(&store, "weld"), Ok(None));
        assert!(!store.status().keeps());
        assert_eq!(set(&store, "weld", "a"), Err(ErrorCode::KeyringUnavailable));
        assert_eq!(get(&store, "weld"), Ok(Some("a".into())));
        // A vault that is made now takes it in.
        assert_eq!(store.create_vault(&PASSPHRASE.into(), &[id("weld")]).unwrap(), 1);
        assert_eq!(set(&store, "paint", ""), Ok(()));
        assert!(store.status().keeps());

        let later = pc.start(PasswordPlace::Keyring, NoKeyring);
        assert_eq!(get(&later, "weld"), Err(ErrorCode::VaultLocked), "there is no keyring, but a vault");
        assert_eq!(code(later.open_vault(&"correct house".into()).unwrap_err()), ErrorCode::VaultPassphrase);
        assert_eq!(later.open_vault(&PASSPHRASE.into()).unwrap(), 2);
        assert_eq!(get(&later, "weld"), Ok(Some("a".into())));
        assert_eq!(get(&later, "paint"), Ok(Some(String::new())), "a controller without a password is known as such");
        assert_eq!(get(&later, "other"), Ok(None));
    }

    #[test]
    fn a_vault_that_was_declined_is_not_asked_for_again() {
        let pc = TestPc::new();
        pc.start(PasswordPlace::Vault, NoKeyring).create_vault(&PASSPHRASE.into(), &[]).unwrap();
        let store = pc.start(PasswordPlace::Vault, WorkingKeyring::default());
        assert_eq!(get(&store, "weld"), Err(ErrorCode::VaultLocked));
        store.decline_vault();
        assert_eq!(get(&store, "weld"), Ok(None));
        assert_eq!(set(&store, "weld", "a"), Err(ErrorCode::VaultLocked), "not kept");
        assert_eq!(get(&store, "weld"), Ok(Some("a".into())));
        assert_eq!(store.status().vault, VaultState::Declined);
        // What was entered and deleted meanwhile follows.
        store.forget(id("gone"));
        assert_eq!(store.open_vault(&PASSPHRASE.into()).unwrap(), 1);
        store.close_vault();
        assert_eq!(get(&store, "weld"), Err(ErrorCode::VaultLocked), "closing forgets");
    }

    #[test]
    fn what_was_deleted_while_the_vault_was_closed_is_taken_out() {
        let pc = TestPc::new();
        let store = pc.start(PasswordPlace::Vault, NoKeyring);
        assert_eq!(set(&store, "weld", "a"), Err(ErrorCode::VaultMissing));
        store.create_vault(&PASSPHRASE.into(), &[]).unwrap();
        set(&store, "weld", "a").unwrap();
        set(&store, "paint", "b").unwrap();
        store.close_vault();
        store.forget(id("weld"));
        assert_eq!(store.open_vault(&PASSPHRASE.into()).unwrap(), 1);
        store.forget(id("paint"));
        assert_eq!(store.in_vault(), Some(vec![]));
    }

    #[test]
    fn by_choice_the_vault_is_used_beside_a_keyring_that_works() {
        let pc = TestPc::new();
        let store = pc.start(PasswordPlace::Keyring, WorkingKeyring::default());
        set(&store, "weld", "a").unwrap();
        assert_eq!(store.status().vault, VaultState::None);
        assert_eq!(store.create_vault(&PASSPHRASE.into(), &[id("weld"), id("paint")]).unwrap(), 1, "taken over");
        set(&store, "paint", "b").unwrap();
        assert_eq!(
            store.status(),
            StoreStatus { place: PasswordPlace::Vault, keyring_fails: false, vault: VaultState::Open { passwords: 2 } }
        );
        store.use_place(PasswordPlace::Keyring);
        assert_eq!(get(&store, "paint"), Ok(None), "the keyring never had it");
        assert_eq!(get(&store, "weld"), Ok(Some("a".into())));
    }

    #[test]
    fn the_passphrase_is_changed_only_by_who_knows_it() {
        let pc = TestPc::new();
        let store = pc.start(PasswordPlace::Vault, NoKeyring);
        store.create_vault(&PASSPHRASE.into(), &[]).unwrap();
        set(&store, "weld", "a").unwrap();
        let change = |present: &str, new: &str| store.change_passphrase(&present.into(), &new.into()).map_err(code);
        assert_eq!(change("correct house", "another one"), Err(ErrorCode::VaultPassphrase));
        assert_eq!(change(PASSPHRASE, "short"), Err(ErrorCode::BadPassphrase));
        assert_eq!(change(PASSPHRASE, "another one"), Ok(()));
        let later = pc.start(PasswordPlace::Vault, NoKeyring);
        assert_eq!(code(later.open_vault(&PASSPHRASE.into()).unwrap_err()), ErrorCode::VaultPassphrase);
        assert_eq!(later.open_vault(&"another one".into()).unwrap(), 1);
    }
}
