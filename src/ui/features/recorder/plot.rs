use std::collections::BTreeSet;
use std::ops::Range;

use crate::recorder::{Quantity, Source};

/// What of the values of a recording is shown, and which part of its time.
#[derive(Debug, Default)]
pub struct RecordingPlot {
    /// Each has a plot of its own, in this order.
    shown: Vec<Quantity>,
    /// Columns that are left out of their plots.
    hidden: BTreeSet<String>,
    /// The part of the time.
    pub range: PlotRange,
}

/// A part of the time of a recording, in seconds since its first sample.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum PlotRange {
    /// From the first sample to the last.
    #[default]
    Whole,
    /// The last so many seconds; follows a recording that runs.
    Last(f64),
    /// What is between two times, whatever comes.
    Held(f64, f64),
}

/// How many plots are drawn at most, one above the other.
pub const MAX_PLOTS: usize = 4;
/// The shortest part of the time that is shown, in seconds.
const SHORTEST: f64 = 0.001;

impl RecordingPlot {
    /// Keeps of the chosen quantities those that the data offers; the first one and the second at first.
    pub fn begin(&mut self, source: Source) {
        let offered = Quantity::of(source);
        self.shown.retain(|quantity| offered.contains(quantity));
        if self.shown.is_empty() {
            self.shown = offered.into_iter().take(2).collect();
        }
        self.range = PlotRange::Whole;
    }

    /// The quantities that are shown.
    pub fn quantities(&self) -> &[Quantity] {
        &self.shown
    }

    /// Whether no other quantity can be shown.
    pub fn is_full(&self) -> bool {
        self.shown.len() >= MAX_PLOTS
    }

    /// Shows a quantity, or shows it no more. Beyond `MAX_PLOTS` nothing is added.
    pub fn toggle(&mut self, quantity: Quantity) {
        match self.shown.iter().position(|shown| *shown == quantity) {
            Some(at) => drop(self.shown.remove(at)),
            None if self.is_full() => {}
            None => self.shown.push(quantity),
        }
    }

    /// The names of the columns of the quantities that are shown.
    pub fn columns(&self, source: Source) -> Vec<String> {
        self.shown.iter().flat_map(|quantity| quantity.columns(source)).collect()
    }

    /// Whether a column is drawn.
    pub fn draws(&self, column: &str) -> bool {
        !self.hidden.contains(column)
    }

    /// Leaves a column out, or draws it again.
    pub fn toggle_column(&mut self, column: &str) {
        if !self.hidden.remove(column) {
            self.hidden.insert(column.to_owned());
        }
    }

    /// The part of the time that is shown of values that span this.
    pub fn seconds(&self, span: &Range<f64>) -> Range<f64> {
        match self.range {
            PlotRange::Whole => span.start..span.end.max(span.start + SHORTEST),
            PlotRange::Last(seconds) => span.end - seconds..span.end,
            PlotRange::Held(from, to) => from..to,
        }
    }

    /// Whether what is shown moves on with a recording that runs.
    pub const fn follows(&self) -> bool {
        !matches!(self.range, PlotRange::Held(..))
    }

    /// Stops following, or follows again with as much time as is shown.
    pub fn pause(&mut self, span: &Range<f64>) {
        let Range { start, end } = self.seconds(span);
        self.range = if self.follows() { PlotRange::Held(start, end) } else { PlotRange::Last(end - start) };
    }

    /// Shows `factor` of the time that is shown, with the same time at `at` (0: the left edge, 1: the right one).
    pub fn zoom(&mut self, span: &Range<f64>, factor: f64, at: f64) {
        let Range { start, end } = self.seconds(span);
        let longest = (span.end - span.start).max(SHORTEST) * 2.0;
        let seconds = ((end - start) * factor).clamp(SHORTEST, longest);
        self.range = match self.range {
            // What follows goes on to follow.
            PlotRange::Last(_) | PlotRange::Whole if at >= 1.0 => PlotRange::Last(seconds),
            _ => {
                let from = start + (end - start - seconds) * at;
                PlotRange::Held(from, from + seconds)
            }
        };
    }

    /// Moves by this part of the time that is shown; it always stays in touch with the values.
    pub fn pan(&mut self, span: &Range<f64>, by: f64) {
        let Range { start, end } = self.seconds(span);
        let seconds = end - start;
        let from = (start + seconds * by).clamp(span.start - seconds / 2.0, (span.end - seconds / 2.0).max(span.start));
        self.range = PlotRange::Held(from, from + seconds);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recorder::RecordSettings;

    const SPAN: Range<f64> = 0.0..100.0;

    #[test]
    fn the_first_quantities_are_shown_and_others_as_long_as_there_is_room() {
        let source = RecordSettings::force(2, 1, 0).unwrap().source();
        let mut plot = RecordingPlot::default();
        plot.begin(source);
        assert_eq!(plot.quantities(), [Quantity::Forces, Quantity::Torques]);
        assert_eq!(plot.columns(source).len(), 8);
        for quantity in Quantity::of(source).into_iter().skip(2) {
            plot.toggle(quantity);
        }
        assert_eq!(plot.quantities().len(), MAX_PLOTS);
        plot.toggle(Quantity::Torques);
        assert_eq!(plot.quantities(), [Quantity::Forces, Quantity::Position, Quantity::Orientation]);
        plot.toggle_column("Fz");
        assert!(plot.draws("Fx") && !plot.draws("Fz"));
        plot.toggle_column("Fz");
        assert!(plot.draws("Fz"));

        // Another kind of data keeps what it offers as well.
        plot.begin(RecordSettings::motion(0, 0).unwrap().source());
        assert_eq!(plot.quantities(), [Quantity::Position, Quantity::Orientation]);
        plot.begin(RecordSettings::motion(0, 0).unwrap().source());
        assert_eq!(plot.quantities().len(), 2);
    }

    #[test]
    fn what_follows_a_recording_is_paused_and_follows_again() {
        let mut plot = RecordingPlot::default();
        assert_eq!(plot.seconds(&SPAN), SPAN);
        plot.zoom(&SPAN, 0.1, 1.0);
        assert_eq!((plot.seconds(&SPAN), plot.seconds(&(0.0..110.0))), (90.0..100.0, 100.0..110.0));
        plot.pause(&SPAN);
        assert_eq!(plot.seconds(&(0.0..110.0)), 90.0..100.0);
        plot.pause(&SPAN);
        assert_eq!(plot.range, PlotRange::Last(10.0));
    }

    #[test]
    fn the_time_under_the_pointer_stays_and_nothing_moves_out_of_sight() {
        let mut plot = RecordingPlot::default();
        plot.zoom(&SPAN, 0.5, 0.25);
        assert_eq!(plot.range, PlotRange::Held(12.5, 62.5));
        plot.pan(&SPAN, 0.5);
        assert_eq!(plot.range, PlotRange::Held(37.5, 87.5));
        plot.pan(&SPAN, 10.0);
        assert_eq!(plot.range, PlotRange::Held(75.0, 125.0));
        plot.pan(&SPAN, -10.0);
        assert_eq!(plot.range, PlotRange::Held(-25.0, 25.0));
        plot.zoom(&SPAN, 1e9, 0.5);
        assert_eq!(plot.range, PlotRange::Held(-100.0, 100.0), "twice the recording at most");
        plot.zoom(&SPAN, 0.0, 0.5);
        let PlotRange::Held(from, to) = plot.range else { panic!("{:?}", plot.range) };
        assert!((to - from - SHORTEST).abs() < 1e-9);
        assert_eq!(RecordingPlot::default().seconds(&(5.0..5.0)), 5.0..5.0 + SHORTEST);
    }
}
