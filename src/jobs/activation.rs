use std::sync::Arc;

use async_trait::async_trait;

use super::{Confirmation, JobController, JobStep, NoOutput, Operation, OperationRun, ServerEffect};
use crate::model::activation::{ActivationEntry, ActivationFile, ActivationKeys};
use crate::model::{ErrorCode, Feature, Problem, SerialNumber};

/// Activates legacy controllers by their keys (manual 2.6.3). A controller without keys fails alone, and nothing is
/// sent to it.
#[derive(Debug, Clone)]
pub struct Activate {
    /// The keys of one controller, or a file with the keys of many.
    pub keys: KeySource,
}

/// Where a controller's keys come from.
#[derive(Debug, Clone)]
pub enum KeySource {
    /// Typed in, for one controller.
    Typed(ActivationKeys),
    /// From an activation file, by serial number.
    File(Arc<ActivationFile>),
}

impl KeySource {
    fn keys(&self, serial: &SerialNumber) -> Result<&ActivationKeys, Problem> {
        match self {
            Self::Typed(keys) => Ok(keys),
            Self::File(file) => match file.find(serial) {
                ActivationEntry::Line(line) => Ok(&line.keys),
                ActivationEntry::Mistake(mistake) => {
                    Err(Problem::with_detail(ErrorCode::NotInFile, format!("{serial}, {mistake}")))
                }
                ActivationEntry::Missing => Err(Problem::with_detail(ErrorCode::NotInFile, serial)),
            },
        }
    }
}

#[async_trait]
impl Operation for Activate {
    type Output = NoOutput;

    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { server: ServerEffect::Restarts, ..Confirmation::default() })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        let Some(known) = &controller.known else { return Ok(()) };
        controller.capabilities().require(Feature::ActivationKeys)?;
        self.keys.keys(&known.serial).map(|_| ())
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<NoOutput, Problem> {
        run.begin(JobStep::Read)?;
        let info = run.session.info().await?;
        run.require(Feature::ActivationKeys).await?;
        let keys = self.keys.keys(&info.serial)?.clone();
        run.begin(JobStep::Apply)?;
        run.session.activate(info.revision, keys).await?;
        Ok(NoOutput)
    }
}
