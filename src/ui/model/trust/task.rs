use std::sync::Arc;

use crate::jobs::{self, Operation};
use crate::texts::TextKey;

/// What a job does to the lists and CRLs of its controllers.
#[derive(Debug, Clone)]
pub enum TrustTask {
    List,
    Add(jobs::AddTrust),
    RemoveClients(jobs::RemoveClients),
    RemoveCrls(jobs::RemoveCrls),
    Move(jobs::MoveClients),
    Undo(jobs::UndoTrust),
}

impl TrustTask {
    pub fn operation(&self) -> Arc<dyn Operation> {
        match self {
            Self::List => Arc::new(jobs::ListTrust),
            Self::Add(operation) => Arc::new(operation.clone()),
            Self::RemoveClients(operation) => Arc::new(operation.clone()),
            Self::RemoveCrls(operation) => Arc::new(operation.clone()),
            Self::Move(operation) => Arc::new(operation.clone()),
            Self::Undo(operation) => Arc::new(operation.clone()),
        }
    }

    pub const fn title(&self) -> TextKey {
        match self {
            Self::List | Self::RemoveClients(_) | Self::Move(_) => TextKey::TrustTitle,
            Self::Add(jobs::AddTrust { destination: jobs::Destination::Crls, .. }) => TextKey::CrlAddTitle,
            Self::Add(_) => TextKey::TrustAddTitle,
            Self::RemoveCrls(_) => TextKey::CrlTitle,
            Self::Undo(_) => TextKey::TrustUndoTitle,
        }
    }
    /// What the button that agrees to it says: the act itself.
    pub const fn act(&self) -> TextKey {
        match self {
            Self::List => TextKey::Ok,
            Self::Add(jobs::AddTrust { destination: jobs::Destination::Crls, .. }) => TextKey::CrlAddTitle,
            Self::Add(_) => TextKey::TrustAddTitle,
            Self::RemoveClients(_) => TextKey::TrustDeleteTitle,
            Self::RemoveCrls(_) => TextKey::CrlDeleteTitle,
            Self::Move(_) => TextKey::ActMoveClients,
            Self::Undo(_) => TextKey::TrustUndo,
        }
    }
}
