use std::path::PathBuf;

use chrono::{DateTime, Utc};
use secrecy::SecretString;

use super::database::{Database, IssuedCertificate, IssuedFor, MAX_ISSUED, RecordedRevocation, StoredCrl};
use super::files::{AuthorityFiles, AuthorityOverview, ROOT};
use super::{AuthorityError, CertificateState};
use crate::model::{Base64Bytes, CertificateProfile};
use crate::pki::{Certificate, CertificateAuthority, Csr, IssueRequest, RevocationReason, RevokedCertificate};
use crate::workspace::WorkspaceLock;

/// How long a CRL is good for unless told otherwise: a year, because in a small plant a person has to publish the next
/// one by hand, and an expired CRL locks every client out.
pub const DEFAULT_CRL_DAYS: u16 = 365;

/// The small CA, unlocked for signing. Held by one process at a time; given up when dropped.
pub struct UnlockedAuthority {
    files: AuthorityFiles,
    _lock: WorkspaceLock,
    database: Database,
    signing: CertificateAuthority,
    /// For the root's key, which is needed rarely.
    passphrase: SecretString,
}

/// A certificate that was signed, but that the CA does not know of yet. It must not be handed out before
/// [`UnlockedAuthority::record`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnrecordedCertificate {
    certificate: Certificate,
    key: String,
    profile: CertificateProfile,
}

impl UnrecordedCertificate {
    /// The certificate. It is not in the database yet.
    pub const fn certificate(&self) -> &Certificate {
        &self.certificate
    }
}

impl UnlockedAuthority {
    pub(super) fn new(
        files: AuthorityFiles,
        lock: WorkspaceLock,
        database: Database,
        signing: CertificateAuthority,
        passphrase: SecretString,
    ) -> Self {
        Self { files, _lock: lock, database, signing, passphrase }
    }

    /// What the CA is like now. Reads its files.
    pub fn overview(&self) -> Result<AuthorityOverview, AuthorityError> {
        AuthorityOverview::of(self.files.folder(), self.database.clone())
    }

    /// The files of the CA.
    pub const fn files(&self) -> &AuthorityFiles {
        &self.files
    }

    /// The newest certificate for the key of a request that is neither revoked nor expired.
    pub fn valid_for(&self, csr: &Csr, now: DateTime<Utc>) -> Option<&IssuedCertificate> {
        let key = csr.key_digest();
        let valid = |issued: &&IssuedCertificate| issued.key == key && issued.state(now) == CertificateState::Valid;
        self.database.issued.iter().rev().find(valid)
    }

    /// Signs, but leaves it at that: for looking at what would be issued.
    pub fn draft(
        &self,
        csr: &Csr,
        request: &IssueRequest,
        now: DateTime<Utc>,
    ) -> Result<UnrecordedCertificate, AuthorityError> {
        if self.database.issued.len() >= MAX_ISSUED {
            return Err(AuthorityError::Full(MAX_ISSUED));
        }
        let certificate = self.signing.issue(csr, request, now)?;
        Ok(UnrecordedCertificate { certificate, key: csr.key_digest(), profile: request.profile })
    }

    /// Writes down what was signed, then the file of the certificate; if that fails, or the program ends before it, the
    /// file is written when the CA is opened again.
    pub fn record(
        &mut self,
        drafted: UnrecordedCertificate,
        controller: Option<IssuedFor>,
        now: DateTime<Utc>,
    ) -> Result<PathBuf, AuthorityError> {
        let UnrecordedCertificate { certificate, key, profile } = drafted;
        let summary = certificate.summary();
        let path = self.files.issued_path(&summary.serial_number);
        // The one before may still be without its file.
        self.files.write_last(&self.database)?;
        let mut database = self.database.clone();
        database.last = Some(Base64Bytes(certificate.der().to_vec()));
        database.issued.push(IssuedCertificate {
            serial_number: summary.serial_number,
            issued_to: summary.issued_to,
            application_uri: summary.application_uri,
            thumbprint: summary.thumbprint,
            key,
            profile,
            not_before: summary.not_before,
            not_after: summary.not_after,
            issued: now,
            controller,
            revoked: None,
        });
        self.commit(database)?;
        Ok(path)
    }

    /// Signs a request and writes that down. Refuses a key for which there is a valid certificate, unless it is to be
    /// renewed; the former certificate then stays valid.
    pub fn sign(
        &mut self,
        csr: &Csr,
        request: &IssueRequest,
        renew: bool,
        now: DateTime<Utc>,
    ) -> Result<(Certificate, PathBuf), AuthorityError> {
        if !renew && let Some(issued) = self.valid_for(csr, now) {
            return Err(AuthorityError::AlreadySigned {
                serial_number: issued.serial_number.clone(),
                not_after: issued.not_after,
            });
        }
        let drafted = self.draft(csr, request, now)?;
        let certificate = drafted.certificate.clone();
        let path = self.record(drafted, None, now)?;
        Ok((certificate, path))
    }

    /// Revokes certificates and publishes a CRL that says so: all of them, or none if one is not known or is revoked
    /// already.
    pub fn revoke(
        &mut self,
        serial_numbers: &[String],
        reason: RevocationReason,
        now: DateTime<Utc>,
    ) -> Result<(), AuthorityError> {
        let mut database = self.database.clone();
        for serial_number in serial_numbers {
            let issued = database.find(serial_number)?;
            if let Some(RecordedRevocation { at, .. }) = issued.revoked {
                return Err(AuthorityError::AlreadyRevoked { serial_number: issued.serial_number.clone(), at });
            }
            issued.revoked = Some(RecordedRevocation { at: now, reason });
        }
        self.update_crl(&mut database, now)?;
        self.commit(database)
    }

    /// Publishes a new CRL, good for `days`, or as long as the one before; that of the root too, if its key is here.
    pub fn publish_crl(&mut self, days: Option<u16>, now: DateTime<Utc>) -> Result<(), AuthorityError> {
        let mut database = self.database.clone();
        database.crl_days = days.unwrap_or(database.crl_days);
        self.update_crl(&mut database, now)?;
        if let Some(stored) = &mut database.root
            && self.files.has_key(ROOT)
        {
            let root = self.files.unlock(ROOT, stored, &self.passphrase)?;
            // The root has only ever signed the intermediate.
            let none: &[RevokedCertificate] = &[];
            let number = crl_number(stored.crl.number, now);
            stored.crl = StoredCrl::new(number, &root.crl(none, number, now, database.crl_days)?);
        }
        self.commit(database)
    }

    pub(super) const fn database(&self) -> &Database {
        &self.database
    }

    pub(super) const fn passphrase(&self) -> &SecretString {
        &self.passphrase
    }

    fn update_crl(&self, database: &mut Database, now: DateTime<Utc>) -> Result<(), AuthorityError> {
        let number = crl_number(database.signing.crl.number, now);
        let crl = self.signing.crl(&database.revoked(), number, now, database.crl_days)?;
        database.signing.crl = StoredCrl::new(number, &crl);
        Ok(())
    }

    /// The database entry is written first: without it nothing has changed, and with it the change stands even if the
    /// copies of its files cannot be written.
    fn commit(&mut self, database: Database) -> Result<(), AuthorityError> {
        self.files.write_database(&database)?;
        self.database = database;
        self.files.write_copies(&self.database)
    }
}

impl std::fmt::Debug for UnlockedAuthority {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("UnlockedAuthority").field("signing", &self.signing).finish_non_exhaustive()
    }
}

/// Larger than the last one, also if the last ones were forgotten because an old backup was restored.
pub(super) fn crl_number(last: u64, now: DateTime<Utc>) -> u64 {
    u64::try_from(now.timestamp()).unwrap_or_default().max(last.saturating_add(1))
}
