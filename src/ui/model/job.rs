use std::path::PathBuf;
use std::sync::Arc;

use secrecy::SecretString;

use super::trust::TrustTask;
use super::{ImportSource, RowId};
use crate::jobs::TrustUndo;
use crate::jobs::{self, CsrFields, Operation, SelfSignedFields, Step, Summary};
use crate::model::{CertificateType, ErrorCode, FileFormat, Problem};
use crate::protocol::CutClient;
use crate::ui::texts::TextKey;
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
    Trust(TrustTask),
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
            Self::Trust(task) => task.operation(),
            Self::ReadLog => Arc::new(jobs::ReadLog { part: jobs::LogPart::End }),
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
            Self::ReadLog => TextKey::ServerLog,
            Self::DeleteLog => TextKey::DeleteLog,
            Self::Trust(task) => task.title(),
        }
    }

    /// Nothing to read when all went well: the status bar says so and no click is asked for.
    pub const fn is_quiet(&self) -> bool {
        matches!(self, Self::GetInfo | Self::Start)
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
    LoadTrust,
    /// The dialog with the lists of one controller, which shows by itself what came of it.
    ChangeTrust,
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

    /// The connection password is missing or no longer the right one.
    pub fn needs_password(&self) -> bool {
        self.problem().is_some_and(|p| matches!(p.code, ErrorCode::PasswordMissing | ErrorCode::WrongPassword))
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
    /// What was asked for and is on this computer now.
    pub saved: Option<PathBuf>,
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
        Self { row, name, state: RowState::Waiting, saved: None, cut: Vec::new(), undo: None }
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
