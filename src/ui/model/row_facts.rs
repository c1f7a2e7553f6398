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
    /// When the job ended for the controller, by this PC's clock.
    pub at: DateTime<Utc>,
    /// How it ended.
    pub state: RowState,
}

/// What was read for the pane, and when.
#[derive(Debug, Clone)]
pub struct OverviewRead {
    /// When it was read, by this PC's clock.
    pub at: DateTime<Utc>,
    /// What was read.
    pub overview: Overview,
}
