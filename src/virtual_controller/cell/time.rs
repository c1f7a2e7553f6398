use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use thiserror::Error;

/// Simulated time since the controller was switched on, in nanoseconds. At most 584 years.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct CellTime(u64);

impl CellTime {
    /// The moment the controller is switched on.
    pub const ZERO: Self = Self(0);

    /// The moment `nanos` nanoseconds after the controller was switched on.
    pub const fn from_nanos(nanos: u64) -> Self {
        Self(nanos)
    }

    /// The moment `millis` milliseconds after the controller was switched on.
    pub const fn from_millis(millis: u64) -> Self {
        Self(millis.saturating_mul(1_000_000))
    }

    /// The moment `secs` seconds after the controller was switched on.
    pub const fn from_secs(secs: u64) -> Self {
        Self(secs.saturating_mul(1_000_000_000))
    }

    /// Nanoseconds since the controller was switched on.
    pub const fn nanos(self) -> u64 {
        self.0
    }

    /// Seconds since the controller was switched on.
    pub fn secs(self) -> f64 {
        self.0 as f64 * 1e-9
    }

    /// The TIMESTAMP of the motion log: 80,000,000 a second (manual 4.3.3).
    pub const fn ticks(self) -> u64 {
        // 80 ticks are 1000 ns; in two parts, so that no product overflows.
        self.0 / 25 * 2 + self.0 % 25 * 2 / 25
    }

    /// This moment as a length of time since the controller was switched on.
    pub const fn since_start(self) -> Duration {
        Duration::from_nanos(self.0)
    }

    /// The time from `earlier` to this moment in nanoseconds; 0 if `earlier` is later.
    pub const fn nanos_since(self, earlier: Self) -> u64 {
        self.0.saturating_sub(earlier.0)
    }

    /// This moment and `nanos` nanoseconds more.
    pub const fn plus_nanos(self, nanos: u64) -> Self {
        Self(self.0.saturating_add(nanos))
    }
}

/// How fast simulated time runs: simulated seconds in one second. From 0.001 to 10,000, in steps of 0.001; 1 by default.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ClockRate {
    thousandths: u32,
}

/// A clock rate out of its range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("the clock rate {0} is not between 0.001 and 10000")]
pub struct ClockRateError(pub f64);

impl Default for ClockRate {
    fn default() -> Self {
        Self { thousandths: 1000 }
    }
}

impl TryFrom<f64> for ClockRate {
    type Error = ClockRateError;

    fn try_from(rate: f64) -> Result<Self, ClockRateError> {
        let thousandths = (rate * 1000.0).round();
        if (1.0..=10_000_000.0).contains(&thousandths) {
            // In range, so nothing is cut off.
            Ok(Self { thousandths: thousandths as u32 })
        } else {
            Err(ClockRateError(rate))
        }
    }
}

impl std::str::FromStr for ClockRate {
    type Err = ClockRateError;

    fn from_str(text: &str) -> Result<Self, ClockRateError> {
        Self::try_from(text.parse::<f64>().unwrap_or(f64::NAN))
    }
}

impl std::fmt::Display for ClockRate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", f64::from(self.thousandths) / 1000.0)
    }
}

/// Says what simulated time it is. Clones are the same clock. Monotonic.
#[derive(Debug, Clone)]
pub struct CellClock(TimeSource);

#[derive(Debug, Clone)]
enum TimeSource {
    Running { started: Instant, rate: ClockRate },
    Manual(Arc<AtomicU64>),
}

impl CellClock {
    /// A clock that starts at [`CellTime::ZERO`] now and runs by itself.
    pub fn running(rate: ClockRate) -> Self {
        Self(TimeSource::Running { started: Instant::now(), rate })
    }

    /// A clock that stands at [`CellTime::ZERO`] until [`CellClock::advance`].
    pub fn manual() -> Self {
        Self(TimeSource::Manual(Arc::new(AtomicU64::new(0))))
    }

    /// Simulated time now.
    pub fn now(&self) -> CellTime {
        match &self.0 {
            TimeSource::Running { started, rate } => {
                let nanos = started.elapsed().as_nanos() * u128::from(rate.thousandths) / 1000;
                CellTime(u64::try_from(nanos).unwrap_or(u64::MAX))
            }
            TimeSource::Manual(nanos) => CellTime(nanos.load(Ordering::Acquire)),
        }
    }

    /// How long a running clock takes for so much simulated time. A manual clock: as long.
    pub fn real_time(&self, simulated: Duration) -> Duration {
        match &self.0 {
            TimeSource::Running { rate, .. } => simulated.saturating_mul(1000) / rate.thousandths.max(1),
            TimeSource::Manual(_) => simulated,
        }
    }

    /// Moves a manual clock forward. A running clock is not changed.
    pub fn advance(&self, by: Duration) {
        if let TimeSource::Manual(nanos) = &self.0 {
            nanos.fetch_add(u64::try_from(by.as_nanos()).unwrap_or(u64::MAX), Ordering::AcqRel);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_has_eighty_million_ticks_at_any_distance_from_power_on() {
        assert_eq!(CellTime::from_secs(1).ticks(), 80_000_000);
        assert_eq!(CellTime::from_nanos(12).ticks(), 0);
        assert_eq!(CellTime::from_nanos(13).ticks(), 1);
        assert_eq!(CellTime::from_millis(4).ticks(), 320_000);
        assert_eq!(CellTime::from_secs(500 * 365 * 86_400).ticks(), 500 * 365 * 86_400 * 80_000_000);
    }

    #[test]
    fn clock_rates_have_bounds() {
        for rate in [0.001, 1.0, 60.0, 10_000.0] {
            assert_eq!(ClockRate::try_from(rate).unwrap().to_string(), rate.to_string());
        }
        for rate in [0.0, -1.0, 10_001.0, f64::NAN, f64::INFINITY] {
            assert!(ClockRate::try_from(rate).is_err(), "{rate}");
        }
        assert!("fast".parse::<ClockRate>().is_err());
    }

    #[test]
    fn a_manual_clock_stands_and_a_running_one_does_not() {
        let clock = CellClock::manual();
        let same = clock.clone();
        clock.advance(Duration::from_millis(1500));
        assert_eq!(same.now(), CellTime::from_millis(1500));
        let running = CellClock::running(ClockRate::try_from(10_000.0).unwrap());
        assert_eq!(running.real_time(Duration::from_secs(600)), Duration::from_millis(60));
        let first = running.now();
        while running.now() == first {}
        running.advance(Duration::from_secs(1_000_000));
        assert!(running.now() < CellTime::from_secs(1_000_000));
    }
}
