//! What the benches share: rounds, their spread, and lines that read alike.

use std::fmt;
use std::time::Duration;

/// How many of a bench's rounds to measure. As part of `cargo test --all-targets` a bench only has to work.
pub const fn rounds_when(benching: bool, rounds: usize) -> usize {
    if benching { rounds } else { 1 }
}

/// Whether this is `cargo bench`, which says so with an argument.
pub fn is_benching() -> bool {
    std::env::args().any(|argument| argument == "--bench")
}

/// The `nth` number on the command line: `cargo bench --bench NAME -- 200 8`.
pub fn number(nth: usize) -> Option<usize> {
    std::env::args().skip(1).filter_map(|argument| argument.parse().ok()).nth(nth)
}

pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Measurements of the same thing.
#[derive(Debug, Clone)]
pub struct Spread(Vec<f64>);

impl Spread {
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.into_iter().collect();
        values.sort_by(f64::total_cmp);
        Self(values)
    }

    pub fn seconds(times: &[Duration]) -> Self {
        Self::of(times.iter().map(Duration::as_secs_f64))
    }

    /// Of an even number of values, the upper one of the two in the middle.
    pub fn median(&self) -> f64 {
        self.0.get(self.0.len() / 2).copied().unwrap_or(f64::NAN)
    }
}

impl fmt::Display for Spread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (min, max) = (self.0.first().unwrap_or(&f64::NAN), self.0.last().unwrap_or(&f64::NAN));
        write!(f, "median {:.3}, from {min:.3} to {max:.3}", self.median())
    }
}

/// `name: value`, in columns.
pub fn line(name: &str, value: impl fmt::Display) {
    println!("  {name:<24} {value}");
}

/// What is resident of this process, in bytes; `None` where the system does not say it the way Linux does.
#[allow(dead_code, reason = "one bench asks")]
pub fn resident_bytes() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let kib = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?.trim().strip_suffix("kB")?;
    kib.trim().parse::<f64>().ok().map(|kib| kib * 1024.0)
}
