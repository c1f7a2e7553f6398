use async_trait::async_trait;

use super::{Confirmation, JobController, Operation, Outcome, Run, Step};
use crate::model::{ClientList, ErrorCode, FirmwareGeneration, ListLimits, Problem};
use crate::pki::Certificate;
use crate::protocol::{AddClients, Base64Bytes};

/// Lists the certificates in one of a controller's client lists (manual 2.7.3.1).
#[derive(Debug, Clone, Copy)]
pub struct ListClients(pub ClientList);

#[async_trait]
impl Operation for ListClients {
    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut Run<'_>) -> Result<Outcome, Problem> {
        run.begin(Step::Read)?;
        Ok(Outcome::Clients(run.session.clients(self.0).await?))
    }
}

/// A certificate read from a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClientCertificateFile {
    pub file_name: String,
    pub certificate: Certificate,
}

/// Adds certificates to a client list (manual 2.7.3.3).
#[derive(Debug, Clone)]
pub struct AddClientCertificates {
    pub list: ClientList,
    pub files: Vec<ClientCertificateFile>,
}

#[async_trait]
impl Operation for AddClientCertificates {
    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation::default())
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        let known = controller.known.as_ref();
        if self.list == ClientList::Issuers && known.is_some_and(|i| i.generation() == FirmwareGeneration::Legacy) {
            return Err(ErrorCode::FirmwareTooOld.into());
        }
        match known {
            Some(info) if self.files.len() > limit(info.limits, self.list) => Err(ErrorCode::ListFull.into()),
            _ => Ok(()),
        }
    }

    async fn run(&self, run: &mut Run<'_>) -> Result<Outcome, Problem> {
        run.begin(Step::Read)?;
        let limits = run.session.info().await?.limits;
        let current = run.session.clients(self.list).await?;
        let held = |c: &Certificate| current.value.iter().any(|listed| listed.certificate.0 == c.der());
        let new: Vec<_> = self
            .files
            .iter()
            .filter(|file| !held(&file.certificate))
            .map(|file| (file.file_name.clone(), Base64Bytes(file.certificate.der().to_vec())))
            .collect();
        if new.is_empty() {
            return Err(ErrorCode::DuplicateCertificate.into());
        }
        let total = current.value.len() + new.len();
        let limit = limit(limits, self.list);
        if total > limit {
            return Err(Problem::with_detail(ErrorCode::ListFull, format!("{total} > {limit}")));
        }
        run.begin(Step::Apply)?;
        run.session.add_clients(self.list, AddClients { revision: current.revision, certificates: new }).await?;
        Ok(Outcome::Done)
    }
}

fn limit(limits: ListLimits, list: ClientList) -> usize {
    match list {
        ClientList::Trusted => limits.trusted,
        ClientList::Issuers => limits.issuers,
        // Kept by the controller; nothing is added to it from outside.
        ClientList::Rejected => 0,
    }
}
