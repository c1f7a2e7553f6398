use std::sync::Arc;

use async_trait::async_trait;
use parking_lot::Mutex;
use secrecy::SecretString;

use super::{
    CertificateImported, Confirmation, CreateCsr, JobController, JobStep, Operation, OperationRun, ServerEffect,
    preflight,
};
use crate::model::{CertificateProfile, CertificateType, ControllerInfo, Problem, ServerStatus, Validity, clock};
use crate::pki::{Certificate, Csr, IssueRequest};
use crate::workspace::authority::{AuthorityFiles, IssuedFor, UnlockedAuthority, UnrecordedCertificate};

/// The small CA for one job: taken up when it is first needed, and held until the job is over.
#[derive(Debug)]
pub struct SharedAuthority {
    files: AuthorityFiles,
    passphrase: SecretString,
    opened: Mutex<Option<UnlockedAuthority>>,
}

impl SharedAuthority {
    /// `passphrase`: that of the CA's key. Nothing is read before the first certificate is needed.
    pub fn new(files: AuthorityFiles, passphrase: SecretString) -> Self {
        Self { files, passphrase, opened: Mutex::new(None) }
    }

    /// Blocks while others use it, and while it is opened.
    fn with<R>(&self, work: impl FnOnce(&mut UnlockedAuthority) -> Result<R, Problem>) -> Result<R, Problem> {
        let mut opened = self.opened.lock();
        match opened.as_mut() {
            Some(authority) => work(authority),
            None => work(opened.insert(self.files.open(&self.passphrase)?)),
        }
    }
}

/// Has the small CA sign what each controller asks for, and imports and selects the certificate, in
/// one operation.
///
/// The signing request is the one the controller holds; one is made where there is none. What is signed is looked at
/// as [`ImportCaSigned`](super::ImportCaSigned) does before the CA writes it down or anything is sent. A
/// request that was signed before, and whose certificate is still valid, gets that certificate: after a failure the
/// operation can simply be repeated. A controller that uses it already is left alone.
#[derive(Debug, Clone)]
pub struct SignCsrs {
    /// The CA, shared by all controllers of the job.
    pub authority: Arc<SharedAuthority>,
    /// How a controller is asked for a signing request.
    pub request: CreateCsr,
    /// Make a new key and request even where there is a request.
    pub new_key: bool,
    /// Sign again what was signed before.
    pub renew: bool,
    /// How long the certificates are valid.
    pub validity: Validity,
    /// See [`IssueRequest::allow_short_keys`].
    pub allow_short_keys: bool,
    /// Import although some clients may complain. Otherwise that is
    /// [`ErrorCode::PreflightWarnings`](crate::model::ErrorCode::PreflightWarnings).
    pub accept_warnings: bool,
}

/// Where the certificate for a request comes from.
enum CertificateOrigin {
    Before(Certificate),
    Now(UnrecordedCertificate),
}

impl CertificateOrigin {
    const fn certificate(&self) -> &Certificate {
        match self {
            Self::Before(certificate) => certificate,
            Self::Now(drafted) => drafted.certificate(),
        }
    }
}

#[async_trait]
impl Operation for SignCsrs {
    type Output = CertificateImported;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation {
            server: ServerEffect::Restarts,
            replaces_certificate: true,
            // A request is also made where there is none.
            invalidates_ca_signed: true,
            moves_files_aside: true,
            ..Confirmation::default()
        })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        self.request.check(controller)
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<CertificateImported, Problem> {
        run.begin(JobStep::Read)?;
        let info = run.session.info().await?;
        let held = run.session.certificates().await?.value;
        let (csr, moved_aside) = match &held.csr {
            Some(csr) if !self.new_key => (Csr::from_der(&csr.0)?, Vec::new()),
            _ => {
                let (csr, saved) = self.request.make(run, &info).await?;
                (csr, saved.moved_aside)
            }
        };
        run.begin(JobStep::Sign)?;
        let signed = self.sign(run, csr).await?;
        let certificate = signed.certificate().clone();
        let findings = preflight::admit(run, &info, &certificate, self.accept_warnings).await?;
        self.record(run, signed, &info).await?;
        let in_use =
            held.selected == CertificateType::CaSigned && held.of(CertificateType::CaSigned) == Some(certificate.der());
        if !in_use {
            run.begin(JobStep::Apply)?;
            // Another one than above, if a request was made.
            let revision = run.session.info().await?.revision;
            let imported = run.session.import_ca_signed(revision, certificate.der().to_vec()).await?;
            // On legacy firmware, a new request took the certificate away from a server that used it.
            if info.status == ServerStatus::Run && imported.changed.status == ServerStatus::Stop {
                run.session.start_server().await?;
            }
        }
        Ok(CertificateImported { summary: certificate.summary(), findings, moved_aside })
    }
}

impl SignCsrs {
    async fn sign(&self, run: &OperationRun<'_>, csr: Csr) -> Result<CertificateOrigin, Problem> {
        let request = IssueRequest {
            profile: CertificateProfile::Server,
            validity: self.validity,
            names: None,
            allow_short_keys: self.allow_short_keys,
        };
        let (authority, renew) = (self.authority.clone(), self.renew);
        run.off_thread(move || {
            authority.with(|authority| {
                let now = clock::now();
                let before = if renew { None } else { authority.valid_for(&csr, now) };
                // A certificate whose file is missing was never handed out.
                match before.and_then(|issued| authority.files().issued(&issued.serial_number).ok()) {
                    Some(certificate) => Ok(CertificateOrigin::Before(certificate)),
                    None => Ok(CertificateOrigin::Now(authority.draft(&csr, &request, now)?)),
                }
            })
        })
        .await
    }

    async fn record(
        &self,
        run: &OperationRun<'_>,
        signed: CertificateOrigin,
        info: &ControllerInfo,
    ) -> Result<(), Problem> {
        let CertificateOrigin::Now(drafted) = signed else { return Ok(()) };
        let controller = IssuedFor { name: run.controller.name.clone(), serial: info.serial.clone() };
        let authority = self.authority.clone();
        run.off_thread(move || {
            authority.with(|authority| Ok(authority.record(drafted, Some(controller), clock::now())?)).map(drop)
        })
        .await
    }
}
