use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use chrono::{DateTime, Utc};
use thiserror::Error;

use zeroize::Zeroizing;

use super::{WorkspaceError, atomic, read_bounded, write_atomic};
use crate::pki::{Certificate, MAX_CERTIFICATE_BYTES, MAX_KEY_FILE_BYTES, PkiError, client_identity, read_pair};
use crate::platform::replace;

/// The configurator's own OPC UA application instance certificate and its key, made once for a workspace:
/// `<workspace>/Configurator/configurator.der` and `configurator_key.pem`, on Windows `configurator_key.dpapi`.
///
/// The certificate is public: it is put into a controller's Trusted list. The key's file is readable by
/// its owner only. On Windows the key is encrypted for the account as well (Data Protection API): it cannot be used
/// under another account or on another PC.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConfiguratorIdentityFiles {
    folder: PathBuf,
}

/// The identity, ready to be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConfiguratorIdentity {
    /// The certificate.
    pub certificate: Certificate,
    /// DER.
    pub certificate_path: PathBuf,
    /// PKCS#8 in PEM, on Windows encrypted; see [`ConfiguratorIdentity::open_key`].
    pub key_path: PathBuf,
}

/// A file with the key in PEM, not encrypted, for as long as this value lives.
#[derive(Debug)]
pub struct KeyFile {
    /// Absolute.
    pub path: PathBuf,
    /// On Windows: a private copy that the system removes with this handle.
    #[cfg(windows)]
    _copy: File,
}

/// Why this program has no identity to show to OPC UA servers.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ConfiguratorIdentityError {
    /// The files cannot be written.
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
    /// Key and certificate could not be made.
    #[error(transparent)]
    Making(#[from] PkiError),
    /// A file exists and cannot be read.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// Key and certificate are damaged, or do not belong together.
    #[error("{}: {source}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: PkiError,
    },
    /// The key was protected by another Windows account.
    #[error("{}: {source}", path.display())]
    Unprotect {
        /// The file with the key.
        path: PathBuf,
        /// The error of Windows.
        source: io::Error,
    },
    /// The current folder of the process is not known.
    #[error("{0}")]
    Path(#[source] io::Error),
}

impl ConfiguratorIdentity {
    /// The ApplicationUri in the certificate.
    pub fn application_uri(&self) -> String {
        self.certificate.application_uri().unwrap_or_default()
    }

    /// The key as the OPC UA library reads it. `folder` is one that only this account can use; on Windows a decrypted
    /// copy lies there, which is gone when the result is dropped or the process ends. Blocks.
    pub fn open_key(&self, folder: &Path) -> Result<KeyFile, ConfiguratorIdentityError> {
        #[cfg(windows)]
        {
            use std::io::Write as _;

            use crate::platform::windows::access::{Open, open_file};
            let path = folder.join("key.pem");
            let unreadable = |source: io::Error| ConfiguratorIdentityError::Unreadable { path: path.clone(), source };
            let pem = read_key(&self.key_path)?.ok_or_else(|| unreadable(io::ErrorKind::NotFound.into()))?;
            let mut copy = open_file(&path, Open::Temporary).map_err(unreadable)?;
            copy.write_all(&pem).map_err(unreadable)?;
            Ok(KeyFile { path: std::path::absolute(&path).map_err(unreadable)?, _copy: copy })
        }
        #[cfg(not(windows))]
        {
            let _ = folder;
            let path = std::path::absolute(&self.key_path).map_err(ConfiguratorIdentityError::Path)?;
            Ok(KeyFile { path })
        }
    }
}

impl ConfiguratorIdentityFiles {
    pub(super) fn new(root: &Path) -> Self {
        Self { folder: root.join(FOLDER) }
    }

    /// Where the certificate is, or will be.
    pub fn certificate_path(&self) -> PathBuf {
        self.folder.join(CERTIFICATE)
    }

    /// The identity; made if there is none yet, and anew once it has expired. Blocks, and makes a key.
    ///
    /// # Errors
    /// Files that are there but damaged, or do not belong together, are [`ConfiguratorIdentityError::Content`] and left
    /// alone: a new identity would have to be trusted again everywhere.
    pub fn load_or_make(&self, now: DateTime<Utc>) -> Result<ConfiguratorIdentity, ConfiguratorIdentityError> {
        let paths = IdentityPaths { certificate: self.certificate_path(), key: self.folder.join(KEY) };
        if let Some(found) = paths.load(now)? {
            return Ok(found);
        }
        // Two programs at the same workspace must not make half of it each.
        let _lock = self.lock()?;
        if let Some(found) = paths.load(now)? {
            return Ok(found);
        }
        let host = gethostname::gethostname();
        let made = client_identity(APPLICATION, &host.to_string_lossy(), now)?;
        let key = made.key_pem()?;
        // The certificate last: without it the key counts for nothing.
        let failed = |e| WorkspaceError::writing(&paths.certificate, e);
        replace::remove_if_there(&paths.certificate).map_err(failed)?;
        write_key(&paths.key, key.as_bytes())?;
        write_atomic(&paths.certificate, made.certificate.der())?;
        Ok(paths.identity(made.certificate))
    }

    fn lock(&self) -> Result<File, WorkspaceError> {
        let path = self.folder.join(LOCK);
        let file = atomic::open_lock_file(&path)?;
        file.lock().map_err(|e| WorkspaceError::writing(&path, e))?;
        Ok(file)
    }
}

struct IdentityPaths {
    certificate: PathBuf,
    key: PathBuf,
}

impl IdentityPaths {
    fn identity(&self, certificate: Certificate) -> ConfiguratorIdentity {
        ConfiguratorIdentity { certificate, certificate_path: self.certificate.clone(), key_path: self.key.clone() }
    }

    fn load(&self, now: DateTime<Utc>) -> Result<Option<ConfiguratorIdentity>, ConfiguratorIdentityError> {
        let Some(certificate) = read(&self.certificate, MAX_CERTIFICATE_BYTES)? else { return Ok(None) };
        let Some(key) = read_key(&self.key)? else { return Ok(None) };
        let (_, certificate) = read_pair(&certificate, &key, None)
            .map_err(|source| ConfiguratorIdentityError::Content { path: self.certificate.clone(), source })?;
        Ok((certificate.not_after() > now).then(|| self.identity(certificate)))
    }
}

fn read(path: &Path, most: usize) -> Result<Option<Vec<u8>>, ConfiguratorIdentityError> {
    match read_bounded(path, most as u64) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(source) => Err(ConfiguratorIdentityError::Unreadable { path: path.to_owned(), source }),
    }
}

/// The key in PEM; `None` if there is none.
fn read_key(path: &Path) -> Result<Option<Zeroizing<Vec<u8>>>, ConfiguratorIdentityError> {
    let stored = read(path, MAX_KEY_FILE_BYTES)?.map(Zeroizing::new);
    #[cfg(not(windows))]
    return Ok(stored);
    #[cfg(windows)]
    {
        let Some(stored) = stored else { return Ok(None) };
        let pem = crate::platform::windows::protect::unprotect(&stored);
        pem.map(Some).map_err(|source| ConfiguratorIdentityError::Unprotect { path: path.to_owned(), source })
    }
}

fn write_key(path: &Path, pem: &[u8]) -> Result<(), WorkspaceError> {
    #[cfg(not(windows))]
    return write_atomic(path, pem);
    #[cfg(windows)]
    {
        let failed = |e| WorkspaceError::writing(path, e);
        write_atomic(path, &crate::platform::windows::protect::protect(pem).map_err(failed)?)
    }
}

const APPLICATION: &str = "OPC UA Configurator";
const FOLDER: &str = "Configurator";
const CERTIFICATE: &str = "configurator.der";
#[cfg(not(windows))]
const KEY: &str = "configurator_key.pem";
#[cfg(windows)]
const KEY: &str = "configurator_key.dpapi";
const LOCK: &str = ".lock";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ErrorCode, Problem};
    use crate::platform::private;
    use chrono::Duration;

    #[test]
    fn it_is_made_once_and_stays() {
        let folder = tempfile::tempdir().unwrap();
        let files = ConfiguratorIdentityFiles::new(&folder.path().join("空 间"));
        // As two windows and a command line would, side by side.
        let made: Vec<ConfiguratorIdentity> = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..3).map(|_| scope.spawn(|| files.load_or_make(Utc::now()).unwrap())).collect();
            threads.into_iter().map(|thread| thread.join().unwrap()).collect()
        });
        assert!(made.iter().all(|identity| *identity == made[0]));
        assert_eq!(files.load_or_make(Utc::now()).unwrap(), made[0]);
        assert!(made[0].application_uri().starts_with("urn:"));
        assert_eq!(std::fs::read(&made[0].certificate_path).unwrap(), made[0].certificate.der());
        assert!(private::is_private(&made[0].key_path));
        assert!(private::is_private(&files.folder.join(LOCK)));
        assert!(private::is_private(made[0].key_path.parent().unwrap()));
    }

    #[test]
    fn the_key_can_be_read_while_it_is_open_and_is_stored_as_the_system_protects_it() {
        let folder = tempfile::tempdir().unwrap();
        let identity = ConfiguratorIdentityFiles::new(folder.path()).load_or_make(Utc::now()).unwrap();
        let temporary = tempfile::tempdir().unwrap();
        let key = identity.open_key(temporary.path()).unwrap();
        let pem = std::fs::read(&key.path).unwrap();
        read_pair(identity.certificate.der(), &pem, None).unwrap();
        let stored = std::fs::read(&identity.key_path).unwrap();
        assert_eq!(stored.starts_with(b"-----BEGIN"), cfg!(not(windows)));
        drop(key);
        assert_eq!(std::fs::read_dir(temporary.path()).unwrap().count(), 0, "no copy of the key is left");
    }

    #[test]
    fn an_expired_one_is_replaced_and_a_damaged_one_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let files = ConfiguratorIdentityFiles::new(folder.path());
        let old = files.load_or_make(Utc::now() - Duration::days(365 * 6)).unwrap();
        let new = files.load_or_make(Utc::now()).unwrap();
        assert_ne!(old.certificate, new.certificate);
        std::fs::write(&new.key_path, "no key").unwrap();
        assert_eq!(Problem::from(files.load_or_make(Utc::now()).unwrap_err()).code, ErrorCode::FileFormat);
        assert_eq!(std::fs::read(&new.certificate_path).unwrap(), new.certificate.der());
        // A crash between the two files leaves a key alone.
        std::fs::remove_file(&new.certificate_path).unwrap();
        assert_ne!(files.load_or_make(Utc::now()).unwrap().certificate, new.certificate);
    }
}
