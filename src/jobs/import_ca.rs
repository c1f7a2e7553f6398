use std::path::{Path, PathBuf};

use async_trait::async_trait;

use super::{Confirmation, JobController, Operation, Outcome, Run, Step, preflight};
use crate::model::{ControllerInfo, ErrorCode, Problem, SerialNumber};
use crate::pki::{Certificate, Csr, MAX_CERTIFICATE_FILE_BYTES};
use crate::protocol::{Base64Bytes, ImportCaSigned};
use crate::workspace::{CertificateFiles, read_import_file};

/// Where the certificate from the CA is.
#[derive(Debug, Clone)]
pub enum CaCertificateSource {
    /// The only `.der` in each controller's `CASigned` folder.
    Folder(CertificateFiles),
    /// This file, DER or PEM, whatever its name. For one controller only.
    File(PathBuf),
}

impl CaCertificateSource {
    /// Finds and reads the certificate for a controller. Blocks for one small file.
    pub fn read(&self, serial: &SerialNumber) -> Result<Certificate, Problem> {
        match self {
            Self::Folder(files) => read(&files.find_ca_signed(serial)?),
            Self::File(path) => read(path),
        }
    }

    /// Reads the certificate if it is the same whatever the controller: a wrong file is found out before any is asked.
    pub fn read_chosen(&self) -> Result<Option<Certificate>, Problem> {
        match self {
            Self::Folder(_) => Ok(None),
            Self::File(path) => read(path).map(Some),
        }
    }
}

fn read(path: &Path) -> Result<Certificate, Problem> {
    let bytes = read_import_file(path, MAX_CERTIFICATE_FILE_BYTES)?;
    Certificate::from_any(&bytes)
        .map_err(|e| Problem::with_detail(ErrorCode::FileFormat, format!("{}: {e}", path.display())))
}

/// The certificate, if it is for the CSR the controller holds.
async fn read_for_csr(
    source: &CaCertificateSource,
    run: &mut Run<'_>,
    info: &ControllerInfo,
) -> Result<Certificate, Problem> {
    let certificate = source.read(&info.serial)?;
    let held = run.session.certificates().await?;
    let csr = held.value.csr.ok_or(ErrorCode::NoCsr)?;
    if !Csr::from_der(&csr.0)?.matches(&certificate) {
        return Err(ErrorCode::CsrMismatch.into());
    }
    Ok(certificate)
}

/// Imports what a CA issued for the CSR the controller holds, and selects it (manual 2.7.1.5).
///
/// Refused before anything is sent: a certificate for another CSR, and one that clients would refuse
/// ([`ErrorCode::Preflight`]).
#[derive(Debug, Clone)]
pub struct ImportCaCertificate {
    pub source: CaCertificateSource,
    /// Import although some clients may complain. Otherwise that is [`ErrorCode::PreflightWarnings`].
    pub accept_warnings: bool,
}

#[async_trait]
impl Operation for ImportCaCertificate {
    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { stops_server: true, replaces_certificate: true, ..Confirmation::default() })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        match &controller.known {
            Some(known) => self.source.read(&known.serial).map(drop),
            None => Ok(()),
        }
    }

    async fn run(&self, run: &mut Run<'_>) -> Result<Outcome, Problem> {
        run.begin(Step::Read)?;
        let info = run.session.info().await?;
        let certificate = read_for_csr(&self.source, run, &info).await?;
        let findings = preflight::admit(run, &info, &certificate, self.accept_warnings).await?;
        run.begin(Step::Apply)?;
        let change = ImportCaSigned { revision: info.revision, certificate: Base64Bytes(certificate.der().to_vec()) };
        run.session.import_ca_signed(change).await?;
        Ok(Outcome::Imported { summary: certificate.summary(), findings })
    }
}

/// Looks at a certificate from the CA as [`ImportCaCertificate`] would, and changes nothing.
#[derive(Debug, Clone)]
pub struct CheckCaCertificate(pub CaCertificateSource);

#[async_trait]
impl Operation for CheckCaCertificate {
    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut Run<'_>) -> Result<Outcome, Problem> {
        run.begin(Step::Read)?;
        let info = run.session.info().await?;
        let certificate = read_for_csr(&self.0, run, &info).await?;
        let findings = preflight::examine(run, &info, &certificate).await?;
        Ok(Outcome::Checked { summary: certificate.summary(), findings })
    }
}
