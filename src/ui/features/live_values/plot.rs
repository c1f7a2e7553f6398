use chrono::{DateTime, TimeDelta, Utc};

use crate::jobs::LivePoint;
use crate::model::opcua::{DataValue, NodeId};
use crate::recorder::Series;

/// Values over time. Shows a minute at first.
#[derive(Debug)]
pub struct LivePlot {
    series: Vec<PlotSeries>,
    /// How far the time of the PC is ahead of the time stamps of the server.
    clock_ahead: Option<TimeDelta>,
    /// Index into [`SPANS`].
    pub span: usize,
    /// The newest time that is shown; `None`: it follows the values.
    pub held_at: Option<f64>,
}

/// How many seconds may be shown.
pub const SPANS: [u32; 4] = [10, 60, 600, 3600];
/// How many values a plot holds.
pub const MAX_SERIES: usize = 16;
/// Samples of one value that are kept: an hour at ten a second, with the points that hold a value. What is older is thinned
/// out.
const MAX_SAMPLES: usize = 72_000;
/// A variable that reports nothing for so long has kept its value, in seconds.
const HOLD: f64 = 0.5;

/// The samples of one variable.
#[derive(Debug)]
pub struct PlotSeries {
    /// The variable.
    pub point: LivePoint,
    /// Number of its colour.
    pub color: usize,
    /// Seconds of Unix time by the PC's clock, and the value; a gap where the connection was lost.
    samples: Series,
}

/// Points of a line without a gap.
pub type Stretch = Vec<[f64; 2]>;

impl Default for LivePlot {
    fn default() -> Self {
        Self { series: Vec::new(), clock_ahead: None, span: 1, held_at: None }
    }
}

impl LivePlot {
    /// What is plotted, in the order in which it was added.
    pub fn series(&self) -> &[PlotSeries] {
        &self.series
    }

    /// The variables that are plotted.
    pub fn nodes(&self) -> impl Iterator<Item = &NodeId> {
        self.series.iter().map(|series| &series.point.node)
    }

    /// Whether a variable is plotted.
    pub fn holds(&self, node: &NodeId) -> bool {
        self.nodes().any(|held| held == node)
    }

    /// Whether no other variable can be added.
    pub fn is_full(&self) -> bool {
        self.series.len() >= MAX_SERIES
    }

    /// Adds a variable; one that is there already, or more than [`MAX_SERIES`], is not added.
    pub fn add(&mut self, point: LivePoint) {
        if self.holds(&point.node) || self.is_full() {
            return;
        }
        let is_free = |color: &usize| self.series.iter().all(|series| series.color != *color);
        let color = (0..MAX_SERIES).find(is_free).unwrap_or_default();
        self.series.push(PlotSeries { point, color, samples: Series::limited(MAX_SAMPLES) });
    }

    /// Removes a variable with its samples.
    pub fn remove(&mut self, node: &NodeId) {
        self.series.retain(|series| series.point.node != *node);
    }

    /// Removes every variable.
    pub fn clear(&mut self) {
        self.series.clear();
        self.held_at = None;
    }

    /// Takes in a value that arrived now. Anything but a number is a gap.
    pub fn push(&mut self, node: &NodeId, value: &DataValue, now: DateTime<Utc>) {
        let Some(series) = self.series.iter_mut().find(|series| series.point.node == *node) else { return };
        let stamped = value.source_time.or(value.server_time);
        let at = match stamped {
            Some(stamped) => stamped + *self.clock_ahead.get_or_insert(now - stamped),
            None => now,
        };
        let number = value.value.as_f64().filter(|_| !value.quality.is_bad()).unwrap_or(f64::NAN);
        series.push(seconds(at), number);
    }

    /// The connection was lost: what comes next does not continue the lines.
    pub fn interrupt(&mut self) {
        self.clock_ahead = None;
        for series in &mut self.series {
            series.samples.push_gap();
        }
    }

    /// The first and the last time that are shown. A value that does not change is held until `now` while `is_live`.
    pub fn range(&self, now: DateTime<Utc>, is_live: bool) -> (f64, f64) {
        let newest = self.series.iter().filter_map(|series| series.samples.last()).map(|(at, _)| at);
        let newest = newest.fold(f64::NEG_INFINITY, f64::max);
        let last = match self.held_at {
            Some(at) => at,
            None if is_live || !newest.is_finite() => seconds(now).max(newest),
            None => newest,
        };
        (last - f64::from(SPANS[self.span.min(SPANS.len() - 1)]), last)
    }
}

impl PlotSeries {
    /// NaN: there is no value from now on.
    fn push(&mut self, at: f64, value: f64) {
        if let Some((before, held)) = self.samples.last()
            && at - before > HOLD
            && !self.samples.ends_with_gap()
        {
            self.samples.push(at, held);
        }
        if value.is_nan() {
            self.samples.push_gap();
        } else {
            self.samples.push(at, value);
        }
    }

    /// The lines between two times, in at most about two points for each of `columns`. Times are in seconds before `to`.
    /// `hold`: the last value holds until `to`.
    pub fn stretches(&self, from: f64, to: f64, columns: usize, hold: bool) -> Vec<Stretch> {
        let mut stretches = self.samples.lines(from..to, columns);
        stretches.iter_mut().flatten().for_each(|point| point[0] -= to);
        if hold
            && let Some((at, value)) = self.samples.last()
            && at < to
            && !self.samples.ends_with_gap()
            && let Some(stretch) = stretches.last_mut()
        {
            stretch.push([0.0, value]);
        }
        stretches
    }
}

fn seconds(at: DateTime<Utc>) -> f64 {
    at.timestamp_micros() as f64 / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::opcua::{Quality, Value};

    fn at(seconds: f64) -> DateTime<Utc> {
        DateTime::from_timestamp_micros((seconds * 1e6) as i64).unwrap()
    }

    fn value(seconds: f64, number: f64) -> DataValue {
        DataValue { value: Value::Double(number), source_time: Some(at(seconds)), ..DataValue::default() }
    }

    fn plot() -> (LivePlot, NodeId) {
        let node = NodeId::numeric(1, 1);
        let mut plot = LivePlot::default();
        plot.add(LivePoint { node: node.clone(), name: "a".into(), unit: None, range: None });
        (plot, node)
    }

    #[test]
    fn times_are_those_of_the_pc_whatever_the_servers_clock_says() {
        let (mut plot, node) = plot();
        plot.push(&node, &value(5_000.0, 1.0), at(100.0));
        plot.push(&node, &value(5_000.2, 2.0), at(100.7));
        assert_eq!(plot.series()[0].samples.lines(0.0..200.0, 100), [[[100.0, 1.0], [100.2, 2.0]]]);
    }

    #[test]
    fn a_value_is_held_until_it_changes() {
        let (mut plot, node) = plot();
        for (seconds, number) in [(100.0, 1.0), (105.0, 3.0)] {
            plot.push(&node, &value(seconds, number), at(seconds));
        }
        let stretches = plot.series()[0].stretches(100.0, 110.0, 1_000, true);
        assert_eq!(stretches, [vec![[-10.0, 1.0], [-5.0, 1.0], [-5.0, 3.0], [0.0, 3.0]]]);
        assert_eq!(plot.series()[0].stretches(100.0, 110.0, 1_000, false)[0].len(), 3, "not while it is not live");
    }

    #[test]
    fn a_lost_connection_and_a_bad_value_are_gaps() {
        let (mut plot, node) = plot();
        plot.push(&node, &value(100.0, 1.0), at(100.0));
        plot.interrupt();
        plot.push(&node, &value(103.0, 2.0), at(103.0));
        let bad = DataValue { quality: Quality::Bad { name: "BadNoData".into() }, ..value(103.2, 0.0) };
        plot.push(&node, &bad, at(103.2));
        plot.push(&node, &value(103.4, 4.0), at(103.4));
        let stretches = plot.series()[0].stretches(100.0, 104.0, 1_000, false);
        assert_eq!(stretches.iter().map(Vec::len).collect::<Vec<_>>(), [1, 1, 1]);
    }

    #[test]
    fn a_long_series_keeps_its_peaks_in_few_points() {
        let (mut plot, node) = plot();
        for step in 0..50_000 {
            let number = if step == 31_234 { 99.0 } else { f64::from(step % 7) };
            plot.push(&node, &value(f64::from(step) * 0.05, number), at(f64::from(step) * 0.05));
        }
        let stretches = plot.series()[0].stretches(0.0, 2_500.0, 500, false);
        let points: Vec<_> = stretches.into_iter().flatten().collect();
        assert!(points.len() <= 4 * 502, "{}", points.len());
        assert!(points.iter().any(|point| point[1] == 99.0));
        assert!(points.windows(2).all(|pair| pair[0][0] <= pair[1][0]), "in the order of time");
    }

    #[test]
    fn memory_is_bounded() {
        let (mut plot, node) = plot();
        for step in 0..MAX_SAMPLES + 10 {
            let seconds = step as f64 * 0.1;
            plot.push(&node, &value(seconds, 1.0), at(seconds));
        }
        let samples = &plot.series()[0].samples;
        assert!(samples.len() <= MAX_SAMPLES && samples.span().unwrap().start == 0.0);
        for number in 0..40 {
            plot.add(LivePoint { node: NodeId::numeric(2, number), name: String::new(), unit: None, range: None });
        }
        assert_eq!(plot.series().len(), MAX_SERIES);
        let mut colors: Vec<_> = plot.series().iter().map(|series| series.color).collect();
        colors.dedup();
        assert_eq!(colors.len(), MAX_SERIES);
    }

    #[test]
    fn what_is_shown_follows_the_values_until_it_is_held() {
        let (mut plot, node) = plot();
        plot.span = 0;
        plot.push(&node, &value(100.0, 1.0), at(100.0));
        assert_eq!(plot.range(at(104.0), true), (94.0, 104.0));
        assert_eq!(plot.range(at(104.0), false), (90.0, 100.0));
        plot.held_at = Some(101.0);
        assert_eq!(plot.range(at(104.0), true), (91.0, 101.0));
    }
}
