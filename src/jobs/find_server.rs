use async_trait::async_trait;

use super::verify::{own_identity, trust_configurator};
use super::{Confirmation, JobStep, Operation, OperationOutput, OperationRun, OutputFacts};
use crate::model::{Problem, SerialNumber};
use crate::session::opcua_client::ControllerServer;
use crate::workspace::{ConfiguratorIdentity, ConfiguratorIdentityFiles};

/// Finds out where the OPC UA server of a controller is and which certificate it must show, for a session that stays
/// open. Fails if the server does not run.
#[derive(Debug, Clone)]
pub struct FindServer {
    /// What this program shows to servers.
    pub identity: ConfiguratorIdentityFiles,
    /// Put this program's certificate into the trusted list first.
    pub trust_first: bool,
}

/// The server of a controller, and what this program connects with.
#[derive(Debug, Clone)]
pub struct FoundServer {
    /// Of the controller.
    pub serial: SerialNumber,
    /// Where it listens, and which certificate it must show.
    pub server: ControllerServer,
    /// What this program shows to it.
    pub own: ConfiguratorIdentity,
}

impl OperationOutput for FoundServer {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts { written: None, used: None, moved_aside: &[], shortcoming: None }
    }
}

#[async_trait]
impl Operation for FindServer {
    type Output = FoundServer;

    fn confirmation(&self) -> Option<Confirmation> {
        self.trust_first.then(Confirmation::default)
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<FoundServer, Problem> {
        run.begin(JobStep::Read)?;
        let own = own_identity(&self.identity, run).await?;
        if self.trust_first {
            trust_configurator(run, &own).await?;
        }
        let serial = run.session.info().await?.serial;
        let server = ControllerServer::find(run.session, run.controller.address.host()).await?;
        Ok(FoundServer { serial, server, own })
    }
}
