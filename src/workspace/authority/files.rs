use std::io;
use std::path::{Path, PathBuf};

use chrono::{DateTime, Utc};
use secrecy::SecretString;

use super::AuthorityError;
use super::database::{Database, IssuedCertificate, MAX_DATABASE_BYTES, StoredAuthority, StoredCrl};
use super::signing::{UnlockedAuthority, crl_number};
use crate::model::{AuthorityRequest, CertificateSummary, clock};
use crate::pki::{
    Certificate, CertificateAuthority, Crl, MAX_KEY_FILE_BYTES, PkiError, PrivateKey, encrypt_key, read_key_file,
};
use crate::platform::replace;
use crate::workspace::{WorkspaceError, WorkspaceLock, check_passphrase, lock_folder, read_bounded, write_atomic};

/// Where the small CA of a workspace is kept, whether there is one or not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AuthorityFiles {
    folder: PathBuf,
}

/// What a CA is to be made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewAuthority {
    /// What the root certificate is made of.
    pub root: AuthorityRequest,
    /// A CA below the root that signs in its place, so that the root's key can be kept elsewhere.
    pub intermediate: Option<AuthorityRequest>,
    /// How long a CRL is good for, in days.
    pub crl_days: u16,
}

/// The public facts about the CA. Needs no passphrase.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AuthorityOverview {
    /// The folder with the files of the CA.
    pub folder: PathBuf,
    /// The certificate that signs others, and its CRL.
    pub signing: PublishedAuthority,
    /// The CA that signed it, if that is not itself.
    pub root: Option<PublishedAuthority>,
    /// Oldest first.
    pub issued: Vec<IssuedCertificate>,
}

/// A CA's certificate and the CRL it published last.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PublishedAuthority {
    /// The certificate.
    pub certificate: Certificate,
    /// Names and dates of the certificate.
    pub summary: CertificateSummary,
    /// After its `next_update` it proves nothing: certificates of the CA are refused until a newer one is installed.
    pub crl: Crl,
    /// Number of the CRL that was published last.
    pub crl_number: u64,
}

impl AuthorityFiles {
    pub(in crate::workspace) fn new(folder: PathBuf) -> Self {
        Self { folder }
    }

    /// `<workspace>/CA`.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Whether the workspace has a CA.
    pub fn exist(&self) -> bool {
        self.database_path().exists()
    }

    /// Refuses if there is a CA.
    pub fn check_absent(&self) -> Result<(), AuthorityError> {
        if self.exist() { Err(AuthorityError::Exists(self.database_path())) } else { Ok(()) }
    }

    /// Makes a CA, with an empty CRL. Slow: makes one key or two.
    pub fn create(
        &self,
        new: &NewAuthority,
        passphrase: &SecretString,
        now: DateTime<Utc>,
    ) -> Result<UnlockedAuthority, AuthorityError> {
        check_passphrase(passphrase)?;
        let lock = self.lock_absent()?;
        let path_length = u8::from(new.intermediate.is_some());
        let key = PrivateKey::generate(new.root.key_length)?;
        let root = CertificateAuthority::root(&new.root, path_length, key, now)?;
        let below = match &new.intermediate {
            None => None,
            Some(request) => Some(root.intermediate(request, PrivateKey::generate(request.key_length)?, now)?),
        };
        let stored = |ca: &CertificateAuthority| -> Result<_, AuthorityError> {
            let number = crl_number(0, now);
            let crl = StoredCrl::new(number, &ca.crl(&[], number, now, new.crl_days)?);
            Ok(StoredAuthority::new(ca.certificate(), crl))
        };
        let (signing, root) = match below {
            None => (root, None),
            Some(below) => (below, Some(root)),
        };
        let database = Database::new(stored(&signing)?, root.as_ref().map(stored).transpose()?, new.crl_days);
        self.write_key(SIGNING, &encrypt_key(signing.key(), passphrase)?)?;
        if let Some(root) = &root {
            self.write_key(ROOT, &encrypt_key(root.key(), passphrase)?)?;
        }
        self.write_database(&database)?;
        self.write_copies(&database)?;
        Ok(UnlockedAuthority::new(self.clone(), lock, database, signing, passphrase.clone()))
    }

    /// Opens the CA for signing and locks it until the result is dropped. Blocks while the passphrase is
    /// hashed.
    pub fn open(&self, passphrase: &SecretString) -> Result<UnlockedAuthority, AuthorityError> {
        self.read_database()?;
        let lock = lock_folder(&self.folder)?;
        let database = self.read_database()?;
        let signing = self.unlock(SIGNING, &database.signing, passphrase)?;
        self.write_copies(&database)?;
        Ok(UnlockedAuthority::new(self.clone(), lock, database, signing, passphrase.clone()))
    }

    /// Reads the public facts about the CA.
    pub fn overview(&self) -> Result<AuthorityOverview, AuthorityError> {
        AuthorityOverview::of(&self.folder, self.read_database()?)
    }

    /// A certificate that was issued.
    pub fn issued(&self, serial_number: &str) -> Result<Certificate, AuthorityError> {
        let path = self.issued_path(serial_number);
        let bytes = read_bounded(&path, crate::pki::MAX_CERTIFICATE_BYTES as u64)
            .map_err(|e| AuthorityError::Damaged { path: path.clone(), source: e.into() })?;
        Certificate::from_der(&bytes).map_err(|e| AuthorityError::Damaged { path, source: e.into() })
    }

    /// The lock, if there is no CA yet.
    pub(super) fn lock_absent(&self) -> Result<WorkspaceLock, AuthorityError> {
        self.check_absent()?;
        let lock = lock_folder(&self.folder)?;
        self.check_absent()?;
        Ok(lock)
    }

    /// A CA with the key from `<name>.key`.
    pub(super) fn unlock(
        &self,
        name: &str,
        stored: &StoredAuthority,
        passphrase: &SecretString,
    ) -> Result<CertificateAuthority, AuthorityError> {
        let path = self.key_path(name);
        let damaged = |source| AuthorityError::Damaged { path: path.clone(), source };
        let pem = read_bounded(&path, MAX_KEY_FILE_BYTES as u64).map_err(|e| damaged(e.into()))?;
        unlock_pem(&pem, stored, passphrase).map_err(|error| match error {
            UnlockError::Passphrase => AuthorityError::Passphrase(path.clone()),
            UnlockError::Damaged(error) => damaged(error.into()),
        })
    }

    pub(super) fn has_key(&self, name: &str) -> bool {
        self.key_path(name).exists()
    }

    /// Keys are never overwritten: one without a CA, left by a creation that was broken off, is kept under another
    /// name.
    pub(super) fn write_key(&self, name: &str, pem: &str) -> Result<(), WorkspaceError> {
        let path = self.key_path(name);
        if path.exists() {
            let stamp = clock::now().format("%Y%m%dT%H%M%S%3fZ");
            let aside = self.folder.join(format!("{name}.left-{stamp}.key"));
            replace::rename(&path, &aside).map_err(|e| WorkspaceError::writing(&path, e))?;
        }
        write_atomic(&path, pem.as_bytes())
    }

    pub(super) fn read_key_pem(&self, name: &str) -> Result<Vec<u8>, AuthorityError> {
        let path = self.key_path(name);
        read_bounded(&path, MAX_KEY_FILE_BYTES as u64).map_err(|source| AuthorityError::Unreadable { path, source })
    }

    pub(super) fn read_database(&self) -> Result<Database, AuthorityError> {
        let path = self.database_path();
        match read_bounded(&path, MAX_DATABASE_BYTES) {
            Ok(json) => Database::from_json(&json, &path),
            Err(e) if e.kind() == io::ErrorKind::NotFound => Err(AuthorityError::Missing(path)),
            Err(source) => Err(AuthorityError::Unreadable { path, source }),
        }
    }

    /// What is written here is true from now on.
    pub(super) fn write_database(&self, database: &Database) -> Result<(), AuthorityError> {
        let path = self.database_path();
        let json = database.to_json().map_err(|e| WorkspaceError::writing(&path, e.into()))?;
        Ok(write_atomic(&path, &json)?)
    }

    /// What others read, made from the database.
    pub(super) fn write_copies(&self, database: &Database) -> Result<(), AuthorityError> {
        let mut pem = String::new();
        for (name, stored) in [(SIGNING, Some(&database.signing)), (ROOT, database.root.as_ref())] {
            let Some(stored) = stored else { continue };
            self.write_if_other(&format!("{name}.der"), &stored.certificate.0)?;
            self.write_if_other(&format!("{name}.crl"), &stored.crl.crl.0)?;
            pem.push_str(&Certificate::from_der(&stored.certificate.0)?.to_pem());
        }
        self.write_if_other("ca.pem", pem.as_bytes())?;
        self.write_last(database)
    }

    /// Writes the file of the certificate that was issued last, if it is missing.
    pub(super) fn write_last(&self, database: &Database) -> Result<(), AuthorityError> {
        let Some(last) = &database.last else { return Ok(()) };
        let path = self.issued_path(&Certificate::from_der(&last.0)?.summary().serial_number);
        if !path.exists() {
            write_atomic(&path, &last.0)?;
        }
        Ok(())
    }

    fn write_if_other(&self, name: &str, bytes: &[u8]) -> Result<(), AuthorityError> {
        let path = self.folder.join(name);
        if !read_bounded(&path, bytes.len() as u64).is_ok_and(|there| there == bytes) {
            write_atomic(&path, bytes)?;
        }
        Ok(())
    }

    fn database_path(&self) -> PathBuf {
        self.folder.join("ca.json")
    }

    fn key_path(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}.key"))
    }

    /// The file of an issued certificate. `serial_number` is one of the database.
    pub(super) fn issued_path(&self, serial_number: &str) -> PathBuf {
        self.folder.join("issued").join(format!("{serial_number}.der"))
    }
}

impl AuthorityOverview {
    pub(super) fn of(folder: &Path, database: Database) -> Result<Self, AuthorityError> {
        Ok(Self {
            folder: folder.to_owned(),
            signing: PublishedAuthority::of(database.signing)?,
            root: database.root.map(PublishedAuthority::of).transpose()?,
            issued: database.issued,
        })
    }
}

impl PublishedAuthority {
    fn of(stored: StoredAuthority) -> Result<Self, AuthorityError> {
        let certificate = Certificate::from_der(&stored.certificate.0)?;
        Ok(Self {
            summary: certificate.summary(),
            certificate,
            crl: Crl::from_der(&stored.crl.crl.0)?,
            crl_number: stored.crl.number,
        })
    }
}

/// Why a key file gives no CA.
pub(super) enum UnlockError {
    Passphrase,
    Damaged(PkiError),
}

pub(super) fn unlock_pem(
    pem: &[u8],
    stored: &StoredAuthority,
    passphrase: &SecretString,
) -> Result<CertificateAuthority, UnlockError> {
    let certificate = Certificate::from_der(&stored.certificate.0).map_err(UnlockError::Damaged)?;
    let password = secrecy::ExposeSecret::expose_secret(passphrase);
    let encrypted = pem.starts_with(b"-----BEGIN ENCRYPTED PRIVATE KEY-----");
    let key = read_key_file(pem, Some(password)).map_err(|error| match error {
        // A wrong passphrase can also decrypt to something that only looks like a key.
        PkiError::WrongPasswordOrDamaged | PkiError::NotAPrivateKey(_) if encrypted => UnlockError::Passphrase,
        error => UnlockError::Damaged(error),
    })?;
    CertificateAuthority::from_parts(certificate, key).map_err(UnlockError::Damaged)
}

/// The CA that signs certificates: the intermediate, if there is one.
pub(super) const SIGNING: &str = "ca";
/// The root, if there is an intermediate.
pub(super) const ROOT: &str = "root";
