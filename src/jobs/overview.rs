use async_trait::async_trait;

use super::{Confirmation, JobStep, Operation, OperationOutput, OperationRun, OutputFacts};
use crate::model::{ClientList, Feature, Problem, ServerSettings};

/// Reads what [`ControllerInfo`](crate::model::ControllerInfo) does not hold, for a look at one controller. Changes
/// nothing.
#[derive(Debug, Clone, Copy)]
pub struct ReadOverview;

/// Settings of a controller, and how long its lists are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Overview {
    /// The basic settings.
    pub settings: ServerSettings,
    /// Number of users.
    pub users: usize,
    /// Certificates in the trusted list.
    pub trusted: usize,
    /// Certificates in the rejected list.
    pub rejected: usize,
    /// `None` where the controller has no such list.
    pub issuers: Option<usize>,
    /// Number of CRLs.
    pub crls: usize,
}

impl OperationOutput for Overview {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts::NONE
    }
}

#[async_trait]
impl Operation for ReadOverview {
    type Output = Overview;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<Overview, Problem> {
        run.begin(JobStep::Read)?;
        let session = &mut *run.session;
        let issuers = if session.capabilities().await?.offers(Feature::IssuersList) {
            Some(session.clients(ClientList::Issuers).await?.value.len())
        } else {
            None
        };
        Ok(Overview {
            settings: session.settings().await?.value,
            users: session.users().await?.value.len(),
            trusted: session.clients(ClientList::Trusted).await?.value.len(),
            rejected: session.rejected_clients().await?.value.len(),
            issuers,
            crls: session.crls().await?.value.len(),
        })
    }
}
