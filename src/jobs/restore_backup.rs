use async_trait::async_trait;
use secrecy::{ExposeSecret as _, SecretString};

use super::self_signed::transfer_password;
use super::{
    CertificateChecked, Confirmation, JobController, JobStep, Operation, OperationOutput, OperationRun, OutputFacts,
    ServerEffect, preflight,
};
use crate::model::{CertificateSummary, CertificateType, ControllerInfo, ErrorCode, Feature, Problem};
use crate::pki::{CertificateFinding, PkiError, pkcs12_write, pkcs12_write_key};
use crate::session::{CsrImport, SealedKey};
use crate::workspace::{BackupKind, KeyBackup, KeyBackupError, KeyBackupSource};

/// Puts a backup of a key back into the controller, under the type it was made as: a self-signed certificate with its
/// key, or a signing request with its key and with what a CA issued for it (manual 2.8.1, appendix B-1).
///
/// Legacy firmware only: keys of current firmware never leave the controller, so there is no backup of them. One change,
/// whole or not at all. Refused before anything is sent: a wrong password, files that do not belong together, and a
/// certificate that clients would refuse ([`ErrorCode::Preflight`]).
#[derive(Debug, Clone)]
pub struct RestoreBackup {
    /// Which backup is put back.
    pub source: KeyBackupSource,
    /// What protects the backup; `None`: the connection password.
    pub password: Option<SecretString>,
    /// Put back although some clients may complain. Otherwise that is [`ErrorCode::PreflightWarnings`].
    pub accept_warnings: bool,
}

/// A backup of a key was put back.
#[derive(Debug, Clone, PartialEq)]
pub struct BackupRestored {
    /// The certificate that the server uses now; `None` if the backup is of a signing request for which no CA has
    /// issued a certificate.
    pub summary: Option<CertificateSummary>,
    /// What clients may complain about, and was accepted.
    pub findings: Vec<CertificateFinding>,
}

impl OperationOutput for BackupRestored {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts::NONE
    }
}

#[async_trait]
impl Operation for RestoreBackup {
    type Output = BackupRestored;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation {
            server: ServerEffect::Restarts,
            replaces_certificate: true,
            replaces_request: self.source.kind == BackupKind::CaSigned,
            ..Confirmation::default()
        })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        controller.capabilities().require(Feature::KeyImport)
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<BackupRestored, Problem> {
        let (info, backup) = read(&self.source, self.password.as_ref(), run).await?;
        let findings = match backup.certificate() {
            Some(certificate) => preflight::admit(run, &info, certificate, self.accept_warnings).await?,
            None => Vec::new(),
        };
        let (alias, password) = (info.serial.to_string(), transfer_password()?);
        let (backup, pkcs12, password) = run
            .on_a_core(move || -> Result<_, PkiError> {
                let pkcs12 = match &backup {
                    KeyBackup::SelfSigned { key, certificate } => {
                        pkcs12_write(&alias, key, &[certificate], password.expose_secret())?
                    }
                    KeyBackup::CaSigned { key, .. } => pkcs12_write_key(&alias, key, password.expose_secret())?,
                };
                Ok((backup, pkcs12, password))
            })
            .await??;
        run.begin(JobStep::Apply)?;
        let (revision, key) = (info.revision, SealedKey { pkcs12, password });
        match &backup {
            KeyBackup::SelfSigned { .. } => {
                run.session.import_certificate(revision, CertificateType::SelfSigned, key).await?;
            }
            KeyBackup::CaSigned { csr, certificate, .. } => {
                let certificate = certificate.as_ref().map(|certificate| certificate.der().to_vec());
                run.session.import_csr(revision, CsrImport { csr: csr.der().to_vec(), key, certificate }).await?;
            }
        }
        Ok(BackupRestored { summary: backup.certificate().map(|certificate| certificate.summary()), findings })
    }
}

/// Looks at a backup as [`RestoreBackup`] would, and changes nothing.
#[derive(Debug, Clone)]
pub struct CheckBackup {
    /// Which backup is looked at.
    pub source: KeyBackupSource,
    /// What protects the backup; `None`: the connection password.
    pub password: Option<SecretString>,
}

#[async_trait]
impl Operation for CheckBackup {
    type Output = CertificateChecked;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        controller.capabilities().require(Feature::KeyImport)
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<CertificateChecked, Problem> {
        let (info, backup) = read(&self.source, self.password.as_ref(), run).await?;
        let Some(certificate) = backup.certificate() else {
            return Ok(CertificateChecked { summary: None, findings: Vec::new(), issuers: None });
        };
        let findings = preflight::examine(run, &info, certificate).await?;
        Ok(CertificateChecked { summary: Some(certificate.summary()), findings, issuers: None })
    }
}

async fn read(
    source: &KeyBackupSource,
    password: Option<&SecretString>,
    run: &mut OperationRun<'_>,
) -> Result<(ControllerInfo, KeyBackup), Problem> {
    run.begin(JobStep::Read)?;
    let info = run.session.info().await?;
    run.require(Feature::KeyImport).await?;
    let (source, serial) = (source.clone(), info.serial.clone());
    let (given, connection) = (password.cloned(), run.password.clone());
    let read = move || {
        let read = |password: &SecretString| source.read(&serial, password);
        match &given {
            Some(password) => read(password),
            None => read(&connection).or_else(|error| match error {
                // Made while the controller had no connection password, by a version that allowed it.
                KeyBackupError::Content { ref source, .. } if source.code() == ErrorCode::WrongKeyPassword => {
                    // The first error is about the password that the file is expected to have.
                    read(&SecretString::default()).map_err(|_| error)
                }
                _ => Err(error),
            }),
        }
    };
    let backup = run.on_a_core(read).await??;
    Ok((info, backup))
}
