//! What the table keeps of a controller besides its information.

use chrono::{DateTime, Utc};

use super::RowState;
use crate::jobs::Overview;
use crate::texts::TextKey;

/// How the last job ended for a controller since the window was opened.
#[derive(Debug, Clone)]
pub struct LastResult {
    /// The job's name.
    pub title: TextKey,
    pub at: DateTime<Utc>,
    pub state: RowState,
}

/// What was read for the pane, and when.
#[derive(Debug, Clone)]
pub struct OverviewRead {
    pub at: DateTime<Utc>,
    pub overview: Overview,
}
