use std::collections::VecDeque;

use chrono::{DateTime, TimeDelta, Utc};

use crate::jobs::LivePoint;
use crate::model::opcua::{DataValue, NodeId};

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
/// Samples of one value that are kept: an hour at ten a second, with the points that hold a value.
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
    /// Seconds of Unix time by the PC's clock, and the value; NaN where the connection was lost.
    samples: VecDeque<(f64, f64)>,
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
        self.series.push(PlotSeries { point, color, samples: VecDeque::new() });
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
            if let Some((at, _)) = series.samples.back().copied() {
                series.samples.push_back((at, f64::NAN));
            }
        }
    }

    /// The first and the last time that are shown. A value that does not change is held until `now` while `is_live`.
    pub fn range(&self, now: DateTime<Utc>, is_live: bool) -> (f64, f64) {
        let newest = self.series.iter().filter_map(|series| series.samples.back()).map(|(at, _)| *at);
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
    fn push(&mut self, at: f64, value: f64) {
        if let Some((before, held)) = self.samples.back().copied() {
            // A time stamp that goes back, for example of a clock that was set.
            let at = at.max(before);
            if at - before > HOLD && !held.is_nan() {
                self.samples.push_back((at, held));
            }
            self.samples.push_back((at, value));
        } else {
            self.samples.push_back((at, value));
        }
        while self.samples.len() > MAX_SAMPLES {
            self.samples.pop_front();
        }
    }

    /// The lines between two times in at most about four points for each of `columns`: the first, lowest, highest and last
    /// value in it. Times are in seconds before `to`. `hold`: the last value holds until `to`.
    pub fn stretches(&self, from: f64, to: f64, columns: usize, hold: bool) -> Vec<Stretch> {
        let begin = self.samples.partition_point(|(at, _)| *at < from).saturating_sub(1);
        let end = self.samples.partition_point(|(at, _)| *at <= to);
        let end = (end + 1).min(self.samples.len());
        let mut stretches = vec![Stretch::new()];
        let width = (to - from) / columns.max(1) as f64;
        let mut column: Option<PixelColumn> = None;
        for (at, value) in self.samples.range(begin..end.max(begin)) {
            if value.is_nan() {
                flush(&mut column, &mut stretches);
                if stretches.last().is_some_and(|stretch| !stretch.is_empty()) {
                    stretches.push(Stretch::new());
                }
                continue;
            }
            let number = ((at - from) / width).floor();
            if column.as_ref().is_some_and(|column| column.number != number) {
                flush(&mut column, &mut stretches);
            }
            let point = [at - to, *value];
            column
                .get_or_insert(PixelColumn { number, first: point, lowest: point, highest: point, last: point })
                .take(point);
        }
        flush(&mut column, &mut stretches);
        if hold
            && let Some((at, value)) = self.samples.back()
            && *at < to
            && !value.is_nan()
            && let Some(stretch) = stretches.last_mut()
        {
            stretch.push([0.0, *value]);
        }
        stretches.retain(|stretch| !stretch.is_empty());
        stretches
    }
}

/// The samples that fall on one column of pixels.
struct PixelColumn {
    number: f64,
    first: [f64; 2],
    lowest: [f64; 2],
    highest: [f64; 2],
    last: [f64; 2],
}

impl PixelColumn {
    fn take(&mut self, point: [f64; 2]) {
        if point[1] < self.lowest[1] {
            self.lowest = point;
        }
        if point[1] > self.highest[1] {
            self.highest = point;
        }
        self.last = point;
    }
}

/// Adds the points of a column, in the order of their times.
fn flush(column: &mut Option<PixelColumn>, stretches: &mut [Stretch]) {
    let Some(PixelColumn { first, lowest, highest, last, .. }) = column.take() else { return };
    let (lower, higher) = if lowest[0] <= highest[0] { (lowest, highest) } else { (highest, lowest) };
    let Some(stretch) = stretches.last_mut() else { return };
    for point in [first, lower, higher, last] {
        if stretch.last() != Some(&point) {
            stretch.push(point);
        }
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
        assert_eq!(plot.series()[0].samples, [(100.0, 1.0), (100.2, 2.0)]);
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
        assert_eq!(plot.series()[0].samples.len(), MAX_SAMPLES);
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
