use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use opcua::crypto::{CertificateStore, X509};
use parking_lot::Mutex;

/// The folder the OPC UA crate reads certificates from.
///
/// The crate reads the server's certificate and key from it again for every connection, so the key lies there, for
/// this account's eyes only, until the server is dropped. It asks the folder for trust in every new session, so
/// changing the files changes who is let in. Only exact certificates are trusted; issuers and revocation are not
/// looked at.
#[derive(Debug)]
pub(super) struct PkiFolder {
    root: PathBuf,
    /// Held while the files are changed.
    changing: Mutex<()>,
}

impl PkiFolder {
    /// Creates the folder, or empties it of what an earlier run left. Nobody but this account may look into it.
    pub(super) fn create(root: PathBuf) -> io::Result<Self> {
        create_private_folder(&root)?;
        for name in [OWN_CERTIFICATE, OWN_KEY, NEW_CERTIFICATE] {
            remove_if_there(&root.join(name))?;
        }
        for name in [TRUSTED, REJECTED] {
            let path = root.join(name);
            match fs::symlink_metadata(&path) {
                Ok(there) if there.is_dir() => fs::remove_dir_all(&path)?,
                Ok(_) => fs::remove_file(&path)?,
                Err(e) if e.kind() == io::ErrorKind::NotFound => {}
                Err(e) => return Err(e),
            }
            create_private_folder(&path)?;
        }
        Ok(Self { root, changing: Mutex::new(()) })
    }

    pub(super) fn root(&self) -> &Path {
        &self.root
    }

    pub(super) fn write_own(&self, certificate_der: &[u8], key_pem: &str) -> io::Result<()> {
        write_private_file(&self.root.join(OWN_CERTIFICATE), certificate_der)?;
        write_private_file(&self.root.join(OWN_KEY), key_pem.as_bytes())
    }

    /// Keeps what strangers send off the disk: the crate would store every unknown certificate in the folder for
    /// rejected ones, without any limit, and refuse it even after it became trusted. A plain file in that folder's
    /// place stops it; the crate insists on a folder only while it builds the server.
    pub(super) fn close_rejected(&self) -> io::Result<()> {
        let rejected = self.root.join(REJECTED);
        fs::remove_dir_all(&rejected)?;
        write_private_file(&rejected, &[])
    }

    /// Makes the given certificates the trusted ones. Whoever loses trust loses it first; a certificate the crate
    /// cannot read can never be presented to it either, and is left out.
    pub(super) fn set_trusted(&self, ders: &[Vec<u8>]) -> io::Result<()> {
        let _changing = self.changing.lock();
        let folder = self.root.join(TRUSTED);
        let wanted: BTreeMap<String, &Vec<u8>> =
            ders.iter().filter_map(|der| file_name(der).map(|name| (name, der))).collect();
        for entry in fs::read_dir(&folder)? {
            let entry = entry?;
            if !entry.file_name().to_str().is_some_and(|name| wanted.contains_key(name)) {
                remove_if_there(&entry.path())?;
            }
        }
        for (name, der) in wanted {
            let path = folder.join(name);
            if !path.exists() {
                // Renamed into place, so that the server never reads half a certificate.
                let new = self.root.join(NEW_CERTIFICATE);
                remove_if_there(&new)?;
                write_private_file(&new, der)?;
                fs::rename(&new, &path)?;
            }
        }
        Ok(())
    }
}

impl Drop for PkiFolder {
    fn drop(&mut self) {
        if let Err(e) = remove_if_there(&self.root.join(OWN_KEY)) {
            tracing::warn!("the OPC UA server's key stays in {}: {e}", self.root.display());
        }
    }
}

/// Where the crate looks for a certificate.
fn file_name(der: &[u8]) -> Option<String> {
    let certificate =
        X509::from_der(der).inspect_err(|_| tracing::warn!("trusted certificate left out: not readable")).ok()?;
    let name = CertificateStore::cert_file_name(&certificate);
    // The common name in it is whatever the client's owner wrote.
    let harmless = name.len() <= 255 && !name.contains(|c: char| c.is_control() || "/\\:*?\"<>|".contains(c));
    if !harmless {
        tracing::warn!("trusted certificate left out: its common name cannot name a file");
    }
    harmless.then_some(name)
}

fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(e) if e.kind() != io::ErrorKind::NotFound => Err(e),
        _ => Ok(()),
    }
}

fn create_private_folder(path: &Path) -> io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::{DirBuilderExt as _, PermissionsExt as _};
        builder.mode(0o700).create(path)?;
        fs::set_permissions(path, fs::Permissions::from_mode(0o700))
    }
    #[cfg(not(unix))]
    builder.create(path)
}

fn write_private_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut options = fs::OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.open(path)?.write_all(bytes)
}

pub(super) const OWN_CERTIFICATE: &str = "own.der";
pub(super) const OWN_KEY: &str = "own.pem";
const NEW_CERTIFICATE: &str = "new.der";
// The crate's names.
const TRUSTED: &str = "trusted";
const REJECTED: &str = "rejected";
