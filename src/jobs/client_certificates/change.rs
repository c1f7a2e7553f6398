use super::TrustSnapshot;
use super::undo::{TrustUndo, undo};
use crate::jobs::{JobStep, OperationOutput, OperationRun, OutputFacts};
use crate::model::{DisconnectedClient, Problem, RevisionToken, TrustStep};

/// What came of a change of lists or CRLs.
#[derive(Debug, Clone, PartialEq)]
pub struct TrustChange {
    /// The lists as they are now.
    pub lists: TrustSnapshot,
    /// Whose open connections the controller ended because of it.
    pub cut: Vec<DisconnectedClient>,
    /// What puts it back; `None` where nothing can, because refused certificates were deleted or because somebody else
    /// changed the configuration at the same time.
    pub undo: Option<TrustUndo>,
}

impl OperationOutput for TrustChange {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts::NONE
    }
}

/// Sends one change that was made up from `before`, and reads what the controller has then.
pub(super) async fn apply(
    run: &mut OperationRun<'_>,
    before: TrustSnapshot,
    steps: Vec<TrustStep>,
    based_on: Option<RevisionToken>,
) -> Result<TrustChange, Problem> {
    run.begin(JobStep::Apply)?;
    let done = run.session.edit_trust(based_on.unwrap_or(before.revision), steps).await?;
    let lists = TrustSnapshot::read(run.session).await?;
    let undo = (lists.revision == done.changed.revision).then(|| undo(&before, &lists)).flatten();
    Ok(TrustChange { lists, cut: done.cut, undo })
}
