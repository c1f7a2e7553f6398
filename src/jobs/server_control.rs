use async_trait::async_trait;

use super::{Confirmation, Done, Operation, Run, ServerEffect, Step};
use crate::model::{Problem, ServerStatus};

/// Starts the OPC UA server (manual 2.4.3).
#[derive(Debug, Clone, Copy)]
pub struct StartServer;

#[async_trait]
impl Operation for StartServer {
    type Output = Done;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut Run<'_>) -> Result<Done, Problem> {
        run.begin(Step::Apply)?;
        run.session.start_server().await?;
        Ok(Done)
    }

    fn wanted_status(&self) -> Option<(ServerStatus, Done)> {
        Some((ServerStatus::Run, Done))
    }
}

/// Stops the OPC UA server, cutting its clients off (manual 2.4.3).
#[derive(Debug, Clone, Copy)]
pub struct StopServer;

#[async_trait]
impl Operation for StopServer {
    type Output = Done;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { server: ServerEffect::Stops, ..Confirmation::default() })
    }

    async fn run(&self, run: &mut Run<'_>) -> Result<Done, Problem> {
        run.begin(Step::Apply)?;
        run.session.stop_server().await?;
        Ok(Done)
    }

    fn wanted_status(&self) -> Option<(ServerStatus, Done)> {
        Some((ServerStatus::Stop, Done))
    }
}
