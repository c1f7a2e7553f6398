//! What the details pane knows about a controller beyond its row.

use super::{BackendCommand, Model, OverviewRead, RowId, Task};
use crate::jobs::ReadOverview;
use crate::texts::TextKey;

impl Model {
    pub(in crate::ui) fn show_details(&mut self, shown: bool) {
        if self.options.window.details != shown {
            self.options.window.details = shown;
            self.unsaved = true;
        }
    }

    /// Reads settings and lists of one controller for the pane.
    pub(in crate::ui) fn read_overview(&mut self, row: RowId) -> Vec<BackendCommand> {
        if self.job.is_some() {
            return vec![];
        }
        let task = Task::with_results(TextKey::RowDetails, ReadOverview, |model, row, result| {
            if let Ok(overview) = result {
                let at = model.now;
                model.rows.set_overview(row, OverviewRead { at, overview });
            }
            vec![]
        });
        self.start(task.in_background(), vec![row], None)
    }
}
