use async_trait::async_trait;

use super::{Confirmation, JobController, JobStep, NoOutput, Operation, OperationRun, ServerEffect};
use crate::model::{CertificateType, ErrorCode, Feature, Problem, Revisioned, StoredServerCertificates};

/// Reads which server certificates a controller holds, and whether a CSR is waiting for its certificate.
#[derive(Debug, Clone, Copy)]
pub struct ListCertificates;

#[async_trait]
impl Operation for ListCertificates {
    type Output = Revisioned<StoredServerCertificates>;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<Revisioned<StoredServerCertificates>, Problem> {
        run.begin(JobStep::Read)?;
        run.session.certificates().await
    }
}

/// Selects the type of the server certificate (manual 2.7.2). A type that is not held is
/// [`ErrorCode::CertificateNotStored`].
#[derive(Debug, Clone, Copy)]
pub struct SelectCertificateType(pub CertificateType);

#[async_trait]
impl Operation for SelectCertificateType {
    type Output = NoOutput;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { server: ServerEffect::Restarts, changes_certificate: true, ..Confirmation::default() })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        match self.0 {
            CertificateType::UserSpecified => controller.capabilities().require(Feature::UserSpecifiedCertificate),
            CertificateType::SelfSigned | CertificateType::CaSigned => Ok(()),
        }
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<NoOutput, Problem> {
        run.begin(JobStep::Read)?;
        let held = run.session.certificates().await?;
        if self.0 != CertificateType::UserSpecified && held.value.of(self.0).is_none() {
            return Err(Problem::with_detail(ErrorCode::CertificateNotStored, self.0.as_str()));
        }
        run.begin(JobStep::Apply)?;
        run.session.select_certificate(held.revision, self.0).await?;
        Ok(NoOutput)
    }
}
