//! What the battery of the controller keeps: taken from a cell, and given back to one.

use super::backup_memory::{BackupMemory, KeptVariable};
use super::simulation::Cell;
use crate::model::SpelType;
use crate::remote::{value_from_text, value_text};

impl Cell {
    /// What a power-off must not lose.
    pub fn backup(&self) -> BackupMemory {
        let kept =
            self.variables.all().filter(|(about, values)| values.iter().any(|value| *value != about.kind.zero()));
        BackupMemory {
            variables: kept
                .map(|(about, values)| KeptVariable {
                    name: about.name.clone(),
                    kind: about.kind.keyword().to_owned(),
                    values: values.iter().map(value_text).collect(),
                })
                .collect(),
            replaced: self.replaced.clone(),
        }
    }

    /// Takes back what fits: variables that are still declared so, parts of robots that are still there.
    pub(super) fn restore(&mut self, memory: BackupMemory) {
        for KeptVariable { name, kind, values } in memory.variables {
            let Some(kind) = SpelType::from_keyword(&kind) else { continue };
            let values: Option<Vec<_>> = values.iter().map(|value| value_from_text(kind, value).ok()).collect();
            if let Some(values) = values {
                self.variables.restore(&name, kind, values);
            }
        }
        for (alarm, at) in memory.replaced {
            self.replaced_before(alarm, at);
        }
    }
}
