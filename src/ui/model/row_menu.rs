//! The context menu of a row, and for which controllers a command is.

use super::{Model, RowId};
use crate::model::Feature;

/// A context menu that is open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowMenu {
    /// The row it belongs to.
    pub row: RowId,
    /// Where it was asked for, in points; `None` with the keyboard: it opens at the row.
    pub at: Option<(f32, f32)>,
}

/// The controllers a command is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Targets {
    /// Every row that is ticked.
    Ticked,
    /// This one alone; the ticks do not count.
    Row(RowId),
}

impl Model {
    /// What the menu of a row acts on: all ticked controllers if it is one of them, else itself alone.
    pub fn targets_of(&self, row: RowId) -> Targets {
        match self.rows.get(row) {
            Some(found) if found.ticked => Targets::Ticked,
            _ => Targets::Row(row),
        }
    }

    /// How many controllers that are.
    pub fn target_count(&self, targets: Targets) -> usize {
        match targets {
            Targets::Ticked => self.rows.ticked_count(),
            Targets::Row(row) => usize::from(self.rows.get(row).is_some()),
        }
    }

    /// Whether one of the controllers is known not to offer this.
    pub fn any_target_lacks(&self, targets: Targets, feature: Feature) -> bool {
        match targets {
            Targets::Ticked => self.rows.any_ticked_lacks(feature),
            Targets::Row(row) => self.any_lacks(&[row], feature),
        }
    }

    /// The identity of every one of the controllers is confirmed.
    pub fn all_targets_are_confirmed(&self, targets: Targets) -> bool {
        match targets {
            Targets::Ticked => self.ticked_unconfirmed().next().is_none(),
            Targets::Row(row) => self.rows.get(row).is_some_and(|row| row.entry.fingerprint.is_some()),
        }
    }

    /// Opens the menu of the row under the cursor.
    pub(in crate::ui) fn open_menu_at_cursor(&mut self) {
        let row = self.rows.at_cursor().map(|row| row.id);
        self.row_menu = row.map(|row| RowMenu { row, at: None });
    }
}
