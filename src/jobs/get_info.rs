use async_trait::async_trait;

use super::{Confirmation, NoOutput, Operation, OperationRun};
use crate::model::Problem;

/// "Get new information" (manual 2.4.4.1). The runner reads the information after every operation, so there is
/// nothing left to do.
#[derive(Debug, Clone, Copy)]
pub struct GetInfo;

#[async_trait]
impl Operation for GetInfo {
    type Output = NoOutput;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, _run: &mut OperationRun<'_>) -> Result<NoOutput, Problem> {
        Ok(NoOutput)
    }

    fn is_information(&self) -> bool {
        true
    }
}
