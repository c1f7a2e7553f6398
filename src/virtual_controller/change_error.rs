//! Why a controller refuses a change, one type for each kind of change. `api` has the error code of each.

use thiserror::Error;

use super::opcua::HashError;
use super::state::PortTaken;
use crate::model::{CertificateType, SerialNumber, SettingsError, SubjectError, UserCredentialError, UserName};
use crate::pki::{CrlUnusable, PkiError};
use crate::protocol::{ExportError, MAX_SENT_CRL_BYTES, MAX_TRUST_STEPS};

/// Why the settings of the OPC UA server are not changed (manual 2.6.1).
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SettingsChangeError {
    #[error(transparent)]
    Settings(#[from] SettingsError),
    #[error(transparent)]
    Port(#[from] PortTaken),
    #[error("the server log is switched on with another password")]
    LogPassword,
}

/// Why users are not added or removed (manual 2.6.2).
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum UserChangeError {
    #[error(transparent)]
    Credential(#[from] UserCredentialError),
    #[error("the user {0} exists")]
    Exists(UserName),
    #[error("there are as many users as a controller can have")]
    TooMany,
    #[error("there is no user {0}")]
    NotFound(UserName),
    #[error(transparent)]
    Hash(#[from] HashError),
}

/// Why the controller is not activated (manual 2.6.3).
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ActivationError {
    #[error("this firmware is not activated with keys")]
    FirmwareTooNew,
    #[error("the keys are not those of {0}")]
    WrongKeys(SerialNumber),
}

/// Why a server certificate is not made, imported or selected (manual 2.7.1, 2.7.2).
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum CertificateChangeError {
    #[error("this firmware makes no keys")]
    FirmwareTooOld,
    #[error("this firmware takes no keys from outside")]
    FirmwareTooNew,
    #[error(transparent)]
    Request(#[from] SubjectError),
    #[error(transparent)]
    Pki(#[from] PkiError),
    #[error("a CA-signed certificate is for the key of a CSR")]
    KeyOfCsr,
    #[error("the certificate is not self-signed")]
    NotSelfSigned,
    #[error("there is no CSR")]
    NoCsr,
    #[error("the certificate is for another key than that of the CSR")]
    CsrMismatch,
    #[error("no {} certificate is held", .0.as_str())]
    NotStored(CertificateType),
}

/// Why settings are not exported or imported (manual 2.6.4, 2.6.5).
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum TransferError {
    #[error("this firmware exports and imports no settings")]
    FirmwareTooNew,
    #[error("the passphrase is empty")]
    NoPassphrase,
    #[error(transparent)]
    Export(#[from] ExportError),
    #[error(transparent)]
    Settings(#[from] SettingsChangeError),
    #[error(transparent)]
    User(#[from] UserChangeError),
    #[error("a password is not an argon2id hash of usual cost")]
    CostlyHash,
    #[error(transparent)]
    Activation(#[from] ActivationError),
}

/// Why client lists and CRLs are not changed, or not read (manual 2.7.3).
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum TrustError {
    #[error("this firmware has no list of issuers")]
    FirmwareTooOld,
    #[error("1 to {MAX_TRUST_STEPS} steps make a change")]
    StepCount,
    #[error("the file name is empty, too long, or has characters that no file name has")]
    FileName,
    #[error("no certificate was sent")]
    NoCertificate,
    #[error("{file_name}: {source}")]
    Certificate { file_name: String, source: PkiError },
    #[error("a certificate is moved into another list")]
    SameList,
    #[error("the controller fills this list")]
    FilledByController,
    #[error("{total} > {limit}")]
    ListFull { total: usize, limit: usize },
    #[error("{file_name} is in the list")]
    Duplicate { file_name: String },
    #[error("no certificate was named")]
    NoCertificateNamed,
    #[error("no CRL was named")]
    NoCrlNamed,
    /// The thumbprint of the certificate, or the id of the CRL.
    #[error("{0} is not in the list")]
    NotInList(String),
    #[error("no CRL was sent")]
    NoCrl,
    #[error("{file_name}: larger than {MAX_SENT_CRL_BYTES} bytes")]
    CrlTooLarge { file_name: String },
    #[error("{file_name}: {source}")]
    Crl { file_name: String, source: PkiError },
    #[error("{file_name}: {because}")]
    CrlUnusable { file_name: String, because: CrlUnusable },
    #[error("{file_name}: it is not signed by the authority whose name it carries")]
    CrlSignature { file_name: String },
    #[error("{file_name} is held")]
    DuplicateCrl { file_name: String },
    /// Number and date of both.
    #[error("{file_name}: {new} < {held}")]
    CrlOutdated { file_name: String, new: String, held: String },
    #[error("more than {most}")]
    TooManyCrls { most: usize },
    #[error("{bytes} > {most} bytes")]
    TooManyCrlBytes { bytes: usize, most: usize },
}
