use std::collections::BTreeMap;

use async_trait::async_trait;

use super::change::{TrustChange, apply};
use super::{TrustSnapshot, TrustUndo};
use crate::jobs::{Confirmation, JobController, JobStep, Operation, OperationRun};
use crate::model::{ControllerName, ErrorCode, Problem};

/// Takes changes back, each in the controller it was made in.
///
/// All or nothing in each controller, also if something else was changed meanwhile; refused where that makes it impossible. Its
/// own [`TrustUndo`] does the change once more.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UndoTrust(pub BTreeMap<ControllerName, TrustUndo>);

#[async_trait]
impl Operation for UndoTrust {
    type Output = TrustChange;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { disconnects_clients: true, ..Confirmation::default() })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        if self.0.contains_key(&controller.name) {
            return Ok(());
        }
        Err(Problem::with_detail(ErrorCode::Refused, "nothing was changed here that could be taken back"))
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<TrustChange, Problem> {
        run.begin(JobStep::Read)?;
        let before = TrustSnapshot::read(run.session).await?;
        let steps = self.0.get(&run.controller.name).map(|undo| undo.0.clone()).unwrap_or_default();
        apply(run, before, steps, None).await
    }
}
