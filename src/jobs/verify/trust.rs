use async_trait::async_trait;

use crate::jobs::{Confirmation, JobStep, NoOutput, Operation, OperationRun, TrustSnapshot};
use crate::model::{Base64Bytes, ClientList, ErrorCode, Problem, TrustStep, clock};
use crate::workspace::{ConfiguratorIdentity, ConfiguratorIdentityFiles};

/// Puts this program's own certificate into the trusted list of a controller, if it is not there yet, so that it may
/// connect as an OPC UA client like any other.
#[derive(Debug, Clone)]
pub struct TrustConfigurator {
    /// The certificate of this program; made first if there is none.
    pub identity: ConfiguratorIdentityFiles,
}

#[async_trait]
impl Operation for TrustConfigurator {
    type Output = NoOutput;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation::default())
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<NoOutput, Problem> {
        run.begin(JobStep::Read)?;
        let own = own(&self.identity, run).await?;
        trust(run, &own).await?;
        Ok(NoOutput)
    }
}

/// The program's own certificate; made if there is none yet.
pub(in crate::jobs) async fn own(
    files: &ConfiguratorIdentityFiles,
    run: &OperationRun<'_>,
) -> Result<ConfiguratorIdentity, Problem> {
    let files = files.clone();
    Ok(run.on_a_core(move || files.load_or_make(clock::now())).await??)
}

/// Does nothing if it is trusted already.
pub(in crate::jobs) async fn trust(run: &mut OperationRun<'_>, own: &ConfiguratorIdentity) -> Result<(), Problem> {
    let before = TrustSnapshot::read(run.session).await?;
    let thumbprint = own.certificate.thumbprint_sha1();
    if before.holds(ClientList::Trusted, &thumbprint) {
        return Ok(());
    }
    let (have, limit) = (before.trusted.len(), before.limits.trusted);
    if have >= limit {
        return Err(Problem::with_detail(ErrorCode::ListFull, format!("{} > {limit}", have + 1)));
    }
    let step = if before.holds(ClientList::Rejected, &thumbprint) {
        TrustStep::Move { from: ClientList::Rejected, to: ClientList::Trusted, thumbprints: vec![thumbprint] }
    } else {
        let name = own.certificate_path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let certificates = vec![(name, Base64Bytes(own.certificate.der().to_vec()))];
        TrustStep::Add { list: ClientList::Trusted, certificates }
    };
    run.begin(JobStep::Apply)?;
    run.session.edit_trust(before.revision, vec![step]).await?;
    Ok(())
}
