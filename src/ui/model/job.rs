use std::path::PathBuf;
use std::sync::Arc;

use secrecy::SecretString;

use super::trust::TrustTask;
use super::{ImportSource, RowId};
use crate::jobs::TrustUndo;
use crate::jobs::{self, CsrFields, Operation, SelfSignedFields, Step, Summary};
use crate::model::{CertificateType, Credential, ErrorCode, FileFormat, Problem, Validity};
use crate::protocol::CutClient;
use crate::session::opcua_client::Patience;
use crate::texts::TextKey;
use crate::workspace::Workspace;

/// Tells the events of one job from those of another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct JobId(pub u64);

/// What a job does to each of its controllers.
#[derive(Debug, Clone)]
pub enum Task {
    GetInfo,
    Start,
    Stop,
    ReadSettings,
    SetSettings(jobs::SetSettings),
    ListUsers,
    AddUser(jobs::AddUser),
    RemoveUsers(jobs::RemoveUsers),
    SelfSigned {
        fields: SelfSignedFields,
        backup: bool,
    },
    Activate(jobs::Activate),
    // server certificates
    ListCertificates,
    SelectType(CertificateType),
    ExportSelfSigned(FileFormat),
    CreateCsr {
        fields: CsrFields,
        format: FileFormat,
        backup: bool,
    },
    Check(ImportSource),
    Import {
        source: ImportSource,
        accept_warnings: bool,
    },
    ExportSettings {
        passphrase: Option<SecretString>,
    },
    ImportSettings {
        passphrase: Option<SecretString>,
        /// Instead of the one in the workspace.
        file: Option<PathBuf>,
    },
    ReadLog,
    DeleteLog,
    SaveLog {
        path: PathBuf,
    },
    Verify {
        login: Option<Credential>,
    },
    TrustConfigurator,
    Trust(TrustTask),
    // the small CA
    SignCsrs(SigningWish),
    PushAuthority(jobs::PushAuthority),
}

/// What the ticked controllers' certificates from the small CA are to be like.
#[derive(Debug, Clone)]
pub struct SigningWish {
    /// For controllers that hold no signing request.
    pub fields: CsrFields,
    pub new_key: bool,
    pub renew: bool,
    pub accept_warnings: bool,
    pub validity: Validity,
    /// Whether keys made here are kept on this computer.
    pub backup: bool,
    pub passphrase: SecretString,
}

impl SigningWish {
    fn operation(&self, workspace: &Workspace) -> jobs::SignCsrs {
        jobs::SignCsrs {
            authority: Arc::new(jobs::SharedAuthority::new(workspace.authority(), self.passphrase.clone())),
            request: jobs::CreateCsr {
                fields: self.fields.clone(),
                format: FileFormat::Der,
                files: workspace.certificate_files(),
                backup: self.backup,
            },
            new_key: self.new_key,
            renew: self.renew,
            validity: self.validity,
            allow_short_keys: false,
            accept_warnings: self.accept_warnings,
        }
    }
}

impl Task {
    pub fn operation(&self, workspace: &Workspace) -> Arc<dyn Operation> {
        match self {
            Self::GetInfo => Arc::new(jobs::GetInfo),
            Self::Start => Arc::new(jobs::StartServer),
            Self::Stop => Arc::new(jobs::StopServer),
            Self::ReadSettings => Arc::new(jobs::ReadSettings),
            Self::SetSettings(operation) => Arc::new(operation.clone()),
            Self::ListUsers => Arc::new(jobs::ListUsers),
            Self::AddUser(operation) => Arc::new(operation.clone()),
            Self::RemoveUsers(operation) => Arc::new(operation.clone()),
            Self::Activate(operation) => Arc::new(operation.clone()),
            Self::SelfSigned { fields, backup } => Arc::new(jobs::SelfSigned {
                fields: fields.clone(),
                backup: backup.then(|| workspace.certificate_files()),
            }),
            Self::ListCertificates => Arc::new(jobs::ListCertificates),
            Self::SelectType(kind) => Arc::new(jobs::SelectCertificateType(*kind)),
            Self::ExportSelfSigned(format) => {
                Arc::new(jobs::ExportSelfSigned { format: *format, files: workspace.certificate_files() })
            }
            Self::CreateCsr { fields, format, backup } => Arc::new(jobs::CreateCsr {
                fields: fields.clone(),
                format: *format,
                files: workspace.certificate_files(),
                backup: *backup,
            }),
            Self::Check(source) => source.check(workspace),
            Self::Import { source, accept_warnings } => source.import(*accept_warnings, workspace),
            Self::ExportSettings { passphrase } => {
                Arc::new(jobs::ExportSettings { files: workspace.settings_files(), passphrase: passphrase.clone() })
            }
            Self::ImportSettings { passphrase, file } => {
                let files = match file {
                    Some(file) => workspace.settings_files().of_file(file.clone()),
                    None => workspace.settings_files(),
                };
                Arc::new(jobs::ImportSettings { files, passphrase: passphrase.clone() })
            }
            Self::Verify { login } => Arc::new(jobs::Verify {
                identity: workspace.own_identity(),
                login: login.clone(),
                trust_first: false,
                patience: Patience::default(),
            }),
            Self::TrustConfigurator => Arc::new(jobs::TrustConfigurator { identity: workspace.own_identity() }),
            Self::Trust(task) => task.operation(),
            Self::SignCsrs(wish) => Arc::new(wish.operation(workspace)),
            Self::PushAuthority(operation) => Arc::new(operation.clone()),
            Self::ReadLog => Arc::new(jobs::ReadLog { part: jobs::LogPart::End }),
            Self::SaveLog { path } => Arc::new(jobs::SaveLog { path: path.clone() }),
            Self::DeleteLog => Arc::new(jobs::SetSettings {
                change: jobs::SettingsChange { delete_log: true, ..Default::default() },
                ..Default::default()
            }),
        }
    }

    pub const fn title(&self) -> TextKey {
        match self {
            Self::GetInfo => TextKey::GetInfo,
            Self::Start => TextKey::Start,
            Self::Stop => TextKey::Stop,
            Self::ReadSettings | Self::SetSettings(_) => TextKey::SettingsTitle,
            Self::ListUsers => TextKey::UsersTitle,
            Self::AddUser(_) => TextKey::AddUserTitle,
            Self::RemoveUsers(_) => TextKey::DeleteUsers,
            Self::SelfSigned { .. } => TextKey::SelfSignedTitle,
            Self::Activate(_) => TextKey::ActivationTitle,
            Self::ListCertificates | Self::SelectType(_) => TextKey::TypeSelectTitle,
            Self::ExportSelfSigned(_) => TextKey::ExportSelfSignedTitle,
            Self::CreateCsr { .. } => TextKey::CsrTitle,
            Self::Check(source) | Self::Import { source, .. } => source.title(),
            Self::ExportSettings { .. } => TextKey::ExportTitle,
            Self::ImportSettings { .. } => TextKey::ImportTitle,
            Self::Verify { .. } => TextKey::VerifyTitle,
            Self::TrustConfigurator => TextKey::TrustConfiguratorTitle,
            Self::SignCsrs(_) => TextKey::CaSignTitle,
            Self::PushAuthority(_) => TextKey::CaCrlTitle,
            Self::ReadLog => TextKey::ServerLog,
            Self::DeleteLog => TextKey::DeleteLog,
            Self::SaveLog { .. } => TextKey::SaveLogTitle,
            Self::Trust(task) => task.title(),
        }
    }

    /// What the button that agrees to it says: the act itself.
    pub const fn act(&self) -> TextKey {
        match self {
            Self::GetInfo => TextKey::GetInfo,
            Self::Start => TextKey::Start,
            Self::Stop => TextKey::Stop,
            Self::SetSettings(_) => TextKey::ActSettings,
            Self::AddUser(_) => TextKey::AddUserTitle,
            Self::RemoveUsers(_) => TextKey::DeleteUsers,
            Self::SelfSigned { .. } => TextKey::ActSelfSigned,
            Self::Activate(_) => TextKey::ActActivate,
            Self::SelectType(_) => TextKey::ActSelectType,
            Self::ExportSelfSigned(_) => TextKey::Export,
            Self::CreateCsr { .. } => TextKey::ActCreateCsr,
            Self::Import { source, .. } => source.act(),
            Self::ExportSettings { .. } => TextKey::ExportButton,
            Self::ImportSettings { .. } => TextKey::ActImportSettings,
            Self::TrustConfigurator => TextKey::TrustTrust,
            Self::SignCsrs(_) => TextKey::ActSignAndImport,
            Self::PushAuthority(_) => TextKey::ActSendCrl,
            Self::DeleteLog => TextKey::DeleteLog,
            Self::Trust(task) => task.act(),
            // These only read: nothing asks before them.
            Self::ReadSettings
            | Self::ListUsers
            | Self::ListCertificates
            | Self::Check(_)
            | Self::ReadLog
            | Self::SaveLog { .. }
            | Self::Verify { .. } => TextKey::Ok,
        }
    }

    /// Nothing to read when all went well: the status bar says so and no click is asked for.
    pub const fn is_quiet(&self) -> bool {
        matches!(self, Self::GetInfo | Self::Start | Self::TrustConfigurator)
    }

    /// Whether a server that runs was started by it, or anew for it.
    pub const fn restarts_server(&self) -> bool {
        matches!(
            self,
            Self::Start
                | Self::SetSettings(_)
                | Self::AddUser(_)
                | Self::RemoveUsers(_)
                | Self::SelfSigned { .. }
                | Self::SelectType(_)
                | Self::Import { .. }
                | Self::ImportSettings { .. }
        )
    }
}

/// Who waits for the job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// The processing dialog.
    Show,
    /// A form that shows what is in the controller.
    LoadSettings,
    LoadUsers,
    /// How many users there are, for a warning; nobody minds if it fails.
    CountUsers,
    LoadPolicies,
    /// What each of several controllers holds; one that cannot be asked does not keep the others out.
    LoadCertificates,
    /// Certificates from elsewhere are looked at before their import; likewise.
    Check,
    LoadLog,
    /// The processing dialog, and in the end the reports; one controller that cannot be asked does not keep the others
    /// out.
    Verify,
    LoadTrust,
    /// The dialog with the lists of one controller, which shows by itself what came of it.
    ChangeTrust,
}

impl Purpose {
    /// Whether the processing dialog shows how far it is.
    pub const fn is_shown(self) -> bool {
        matches!(self, Self::Show | Self::Verify)
    }
}

/// Where a job is with one controller.
#[derive(Debug, Clone, PartialEq)]
pub enum RowState {
    Waiting,
    Step(Step),
    Done,
    Failed(Problem),
    NotStarted,
}

impl RowState {
    pub fn problem(&self) -> Option<&Problem> {
        match self {
            Self::Failed(problem) => Some(problem),
            _ => None,
        }
    }

    /// The connection password is missing, in a closed vault, or no longer the right one.
    pub fn needs_password(&self) -> bool {
        use ErrorCode::{PasswordMissing, VaultLocked, WrongPassword};
        self.problem().is_some_and(|p| matches!(p.code, PasswordMissing | WrongPassword | VaultLocked))
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CancelState {
    #[default]
    No,
    /// "Stop after the step in hand?" is shown.
    Asking,
    Sent,
}

#[derive(Debug)]
pub struct JobRow {
    pub row: RowId,
    pub name: String,
    pub state: RowState,
    /// The file on this computer that was asked for, or that was used.
    pub saved: Option<PathBuf>,
    /// Where files on this computer are now that had to make room.
    pub moved_aside: Vec<PathBuf>,
    /// Whose connections the change ended.
    pub cut: Vec<CutClient>,
    /// What takes a change of whom it trusts back.
    pub undo: Option<TrustUndo>,
}

/// A job, running or ended.
#[derive(Debug)]
pub struct Job {
    pub id: JobId,
    pub task: Task,
    pub purpose: Purpose,
    pub rows: Vec<JobRow>,
    pub finished: usize,
    pub failed: usize,
    pub cancel: CancelState,
    /// Set when it has ended.
    pub summary: Option<Summary>,
}

impl JobRow {
    pub fn new(row: RowId, name: String) -> Self {
        Self { row, name, state: RowState::Waiting, saved: None, moved_aside: Vec::new(), cut: Vec::new(), undo: None }
    }
}

impl Job {
    pub fn names(&self) -> Vec<String> {
        self.rows.iter().map(|row| row.name.clone()).collect()
    }

    pub fn without_password(&self) -> Vec<RowId> {
        self.rows.iter().filter(|row| row.state.needs_password()).map(|row| row.row).collect()
    }
}
