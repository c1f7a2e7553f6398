//! The whole CA in one file: everything of its folder, sealed once more under its passphrase.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;

use chrono::{DateTime, Utc};
use secrecy::SecretString;
use serde::{Deserialize, Serialize};
use zeroize::Zeroizing;

use super::database::{Database, StoredAuthority};
use super::files::{AuthorityFiles, ROOT, SIGNING, UnlockError, unlock_pem};
use super::{AuthorityError, AuthorityOverview, UnlockedAuthority};
use crate::model::{Base64Bytes, text};
use crate::pki::{SEAL_NONCE_BYTES, SEAL_SALT_BYTES, SealError, Sealed, open, seal};
use crate::workspace::{WorkspaceError, read_bounded, write_atomic};

/// Format 1: JSON with exactly these members. What is inside, a [`AuthorityBackupContent`] as JSON, is encrypted with
/// AES-256-GCM under a key that Argon2id makes of passphrase and salt, and authenticated together with
/// [`AuthorityBackup::context`].
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct AuthorityBackup {
    format: String,
    version: u32,
    made: DateTime<Utc>,
    salt: Base64Bytes,
    nonce: Base64Bytes,
    sealed: Base64Bytes,
}

/// Every file of the CA that cannot be made from the others.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct AuthorityBackupContent {
    database: Database,
    /// Encrypted PKCS#8 in PEM, by name.
    keys: BTreeMap<String, String>,
    /// DER, by serial number.
    issued: BTreeMap<String, Base64Bytes>,
}

impl AuthorityBackup {
    fn context(&self) -> String {
        format!("{} {} {}", self.format, self.version, self.made.timestamp_micros())
    }
}

impl UnlockedAuthority {
    /// Writes a backup that the passphrase of the CA opens. Blocks for the size of the CA.
    ///
    /// Not into the folder of the CA: under the name of a key it would be the end of that key.
    pub fn back_up(&self, path: &Path, now: DateTime<Utc>) -> Result<(), AuthorityError> {
        if is_below(path, self.files().folder()) {
            let reason = io::Error::new(io::ErrorKind::InvalidInput, "the folder of the CA is no place for its backup");
            return Err(WorkspaceError::writing(path, reason).into());
        }
        let mut keys = BTreeMap::new();
        for name in [SIGNING, ROOT].into_iter().filter(|name| self.files().has_key(name)) {
            let pem = self.files().read_key_pem(name)?;
            keys.insert(name.to_owned(), String::from_utf8_lossy(&pem).into_owned());
        }
        let mut issued = BTreeMap::new();
        for certificate in &self.database().issued {
            // A file that was never written was never handed out.
            if self.files().issued_path(&certificate.serial_number).exists() {
                let der = self.files().issued(&certificate.serial_number)?.der().to_vec();
                issued.insert(certificate.serial_number.clone(), Base64Bytes(der));
            }
        }
        let content = AuthorityBackupContent { database: self.database().clone(), keys, issued };
        let failed = |e: serde_json::Error| WorkspaceError::writing(path, e.into());
        let plain = Zeroizing::new(serde_json::to_vec(&content).map_err(failed)?);
        let mut backup = AuthorityBackup {
            format: FORMAT.to_owned(),
            version: VERSION,
            made: now,
            salt: Base64Bytes(Vec::new()),
            nonce: Base64Bytes(Vec::new()),
            sealed: Base64Bytes(Vec::new()),
        };
        let sealed = seal(&plain, backup.context().as_bytes(), self.passphrase())
            .map_err(|e| WorkspaceError::writing(path, io::Error::other(e)))?;
        backup.salt = Base64Bytes(sealed.salt.to_vec());
        backup.nonce = Base64Bytes(sealed.nonce.to_vec());
        backup.sealed = Base64Bytes(sealed.bytes);
        write_atomic(path, &serde_json::to_vec_pretty(&backup).map_err(failed)?)?;
        Ok(())
    }
}

impl AuthorityFiles {
    /// Puts a backup back where there is no CA. Nothing is written before all of it was found whole, and there is a CA
    /// only once everything is written.
    pub fn restore(&self, backup: &Path, passphrase: &SecretString) -> Result<AuthorityOverview, AuthorityError> {
        let _lock = self.lock_absent()?;
        let content = read(backup, passphrase)?;
        for (name, pem) in &content.keys {
            self.write_key(name, pem)?;
        }
        for (serial_number, der) in &content.issued {
            write_atomic(&self.issued_path(serial_number), &der.0)?;
        }
        self.write_database(&content.database)?;
        self.write_copies(&content.database)?;
        AuthorityOverview::of(self.folder(), content.database)
    }
}

/// Whether a file, there or not, is in a folder or below it, however the path is written.
fn is_below(file: &Path, folder: &Path) -> bool {
    let Ok(folder) = folder.canonicalize() else { return false };
    // The nearest folder that exists.
    let Ok(file) = std::path::absolute(file) else { return false };
    let there = file.ancestors().skip(1).find_map(|above| above.canonicalize().ok());
    there.is_some_and(|there| there.starts_with(&folder))
}

fn read(path: &Path, passphrase: &SecretString) -> Result<AuthorityBackupContent, AuthorityError> {
    let damaged = |source| AuthorityError::BackupDamaged { path: path.to_owned(), source };
    let bytes = read_bounded(path, MAX_BACKUP_BYTES)
        .map_err(|source| AuthorityError::Unreadable { path: path.to_owned(), source })?;
    if bytes.len() as u64 > MAX_BACKUP_BYTES {
        return Err(damaged(format!("it has more than {MAX_BACKUP_BYTES} bytes").into()));
    }
    let text = text::decode(&bytes).map_err(|e| damaged(e.into()))?;
    let backup: AuthorityBackup = serde_json::from_str(&text).map_err(|e| damaged(e.into()))?;
    if backup.format != FORMAT || backup.version != VERSION {
        return Err(damaged(format!("it is \"{}\", version {}", backup.format, backup.version).into()));
    }
    let context = backup.context();
    let odd = |_| damaged("it is cut short".into());
    let sealed = Sealed {
        salt: <[u8; SEAL_SALT_BYTES]>::try_from(backup.salt.0).map_err(odd)?,
        nonce: <[u8; SEAL_NONCE_BYTES]>::try_from(backup.nonce.0).map_err(odd)?,
        bytes: backup.sealed.0,
    };
    let plain = open(&sealed, context.as_bytes(), passphrase).map_err(|error| match error {
        SealError::NotOpened => AuthorityError::BackupPassphrase(path.to_owned()),
        error => damaged(error.into()),
    })?;
    let content: AuthorityBackupContent = serde_json::from_slice(&plain).map_err(|e| damaged(e.into()))?;
    check(&content, passphrase).map_err(|reason| damaged(reason.into()))?;
    Ok(content)
}

/// What comes back must be a CA that can sign.
fn check(content: &AuthorityBackupContent, passphrase: &SecretString) -> Result<(), String> {
    let check_key = |name: &str, stored: &StoredAuthority| -> Result<(), String> {
        let Some(pem) = content.keys.get(name) else { return Ok(()) };
        match unlock_pem(pem.as_bytes(), stored, passphrase) {
            Ok(_) => Ok(()),
            Err(UnlockError::Passphrase) => Err(format!("{name}.key has another passphrase")),
            Err(UnlockError::Damaged(error)) => Err(format!("{name}.key: {error}")),
        }
    };
    if !content.keys.contains_key(SIGNING) {
        return Err("the key of the CA is missing".to_owned());
    }
    check_key(SIGNING, &content.database.signing)?;
    match &content.database.root {
        Some(root) => check_key(ROOT, root)?,
        None if content.keys.contains_key(ROOT) => return Err("there is a key too many".to_owned()),
        None => {}
    }
    let known: std::collections::HashSet<_> = content.database.issued.iter().map(|i| &i.serial_number).collect();
    let is_key = |name: &String| [SIGNING, ROOT].contains(&name.as_str());
    if !content.keys.keys().all(is_key) || content.issued.keys().any(|serial| !known.contains(serial)) {
        return Err("it holds something the CA does not know of".to_owned());
    }
    // The rules of the database itself, such as that a serial number is one and not a path.
    let json = content.database.to_json().map_err(|e| e.to_string())?;
    Database::from_json(&json, Path::new("ca.json")).map(drop).map_err(|e| e.to_string())
}

const FORMAT: &str = "opcua-configurator-ca";
const VERSION: u32 = 1;
const MAX_BACKUP_BYTES: u64 = 256 * 1024 * 1024;
