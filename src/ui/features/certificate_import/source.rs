use std::path::PathBuf;

use secrecy::SecretString;

use super::ImportForm;
use crate::jobs::{
    CaSignedSource, CheckBackup, CheckCaSigned, CheckUserSpecified, ImportCaSigned, ImportUserSpecified, RestoreBackup,
    UserSpecifiedFiles,
};
use crate::texts::TextKey;
use crate::ui::model::{Model, Task};
use crate::workspace::{BackupKind, KeyBackupSource, Workspace};

/// What is imported.
#[derive(Debug, Clone)]
pub enum ImportSource {
    /// What a CA issued: the only one in each controller's folder, or this file.
    Ca(Option<PathBuf>),
    /// Key and certificate made with another tool.
    User { files: UserSpecifiedFiles, password: Option<SecretString> },
    /// A backup of a key that was made here.
    Backup {
        kind: BackupKind,
        /// Instead of the one in each controller's folder.
        file: Option<PathBuf>,
        /// `None`: the connection password.
        password: Option<SecretString>,
    },
}

impl ImportSource {
    /// What the button that agrees to it says: the act itself.
    pub const fn act(&self) -> TextKey {
        match self {
            Self::Ca(_) | Self::User { .. } => TextKey::ImportButton,
            Self::Backup { .. } => TextKey::CaRestoreNow,
        }
    }

    /// Looks at the certificates and changes nothing.
    ///
    /// `F`: the form that asked, which gets what was found.
    pub(super) fn check<F: ImportForm>(&self, workspace: &Workspace) -> Task {
        let (title, checked) = (self.title(), Model::checked::<F>);
        let task = match self.clone() {
            Self::Ca(file) => Task::with_results(title, CheckCaSigned(ca_source(file, workspace)), checked),
            Self::User { files, password } => {
                Task::with_results(title, CheckUserSpecified { files, password }, checked)
            }
            Self::Backup { kind, file, password } => {
                let source = backup_source(kind, file, workspace);
                Task::with_results(title, CheckBackup { source, password }, checked)
            }
        };
        let source = self.clone();
        task.in_background().on_end(move |model| model.checks_ended::<F>(&source))
    }

    /// The import itself. `accept_warnings`: also of certificates that clients may complain about.
    pub fn import(&self, accept_warnings: bool, workspace: &Workspace) -> Task {
        let title = self.title();
        let task = match self.clone() {
            Self::Ca(file) => Task::new(title, ImportCaSigned { source: ca_source(file, workspace), accept_warnings }),
            Self::User { files, password } => {
                Task::new(title, ImportUserSpecified { files, password, accept_warnings })
            }
            Self::Backup { kind, file, password } => {
                let source = backup_source(kind, file, workspace);
                Task::new(title, RestoreBackup { source, password, accept_warnings })
            }
        };
        task.act(self.act()).restarts_server()
    }

    /// The title of its dialogs.
    pub const fn title(&self) -> TextKey {
        match self {
            Self::Ca(_) => TextKey::CaSignedTitle,
            Self::User { .. } => TextKey::UserSpecifiedTitle,
            Self::Backup { .. } => TextKey::RestoreTitle,
        }
    }
}

fn ca_source(file: Option<PathBuf>, workspace: &Workspace) -> CaSignedSource {
    match file {
        Some(file) => CaSignedSource::File(file),
        None => CaSignedSource::Folder(workspace.certificate_files()),
    }
}

fn backup_source(kind: BackupKind, file: Option<PathBuf>, workspace: &Workspace) -> KeyBackupSource {
    KeyBackupSource { files: workspace.certificate_files(), kind, chosen: file }
}
