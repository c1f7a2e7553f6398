use std::sync::Arc;

use parking_lot::RwLock;

use super::decoder::Decoder;
use super::series::Series;
use super::sidecar::{Gap, GapCause};
use crate::records::Ticks;
use crate::records::columns::Column;

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
    /// Rows of the columns that were taken over, since they were cleared.
    taken: usize,
    /// Of each column that is shown.
    clocks: Vec<Clock>,
}

impl LiveTap {
    /// For the columns of these names.
    pub const fn new(values: LiveValues, names: Vec<String>) -> Self {
        Self { values, names, taken: 0, clocks: Vec::new() }
    }

    /// Takes over the rows of a decoder that are new.
    pub(super) fn take_decoded(&mut self, decoder: &Decoder) {
        let facts = decoder.facts();
        let first_row = facts.rows - decoder.rows() as u64;
        self.take(&decoder.columns(), decoder.rows(), first_row, &facts.gaps);
    }

    /// Takes over those of `rows` rows that are new. `first_row` is the number of the first of them in the recording;
    /// `gaps` are those of the whole recording, as far as they are known.
    pub(super) fn take(&mut self, columns: &[Column<'_>], rows: usize, first_row: u64, gaps: &[Gap]) {
        let elapsed = columns.iter().find(|column| column.name == ELAPSED_TIME);
        let mut live = self.values.0.write();
        if live.is_empty() {
            let shown = columns.iter().filter(|column| self.names.contains(&column.name));
            let new = |column: &Column<'_>| LiveColumn {
                name: column.name.clone(),
                unit: column.unit,
                series: Series::default(),
            };
            live.extend(shown.map(new));
        }
        self.clocks.resize(live.len(), Clock::default());
        for (LiveColumn { name, series, .. }, clock) in live.iter_mut().zip(&mut self.clocks) {
            let Some(column) = columns.iter().find(|column| column.name == *name) else { continue };
            for index in self.taken.div_ceil(column.rows_per_value)..column.values.len() {
                let row = first_row + (index * column.rows_per_value) as u64;
                while let Some(gap) = gaps.get(clock.gaps).filter(|gap| gap.at_row <= row) {
                    clock.pass(gap);
                    series.push_gap();
                }
                let seconds = match (column.timestamps, elapsed) {
                    (Some(stamps), _) if stamps[index] == 0 => continue,
                    (Some(stamps), _) => Ticks(stamps[index]).seconds(),
                    (None, Some(elapsed)) => elapsed.values.number(index).unwrap_or_default() / 1000.0,
                    (None, None) => continue,
                };
                if let Some(value) = column.values.number(index) {
                    if clock.goes_back_to(seconds) {
                        series.push_gap();
                    }
                    series.push(clock.advance(seconds), value);
                }
            }
        }
        self.taken = rows;
    }

    /// The columns were cleared.
    pub(super) const fn cleared(&mut self) {
        self.taken = 0;
    }
}

/// The column with the time of force sensor data, in milliseconds since RecordStart.
pub(super) const ELAPSED_TIME: &str = "ElapsedTime";

/// The time of a plot, which goes on where the controller's time begins anew.
#[derive(Debug, Clone, Copy, Default)]
struct Clock {
    /// Seconds that are added to the controller's time.
    offset: f64,
    /// Time of the last value, in seconds.
    last: f64,
    /// Gaps before the last value.
    gaps: usize,
}

impl Clock {
    fn pass(&mut self, gap: &Gap) {
        self.gaps += 1;
        if let Gap { cause: GapCause::ControllerRestarted, after: Some(after), until: Some(until), .. } = *gap {
            self.offset += Ticks(after).seconds() - Ticks(until).seconds();
        }
    }

    fn goes_back_to(&self, seconds: f64) -> bool {
        seconds + self.offset < self.last
    }

    /// The time in the plot.
    fn advance(&mut self, seconds: f64) -> f64 {
        self.offset = self.offset.max(self.last - seconds);
        self.last = seconds + self.offset;
        self.last
    }
}
