use serde::{Deserialize, Serialize};

/// Where an error can arise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ErrorOrigin {
    /// Only in a controller. The PC gives the code on when a controller reports it.
    Controller,
    /// Only on the PC. A controller that reports such a code is at fault.
    Pc,
    /// In a controller, and on the PC where it checks the same before it asks a controller.
    Both,
}

macro_rules! error_codes {
    ($($code:ident $wire_name:literal $origin:ident,)*) => {
        /// Everything that can go wrong between an engineer and a controller, with one stable code each.
        ///
        /// The code is what travels in the management protocol and in `--json`. `ErrorCode::explain` gives the message,
        /// cause and remedy that a person reads (manual 6.1 and 6.2).
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        #[non_exhaustive]
        pub enum ErrorCode {
            $(
                #[doc = concat!("`", $wire_name, "`; arises in: ", stringify!($origin), ".")]
                #[serde(rename = $wire_name)]
                $code,
            )*
        }

        impl ErrorCode {
            /// All codes, in the order of their table.
            pub const ALL: &[Self] = &[$(Self::$code),*];

            /// The code as the protocol and `--json` write it.
            pub const fn as_str(self) -> &'static str {
                match self { $(Self::$code => $wire_name),* }
            }

            /// Where the error can arise.
            pub const fn origin(self) -> ErrorOrigin {
                match self { $(Self::$code => ErrorOrigin::$origin),* }
            }
        }
    };
}

impl ErrorCode {
    /// Whether a controller may give this code. The others are the PC's own findings.
    pub const fn is_a_controllers(self) -> bool {
        !matches!(self.origin(), ErrorOrigin::Pc)
    }

    /// Whether nothing answered at the controller's address, as while it is switched off.
    pub const fn is_unreached(self) -> bool {
        matches!(self, Self::Unreachable | Self::Timeout | Self::ConnectionLost)
    }

    /// Whether another try gives the same error until somebody changes something: a watch ends with it instead of trying
    /// again. A wrong password tried again would lock this computer out.
    pub const fn is_lasting(self) -> bool {
        use ErrorCode::*;
        matches!(
            self,
            WrongPassword
                | PasswordMissing
                | VaultLocked
                | LockedOut
                | FingerprintChanged
                | FingerprintUnknown
                | NotAController
                | ProtocolVersion
                | KeyringUnavailable
                | NoCertificate
                | NoSuitableEndpoint
                | ConfiguratorNotTrusted
                | OpcUaLoginRefused
                | FileUnreadable
                | WorkspaceReadOnly
                | RemoteWrongPassword
                | RemotePasswordRequired
                | RemoteCommandUnknown
                | RemoteRequestInvalid
        )
    }
}

// Code, wire name, origin. The texts are in each language's `errors.rs`.
error_codes! {
    // controller errors, manual 6.1
    NotActivated "7930" Controller,
    NoCertificate "7931" Controller,
    InvalidParameter "7932" Controller,
    PortConflict "7933" Both,
    ServerError "580" Controller,
    ServerLogOn "581" Controller,
    ServerLogFull "582" Controller,
    // reaching a controller
    Unreachable "unreachable" Pc,
    Timeout "timeout" Pc,
    ConnectionLost "connection-lost" Pc,
    AnswerLost "answer-lost" Pc,
    HandshakeLost "handshake-lost" Pc,
    NotAController "not-a-controller" Pc,
    ProtocolVersion "protocol-version" Pc,
    FingerprintChanged "fingerprint-changed" Pc,
    FingerprintUnknown "fingerprint-unknown" Pc,
    WrongPassword "wrong-password" Controller,
    PasswordMissing "password-missing" Pc,
    LockedOut "locked-out" Controller,
    SessionExpired "session-expired" Controller,
    // a controller refusing
    FirmwareNotSupported "firmware-not-supported" Both,
    FirmwareTooNew "firmware-too-new" Both,
    FirmwareTooOld "firmware-too-old" Both,
    TaskRunning "task-running" Controller,
    TeachPendantConnected "teach-pendant-connected" Controller,
    ChangedMeanwhile "changed-meanwhile" Both,
    TooManyUsers "too-many-users" Both,
    UserExists "user-exists" Both,
    UserNotFound "user-not-found" Both,
    ListFull "list-full" Both,
    DuplicateCertificate "duplicate-certificate" Both,
    NotInList "not-in-list" Both,
    NotAnAuthority "not-an-authority" Both,
    TooManyCrls "too-many-crls" Both,
    DuplicateCrl "duplicate-crl" Both,
    CrlOutdated "crl-outdated" Both,
    DiskFull "disk-full" Controller,
    Refused "refused" Both,
    LogPassword "log-password" Both,
    RequestTooLarge "request-too-large" Both,
    // input
    UnknownSeries "unknown-series" Pc,
    NothingToChange "nothing-to-change" Pc,
    UnknownComponent "unknown-component" Pc,
    BadName "bad-name" Both,
    BadAddress "bad-address" Pc,
    BadPort "bad-port" Pc,
    BadSettings "bad-settings" Both,
    BadCredential "bad-credential" Both,
    BadCertificateRequest "bad-certificate-request" Both,
    BadCertificate "bad-certificate" Both,
    BadCrl "bad-crl" Both,
    BadFingerprint "bad-fingerprint" Pc,
    NameTaken "name-taken" Pc,
    AddressTaken "address-taken" Pc,
    UnknownController "unknown-controller" Pc,
    FileUnreadable "file-unreadable" Pc,
    NotConfirmed "not-confirmed" Pc,
    // server certificates and their files
    CsrMismatch "csr-mismatch" Both,
    NoCsr "no-csr" Both,
    CertificateNotStored "certificate-not-stored" Both,
    CertificateExpired "certificate-expired" Both,
    KeyLengthNotAllowed "key-length-not-allowed" Both,
    KeyMismatch "key-mismatch" Both,
    WrongKeyPassword "wrong-key-password" Both,
    FileNotFound "file-not-found" Pc,
    SeveralFiles "several-files" Pc,
    BadFileName "bad-file-name" Pc,
    FileFormat "file-format" Both,
    OneControllerOnly "one-controller-only" Pc,
    Preflight "preflight" Pc,
    PreflightWarnings "preflight-warnings" Pc,
    // the small CA
    NoAuthority "no-authority" Pc,
    AuthorityExists "authority-exists" Pc,
    AuthorityBusy "authority-busy" Pc,
    AuthorityDamaged "authority-damaged" Pc,
    AuthorityPassphrase "authority-passphrase" Pc,
    NoPassphrase "no-passphrase" Pc,
    AuthorityExpired "authority-expired" Pc,
    CsrRefused "csr-refused" Pc,
    ShortKey "short-key" Pc,
    AlreadySigned "already-signed" Pc,
    UnknownSerial "unknown-serial" Pc,
    AlreadyRevoked "already-revoked" Pc,
    BackupDamaged "backup-damaged" Pc,
    BackupPassphrase "backup-passphrase" Pc,
    // connecting as a client
    VerifyFailed "verify-failed" Pc,
    ServerNotRunning "server-not-running" Pc,
    NoSuitableEndpoint "no-suitable-endpoint" Pc,
    ConfiguratorNotTrusted "configurator-not-trusted" Pc,
    OpcUaLoginRefused "opcua-login-refused" Pc,
    OpcUaConnectionFailed "opcua-connection-failed" Pc,
    // recording
    NoDataNodes "no-data-nodes" Pc,
    DataSettingsRefused "data-settings-refused" Pc,
    NoRecordingDescription "no-recording-description" Pc,
    // remote commands
    SerialPortUnavailable "serial-port-unavailable" Pc,
    RemoteNoAnswer "remote-no-answer" Pc,
    RemoteOccupied "remote-occupied" Pc,
    RemoteAnswerUnreadable "remote-answer-unreadable" Pc,
    RemoteCommandUnknown "remote-command-unknown" Controller,
    RemoteWrongPassword "remote-wrong-password" Controller,
    RemotePasswordRequired "remote-password-required" Controller,
    RemoteRequestRefused "remote-request-refused" Controller,
    RemoteVariableUnknown "remote-variable-unknown" Controller,
    RemoteLineDisturbed "remote-line-disturbed" Controller,
    RemoteExecuteRunning "remote-execute-running" Controller,
    RemoteSystemError "remote-system-error" Controller,
    RemoteNotReady "remote-not-ready" Controller,
    RemoteOutcomeUnknown "remote-outcome-unknown" Pc,
    RemoteRequestInvalid "remote-request-invalid" Pc,
    BadRemoteTarget "bad-remote-target" Pc,
    // PLCs (FINS)
    PlcUnreachable "plc-unreachable" Pc,
    PlcConnectionRefused "plc-connection-refused" Pc,
    PlcConnectionLost "plc-connection-lost" Pc,
    PlcNoAnswer "plc-no-answer" Pc,
    PlcCommandRefused "plc-command-refused" Pc,
    PlcWriteUnknown "plc-write-unknown" Pc,
    NotFins "not-fins" Pc,
    BadPlcAddress "bad-plc-address" Pc,
    BadPlcValue "bad-plc-value" Pc,
    BadBridgeMap "bad-bridge-map" Pc,
    PlcCannotListen "plc-cannot-listen" Pc,
    // activation (2.6.3)
    WrongKeys "wrong-keys" Both,
    NotInFile "not-in-file" Pc,
    BadActivationKey "bad-activation-key" Both,
    BadActivationFile "bad-activation-file" Pc,
    // connection list (2.5.3)
    BadConnectionList "bad-connection-list" Pc,
    BadIoLabels "bad-io-labels" Pc,
    // settings export (2.6.4, 2.6.5)
    ExportMissing "export-missing" Pc,
    ExportRenamed "export-renamed" Pc,
    ExportOfAnother "export-of-another" Both,
    ExportVersion "export-version" Both,
    ExportDamaged "export-damaged" Both,
    WrongPassphrase "wrong-passphrase" Both,
    BadPassphrase "bad-passphrase" Both,
    UnprotectedFile "unprotected-file" Pc,
    // the PC
    WorkspaceReadOnly "workspace-read-only" Pc,
    WorkspaceFull "workspace-full" Pc,
    WorkspaceBusy "workspace-busy" Pc,
    FileInUse "file-in-use" Pc,
    ConfigurationDamaged "configuration-damaged" Pc,
    KeyringUnavailable "keyring-unavailable" Pc,
    VaultMissing "vault-missing" Pc,
    VaultExists "vault-exists" Pc,
    VaultLocked "vault-locked" Pc,
    VaultPassphrase "vault-passphrase" Pc,
    VaultDamaged "vault-damaged" Pc,
    VaultVersion "vault-version" Pc,
    VaultFull "vault-full" Pc,
    BadPasswordList "bad-password-list" Pc,
    CannotListen "cannot-listen" Pc,
    NoDisplay "no-display" Pc,
    NoFilePicker "no-file-picker" Pc,
    FolderNotOpened "folder-not-opened" Pc,
    FileTooLarge "file-too-large" Pc,
    FileNotRecognised "file-not-recognised" Pc,
    Cancelled "cancelled" Pc,
    Internal "internal" Both,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wire_names_are_unique_and_read_back() {
        for code in ErrorCode::ALL {
            let json = serde_json::to_string(code).unwrap();
            assert_eq!(json, format!("\"{}\"", code.as_str()));
            assert_eq!(serde_json::from_str::<ErrorCode>(&json).unwrap(), *code);
        }
    }

    #[test]
    fn the_manuals_numbers_are_the_codes() {
        assert_eq!(ErrorCode::NotActivated.as_str(), "7930");
        assert_eq!(ErrorCode::PortConflict.as_str(), "7933");
        assert_eq!(ErrorCode::ServerLogFull.as_str(), "582");
        assert_eq!(ErrorCode::WrongPassword.as_str(), "wrong-password");
    }
}
