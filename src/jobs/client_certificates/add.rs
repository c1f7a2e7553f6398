use std::sync::Arc;

use async_trait::async_trait;

use super::change::{TrustChange, apply};
use super::{Destination, TrustFile, TrustPlan, TrustSnapshot};
use crate::jobs::{Confirmation, JobController, JobStep, Operation, OperationRun};
use crate::model::Problem;
use crate::model::RevisionToken;

/// Adds certificates to client lists and CRLs (manual 2.7.3.3, 2.7.3.6).
///
/// What goes where is said by a [`TrustPlan`], made anew from what each controller holds. If anything is refused, or
/// nothing is new, nothing is sent.
#[derive(Debug, Clone)]
pub struct AddTrust {
    /// The files, read and parsed once for all controllers.
    pub files: Arc<[TrustFile]>,
    /// Which list certificates go into.
    pub destination: Destination,
    /// The configuration that a dialog showed; `None` bases the change on the present one.
    pub based_on: Option<RevisionToken>,
}

#[async_trait]
impl Operation for AddTrust {
    type Output = TrustChange;

    fn confirmation(&self) -> Option<Confirmation> {
        // A new CRL may revoke a client that is connected.
        let disconnects_clients = self.files.iter().any(|file| !file.bundle.crls.is_empty());
        Some(Confirmation { disconnects_clients, ..Confirmation::default() })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        match &controller.known {
            Some(info) => {
                let (capabilities, limits) = (controller.capabilities(), info.limits);
                TrustPlan::new(&self.files, self.destination, &capabilities, limits, info.clock, None).check()
            }
            None => Ok(()),
        }
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<TrustChange, Problem> {
        run.begin(JobStep::Read)?;
        let before = TrustSnapshot::read(run.session).await?;
        let (files, destination) = (Arc::clone(&self.files), self.destination);
        let (before, steps) = run
            .off_thread(move || {
                let plan = TrustPlan::for_controller(&files, destination, &before);
                plan.check()?;
                Ok((before, plan.steps()))
            })
            .await?;
        apply(run, before, steps, self.based_on).await
    }
}
