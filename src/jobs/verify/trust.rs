use async_trait::async_trait;
use chrono::Utc;

use crate::jobs::{Confirmation, Operation, Outcome, Run, Step};
use crate::model::{ClientList, ErrorCode, Problem};
use crate::protocol::{AddClients, Base64Bytes};
use crate::workspace::{OwnIdentity, OwnIdentityFiles};

/// Puts this program's own certificate into the trusted list of a controller, if it is not there yet, so that it may
/// connect as an OPC UA client like any other.
#[derive(Debug, Clone)]
pub struct TrustConfigurator {
    pub identity: OwnIdentityFiles,
}

#[async_trait]
impl Operation for TrustConfigurator {
    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation::default())
    }

    async fn run(&self, run: &mut Run<'_>) -> Result<Outcome, Problem> {
        run.begin(Step::Read)?;
        let own = own(&self.identity, run).await?;
        trust(run, &own).await?;
        Ok(Outcome::Done)
    }
}

/// The program's own certificate; made if there is none yet.
pub(super) async fn own(files: &OwnIdentityFiles, run: &Run<'_>) -> Result<OwnIdentity, Problem> {
    let files = files.clone();
    run.on_a_core(move || files.load_or_make(Utc::now())).await?
}

/// Does nothing if it is trusted already.
pub(super) async fn trust(run: &mut Run<'_>, own: &OwnIdentity) -> Result<(), Problem> {
    let limit = run.session.info().await?.limits.trusted;
    let trusted = run.session.clients(ClientList::Trusted).await?;
    if trusted.value.iter().any(|listed| listed.certificate.0 == own.certificate.der()) {
        return Ok(());
    }
    if trusted.value.len() >= limit {
        return Err(Problem::with_detail(ErrorCode::ListFull, format!("{} > {limit}", trusted.value.len() + 1)));
    }
    let name = own.certificate_path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let certificates = vec![(name, Base64Bytes(own.certificate.der().to_vec()))];
    run.begin(Step::Apply)?;
    run.session.add_clients(ClientList::Trusted, AddClients { revision: trusted.revision, certificates }).await?;
    Ok(())
}
