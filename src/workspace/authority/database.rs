use std::collections::HashSet;
use std::path::Path;

use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};

use super::AuthorityError;
use crate::model::{Base64Bytes, CertificateProfile, ControllerName, SerialNumber};
use crate::pki::{Certificate, Crl, RevocationReason, RevokedCertificate};

/// Everything the CA must never forget: the content of `ca.json`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Database {
    version: u32,
    /// The CA that signs certificates.
    pub signing: StoredAuthority,
    /// The CA that signed it, if that is not itself.
    pub root: Option<StoredAuthority>,
    /// Oldest first.
    pub issued: Vec<IssuedCertificate>,
    /// The certificate issued last, in DER. Its file is written after this entry, and again if the program ended between
    /// the two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub last: Option<Base64Bytes>,
    /// How long a CRL is good for, as last chosen.
    pub crl_days: u16,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StoredAuthority {
    /// DER.
    pub certificate: Base64Bytes,
    pub crl: StoredCrl,
}

/// The CRL published last.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StoredCrl {
    pub number: u64,
    /// DER.
    pub crl: Base64Bytes,
}

/// One certificate the CA has issued.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IssuedCertificate {
    /// Upper-case hexadecimal.
    pub serial_number: String,
    /// Its common name.
    pub issued_to: String,
    /// The application URI in it; `None` if it has none.
    pub application_uri: Option<String>,
    /// SHA-1 of the DER, upper-case hexadecimal.
    pub thumbprint: String,
    /// SHA-256 of the public key, lower-case hexadecimal: certificates for the same key have the same.
    pub key: String,
    /// Whether it is for a server or a client.
    pub profile: CertificateProfile,
    /// First moment of its validity.
    pub not_before: DateTime<Utc>,
    /// Last moment of its validity.
    pub not_after: DateTime<Utc>,
    /// When it was signed.
    pub issued: DateTime<Utc>,
    /// `None`: for a request from a file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub controller: Option<IssuedFor>,
    /// `None` unless it was revoked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub revoked: Option<RecordedRevocation>,
}

/// The controller a certificate was issued for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IssuedFor {
    /// As it was called then.
    pub name: ControllerName,
    /// Serial number of the controller.
    pub serial: SerialNumber,
}

/// When and why a certificate was revoked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordedRevocation {
    /// When it was revoked.
    pub at: DateTime<Utc>,
    /// Why it was revoked.
    pub reason: RevocationReason,
}

/// Whether a certificate can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CertificateState {
    /// In its validity, and not revoked.
    Valid,
    /// Its validity is over, and it was not revoked before.
    Expired,
    /// Also once it has expired.
    Revoked,
}

impl CertificateState {
    /// `valid`, `expired` or `revoked`: the word in JSON.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Valid => "valid",
            Self::Expired => "expired",
            Self::Revoked => "revoked",
        }
    }
}

impl IssuedCertificate {
    /// Its state at a time. A revoked certificate stays revoked after its validity.
    pub fn state(&self, now: DateTime<Utc>) -> CertificateState {
        if self.revoked.is_some() {
            CertificateState::Revoked
        } else if now > self.not_after {
            CertificateState::Expired
        } else {
            CertificateState::Valid
        }
    }
}

impl StoredAuthority {
    pub fn new(certificate: &Certificate, crl: StoredCrl) -> Self {
        Self { certificate: Base64Bytes(certificate.der().to_vec()), crl }
    }
}

impl StoredCrl {
    pub fn new(number: u64, crl: &Crl) -> Self {
        Self { number, crl: Base64Bytes(crl.der().to_vec()) }
    }
}

impl Database {
    pub fn new(signing: StoredAuthority, root: Option<StoredAuthority>, crl_days: u16) -> Self {
        Self { version: VERSION, signing, root, issued: Vec::new(), last: None, crl_days }
    }

    /// The content of the file at `path`, which only the error names.
    pub fn from_json(json: &[u8], path: &Path) -> Result<Self, AuthorityError> {
        Self::parse(json).map_err(|reason| AuthorityError::Damaged { path: path.to_owned(), source: reason.into() })
    }

    fn parse(json: &[u8]) -> Result<Self, String> {
        #[derive(Deserialize)]
        struct DatabaseHeader {
            version: u32,
        }
        if json.len() as u64 > MAX_DATABASE_BYTES {
            return Err(format!("it has more than {MAX_DATABASE_BYTES} bytes"));
        }
        let DatabaseHeader { version } = serde_json::from_slice(json).map_err(|e| e.to_string())?;
        if version != VERSION {
            return Err(format!("it is of version {version}; this program knows version {VERSION}"));
        }
        let database: Self = serde_json::from_slice(json).map_err(|e| e.to_string())?;
        for stored in std::iter::once(&database.signing).chain(&database.root) {
            Certificate::from_der(&stored.certificate.0).map_err(|e| format!("the certificate of a CA: {e}"))?;
            Crl::from_der(&stored.crl.crl.0).map_err(|e| format!("the CRL of a CA: {e}"))?;
        }
        if let Some(last) = &database.last {
            Certificate::from_der(&last.0).map_err(|e| format!("the certificate issued last: {e}"))?;
        }
        let mut seen = HashSet::new();
        for issued in &database.issued {
            let serial = &issued.serial_number;
            // It also names a file.
            if serial.is_empty() || serial.len() > 40 || hex::decode(serial).is_err() {
                return Err(format!("\"{serial}\" is not a serial number"));
            }
            if !seen.insert(serial) {
                return Err(format!("serial number {serial} is there twice"));
            }
        }
        Ok(database)
    }

    pub fn to_json(&self) -> serde_json::Result<Vec<u8>> {
        serde_json::to_vec_pretty(self)
    }

    /// The certificate with this serial number, however that is written: any case, with colons, with zeros before it.
    pub fn find(&mut self, serial_number: &str) -> Result<&mut IssuedCertificate, AuthorityError> {
        let plain = |text: &str| text.replace([':', ' '], "").trim_start_matches('0').to_ascii_uppercase();
        let wanted = plain(serial_number);
        let found = self.issued.iter_mut().find(|issued| plain(&issued.serial_number) == wanted);
        found.ok_or_else(|| AuthorityError::UnknownSerial(serial_number.to_owned()))
    }

    pub fn revoked(&self) -> Vec<RevokedCertificate> {
        self.issued
            .iter()
            .filter_map(|issued| {
                let RecordedRevocation { at, reason } = issued.revoked?;
                Some(RevokedCertificate { serial_number: issued.serial_number.clone(), at, reason })
            })
            .collect()
    }
}

const VERSION: u32 = 1;
/// About 100,000 certificates.
pub(super) const MAX_DATABASE_BYTES: u64 = 64 * 1024 * 1024;
/// More fit into no CRL that a controller would read.
pub(super) const MAX_ISSUED: usize = 50_000;
