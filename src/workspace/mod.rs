//! The folder on the PC: configuration, per-serial folders, backup, secrets.
//!
//! ```text
//! <workspace>/
//!   epson_opcua_config.json          controllers and options
//!   connections.csv                  a connection list to import, if there is one (manual 2.5.3)
//!   Configurator/…                   the certificate this program shows to OPC UA servers, and its key
//!   .lock                            locked by the process that may write the configuration
//!   .window                          where a second start asks the window to come to the front (Unix)
//!   CA/…                             the small CA, see `authority`
//!   Vault/…                          connection passwords sealed under a passphrase, see `vault`
//!   <serial>/option.json             settings export of one controller (manual 2.6.4)
//!   <serial>/Cert/SelfSigned/…       what was made for one controller (manual appendix B-1)
//!   <serial>/Cert/CSR/…              the signing request made last
//!   <serial>/Cert/CASigned/…         where what the CA issued for it is put; the key of the request with backup on
//!   <serial>/Cert/UserSpecified/…    where what other tools made is put
//!   <serial>/Cert/<kind>/<date>/…    what was there before and belongs together, see `file_sets`
//! ```
//!
//! Every file is written under a temporary name, flushed and renamed, readable by its owner only: a reader sees the
//! old content or the new one, also after a crash.

mod atomic;
pub mod authority;
mod certificate_files;
mod certificate_import;
mod configuration;
mod configurator_identity;
mod connection_list;
mod error;
mod file_sets;
mod import_files;
mod key_backups;
mod keyring;
mod passphrase;
mod password_list;
mod password_store;
mod passwords;
mod problem;
mod recognise;
mod running_window;
mod settings_files;
mod vault;

use std::fs::{self, File, TryLockError};
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

pub use atomic::write_atomic;
pub use certificate_files::{CertificateFiles, SaveError, SavedCertificate, SavedCsr, SavedFile};
pub use configuration::{
    Configuration, ControllerEntry, DuplicateController, MAX_PARALLELISM, Options, RetrievedInfo, ThemeChoice,
    WindowState,
};
pub use configurator_identity::{ConfiguratorIdentity, ConfiguratorIdentityError, ConfiguratorIdentityFiles, KeyFile};
pub use connection_list::{
    CONNECTION_LIST_COLUMNS, ConnectionList, ConnectionListError, MAX_CONNECTION_LIST_BYTES, MAX_CONNECTIONS,
    NewConnection, PlannedConnection, SkippedLine,
};
pub use error::{FileError, WorkspaceError};
pub use import_files::{certificate_files_beside, read_import_file};
pub use key_backups::{BackupKind, KeyBackup, KeyBackupError, KeyBackupSource};
pub use keyring::{Keyring, KeyringError, NoKeyring, SystemKeyring};
pub use passphrase::{MIN_PASSPHRASE_CHARS, PassphraseError, check_passphrase, check_protects_files};
pub use password_list::{MAX_PASSWORD_LIST_BYTES, PasswordList, PasswordListError};
pub use password_store::{PasswordPlace, PasswordStore, StoreStatus, VaultState};
pub use passwords::{MemoryPasswords, PasswordError, Passwords};
pub use recognise::{MAX_RECOGNISED_BYTES, RecogniseError, Recognised, recognise, recognise_file};
pub use running_window::{ShowWindowOutcome, StartRequests, show_running_window};
pub use settings_files::{SettingsFileError, SettingsFiles};
pub use vault::{MAX_VAULT_PASSWORD_BYTES, MAX_VAULT_PASSWORDS, Vault, VaultError, VaultFiles};

use crate::model::clock;
use crate::platform::replace;

const CONFIGURATION: &str = "epson_opcua_config.json";
const CONNECTION_LIST: &str = "connections.csv";
const LOCK: &str = ".lock";

/// A configuration larger than this is not one (10,000 controllers take about 12 MB).
const MAX_CONFIGURATION_BYTES: u64 = 64 * 1024 * 1024;

/// A workspace folder.
#[derive(Debug, Clone)]
pub struct Workspace {
    root: PathBuf,
}

/// Permission to write the configuration. Released when dropped, or when the process ends.
#[derive(Debug)]
pub struct WorkspaceLock {
    _file: File,
}

/// Reads a file of at most `max` bytes; of a larger one, just enough to see that it is larger.
fn read_bounded(path: &Path, max: u64) -> io::Result<Vec<u8>> {
    read_head(path, max + 1)
}

/// The beginning of a file: `count` bytes, or all if it has fewer.
fn read_head(path: &Path, count: u64) -> io::Result<Vec<u8>> {
    let found = fs::metadata(path)?;
    // A pipe would be waited for, without end.
    if !found.is_file() {
        return Err(io::Error::other("not a file"));
    }
    // Room for all of it at once: a key must not leave copies where the bytes grow.
    let mut bytes = Vec::with_capacity(usize::try_from(found.len().saturating_add(1).min(count)).unwrap_or_default());
    File::open(path)?.take(count).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Creates the folder if it is missing, and locks it for as long as the result lives.
fn lock_folder(folder: &Path) -> Result<WorkspaceLock, WorkspaceError> {
    let path = folder.join(LOCK);
    let file = atomic::open_lock_file(&path)?;
    match file.try_lock() {
        Ok(()) => Ok(WorkspaceLock { _file: file }),
        Err(TryLockError::WouldBlock) => Err(WorkspaceError::Busy(folder.to_owned())),
        Err(TryLockError::Error(e)) => Err(WorkspaceError::writing(&path, e)),
    }
}

/// A configuration as it was found.
#[derive(Debug)]
pub struct LoadedConfiguration {
    /// What was loaded; the default where the file was damaged or missing.
    pub configuration: Configuration,
    /// The file was damaged and is now kept under this name, with the reason.
    pub damaged: Option<(PathBuf, String)>,
}

impl Workspace {
    /// `C:\EpsonRC80\OPCUA` on Windows, `~/EpsonRC80/OPCUA` elsewhere: where the vendor's tool keeps its files.
    pub fn default_root() -> PathBuf {
        let base = if cfg!(windows) { Some(PathBuf::from("C:\\")) } else { std::env::home_dir() };
        base.unwrap_or_default().join("EpsonRC80").join("OPCUA")
    }

    /// The folder is made when something is first written.
    pub fn new(root: impl Into<PathBuf>) -> Self {
        Self { root: root.into() }
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Where a connection list is looked for when none is picked by hand (manual 2.5.3).
    pub fn connection_list_path(&self) -> PathBuf {
        self.root.join(CONNECTION_LIST)
    }

    /// Where the exports of settings are kept.
    pub fn settings_files(&self) -> SettingsFiles {
        SettingsFiles::new(self.root.clone())
    }

    /// The small CA of this workspace, whether there is one or not.
    pub fn authority(&self) -> authority::AuthorityFiles {
        authority::AuthorityFiles::new(self.root.join("CA"))
    }

    /// The vault of this workspace, whether there is one or not.
    pub fn vault(&self) -> VaultFiles {
        VaultFiles::new(&self.root)
    }

    /// Where the configurator's own OPC UA certificate is kept.
    pub fn own_identity(&self) -> ConfiguratorIdentityFiles {
        ConfiguratorIdentityFiles::new(&self.root)
    }

    /// Where the certificates of controllers are kept.
    pub fn certificate_files(&self) -> CertificateFiles {
        CertificateFiles::new(self.root.clone())
    }

    /// Makes a folder of the workspace, so that something can be put into it. Folders elsewhere are left alone.
    pub fn make_folder(&self, folder: &Path) -> Result<(), WorkspaceError> {
        if folder.starts_with(&self.root) { atomic::create_folder(folder) } else { Ok(()) }
    }

    /// Removes temporary files that a killed process left here long ago. Only the process with the lock may call it.
    pub fn remove_leftovers(&self, _lock: &WorkspaceLock) {
        let removed = atomic::remove_leftovers(&self.root, std::time::SystemTime::now());
        if removed > 0 {
            tracing::info!(removed, "temporary files of a former run were removed");
        }
    }

    /// Takes the right to write the configuration: the window for as long as it is open, a command for one change.
    pub fn lock(&self) -> Result<WorkspaceLock, WorkspaceError> {
        lock_folder(&self.root)
    }

    /// Reads the configuration; without one, an empty one.
    ///
    /// A damaged file is renamed to `epson_opcua_config.damaged-<time>.json` and never written to again. If even that
    /// is impossible the workspace is refused, so that nothing can overwrite it.
    pub fn load(&self) -> Result<LoadedConfiguration, WorkspaceError> {
        let path = self.root.join(CONFIGURATION);
        let unreadable = |source| WorkspaceError::Unreadable { path: path.clone(), source };
        let fresh = |damaged| LoadedConfiguration { configuration: Configuration::default(), damaged };
        let bytes = match read_bounded(&path, MAX_CONFIGURATION_BYTES) {
            Ok(bytes) => bytes,
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(fresh(None)),
            Err(e) => return Err(unreadable(e)),
        };
        let parsed = if bytes.len() as u64 > MAX_CONFIGURATION_BYTES {
            Err(format!("the file has more than {MAX_CONFIGURATION_BYTES} bytes"))
        } else {
            Configuration::from_json(&bytes)
        };
        match parsed {
            Ok(configuration) => Ok(LoadedConfiguration { configuration, damaged: None }),
            Err(reason) => {
                let aside = self.unused_name();
                replace::rename(&path, &aside).map_err(|e| WorkspaceError::writing(&path, e))?;
                Ok(fresh(Some((aside, reason))))
            }
        }
    }

    fn unused_name(&self) -> PathBuf {
        let stamp = clock::now().format("%Y%m%dT%H%M%SZ");
        (0u32..)
            .map(|n| {
                let suffix = if n == 0 { String::new() } else { format!("-{n}") };
                self.root.join(format!("epson_opcua_config.damaged-{stamp}{suffix}.json"))
            })
            .find(|path| !path.exists())
            .unwrap_or_else(|| self.root.join("epson_opcua_config.damaged.json"))
    }

    /// Replaces the configuration. The lock proves that no other process does the same.
    ///
    /// One that could not be loaded again is refused, and the old one stays.
    pub fn save(&self, configuration: &Configuration, _lock: &WorkspaceLock) -> Result<(), WorkspaceError> {
        let path = self.root.join(CONFIGURATION);
        let json = configuration.to_json().map_err(|e| WorkspaceError::writing(&path, e))?;
        if json.len() as u64 > MAX_CONFIGURATION_BYTES {
            return Err(WorkspaceError::writing(&path, io::ErrorKind::FileTooLarge.into()));
        }
        write_atomic(&path, &json)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ErrorCode, Problem};

    fn entry(name: &str) -> ControllerEntry {
        ControllerEntry {
            name: name.parse().unwrap(),
            address: "192.168.0.1".parse().unwrap(),
            series: crate::model::ControllerSeries::Rc800,
            connection: crate::model::ConnectionKind::Management,
            fingerprint: None,
            last: None,
        }
    }

    #[test]
    fn what_is_saved_is_loaded() {
        let folder = tempfile::tempdir().unwrap();
        let workspace = Workspace::new(folder.path().join("空 间"));
        let mut configuration = workspace.load().unwrap().configuration;
        assert!(configuration.controllers.is_empty());
        configuration.controllers.push(entry("焊接 1"));
        workspace.save(&configuration, &workspace.lock().unwrap()).unwrap();
        assert_eq!(workspace.load().unwrap().configuration, configuration);
    }

    #[test]
    fn a_damaged_configuration_is_kept_aside_and_said_so() {
        let folder = tempfile::tempdir().unwrap();
        let workspace = Workspace::new(folder.path());
        let path = folder.path().join(CONFIGURATION);
        for damaged in [&b"{\"version\":1,\"contr"[..], b"", b"\xff\xfe", b"{\"version\":99}"] {
            fs::write(&path, damaged).unwrap();
            let loaded = workspace.load().unwrap();
            assert!(loaded.configuration.controllers.is_empty());
            let (aside, _) = loaded.damaged.as_ref().expect("said so");
            assert_eq!(fs::read(aside).unwrap(), damaged, "kept as it was");
            assert_eq!(loaded.notice().unwrap().code, ErrorCode::ConfigurationDamaged);
            workspace.save(&loaded.configuration, &workspace.lock().unwrap()).unwrap();
            assert_eq!(fs::read(aside).unwrap(), damaged, "never overwritten");
        }
    }

    #[test]
    fn a_configuration_that_could_not_be_loaded_again_is_not_saved() {
        let folder = tempfile::tempdir().unwrap();
        let workspace = Workspace::new(folder.path());
        let lock = workspace.lock().unwrap();
        let mut configuration = Configuration::default();
        configuration.controllers.push(entry("Weld 1"));
        workspace.save(&configuration, &lock).unwrap();
        let mut endless = configuration.clone();
        endless.options.window.sort = Some(("x".repeat(MAX_CONFIGURATION_BYTES as usize), true));
        assert!(matches!(workspace.save(&endless, &lock), Err(WorkspaceError::Full { .. })));
        assert_eq!(workspace.load().unwrap().configuration, configuration);
    }

    #[test]
    fn only_one_writer_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let workspace = Workspace::new(folder.path());
        let held = workspace.lock().unwrap();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            let mode = fs::metadata(folder.path().join(LOCK)).unwrap().permissions().mode();
            assert_eq!(mode & 0o777, 0o600, "private like the rest");
        }
        assert!(matches!(workspace.lock(), Err(WorkspaceError::Busy(_))));
        drop(held);
        assert!(workspace.lock().is_ok());
    }

    #[test]
    fn a_full_disk_is_told_from_a_missing_permission_and_a_file_in_use() {
        let of = |kind: io::ErrorKind| Problem::from(WorkspaceError::writing(Path::new("x"), kind.into())).code;
        assert_eq!(of(io::ErrorKind::StorageFull), ErrorCode::WorkspaceFull);
        assert_eq!(of(io::ErrorKind::PermissionDenied), ErrorCode::WorkspaceReadOnly);
        assert_eq!(of(io::ErrorKind::ReadOnlyFilesystem), ErrorCode::WorkspaceReadOnly);
        assert_eq!(of(io::ErrorKind::ResourceBusy), ErrorCode::FileInUse);
    }

    #[test]
    fn a_workspace_that_is_a_file_is_refused_with_its_path() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "x").unwrap();
        let error = Workspace::new(&file).lock().expect_err("not a folder");
        assert!(error.to_string().contains("file"), "{error}");
    }
}
