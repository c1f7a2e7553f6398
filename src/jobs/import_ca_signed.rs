use std::path::{Path, PathBuf};

use async_trait::async_trait;

use super::{
    CertificateChecked, CertificateImported, Confirmation, JobController, JobStep, Operation, OperationRun,
    ServerEffect, preflight,
};
use crate::model::{ControllerInfo, ErrorCode, Problem, SerialNumber};
use crate::pki::{Certificate, Csr, Issuers, MAX_CERTIFICATE_FILE_BYTES, issuers_of, read_bundle};
use crate::workspace::{CertificateFiles, certificate_files_beside, read_import_file};

/// Where the certificate from the CA is.
#[derive(Debug, Clone)]
pub enum CaSignedSource {
    /// The only `.der` in each controller's `CASigned` folder.
    Folder(CertificateFiles),
    /// This file, DER or PEM, of any name; issuers may stand beside the certificate. For one controller only.
    File(PathBuf),
}

impl CaSignedSource {
    /// Finds and reads the file for a controller: what the CA issued, and what it sent with it. Blocks for one small
    /// file.
    pub fn read(&self, serial: &SerialNumber) -> Result<Vec<Certificate>, Problem> {
        read(&self.path(serial)?)
    }

    /// Reads the certificate if it is the same for every controller: a wrong file is refused before a controller is connected to.
    pub fn read_chosen(&self) -> Result<Option<Vec<Certificate>>, Problem> {
        match self {
            Self::Folder(_) => Ok(None),
            Self::File(path) => read(path).map(Some),
        }
    }

    fn path(&self, serial: &SerialNumber) -> Result<PathBuf, Problem> {
        match self {
            Self::Folder(files) => Ok(files.find_ca_signed(serial)?),
            Self::File(path) => Ok(path.clone()),
        }
    }
}

fn read(path: &Path) -> Result<Vec<Certificate>, Problem> {
    let bytes = read_import_file(path, MAX_CERTIFICATE_FILE_BYTES)?;
    read_bundle(&bytes)
        .map(|bundle| bundle.certificates)
        .map_err(|e| Problem::with_detail(ErrorCode::FileFormat, format!("{}: {e}", path.display())))
}

/// The certificate of the file that is for the CSR the controller holds, and its issuers as far as they are in the file
/// or in files beside it.
async fn read_for_csr(
    source: &CaSignedSource,
    run: &mut OperationRun<'_>,
    info: &ControllerInfo,
) -> Result<(Certificate, Issuers), Problem> {
    let (source, serial) = (source.clone(), info.serial.clone());
    let (certificates, beside) = run
        .off_thread(move || {
            let path = source.path(&serial)?;
            let beside = certificate_files_beside(&path);
            Ok((
                read(&path)?,
                beside.iter().filter_map(|bytes| read_bundle(bytes).ok()).flat_map(|b| b.certificates).collect(),
            ))
        })
        .await?;
    let held = run.session.certificates().await?;
    let csr = Csr::from_der(&held.value.csr.ok_or(ErrorCode::NoCsr)?.0)?;
    let issued = certificates.iter().find(|certificate| csr.matches(certificate)).cloned();
    let issued = issued.ok_or(ErrorCode::CsrMismatch)?;
    let known: Vec<Certificate> = certificates.into_iter().chain::<Vec<_>>(beside).collect();
    let issuers = issuers_of(&issued, &known);
    Ok((issued, issuers))
}

/// Imports what a CA issued for the CSR the controller holds, and selects it (manual 2.7.1.5).
///
/// Refused before anything is sent: a certificate for another CSR, and one that clients would refuse
/// ([`ErrorCode::Preflight`]).
#[derive(Debug, Clone)]
pub struct ImportCaSigned {
    /// Where the certificate is.
    pub source: CaSignedSource,
    /// Import although some clients may complain. Otherwise that is [`ErrorCode::PreflightWarnings`].
    pub accept_warnings: bool,
}

#[async_trait]
impl Operation for ImportCaSigned {
    type Output = CertificateImported;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { server: ServerEffect::Restarts, replaces_certificate: true, ..Confirmation::default() })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        match &controller.known {
            Some(known) => self.source.read(&known.serial).map(drop),
            None => Ok(()),
        }
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<CertificateImported, Problem> {
        run.begin(JobStep::Read)?;
        let info = run.session.info().await?;
        let (certificate, _) = read_for_csr(&self.source, run, &info).await?;
        let findings = preflight::admit(run, &info, &certificate, self.accept_warnings).await?;
        run.begin(JobStep::Apply)?;
        run.session.import_ca_signed(info.revision, certificate.der().to_vec()).await?;
        Ok(CertificateImported { summary: certificate.summary(), findings, moved_aside: Vec::new() })
    }
}

/// Looks at a certificate from the CA as [`ImportCaSigned`] would, and changes nothing.
#[derive(Debug, Clone)]
pub struct CheckCaSigned(pub CaSignedSource);

#[async_trait]
impl Operation for CheckCaSigned {
    type Output = CertificateChecked;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<CertificateChecked, Problem> {
        run.begin(JobStep::Read)?;
        let info = run.session.info().await?;
        let (certificate, issuers) = read_for_csr(&self.0, run, &info).await?;
        let findings = preflight::examine(run, &info, &certificate).await?;
        Ok(CertificateChecked { summary: Some(certificate.summary()), findings, issuers: Some(issuers) })
    }
}
