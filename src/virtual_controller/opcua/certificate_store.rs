use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use opcua::crypto::{CertificateStore, X509};
use parking_lot::Mutex;

use crate::platform::replace::remove_if_there;
use crate::platform::{private, replace};

/// The folder the OPC UA crate reads certificates from.
///
/// The crate reads the server's certificate and key from it again for every connection, so the key lies there, for
/// this account's eyes only, until the server is dropped. It asks the folder for trust in every new session: there lie
/// the certificates of clients the gate has let in, and no others.
#[derive(Debug)]
pub(super) struct PkiFolder {
    root: PathBuf,
    /// The file with the server's key. Its name is used once, because a server that was stopped is dropped together
    /// with its last connection, which may be after the next server has started in the same folder.
    key_file: String,
    /// The names of the files in the folder for trusted certificates, the one used longest ago first.
    admitted: Mutex<Vec<String>>,
}

impl PkiFolder {
    /// Creates the folder, or empties it of what an earlier run left. Only this account may read it.
    pub(super) fn create(root: PathBuf) -> io::Result<Self> {
        create_private_folder(&root)?;
        for name in [OWN_CERTIFICATE, NEW_CERTIFICATE] {
            remove_if_there(&root.join(name))?;
        }
        for entry in fs::read_dir(&root)? {
            let path = entry?.path();
            if path.extension().is_some_and(|extension| extension == KEY_EXTENSION) {
                remove_if_there(&path)?;
            }
        }
        for name in [TRUSTED, REJECTED] {
            let path = root.join(name);
            match fs::symlink_metadata(&path) {
                Ok(there) if there.is_dir() => fs::remove_dir_all(&path)?,
                Ok(_) => replace::remove(&path)?,
                Err(e) if e.kind() == io::ErrorKind::NotFound => {}
                Err(e) => return Err(e),
            }
            create_private_folder(&path)?;
        }
        let number = STARTED.fetch_add(1, Ordering::Relaxed);
        Ok(Self { root, key_file: format!("own-{number}.{KEY_EXTENSION}"), admitted: Mutex::default() })
    }

    pub(super) fn root(&self) -> &Path {
        &self.root
    }

    /// The name of the file with the server's key in this folder.
    pub(super) fn key_file(&self) -> &str {
        &self.key_file
    }

    pub(super) fn write_own(&self, certificate_der: &[u8], key_pem: &str) -> io::Result<()> {
        write_private_file(&self.root.join(OWN_CERTIFICATE), certificate_der)?;
        write_private_file(&self.root.join(&self.key_file), key_pem.as_bytes())
    }

    /// Keeps what strangers send off the disk: the crate would store every unknown certificate in the folder for
    /// rejected ones, without any limit, and refuse it even after it became trusted. A plain file in that folder's
    /// place stops it; the crate insists on a folder only while it builds the server.
    pub(super) fn close_rejected(&self) -> io::Result<()> {
        let rejected = self.root.join(REJECTED);
        fs::remove_dir_all(&rejected)?;
        write_private_file(&rejected, &[])
    }

    /// Lets the crate take a client's certificate. `InvalidInput` if it cannot read it, or name a file after it.
    ///
    /// Of more than [`MAX_ADMITTED`], the one used longest ago is forgotten; there are fewer sessions.
    pub(super) fn admit(&self, der: &[u8]) -> io::Result<()> {
        let name = file_name(der).ok_or(io::ErrorKind::InvalidInput)?;
        let mut admitted = self.admitted.lock();
        if let Some(at) = admitted.iter().position(|known| *known == name) {
            let known = admitted.remove(at);
            admitted.push(known);
            return Ok(());
        }
        // Renamed into place, so that the server never reads half a certificate.
        let new = self.root.join(NEW_CERTIFICATE);
        remove_if_there(&new)?;
        write_private_file(&new, der)?;
        replace::rename(&new, &self.root.join(TRUSTED).join(&name))?;
        admitted.push(name);
        if admitted.len() > MAX_ADMITTED {
            let oldest = admitted.remove(0);
            remove_if_there(&self.root.join(TRUSTED).join(oldest))?;
        }
        Ok(())
    }

    /// Keeps the crate from taking a certificate, unless `is_needed`, which is asked while nothing can be admitted.
    /// Should that fail, the gate still does not let it in.
    pub(super) fn forget(&self, der: &[u8], is_needed: impl FnOnce() -> bool) {
        let Some(name) = file_name(der) else { return };
        let mut admitted = self.admitted.lock();
        if is_needed() {
            return;
        }
        let Some(at) = admitted.iter().position(|known| *known == name) else { return };
        let name = admitted.remove(at);
        if let Err(e) = remove_if_there(&self.root.join(TRUSTED).join(name)) {
            tracing::warn!("an OPC UA client's certificate stays in {}: {e}", self.root.display());
        }
    }
}

impl Drop for PkiFolder {
    fn drop(&mut self) {
        if let Err(e) = remove_if_there(&self.root.join(&self.key_file)) {
            tracing::warn!("the OPC UA server's key stays in {}: {e}", self.root.display());
        }
    }
}

/// Where the crate looks for a certificate.
fn file_name(der: &[u8]) -> Option<String> {
    let name = CertificateStore::cert_file_name(&X509::from_der(der).ok()?);
    // The common name in it is free text of the client's owner.
    let harmless = name.len() <= 255 && !name.contains(|c: char| c.is_control() || "/\\:*?\"<>|".contains(c));
    harmless.then_some(name)
}

/// A folder that is there already is made private too.
fn create_private_folder(path: &Path) -> io::Result<()> {
    private::create_folder(path)?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        fs::set_permissions(path, fs::Permissions::from_mode(0o700))?;
    }
    Ok(())
}

fn write_private_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    private::create_file(path)?.write_all(bytes)
}

pub(super) const OWN_CERTIFICATE: &str = "own.der";
const KEY_EXTENSION: &str = "pem";
/// How many servers were started in this process.
static STARTED: AtomicU64 = AtomicU64::new(0);
const NEW_CERTIFICATE: &str = "new.der";
const MAX_ADMITTED: usize = 256;
// The crate's names.
const TRUSTED: &str = "trusted";
const REJECTED: &str = "rejected";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_server_that_is_dropped_late_leaves_the_key_of_the_next_one() {
        let folder = tempfile::tempdir().unwrap();
        let keys = || fs::read_dir(folder.path()).unwrap().filter(|e| e.as_ref().unwrap().path().extension().is_some());
        let stopped = PkiFolder::create(folder.path().to_owned()).unwrap();
        stopped.write_own(b"certificate", "key").unwrap();
        let next = PkiFolder::create(folder.path().to_owned()).unwrap();
        next.write_own(b"certificate", "key").unwrap();
        drop(stopped);
        assert!(folder.path().join(next.key_file()).is_file());
        assert_eq!(keys().count(), 2, "a certificate and a key");
        drop(next);
        assert_eq!(keys().count(), 1, "a certificate");
    }
}
