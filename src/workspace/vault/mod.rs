//! The vault: connection passwords in the workspace, sealed under a passphrase, for a PC without a keyring.
//!
//! ```text
//! <workspace>/Vault/passwords.vault   every password, sealed together; see `file`
//! <workspace>/Vault/.lock             held while the file is read and replaced
//! ```
//!
//! All passwords are sealed as one: an entry cannot be moved to another controller, taken out or put back singly. That
//! the whole file is replaced by an older one of the same passphrase is not noticed.
//!
//! The window and commands may use a vault at the same time. Every change reads the file again under the lock, changes
//! that one entry and writes it whole, so no change of another process is lost.

mod entries;
mod error;
mod file;
mod limits;

#[cfg(test)]
mod tests;

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use secrecy::SecretString;

pub use error::VaultError;
pub use limits::{MAX_VAULT_PASSWORD_BYTES, MAX_VAULT_PASSWORDS};

use super::{WorkspaceError, atomic, check_passphrase, read_bounded, write_atomic};
use crate::pki::{Fingerprint, SealCost, SealError, Sealed, SealingKey};
use entries::VaultEntries;
use file::VaultFormatError;

/// The vault of a workspace, whether there is one or not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VaultFiles {
    folder: PathBuf,
}

impl VaultFiles {
    pub(super) fn new(root: &Path) -> Self {
        Self { folder: root.join(FOLDER) }
    }

    /// The file of the vault, whether it exists or not.
    pub fn path(&self) -> PathBuf {
        self.folder.join(FILE)
    }

    /// Whether there is a vault, damaged or not.
    pub fn exists(&self) -> bool {
        self.path().exists()
    }

    /// Makes an empty vault. Blocks for some hundred milliseconds.
    ///
    /// Errors: a passphrase shorter than [`super::MIN_PASSPHRASE_CHARS`]; a vault that is there already, which is left
    /// as it is.
    pub fn create(&self, passphrase: &SecretString) -> Result<Vault, VaultError> {
        check_passphrase(passphrase)?;
        let key = SealingKey::new(passphrase, SealCost::PC).map_err(VaultError::Seal)?;
        let _lock = self.lock()?;
        if self.exists() {
            return Err(VaultError::Exists(self.path()));
        }
        let vault = Vault { files: self.clone(), key, entries: VaultEntries::default() };
        vault.write(&vault.entries, &vault.key)?;
        Ok(vault)
    }

    /// Opens the vault. Blocks for some hundred milliseconds.
    pub fn open(&self, passphrase: &SecretString) -> Result<Vault, VaultError> {
        let sealed = self.read()?;
        let key = file::key(&sealed, passphrase).map_err(VaultError::Seal)?;
        let entries = self.entries(&sealed, &key)?;
        Ok(Vault { files: self.clone(), key, entries })
    }

    fn lock(&self) -> Result<File, WorkspaceError> {
        let path = self.folder.join(LOCK);
        let file = atomic::open_lock_file(&path)?;
        file.lock().map_err(|e| WorkspaceError::writing(&path, e))?;
        Ok(file)
    }

    fn read(&self) -> Result<Sealed, VaultError> {
        let path = self.path();
        let bytes = match read_bounded(&path, file::MAX_VAULT_BYTES) {
            Ok(bytes) => bytes,
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Err(VaultError::Missing(path)),
            Err(source) => return Err(WorkspaceError::Unreadable { path, source }.into()),
        };
        file::parse(&bytes).map_err(|error| match error {
            VaultFormatError::Damaged(reason) => VaultError::Damaged { path, reason },
            VaultFormatError::Version(version) => VaultError::Version { path, version },
        })
    }

    fn entries(&self, sealed: &Sealed, key: &SealingKey) -> Result<VaultEntries, VaultError> {
        let plain = file::open(sealed, key).map_err(|error| match error {
            SealError::NotOpened => VaultError::WrongPassphrase(self.path()),
            other => VaultError::Seal(other),
        })?;
        let damaged = || VaultError::Damaged { path: self.path(), reason: "its entries".to_owned() };
        VaultEntries::decode(&plain).ok_or_else(damaged)
    }
}

/// An open vault: its key and its passwords in memory, wiped when it is dropped.
pub struct Vault {
    files: VaultFiles,
    key: SealingKey,
    /// As they were when the file was read or written last.
    entries: VaultEntries,
}

impl std::fmt::Debug for Vault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Vault").field("files", &self.files).field("passwords", &self.entries.len()).finish()
    }
}

impl Vault {
    /// How many passwords there are.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether it holds no password.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The controllers whose password is there, by fingerprint.
    pub fn controllers(&self) -> impl Iterator<Item = Fingerprint> + '_ {
        self.entries.controllers()
    }

    /// The password of a controller. One that is not known is looked for in the file again: another process may have
    /// put it there.
    pub fn get(&mut self, controller: Fingerprint) -> Result<Option<SecretString>, VaultError> {
        if self.entries.get(controller).is_none() {
            self.entries = self.read()?;
        }
        Ok(self.entries.get(controller).cloned())
    }

    /// Puts the password of several controllers in. Nothing is written if all of them are known.
    pub fn set(&mut self, controllers: &[Fingerprint], password: &SecretString) -> Result<(), VaultError> {
        self.set_all(controllers.iter().map(|controller| (*controller, password.clone())))
    }

    /// Puts passwords in, all of them or none.
    pub fn set_all(
        &mut self,
        passwords: impl IntoIterator<Item = (Fingerprint, SecretString)>,
    ) -> Result<(), VaultError> {
        self.update(|entries| {
            let mut changed = false;
            for (controller, password) in passwords {
                changed |= entries.set(controller, &password)?;
            }
            Ok(changed)
        })
    }

    /// Takes passwords out; how many of them were there.
    pub fn forget(&mut self, controllers: &[Fingerprint]) -> Result<usize, VaultError> {
        let mut gone = 0;
        self.update(|entries| {
            gone = controllers.iter().filter(|controller| entries.remove(**controller)).count();
            Ok(gone > 0)
        })?;
        Ok(gone)
    }

    /// Seals the vault under another passphrase. Blocks for some hundred milliseconds. Older copies of the file still
    /// open with the old one.
    pub fn change_passphrase(&mut self, passphrase: &SecretString) -> Result<(), VaultError> {
        check_passphrase(passphrase)?;
        let key = SealingKey::new(passphrase, SealCost::PC).map_err(VaultError::Seal)?;
        let _lock = self.files.lock()?;
        let entries = self.read()?;
        self.write(&entries, &key)?;
        (self.entries, self.key) = (entries, key);
        Ok(())
    }

    /// `change` says whether it changed anything.
    fn update(&mut self, change: impl FnOnce(&mut VaultEntries) -> Result<bool, VaultError>) -> Result<(), VaultError> {
        let _lock = self.files.lock()?;
        let mut entries = self.read()?;
        if change(&mut entries)? {
            self.write(&entries, &self.key)?;
        }
        self.entries = entries;
        Ok(())
    }

    fn read(&self) -> Result<VaultEntries, VaultError> {
        let sealed = self.files.read()?;
        if !self.key.has_salt_of(&sealed) {
            return Err(VaultError::PassphraseChanged(self.files.path()));
        }
        self.files.entries(&sealed, &self.key)
    }

    fn write(&self, entries: &VaultEntries, key: &SealingKey) -> Result<(), VaultError> {
        let bytes = file::write(&entries.encode(), key).map_err(VaultError::Seal)?;
        Ok(write_atomic(&self.files.path(), &bytes)?)
    }
}

const FOLDER: &str = "Vault";
const FILE: &str = "passwords.vault";
const LOCK: &str = ".lock";
