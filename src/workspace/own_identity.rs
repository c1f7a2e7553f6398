use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use chrono::{DateTime, Utc};

use super::{WorkspaceError, atomic, read_bounded, write_atomic};
use crate::model::{ErrorCode, Problem};
use crate::pki::{Certificate, MAX_CERTIFICATE_BYTES, MAX_KEY_FILE_BYTES, client_identity, read_pair};

/// The configurator's own OPC UA application instance certificate and its key, made once for a workspace:
/// `<workspace>/Configurator/configurator.der` and `configurator_key.pem`.
///
/// The certificate is for everybody: it is what is put into a controller's Trusted list. The key is not encrypted, but
/// readable by its owner only.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OwnIdentityFiles {
    folder: PathBuf,
}

/// The identity, ready to be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OwnIdentity {
    pub certificate: Certificate,
    /// DER.
    pub certificate_path: PathBuf,
    /// PKCS#8 in PEM.
    pub key_path: PathBuf,
}

impl OwnIdentity {
    /// The ApplicationUri in the certificate.
    pub fn application_uri(&self) -> String {
        self.certificate.application_uri().unwrap_or_default()
    }
}

impl OwnIdentityFiles {
    pub(super) fn new(root: &Path) -> Self {
        Self { folder: root.join(FOLDER) }
    }

    /// Where the certificate is, or will be.
    pub fn certificate_path(&self) -> PathBuf {
        self.folder.join(CERTIFICATE)
    }

    /// The identity; made if there is none yet, and anew once it has expired. Blocks, and makes a key.
    ///
    /// Files that are there but damaged, or do not belong together, are [`ErrorCode::FileFormat`] and left alone: a new
    /// identity would have to be trusted again everywhere.
    pub fn load_or_make(&self, now: DateTime<Utc>) -> Result<OwnIdentity, Problem> {
        let paths = OwnPaths { certificate: self.certificate_path(), key: self.folder.join(KEY) };
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
        remove(&paths.certificate)?;
        write_atomic(&paths.key, key.as_bytes())?;
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

struct OwnPaths {
    certificate: PathBuf,
    key: PathBuf,
}

impl OwnPaths {
    fn identity(&self, certificate: Certificate) -> OwnIdentity {
        OwnIdentity { certificate, certificate_path: self.certificate.clone(), key_path: self.key.clone() }
    }

    fn load(&self, now: DateTime<Utc>) -> Result<Option<OwnIdentity>, Problem> {
        let Some(certificate) = read(&self.certificate, MAX_CERTIFICATE_BYTES)? else { return Ok(None) };
        let Some(key) = read(&self.key, MAX_KEY_FILE_BYTES)?.map(zeroize::Zeroizing::new) else { return Ok(None) };
        let (_, certificate) = read_pair(&certificate, &key, None)
            .map_err(|e| Problem::with_detail(ErrorCode::FileFormat, format!("{}: {e}", self.certificate.display())))?;
        Ok((certificate.not_after() > now).then(|| self.identity(certificate)))
    }
}

fn read(path: &Path, most: usize) -> Result<Option<Vec<u8>>, Problem> {
    match read_bounded(path, most as u64) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(e) => Err(Problem::with_detail(ErrorCode::FileUnreadable, format!("{}: {e}", path.display()))),
    }
}

fn remove(path: &Path) -> Result<(), WorkspaceError> {
    match std::fs::remove_file(path) {
        Err(e) if e.kind() != io::ErrorKind::NotFound => Err(WorkspaceError::writing(path, e)),
        _ => Ok(()),
    }
}

const APPLICATION: &str = "OPC UA Configurator";
const FOLDER: &str = "Configurator";
const CERTIFICATE: &str = "configurator.der";
const KEY: &str = "configurator_key.pem";
const LOCK: &str = ".lock";

#[cfg(test)]
mod tests {
    use super::*;
    use chrono::Duration;

    #[test]
    fn it_is_made_once_and_stays() {
        let folder = tempfile::tempdir().unwrap();
        let files = OwnIdentityFiles::new(&folder.path().join("空 间"));
        // As two windows and a command line would, side by side.
        let made: Vec<OwnIdentity> = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..3).map(|_| scope.spawn(|| files.load_or_make(Utc::now()).unwrap())).collect();
            threads.into_iter().map(|thread| thread.join().unwrap()).collect()
        });
        assert!(made.iter().all(|identity| *identity == made[0]));
        assert_eq!(files.load_or_make(Utc::now()).unwrap(), made[0]);
        assert!(made[0].application_uri().starts_with("urn:"));
        assert_eq!(std::fs::read(&made[0].certificate_path).unwrap(), made[0].certificate.der());
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            let mode = |p: &Path| std::fs::metadata(p).unwrap().permissions().mode() & 0o777;
            assert_eq!(mode(&made[0].key_path), 0o600);
            assert_eq!(mode(&files.folder.join(LOCK)), 0o600);
            assert_eq!(mode(made[0].key_path.parent().unwrap()), 0o700);
        }
    }

    #[test]
    fn an_expired_one_is_replaced_and_a_damaged_one_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let files = OwnIdentityFiles::new(folder.path());
        let old = files.load_or_make(Utc::now() - Duration::days(365 * 6)).unwrap();
        let new = files.load_or_make(Utc::now()).unwrap();
        assert_ne!(old.certificate, new.certificate);
        std::fs::write(&new.key_path, "no key").unwrap();
        assert_eq!(files.load_or_make(Utc::now()).unwrap_err().code, ErrorCode::FileFormat);
        assert_eq!(std::fs::read(&new.certificate_path).unwrap(), new.certificate.der());
        // A crash between the two files leaves a key alone.
        std::fs::remove_file(&new.certificate_path).unwrap();
        assert_ne!(files.load_or_make(Utc::now()).unwrap().certificate, new.certificate);
    }
}
