use std::sync::Arc;

use parking_lot::RwLock;

use super::decoder::Decoder;
use super::series::Series;
use crate::records::Ticks;

/// The values of some columns while they are recorded, shared with the plots that show them.
#[derive(Debug, Clone, Default)]
pub struct LiveValues(Arc<RwLock<Vec<LiveColumn>>>);

/// One column.
#[derive(Debug, Clone, PartialEq)]
pub struct LiveColumn {
    /// The name that the column has in the file.
    pub name: String,
    /// The unit of the values; empty for plain numbers.
    pub unit: &'static str,
    /// `x` is in seconds of the controller's time.
    pub series: Series,
}

impl LiveValues {
    /// Calls `read` with the columns. New values wait meanwhile.
    pub fn read<R>(&self, read: impl FnOnce(&[LiveColumn]) -> R) -> R {
        read(&self.0.read())
    }
}

/// Takes the values of a recording over into [`LiveValues`].
#[derive(Debug)]
pub struct LiveTap {
    values: LiveValues,
    /// Names of the columns that are shown.
    names: Vec<String>,
    /// Rows of the decoder's columns that were taken over.
    taken: usize,
    gaps: usize,
    /// Added to times, so that they go on where the controller's time begins anew.
    offset: f64,
    last: f64,
}

impl LiveTap {
    /// For the columns of these names.
    pub const fn new(values: LiveValues, names: Vec<String>) -> Self {
        Self { values, names, taken: 0, gaps: 0, offset: 0.0, last: 0.0 }
    }

    /// Takes over the rows that are new.
    pub(super) fn take(&mut self, decoder: &Decoder) {
        let columns = decoder.columns();
        let elapsed = columns.iter().find(|column| column.name == "ElapsedTime");
        let mut live = self.values.0.write();
        if live.is_empty() {
            let shown = columns.iter().filter(|column| self.names.contains(&column.name));
            let new = |column: &crate::records::columns::Column<'_>| LiveColumn {
                name: column.name.clone(),
                unit: column.unit,
                series: Series::default(),
            };
            live.extend(shown.map(new));
        }
        let gaps = decoder.facts().gaps.len();
        let mut last = self.last;
        for shown in live.iter_mut() {
            let Some(column) = columns.iter().find(|column| column.name == shown.name) else { continue };
            if gaps > self.gaps {
                shown.series.push_gap();
            }
            for index in self.taken.div_ceil(column.rows_per_value)..column.values.len() {
                let seconds = match (column.timestamps, elapsed) {
                    (Some(stamps), _) if stamps[index] == 0 => continue,
                    (Some(stamps), _) => Ticks(stamps[index]).seconds(),
                    (None, Some(elapsed)) => elapsed.values.number(index).unwrap_or_default() / 1000.0,
                    (None, None) => continue,
                };
                if let Some(value) = column.values.number(index) {
                    if seconds + self.offset < self.last {
                        self.offset = self.last - seconds;
                        shown.series.push_gap();
                    }
                    shown.series.push(seconds + self.offset, value);
                    last = last.max(seconds + self.offset);
                }
            }
        }
        self.last = last;
        self.gaps = gaps;
        self.taken = decoder.rows();
    }

    /// The decoder's columns were cleared.
    pub(super) const fn cleared(&mut self) {
        self.taken = 0;
    }
}
