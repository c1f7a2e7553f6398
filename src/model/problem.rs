use std::fmt;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::Language;
use super::error_texts::REGISTRY;
use super::foreign_text::one_line;

/// Everything that can go wrong between an engineer and a controller, with one stable code each.
///
/// The code is what travels in the management protocol and in `--json`; [`ErrorCode::explain`] gives the message,
/// cause and remedy a person reads (manual 6.1 and 6.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ErrorCode {
    // controller errors, manual 6.1
    #[serde(rename = "7930")]
    NotActivated,
    #[serde(rename = "7931")]
    NoCertificate,
    #[serde(rename = "7932")]
    InvalidParameter,
    #[serde(rename = "7933")]
    PortConflict,
    #[serde(rename = "580")]
    ServerError,
    #[serde(rename = "581")]
    ServerLogOn,
    #[serde(rename = "582")]
    ServerLogFull,
    // reaching a controller
    Unreachable,
    Timeout,
    ConnectionLost,
    AnswerLost,
    HandshakeLost,
    NotAController,
    ProtocolVersion,
    FingerprintChanged,
    FingerprintUnknown,
    WrongPassword,
    PasswordMissing,
    LockedOut,
    SessionExpired,
    // a controller refusing
    FirmwareNotSupported,
    FirmwareTooNew,
    FirmwareTooOld,
    TaskRunning,
    TeachPendantConnected,
    ChangedMeanwhile,
    TooManyUsers,
    UserExists,
    UserNotFound,
    ListFull,
    DuplicateCertificate,
    NotInList,
    NotAnAuthority,
    TooManyCrls,
    DuplicateCrl,
    CrlOutdated,
    DiskFull,
    Refused,
    LogPassword,
    RequestTooLarge,
    // input
    UnknownSeries,
    NothingToChange,
    UnknownComponent,
    BadName,
    BadAddress,
    BadPort,
    BadSettings,
    BadCredential,
    BadCertificateRequest,
    BadCertificate,
    BadCrl,
    BadFingerprint,
    NameTaken,
    AddressTaken,
    UnknownController,
    FileUnreadable,
    NotConfirmed,
    // server certificates and their files
    CsrMismatch,
    NoCsr,
    CertificateNotStored,
    CertificateExpired,
    KeyLengthNotAllowed,
    KeyMismatch,
    WrongKeyPassword,
    FileNotFound,
    SeveralFiles,
    BadFileName,
    FileFormat,
    OneControllerOnly,
    Preflight,
    PreflightWarnings,
    // the small CA
    NoAuthority,
    AuthorityExists,
    AuthorityBusy,
    AuthorityDamaged,
    AuthorityPassphrase,
    NoPassphrase,
    AuthorityExpired,
    CsrRefused,
    ShortKey,
    AlreadySigned,
    UnknownSerial,
    AlreadyRevoked,
    BackupDamaged,
    BackupPassphrase,
    // connecting as a client
    VerifyFailed,
    // activation (2.6.3)
    WrongKeys,
    NotInFile,
    BadActivationKey,
    BadActivationFile,
    // connection list (2.5.3)
    BadConnectionList,
    // settings export (2.6.4, 2.6.5)
    ExportMissing,
    ExportRenamed,
    ExportOfAnother,
    ExportVersion,
    ExportDamaged,
    WrongPassphrase,
    BadPassphrase,
    UnprotectedFile,
    // the PC
    WorkspaceReadOnly,
    WorkspaceFull,
    WorkspaceBusy,
    FileInUse,
    ConfigurationDamaged,
    KeyringUnavailable,
    VaultMissing,
    VaultExists,
    VaultLocked,
    VaultPassphrase,
    VaultDamaged,
    VaultVersion,
    VaultFull,
    BadPasswordList,
    CannotListen,
    NoDisplay,
    NoFilePicker,
    FolderNotOpened,
    FileTooLarge,
    FileNotRecognised,
    Cancelled,
    Internal,
}

/// What a person reads about an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Explanation {
    pub message: &'static str,
    pub cause: &'static str,
    pub remedy: &'static str,
}

impl ErrorCode {
    /// Every code, in the order of the registry.
    pub fn all() -> impl Iterator<Item = Self> {
        REGISTRY.iter().map(|entry| entry.0)
    }

    /// The code as the protocol and `--json` write it.
    pub fn as_str(self) -> String {
        match serde_json::to_value(self) {
            Ok(serde_json::Value::String(code)) => code,
            _ => unreachable!("a unit variant is a JSON string"),
        }
    }

    /// Whether a controller may give this code. The others are the PC's own findings.
    pub const fn is_a_controllers(self) -> bool {
        use ErrorCode::*;
        !matches!(
            self,
            Unreachable
                | Timeout
                | ConnectionLost
                | AnswerLost
                | HandshakeLost
                | NotAController
                | ProtocolVersion
                | FingerprintChanged
                | FingerprintUnknown
                | PasswordMissing
                | BadFingerprint
                | NameTaken
                | AddressTaken
                | UnknownController
                | UnknownSeries
                | NothingToChange
                | UnknownComponent
                | FileUnreadable
                | NotConfirmed
                | VerifyFailed
                | WorkspaceReadOnly
                | WorkspaceFull
                | WorkspaceBusy
                | FileInUse
                | ConfigurationDamaged
                | KeyringUnavailable
                | VaultMissing
                | VaultExists
                | VaultLocked
                | VaultPassphrase
                | VaultDamaged
                | VaultVersion
                | VaultFull
                | BadPasswordList
                | CannotListen
                | NoFilePicker
                | FolderNotOpened
                | FileTooLarge
                | FileNotRecognised
                | NoAuthority
                | AuthorityExists
                | AuthorityBusy
                | AuthorityDamaged
                | AuthorityPassphrase
                | NoPassphrase
                | AuthorityExpired
                | CsrRefused
                | ShortKey
                | AlreadySigned
                | UnknownSerial
                | AlreadyRevoked
                | BackupDamaged
                | BackupPassphrase
                | UnprotectedFile
                | Cancelled
        )
    }

    /// Whether nothing answered at the controller's address, as while it is switched off.
    pub const fn is_unreached(self) -> bool {
        matches!(self, Self::Unreachable | Self::Timeout | Self::ConnectionLost)
    }

    pub fn explain(self, language: Language) -> Explanation {
        let entry = REGISTRY.iter().find(|entry| entry.0 == self).expect("the registry test covers every code");
        match language {
            Language::En => entry.1,
            Language::Zh => entry.2,
        }
    }
}

/// One failure, as it is shown, logged and sent: a code and, where it helps, one technical detail.
///
/// The detail is free text in English and never holds a secret. It is one line of at most 500 characters, without those
/// that a terminal obeys ([`super::foreign_text`]).
#[derive(Debug, Clone, PartialEq, Eq, Error, Serialize, Deserialize)]
pub struct Problem {
    pub code: ErrorCode,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub detail: Option<String>,
}

impl Problem {
    pub const fn new(code: ErrorCode) -> Self {
        Self { code, detail: None }
    }

    pub fn with_detail(code: ErrorCode, detail: impl fmt::Display) -> Self {
        Self { code, detail: Some(one_line(&detail.to_string(), MAX_DETAIL_CHARS)) }
    }
}

/// A detail may quote what a peer sent.
const MAX_DETAIL_CHARS: usize = 500;

impl From<ErrorCode> for Problem {
    fn from(code: ErrorCode) -> Self {
        Self::new(code)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.code.explain(Language::En).message)?;
        match &self.detail {
            Some(detail) => write!(f, " ({detail})"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every variant of the enum, by the wire name that serde knows it by.
    fn wire_names() -> Vec<String> {
        let refusal = serde_json::from_str::<ErrorCode>("\"?\"").unwrap_err().to_string();
        let known = refusal.split("expected one of ").nth(1).expect("serde lists the variants");
        known.split('`').skip(1).step_by(2).map(str::to_owned).collect()
    }

    #[test]
    fn every_code_is_explained_once_in_both_languages() {
        let mut explained: Vec<String> = ErrorCode::all().map(ErrorCode::as_str).collect();
        let mut known = wire_names();
        explained.sort();
        known.sort();
        assert_eq!(explained, known);
        for code in ErrorCode::all() {
            let (en, zh) = (code.explain(Language::En), code.explain(Language::Zh));
            for text in [en.message, en.cause, en.remedy, zh.message, zh.cause, zh.remedy] {
                assert!(!text.is_empty(), "{code:?}");
            }
            assert!(en.message.is_ascii() && !zh.message.is_ascii(), "{code:?}");
        }
    }

    #[test]
    fn a_detail_is_one_line_that_fits_on_a_screen() {
        let detail = |text: &str| Problem::with_detail(ErrorCode::Internal, text).detail.unwrap();
        assert_eq!(detail("\u{1b}[2Jgone\r\nnext"), "�[2Jgone  next");
        assert_eq!(detail(&"长".repeat(MAX_DETAIL_CHARS)), "长".repeat(MAX_DETAIL_CHARS));
        assert_eq!(detail(&"x".repeat(4_000_000)).chars().count(), MAX_DETAIL_CHARS + 1);
    }

    #[test]
    fn the_manuals_numbers_are_the_codes() {
        assert_eq!(ErrorCode::NotActivated.as_str(), "7930");
        assert_eq!(ErrorCode::PortConflict.as_str(), "7933");
        assert_eq!(ErrorCode::ServerLogFull.as_str(), "582");
        assert_eq!(ErrorCode::WrongPassword.as_str(), "wrong-password");
    }
}
