use serde::{Deserialize, Serialize};

use super::{RevisionToken, ServerStatus};

/// A change was applied.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Changed {
    /// The configuration after the change.
    pub revision: RevisionToken,
    /// The state of the OPC UA server after the change.
    pub status: ServerStatus,
}
