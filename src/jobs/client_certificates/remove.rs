use async_trait::async_trait;

use super::TrustSnapshot;
use super::change::{TrustChange, apply};
use crate::jobs::{Confirmation, JobStep, Operation, OperationRun};
use crate::model::{ClientList, ErrorCode, Problem, RevisionToken, TrustStep};

/// Removes certificates from client lists (manual 2.7.3.2).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RemoveClients {
    /// `None`: from every list they are in.
    pub list: Option<ClientList>,
    /// SHA-1, upper-case hexadecimal.
    pub thumbprints: Vec<String>,
    /// The configuration that a dialog showed; `None` bases the change on the present one.
    pub based_on: Option<RevisionToken>,
}

#[async_trait]
impl Operation for RemoveClients {
    type Output = TrustChange;

    fn confirmation(&self) -> Option<Confirmation> {
        let disconnects_clients = self.list != Some(ClientList::Rejected);
        Some(Confirmation { disconnects_clients, ..Confirmation::default() })
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<TrustChange, Problem> {
        run.begin(JobStep::Read)?;
        let before = TrustSnapshot::read(run.session).await?;
        let lists = match self.list {
            Some(list) => vec![list],
            None => vec![ClientList::Trusted, ClientList::Issuers, ClientList::Rejected],
        };
        if let Some(missing) = self.thumbprints.iter().find(|t| !lists.iter().any(|list| before.holds(*list, t))) {
            return Err(Problem::with_detail(ErrorCode::NotInList, missing));
        }
        let steps = lists
            .into_iter()
            .filter_map(|list| {
                let thumbprints: Vec<String> =
                    self.thumbprints.iter().filter(|t| before.holds(list, t)).cloned().collect();
                (!thumbprints.is_empty()).then_some(TrustStep::Remove { list, thumbprints })
            })
            .collect();
        apply(run, before, steps, self.based_on).await
    }
}

/// Removes CRLs (manual 2.7.3.5).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RemoveCrls {
    /// [`CrlSummary::id`](crate::model::CrlSummary::id) of each.
    pub ids: Vec<String>,
    /// The configuration that a dialog showed; `None` bases the change on the present one.
    pub based_on: Option<RevisionToken>,
}

#[async_trait]
impl Operation for RemoveCrls {
    type Output = TrustChange;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { disconnects_clients: true, ..Confirmation::default() })
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<TrustChange, Problem> {
        run.begin(JobStep::Read)?;
        let before = TrustSnapshot::read(run.session).await?;
        if let Some(missing) = self.ids.iter().find(|id| !before.holds_crl(id)) {
            return Err(Problem::with_detail(ErrorCode::NotInList, missing));
        }
        apply(run, before, vec![TrustStep::RemoveCrls { ids: self.ids.clone() }], self.based_on).await
    }
}
