//! How the errors of the workspace become a [`Problem`]. No other file of the module makes one.

use super::authority::AuthorityError;
use super::vault::VaultError;
use super::{
    ConfiguratorIdentityError, ConnectionListError, DuplicateController, FileError, KeyBackupError, KeyringError,
    LoadedConfiguration, PassphraseError, PasswordError, PasswordListError, RecogniseError, SaveError,
    SettingsFileError, SkippedLine, WorkspaceError,
};
use crate::model::{ErrorCode, Problem, with_sources};

impl LoadedConfiguration {
    /// What to tell the engineer, if anything.
    pub fn notice(&self) -> Option<Problem> {
        self.damaged.as_ref().map(|(path, reason)| {
            Problem::with_detail(ErrorCode::ConfigurationDamaged, format!("{reason}; kept as {}", path.display()))
        })
    }
}

impl SkippedLine {
    /// The mistake to be told about; `None` where leaving the line out is what was wanted.
    pub fn problem(&self, line: usize) -> Option<Problem> {
        let code = match self {
            Self::Usb | Self::Virtual | Self::NameRegistered | Self::AddressRegistered(_) => return None,
            Self::Fields(_) | Self::Quotes | Self::Type(_) => ErrorCode::BadConnectionList,
            Self::Name(_) => ErrorCode::BadName,
            Self::Address(_) => ErrorCode::BadAddress,
            Self::NameTwice(_) => ErrorCode::NameTaken,
            Self::AddressTwice(_) => ErrorCode::AddressTaken,
        };
        Some(Problem::with_detail(code, format!("line {line}: {self}")))
    }
}

impl From<WorkspaceError> for Problem {
    fn from(error: WorkspaceError) -> Self {
        let code = match &error {
            WorkspaceError::NotWritable { .. } => ErrorCode::WorkspaceReadOnly,
            WorkspaceError::Full { .. } => ErrorCode::WorkspaceFull,
            WorkspaceError::Busy(_) => ErrorCode::WorkspaceBusy,
            WorkspaceError::Held(_) => ErrorCode::FileInUse,
            WorkspaceError::Unreadable { .. } => ErrorCode::FileUnreadable,
            WorkspaceError::ReservedName { .. } => ErrorCode::BadFileName,
        };
        Self::with_detail(code, with_sources(&error))
    }
}

impl From<FileError> for Problem {
    fn from(error: FileError) -> Self {
        let code = match &error {
            FileError::Missing { .. } | FileError::NoneOfKind { .. } => ErrorCode::FileNotFound,
            FileError::SeveralOfKind { .. } => ErrorCode::SeveralFiles,
            FileError::BadName(_) => ErrorCode::BadFileName,
            FileError::Unreadable { .. } => ErrorCode::FileUnreadable,
            FileError::TooLarge { .. } => ErrorCode::FileFormat,
        };
        Self::with_detail(code, with_sources(&error))
    }
}

impl From<RecogniseError> for Problem {
    fn from(error: RecogniseError) -> Self {
        let code = match &error {
            RecogniseError::File(FileError::TooLarge { .. }) => ErrorCode::FileTooLarge,
            // No import folder is meant here.
            RecogniseError::File(_) => ErrorCode::FileUnreadable,
            RecogniseError::Unknown(_) => ErrorCode::FileNotRecognised,
        };
        Self::with_detail(code, with_sources(&error))
    }
}

impl From<KeyBackupError> for Problem {
    fn from(error: KeyBackupError) -> Self {
        let code = match error {
            KeyBackupError::File(error) => return error.into(),
            KeyBackupError::NoKey { .. } | KeyBackupError::NoRequest(_) => ErrorCode::FileNotFound,
            KeyBackupError::Content { ref source, .. } => source.code(),
        };
        Self::with_detail(code, with_sources(&error))
    }
}

impl From<ConfiguratorIdentityError> for Problem {
    fn from(error: ConfiguratorIdentityError) -> Self {
        let code = match error {
            ConfiguratorIdentityError::Workspace(error) => return error.into(),
            ConfiguratorIdentityError::Making(error) => return error.into(),
            ConfiguratorIdentityError::Unreadable { .. } => ErrorCode::FileUnreadable,
            ConfiguratorIdentityError::Content { .. } | ConfiguratorIdentityError::Unprotect { .. } => {
                ErrorCode::FileFormat
            }
            ConfiguratorIdentityError::Path(_) => ErrorCode::Internal,
        };
        Self::with_detail(code, with_sources(&error))
    }
}

impl From<SaveError> for Problem {
    fn from(error: SaveError) -> Self {
        match error {
            SaveError::Workspace(error) => error.into(),
            SaveError::Passphrase(error) => error.into(),
            SaveError::Encoding(error) => Self::with_detail(ErrorCode::Internal, error),
        }
    }
}

impl From<SettingsFileError> for Problem {
    fn from(error: SettingsFileError) -> Self {
        let code = match error {
            SettingsFileError::File(error) => return error.into(),
            SettingsFileError::Content(error) => return error.into(),
            SettingsFileError::Renamed(_) => ErrorCode::ExportRenamed,
            SettingsFileError::Missing(_) => ErrorCode::ExportMissing,
        };
        Self::with_detail(code, with_sources(&error))
    }
}

impl From<DuplicateController> for Problem {
    fn from(error: DuplicateController) -> Self {
        match error {
            DuplicateController::Name(name) => Self::with_detail(ErrorCode::NameTaken, name),
            DuplicateController::Address(of) => Self::with_detail(ErrorCode::AddressTaken, of),
        }
    }
}

impl From<ConnectionListError> for Problem {
    fn from(error: ConnectionListError) -> Self {
        Self::with_detail(ErrorCode::BadConnectionList, error)
    }
}

impl From<PasswordListError> for Problem {
    fn from(error: PasswordListError) -> Self {
        Self::with_detail(ErrorCode::BadPasswordList, error)
    }
}

impl From<PassphraseError> for Problem {
    fn from(error: PassphraseError) -> Self {
        match error {
            PassphraseError::TooShort => ErrorCode::BadPassphrase.into(),
            PassphraseError::Empty => ErrorCode::UnprotectedFile.into(),
        }
    }
}

impl From<KeyringError> for Problem {
    fn from(error: KeyringError) -> Self {
        match error {
            KeyringError::None => ErrorCode::KeyringUnavailable.into(),
            KeyringError::Failed(error) => Self::with_detail(ErrorCode::KeyringUnavailable, error),
        }
    }
}

impl From<PasswordError> for Problem {
    fn from(error: PasswordError) -> Self {
        match error {
            PasswordError::Keyring(error) => error.into(),
            PasswordError::Vault(error) => error.into(),
            PasswordError::VaultClosed => ErrorCode::VaultLocked.into(),
            PasswordError::NoVault => ErrorCode::VaultMissing.into(),
        }
    }
}

impl From<VaultError> for Problem {
    fn from(error: VaultError) -> Self {
        let code = match error {
            VaultError::Missing(_) => ErrorCode::VaultMissing,
            VaultError::Exists(_) => ErrorCode::VaultExists,
            VaultError::Damaged { .. } => ErrorCode::VaultDamaged,
            VaultError::Version { .. } => ErrorCode::VaultVersion,
            VaultError::WrongPassphrase(_) => ErrorCode::VaultPassphrase,
            VaultError::PassphraseChanged(_) => ErrorCode::VaultLocked,
            VaultError::TooMany | VaultError::PasswordTooLong => ErrorCode::VaultFull,
            VaultError::Passphrase(error) => return error.into(),
            VaultError::Seal(_) => ErrorCode::Internal,
            VaultError::Workspace(error) => return error.into(),
        };
        Self::with_detail(code, with_sources(&error))
    }
}

impl From<AuthorityError> for Problem {
    fn from(error: AuthorityError) -> Self {
        let code = match error {
            AuthorityError::Workspace(WorkspaceError::Busy(path)) => {
                return Self::with_detail(ErrorCode::AuthorityBusy, path.display());
            }
            AuthorityError::Workspace(error) => return error.into(),
            AuthorityError::Pki(error) => return error.into(),
            AuthorityError::Missing(_) => ErrorCode::NoAuthority,
            AuthorityError::Exists(_) => ErrorCode::AuthorityExists,
            AuthorityError::Damaged { .. } => ErrorCode::AuthorityDamaged,
            AuthorityError::Passphrase(_) => ErrorCode::AuthorityPassphrase,
            AuthorityError::ShortPassphrase(error) => return error.into(),
            AuthorityError::AlreadySigned { .. } => ErrorCode::AlreadySigned,
            AuthorityError::UnknownSerial(_) => ErrorCode::UnknownSerial,
            AuthorityError::AlreadyRevoked { .. } => ErrorCode::AlreadyRevoked,
            AuthorityError::Full(_) => ErrorCode::ListFull,
            AuthorityError::BackupDamaged { .. } => ErrorCode::BackupDamaged,
            AuthorityError::BackupPassphrase(_) => ErrorCode::BackupPassphrase,
            AuthorityError::Unreadable { .. } => ErrorCode::FileUnreadable,
        };
        Self::with_detail(code, with_sources(&error))
    }
}
