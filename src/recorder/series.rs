//! Values over time for plots: append-only, with a pyramid of minima and maxima, so that a plot of any length costs as
//! much as it has pixels.

use std::ops::Range;

/// One column over time.
///
/// Beside the points there are levels: the first holds minimum and maximum of every 16 points, the next those of every 16
/// entries of the first, and so on. An entry is added once all that it stands for is there.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Series {
    x: Vec<f64>,
    y: Vec<f64>,
    levels: Vec<Vec<Extremes>>,
    /// Indices of points that do not follow the point before.
    breaks: Vec<usize>,
    /// Of a series that keeps so many points at most.
    thinning: Option<Thinning>,
}

/// How a series stays below a limit: the newest points are all there, and of those before, the lowest and the highest of
/// each stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Thinning {
    /// Points that are kept at most.
    limit: usize,
    /// Points at the start that are thinned out: three quarters of the limit at most.
    thinned: usize,
    /// How many points each two of those stand for.
    stretch: usize,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Extremes {
    min: f64,
    max: f64,
}

/// What a plot draws at one pixel column: a vertical line from `min` to `max`, or a point where both are the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bar {
    /// Of the first of its points.
    pub x: f64,
    /// The smallest of its points.
    pub min: f64,
    /// The largest of its points.
    pub max: f64,
    /// Whether a gap is before it: no line is drawn from the bar before.
    pub after_gap: bool,
}

/// Entries that one of the next level stands for.
const FACTOR: usize = 16;

impl Series {
    /// A series that keeps at most `limit` points, 64 at least. A quarter of it, at least, is the newest points; of the time
    /// before, the lowest and the highest point of each of many equal stretches stay. The whole time stays visible with
    /// every peak.
    pub fn limited(limit: usize) -> Self {
        let thinning = Thinning { limit: limit.max(4 * FACTOR), thinned: 0, stretch: FACTOR };
        Self { thinning: Some(thinning), ..Self::default() }
    }

    /// Appends a point. `x` smaller than that of the last point is taken as that one; a `y` that is not a number is left
    /// out.
    pub fn push(&mut self, x: f64, y: f64) {
        if !x.is_finite() || !y.is_finite() {
            return;
        }
        self.x.push(self.x.last().map_or(x, |last| last.max(x)));
        self.y.push(y);
        let mut lower = self.y.len();
        for level in 0.. {
            if !lower.is_multiple_of(FACTOR) {
                break;
            }
            let complete = self.range_extremes_at(level, lower - FACTOR..lower);
            if level == self.levels.len() {
                self.levels.push(Vec::new());
            }
            self.levels[level].push(complete);
            lower = self.levels[level].len();
        }
        if let Some(thinning) = self.thinning.filter(|thinning| self.y.len() > thinning.limit) {
            self.thin(thinning);
        }
    }

    /// Thins out the older half of the newest points, and all the thinned ones again when they are too many.
    fn thin(&mut self, thinning: Thinning) {
        let Thinning { limit, thinned, mut stretch } = thinning;
        let all = std::mem::take(self);
        let half = (all.y.len() - thinned) / 2;
        let chunk = stretch.min(half).max(1);
        let newest = thinned + half / chunk * chunk;
        let mut kept: Vec<usize> = (0..thinned).collect();
        kept.extend((thinned..newest).step_by(chunk).flat_map(|start| all.extreme_points(start..start + chunk)));
        while kept.len() > limit / 4 * 3 {
            kept = kept.chunks(4).flat_map(|four| all.extreme_points(four.iter().copied())).collect();
            stretch = stretch.saturating_mul(2);
        }
        let thinned = kept.len();
        let mut breaks = all.breaks.iter().peekable();
        for index in kept.into_iter().chain(newest..all.y.len()) {
            // Gaps among the points that are left out stay gaps.
            while breaks.next_if(|at| **at <= index).is_some() {
                self.push_gap();
            }
            self.push(all.x[index], all.y[index]);
        }
        if breaks.next().is_some() {
            self.push_gap();
        }
        self.thinning = Some(Thinning { limit, thinned, stretch });
    }

    /// The lowest and the highest of some points, in their order; one where both are the same.
    fn extreme_points(&self, indices: impl IntoIterator<Item = usize>) -> impl Iterator<Item = usize> {
        let mut found = None;
        for index in indices {
            let (lowest, highest) = found.get_or_insert((index, index));
            if self.y[index] < self.y[*lowest] {
                *lowest = index;
            }
            if self.y[index] > self.y[*highest] {
                *highest = index;
            }
        }
        let (lowest, highest) = found.unzip();
        let first = lowest.min(highest);
        [first, lowest.max(highest).filter(|last| Some(*last) != first)].into_iter().flatten()
    }

    /// Of entries of a level; level 0 are the points.
    fn range_extremes_at(&self, level: usize, range: Range<usize>) -> Extremes {
        range.map(|index| self.entry(level, index)).fold(Extremes::NONE, Extremes::joined)
    }

    fn entry(&self, level: usize, index: usize) -> Extremes {
        match level {
            0 => Extremes { min: self.y[index], max: self.y[index] },
            level => self.levels[level - 1][index],
        }
    }

    /// The next point does not follow the last one.
    pub fn push_gap(&mut self) {
        if self.breaks.last() != Some(&self.y.len()) {
            self.breaks.push(self.y.len());
        }
    }

    /// How many points there are.
    pub const fn len(&self) -> usize {
        self.y.len()
    }

    /// Whether there are none.
    pub const fn is_empty(&self) -> bool {
        self.y.is_empty()
    }

    /// The last point.
    pub fn last(&self) -> Option<(f64, f64)> {
        Some((*self.x.last()?, *self.y.last()?))
    }

    /// Whether the next point will not follow the last one.
    pub fn ends_with_gap(&self) -> bool {
        self.breaks.last() == Some(&self.y.len())
    }

    /// How many gaps are between points.
    pub fn gaps(&self) -> usize {
        self.breaks.iter().filter(|at| (1..self.y.len()).contains(*at)).count()
    }

    /// `x` of the first and the last point.
    pub fn span(&self) -> Option<Range<f64>> {
        Some(*self.x.first()?..*self.x.last()?)
    }

    /// What a plot of a range of `x` draws on `pixels` columns: at most one bar a column, or each point where there are
    /// fewer points than columns. One point before and one behind the range are included, for the lines that leave it.
    pub fn query(&self, range: Range<f64>, pixels: usize) -> Vec<Bar> {
        let start = self.x.partition_point(|x| *x < range.start).saturating_sub(1);
        let end = (self.x.partition_point(|x| *x <= range.end) + 1).min(self.x.len());
        if start >= end || pixels == 0 {
            return Vec::new();
        }
        if end - start <= pixels {
            return (start..end).map(|index| self.bar(index..index + 1)).collect();
        }
        let (first, last) = (self.x[start], self.x[end - 1]);
        let width = (last - first) / pixels as f64;
        let mut bars = Vec::with_capacity(pixels);
        let (mut from, mut points) = (start, (end - start) / pixels);
        for pixel in 1..=pixels {
            let to =
                if pixel == pixels { end } else { self.first_from(first + width * pixel as f64, from..end, points) };
            if from < to {
                bars.push(self.bar(from..to));
            }
            points = to - from;
            from = to;
        }
        bars
    }

    /// The lines of a plot of a range of `x` on `pixels` columns: of each stretch without a gap its points, at most two a
    /// column, those of [`Series::query`].
    pub fn lines(&self, range: Range<f64>, pixels: usize) -> Vec<Vec<[f64; 2]>> {
        let mut lines: Vec<Vec<[f64; 2]>> = Vec::new();
        for Bar { x, min, max, after_gap } in self.query(range, pixels) {
            let before = lines.last().and_then(|line| line.last()).map(|point| point[1]).filter(|_| !after_gap);
            // The nearer end first.
            let is_below = before.is_none_or(|before| (before - min).abs() <= (before - max).abs());
            let (first, second) = if is_below { (min, max) } else { (max, min) };
            let points = [[x, first], [x, second]].into_iter().take(if min == max { 1 } else { 2 });
            match lines.last_mut().filter(|_| !after_gap) {
                Some(line) => line.extend(points),
                None => lines.push(points.collect()),
            }
        }
        lines
    }

    /// The first point of `range` whose `x` is not below `until`, looked for around the one `guess` behind its start: points
    /// come evenly, and a search through all of them would miss the processor's cache at each step.
    fn first_from(&self, until: f64, range: Range<usize>, guess: usize) -> usize {
        let is_below = |index: usize| self.x[index] < until;
        let (mut low, mut high) = (range.start, range.end);
        let guess = (range.start + guess).min(range.end.saturating_sub(1));
        let mut step = 1;
        if is_below(guess) {
            low = guess;
            while low + step < high && is_below(low + step) {
                low += step;
                step *= 2;
            }
            high = high.min(low + step);
        } else {
            high = guess;
            while high >= low + step && !is_below(high - step) {
                high -= step;
                step *= 2;
            }
            low = low.max(high.saturating_sub(step));
        }
        low + self.x[low..high].partition_point(|x| *x < until)
    }

    fn bar(&self, points: Range<usize>) -> Bar {
        let Extremes { min, max } = self.range_extremes(points.clone());
        let breaks = self.breaks.partition_point(|at| *at < points.start);
        let after_gap = self.breaks.get(breaks).is_some_and(|at| points.contains(at));
        Bar { x: self.x[points.start], min, max, after_gap }
    }

    /// Of the points `range`: single points and entries at the edges, entries of the highest levels between.
    fn range_extremes(&self, range: Range<usize>) -> Extremes {
        let mut found = Extremes::NONE;
        let Range { mut start, mut end } = range;
        for level in 0..=self.levels.len() {
            let is_last = level == self.levels.len();
            // Up to the first entry, and from the last entry, that the next level has no whole entry for.
            let inner_start = if is_last { end } else { start.next_multiple_of(FACTOR).min(end) };
            found = found.joined(self.range_extremes_at(level, start..inner_start));
            let inner_end = (end / FACTOR * FACTOR).max(inner_start);
            found = found.joined(self.range_extremes_at(level, inner_end..end));
            if inner_start >= inner_end {
                break;
            }
            (start, end) = (inner_start / FACTOR, inner_end / FACTOR);
        }
        found
    }
}

impl Extremes {
    /// Of no points.
    const NONE: Self = Self { min: f64::INFINITY, max: f64::NEG_INFINITY };

    const fn joined(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn series(values: impl IntoIterator<Item = f64>) -> Series {
        let mut series = Series::default();
        for (index, y) in values.into_iter().enumerate() {
            series.push(index as f64, y);
        }
        series
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn a_bar_has_minimum_and_maximum_of_its_points(
            values in proptest::collection::vec(-1e6..1e6_f64, 1..9000),
            (from, to) in (0..9000_usize, 0..9000_usize),
        ) {
            let (from, to) = (from.min(to).min(values.len() - 1), to.max(from).min(values.len() - 1));
            let series = series(values.iter().copied());
            let expected = values[from..=to].iter().fold((f64::MAX, f64::MIN), |(min, max), y| (min.min(*y), max.max(*y)));
            let found = series.range_extremes(from..to + 1);
            prop_assert_eq!((found.min, found.max), expected);
        }

        #[test]
        fn every_point_of_the_range_is_in_one_bar(
            values in proptest::collection::vec(-1e6..1e6_f64, 1..3000),
            pixels in 1..500_usize,
        ) {
            let series = series(values.iter().copied());
            let bars = series.query(f64::MIN..f64::MAX, pixels);
            prop_assert!(bars.len() <= pixels.max(1));
            let (min, max) = bars.iter().fold((f64::MAX, f64::MIN), |(min, max), bar| (min.min(bar.min), max.max(bar.max)));
            let expected = values.iter().fold((f64::MAX, f64::MIN), |(min, max), y| (min.min(*y), max.max(*y)));
            prop_assert_eq!((min, max), expected);
            prop_assert!(bars.is_sorted_by(|one, next| one.x < next.x));
        }
    }

    #[test]
    fn a_limited_series_keeps_its_whole_time_its_peaks_and_its_gaps() {
        let mut series = Series::limited(1_000);
        for step in 0..100_000 {
            if step == 40_003 {
                series.push_gap();
            }
            let y = if step == 31_234 { 99.0 } else { f64::from(step % 7) };
            series.push(f64::from(step), y);
            assert!(series.len() <= 1_000);
        }
        assert_eq!(series.span(), Some(0.0..99_999.0));
        assert_eq!((series.gaps(), series.last()), (1, Some((99_999.0, f64::from(99_999 % 7)))));
        let lines = series.lines(0.0..100_000.0, 300);
        assert_eq!(lines.len(), 2, "one gap");
        // As exact as a stretch is long: three quarters of the limit are for the time before the newest points.
        let (end, start) = (lines[0].last().unwrap()[0], lines[1][0][0]);
        let stretch = 2.0 * 2.0 * 100_000.0 / 750.0;
        assert!(end < 40_003.0 && (40_003.0 - stretch..40_003.0 + stretch).contains(&start), "{end} {start}");
        let newest = series.query(99_900.0..99_999.0, 1_000);
        assert!(newest.len() >= 100, "the newest points are all there: {}", newest.len());
        assert!(lines.iter().flatten().any(|point| point[1] == 99.0), "the peak of long ago");
        // Many gaps do not stop the thinning.
        let mut torn = Series::limited(64);
        for step in 0..10_000 {
            torn.push_gap();
            torn.push(f64::from(step), f64::from(step));
        }
        assert!(torn.len() <= 64 && !torn.ends_with_gap());
        torn.push_gap();
        assert!(torn.ends_with_gap());
    }

    #[test]
    fn lines_join_bars_by_their_nearer_ends() {
        let mut series = series([0.0, 10.0, 10.0, 0.0]);
        assert_eq!(series.lines(0.0..10.0, 2), [vec![[0.0, 0.0], [0.0, 10.0], [2.0, 10.0], [2.0, 0.0]]]);
        series.push_gap();
        series.push(4.0, 5.0);
        let lines = series.lines(0.0..10.0, 10);
        assert_eq!(lines, [vec![[0.0, 0.0], [1.0, 10.0], [2.0, 10.0], [3.0, 0.0]], vec![[4.0, 5.0]]]);
        assert_eq!(Series::default().lines(0.0..1.0, 10), Vec::<Vec<[f64; 2]>>::new());
    }

    #[test]
    fn few_points_are_drawn_as_they_are_and_gaps_are_kept() {
        let mut series = series([1.0, 5.0, 2.0]);
        series.push_gap();
        series.push(10.0, 4.0);
        series.push(9.0, f64::NAN);
        series.push(9.0, 3.0);
        let bars = series.query(1.5..100.0, 100);
        let shown: Vec<_> = bars.iter().map(|bar| (bar.x, bar.min, bar.after_gap)).collect();
        assert_eq!(shown, [(1.0, 5.0, false), (2.0, 2.0, false), (10.0, 4.0, true), (10.0, 3.0, false)]);
        assert_eq!(series.query(0.0..1.0, 0), []);
        assert_eq!(Series::default().query(0.0..1.0, 10), []);
        let joined = series.query(0.0..10.0, 2);
        assert!(joined[1].after_gap && joined[1].max == 4.0, "{joined:?}");
    }
}
