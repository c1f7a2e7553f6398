use async_trait::async_trait;

use super::{Confirmation, Done, Operation, Run};
use crate::model::Problem;

/// "Get new information" (manual 2.4.4.1). The runner reads the information after every operation, so there is
/// nothing left to do.
#[derive(Debug, Clone, Copy)]
pub struct GetInfo;

#[async_trait]
impl Operation for GetInfo {
    type Output = Done;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, _run: &mut Run<'_>) -> Result<Done, Problem> {
        Ok(Done)
    }

    fn is_information(&self) -> bool {
        true
    }
}
