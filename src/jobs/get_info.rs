use async_trait::async_trait;

use super::{Confirmation, Operation, Outcome, Run};
use crate::model::Problem;

/// "Get new information" (manual 2.4.4.1). The runner reads the information after every operation, so there is
/// nothing left to do.
#[derive(Debug, Clone, Copy)]
pub struct GetInfo;

#[async_trait]
impl Operation for GetInfo {
    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, _run: &mut Run<'_>) -> Result<Outcome, Problem> {
        Ok(Outcome::Done)
    }

    fn is_information(&self) -> bool {
        true
    }
}
