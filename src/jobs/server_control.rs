use async_trait::async_trait;

use super::{Confirmation, JobStep, NoOutput, Operation, OperationRun, ServerEffect};
use crate::model::{Problem, ServerStatus};

/// Starts the OPC UA server (manual 2.4.3).
#[derive(Debug, Clone, Copy)]
pub struct StartServer;

#[async_trait]
impl Operation for StartServer {
    type Output = NoOutput;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<NoOutput, Problem> {
        run.begin(JobStep::Apply)?;
        run.session.start_server().await?;
        Ok(NoOutput)
    }

    fn wanted_status(&self) -> Option<(ServerStatus, NoOutput)> {
        Some((ServerStatus::Run, NoOutput))
    }
}

/// Stops the OPC UA server, cutting its clients off (manual 2.4.3).
#[derive(Debug, Clone, Copy)]
pub struct StopServer;

#[async_trait]
impl Operation for StopServer {
    type Output = NoOutput;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { server: ServerEffect::Stops, ..Confirmation::default() })
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<NoOutput, Problem> {
        run.begin(JobStep::Apply)?;
        run.session.stop_server().await?;
        Ok(NoOutput)
    }

    fn wanted_status(&self) -> Option<(ServerStatus, NoOutput)> {
        Some((ServerStatus::Stop, NoOutput))
    }
}
