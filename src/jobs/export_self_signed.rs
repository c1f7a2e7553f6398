use async_trait::async_trait;

use super::{Confirmation, JobStep, Operation, OperationOutput, OperationRun, OutputFacts};
use crate::model::{CertificateSummary, CertificateType, ErrorCode, FileFormat, Problem};
use crate::pki::Certificate;
use crate::workspace::{CertificateFiles, SavedFile};

/// Saves a controller's self-signed certificate, in use or not, into its folder on the PC (manual 2.7.1.3).
#[derive(Debug, Clone)]
pub struct ExportSelfSigned {
    /// How the certificate is written to the file.
    pub format: FileFormat,
    /// Where the certificate is saved.
    pub files: CertificateFiles,
}

/// A server certificate was saved on the PC.
#[derive(Debug, Clone, PartialEq)]
pub struct CertificateExported {
    /// Names and dates of the certificate.
    pub summary: CertificateSummary,
    /// The file, and what was moved aside for it.
    pub saved: SavedFile,
}

impl OperationOutput for CertificateExported {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts {
            written: Some(&self.saved.file),
            used: None,
            moved_aside: &self.saved.moved_aside,
            shortcoming: None,
        }
    }
}

#[async_trait]
impl Operation for ExportSelfSigned {
    type Output = CertificateExported;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { moves_files_aside: true, ..Confirmation::default() })
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<CertificateExported, Problem> {
        run.begin(JobStep::Read)?;
        let info = run.session.info().await?;
        let held = run.session.certificates().await?;
        let missing = || Problem::with_detail(ErrorCode::CertificateNotStored, CertificateType::SelfSigned.as_str());
        let certificate = Certificate::from_der(held.value.of(CertificateType::SelfSigned).ok_or_else(missing)?)?;
        run.begin(JobStep::SaveBackup)?;
        let (files, format, password) = (self.files.clone(), self.format, run.password.clone());
        let exporting = certificate.clone();
        let export =
            move || files.export_self_signed(&info.serial, &exporting, format, &password).map_err(Problem::from);
        let saved = run.off_thread(export).await?;
        Ok(CertificateExported { summary: certificate.summary(), saved })
    }
}
