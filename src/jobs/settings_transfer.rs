use std::path::PathBuf;

use async_trait::async_trait;
use secrecy::SecretString;

use super::{
    Confirmation, JobController, JobStep, Operation, OperationOutput, OperationRun, OutputFacts, ServerEffect,
};
use crate::model::{Feature, Problem};
use crate::workspace::{SettingsFiles, check_passphrase, check_protects_files};

/// Saves the settings, users and keys of legacy controllers to the workspace (manual 2.6.4). The controller seals
/// them: passwords' hashes never lie open on the PC.
#[derive(Debug, Clone)]
pub struct ExportSettings {
    /// Where exports are saved.
    pub files: SettingsFiles,
    /// `None`: each controller's connection password, as with its key files; an empty one is refused
    /// ([`ErrorCode::UnprotectedFile`](crate::model::ErrorCode::UnprotectedFile)).
    pub passphrase: Option<SecretString>,
}

/// Puts exports back into the controllers they were made by, whole or not at all (manual 2.6.5).
#[derive(Debug, Clone)]
pub struct ImportSettings {
    /// Where exports are looked for.
    pub files: SettingsFiles,
    /// What the exports were sealed with; `None`: each controller's connection password.
    pub passphrase: Option<SecretString>,
}

/// The settings of the controller are in this file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SettingsExported {
    /// The file that was written.
    pub path: PathBuf,
}

impl OperationOutput for SettingsExported {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts { written: Some(&self.path), used: None, moved_aside: &[], shortcoming: None }
    }
}

/// The settings of this file are in the controller.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SettingsImported {
    /// The file that was read.
    pub path: PathBuf,
}

impl OperationOutput for SettingsImported {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts { written: None, used: Some(&self.path), moved_aside: &[], shortcoming: None }
    }
}

#[async_trait]
impl Operation for ExportSettings {
    type Output = SettingsExported;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { overwrites_export: true, ..Confirmation::default() })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        self.passphrase.as_ref().map_or(Ok(()), check_passphrase)?;
        controller.capabilities().require(Feature::SettingsTransfer)
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<SettingsExported, Problem> {
        run.begin(JobStep::Read)?;
        let info = run.session.info().await?;
        run.require(Feature::SettingsTransfer).await?;
        if self.passphrase.is_none() {
            check_protects_files(run.password)?;
        }
        let passphrase = self.passphrase.as_ref().unwrap_or(run.password).clone();
        let export = run.session.export_settings(passphrase).await?;
        // Another one's would be refused at the import, when it is too late.
        export.check_for(&info.serial, info.series, info.firmware)?;
        run.begin(JobStep::SaveBackup)?;
        let files = self.files.clone();
        let path = run.on_a_core(move || files.save(&info.serial, &export)).await??;
        Ok(SettingsExported { path })
    }
}

#[async_trait]
impl Operation for ImportSettings {
    type Output = SettingsImported;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { server: ServerEffect::Restarts, replaces_settings: true, ..Confirmation::default() })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        controller.capabilities().require(Feature::SettingsTransfer)
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<SettingsImported, Problem> {
        run.begin(JobStep::Read)?;
        let info = run.session.info().await?;
        run.require(Feature::SettingsTransfer).await?;
        let (files, revision) = (self.files.clone(), info.revision);
        let passphrase = self.passphrase.as_ref().unwrap_or(run.password).clone();
        let tried = passphrase.clone();
        // Mistakes in the file are found before anything is sent.
        let (export, path) = run
            .on_a_core(move || -> Result<_, Problem> {
                let (export, path) = files.load(&info.serial)?;
                export.check_for(&info.serial, info.series, info.firmware)?;
                export.open(&tried)?;
                Ok((export, path))
            })
            .await??;
        run.begin(JobStep::Apply)?;
        run.session.import_settings(revision, export, passphrase).await?;
        Ok(SettingsImported { path })
    }
}
