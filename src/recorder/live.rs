use std::sync::Arc;

use parking_lot::RwLock;

use super::series::Series;
use super::sidecar::{Gap, GapCause};
use crate::records::Ticks;
use crate::records::columns::Column;

/// The values of some columns of a recording, shared with the plots that show them.
#[derive(Debug, Clone)]
pub struct LiveValues(Arc<RwLock<Shown>>);

#[derive(Debug)]
struct Shown {
    /// Of the columns that are wanted.
    names: Vec<String>,
    columns: Vec<LiveColumn>,
    /// Points that each series keeps at most.
    limit: usize,
}

/// One column.
#[derive(Debug, Clone, PartialEq)]
pub struct LiveColumn {
    /// The name that the column has in the file.
    pub name: String,
    /// The unit of the values; empty for plain numbers.
    pub unit: String,
    /// `x` is in seconds of the controller's time since the first sample.
    pub series: Series,
}

/// Points that a series of a running recording keeps: with their levels 9 MB.
const POINTS: usize = 1 << 19;

impl LiveValues {
    /// For the columns of these names. Each keeps half a million points; what is older is thinned out
    /// ([`Series::limited`]).
    pub fn new(names: Vec<String>) -> Self {
        Self::limited(names, POINTS)
    }

    /// As [`LiveValues::new`], for so many points of each column.
    pub fn limited(names: Vec<String>, limit: usize) -> Self {
        Self(Arc::new(RwLock::new(Shown { names, columns: Vec::new(), limit })))
    }

    /// From now on the columns of these names are wanted. The values of others are dropped; a column that was not wanted
    /// before begins now.
    pub fn show(&self, names: Vec<String>) {
        let mut shown = self.0.write();
        shown.columns.retain(|column| names.contains(&column.name));
        shown.names = names;
    }

    pub(super) fn names(&self) -> Vec<String> {
        self.0.read().names.clone()
    }

    /// Replaces the columns, for values that are there already.
    pub fn replace(&self, columns: Vec<LiveColumn>) {
        let mut shown = self.0.write();
        shown.names = columns.iter().map(|column| column.name.clone()).collect();
        shown.columns = columns;
    }

    /// Calls `read` with the columns. New values wait meanwhile.
    pub fn read<R>(&self, read: impl FnOnce(&[LiveColumn]) -> R) -> R {
        read(&self.0.read().columns)
    }
}

/// Rows of a recording, and what is known of it so far.
#[derive(Debug, Clone, Copy)]
pub struct RowBatch<'a> {
    pub columns: &'a [Column<'a>],
    /// How many rows of the recording are before those of the columns.
    pub first_row: u64,
    /// How many rows the columns have.
    pub rows: usize,
    /// Of the whole recording, as far as they are known, sorted by row.
    pub gaps: &'a [Gap],
    /// The first time stamp of the recording.
    pub first_ticks: Option<u64>,
}

/// The column with the time of force sensor data, in milliseconds since RecordStart.
pub(super) const ELAPSED_TIME: &str = "ElapsedTime";

/// Takes the values of a recording over into [`LiveValues`].
#[derive(Debug)]
pub struct LiveTap {
    values: LiveValues,
    /// Rows of the recording that were taken over.
    taken: u64,
    /// Gaps that were taken over.
    gaps: usize,
    /// Seconds that are added to times, so that they go on where the controller's time begins anew.
    offset: f64,
    /// ElapsedTime of the last record of the force sensor, in seconds.
    elapsed: f64,
}

impl LiveTap {
    /// Fills these.
    pub const fn new(values: LiveValues) -> Self {
        Self { values, taken: 0, gaps: 0, offset: 0.0, elapsed: 0.0 }
    }

    /// Takes over the rows that are new.
    pub(super) fn take(&mut self, batch: &RowBatch<'_>) {
        let gaps = batch.gaps.get(self.gaps..).unwrap_or_default();
        let end = batch.first_row + batch.rows as u64;
        let gaps = &gaps[..gaps.partition_point(|gap| gap.at_row <= end)];
        self.gaps += gaps.len();
        let is_there = |gap: &&Gap| gap.missing != Some(0);
        let mut breaks: Vec<u64> = gaps.iter().filter(is_there).map(|gap| gap.at_row).collect();
        let clock = self.clock(batch, gaps, &mut breaks);
        breaks.sort_unstable();
        let mut shown = self.values.0.write();
        shown.begin(batch.columns);
        for live in &mut shown.columns {
            let Some(column) = batch.columns.iter().find(|column| column.name == live.name) else { continue };
            let mut breaks = breaks.iter().peekable();
            for index in self.new_rows(batch).div_ceil(column.rows_per_value)..column.values.len() {
                let row = index * column.rows_per_value;
                while breaks.next_if(|at| **at <= batch.first_row + row as u64).is_some() {
                    live.series.push_gap();
                }
                if let (Some(x), Some(y)) = (clock.seconds(column, index, row), column.values.number(index)) {
                    live.series.push(x, y);
                }
            }
            if breaks.next().is_some() {
                live.series.push_gap();
            }
        }
        self.taken = end;
    }

    /// The first row of the batch that was not taken over.
    fn new_rows(&self, batch: &RowBatch<'_>) -> usize {
        self.taken.saturating_sub(batch.first_row) as usize
    }

    /// The times of the new rows. `breaks` gets the rows at which another recording of the force sensor begins.
    fn clock(&mut self, batch: &RowBatch<'_>, gaps: &[Gap], breaks: &mut Vec<u64>) -> Clock {
        if let Some(elapsed) = batch.columns.iter().find(|column| column.name == ELAPSED_TIME) {
            let from = self.new_rows(batch);
            let mut times = Vec::with_capacity(batch.rows - from.min(batch.rows));
            for row in from..batch.rows {
                let seconds = elapsed.values.number(row).unwrap_or_default() / 1000.0;
                if seconds < self.elapsed {
                    self.offset += self.elapsed;
                    breaks.push(batch.first_row + row as u64);
                }
                self.elapsed = seconds;
                times.push(seconds + self.offset);
            }
            return Clock::Elapsed { from, times };
        }
        let first = batch.first_ticks.unwrap_or_default();
        let mut offsets = vec![(0, self.offset)];
        for gap in gaps.iter().filter(|gap| gap.cause == GapCause::ControllerRestarted) {
            if let (Some(after), Some(until)) = (gap.after, gap.until) {
                self.offset += Ticks(after).seconds() - Ticks(until).seconds();
                offsets.push((gap.at_row.saturating_sub(batch.first_row) as usize, self.offset));
            }
        }
        Clock::Stamps { first, offsets }
    }
}

/// The times of rows.
enum Clock {
    /// Of the force sensor: the times of the rows from a row on.
    Elapsed { from: usize, times: Vec<f64> },
    /// Of the motion log, whose items have time stamps: what the first is, and what is added from a row on.
    Stamps { first: u64, offsets: Vec<(usize, f64)> },
}

impl Clock {
    /// `None` where there is no value.
    fn seconds(&self, column: &Column<'_>, index: usize, row: usize) -> Option<f64> {
        match self {
            Self::Elapsed { from, times } => times.get(row.checked_sub(*from)?).copied(),
            Self::Stamps { first, offsets } => {
                let ticks = *column.timestamps?.get(index).filter(|ticks| **ticks != 0)?;
                let offset = offsets.iter().rev().find(|(from, _)| *from <= row).map_or(0.0, |(_, offset)| *offset);
                let since = Ticks(ticks.abs_diff(*first)).seconds();
                Some(if ticks < *first { offset - since } else { offset + since })
            }
        }
    }
}

impl Shown {
    /// Makes the columns that are wanted and not there yet, in the order in which they are wanted.
    fn begin(&mut self, columns: &[Column<'_>]) {
        if self.columns.len() == self.names.len() {
            return;
        }
        let mut before = std::mem::take(&mut self.columns);
        for name in &self.names {
            if let Some(at) = before.iter().position(|column| column.name == *name) {
                self.columns.push(before.swap_remove(at));
            } else if let Some(column) = columns.iter().find(|column| column.name == *name) {
                let series = Series::limited(self.limit);
                self.columns.push(LiveColumn { name: name.clone(), unit: column.unit.to_owned(), series });
            }
        }
    }
}
