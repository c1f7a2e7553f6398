use crate::jobs::JobStep;
use crate::model::{ErrorCode, Problem};

/// Where a job is with one controller.
#[derive(Debug, Clone, PartialEq)]
pub enum RowState {
    /// Its turn has not come.
    Waiting,
    /// The operation is at this step.
    Step(JobStep),
    /// The operation succeeded.
    Done,
    /// The operation failed.
    Failed(Problem),
    /// The job was cancelled before its turn.
    NotStarted,
}

impl RowState {
    /// Why the operation failed.
    pub fn problem(&self) -> Option<&Problem> {
        match self {
            Self::Failed(problem) => Some(problem),
            _ => None,
        }
    }

    /// The connection password is missing, in a closed vault, or no longer the right one.
    pub fn needs_password(&self) -> bool {
        use ErrorCode::{PasswordMissing, VaultLocked, WrongPassword};
        self.problem().is_some_and(|p| matches!(p.code, PasswordMissing | WrongPassword | VaultLocked))
    }
}
