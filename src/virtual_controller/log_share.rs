use std::time::{Duration, Instant};

/// How much of a log peers may fill that have proved nothing.
///
/// The log stops the server when it is full, so that strangers must not be able to fill it: they get a quarter of what
/// was free when this process opened the log. Of what comes after that, the number and the last line are written, first
/// after a minute, then after two, and so on up to once a day.
#[derive(Debug)]
pub struct UnauthenticatedShare {
    /// Bytes the log had when it was opened.
    begin: u64,
    used: u64,
    left_out: u64,
    last: String,
    summary_due: Instant,
    interval: Duration,
}

impl UnauthenticatedShare {
    pub fn new(begin: u64, now: Instant) -> Self {
        Self {
            begin,
            used: 0,
            left_out: 0,
            last: String::new(),
            summary_due: now + FIRST_INTERVAL,
            interval: FIRST_INTERVAL,
        }
    }

    /// Whether a line of `bytes` may be written to a log that is full at `threshold` bytes. If not, it is counted.
    pub fn admit(&mut self, what: &str, bytes: u64, threshold: u64) -> bool {
        let share = threshold.saturating_sub(self.begin) / SHARE;
        if self.used + bytes <= share {
            self.used += bytes;
            return true;
        }
        self.left_out += 1;
        what.clone_into(&mut self.last);
        false
    }

    /// A line about what was left out, when it is time for one.
    pub fn summary(&mut self, now: Instant) -> Option<String> {
        if self.left_out == 0 || now < self.summary_due {
            return None;
        }
        self.interval = (self.interval * 2).min(LAST_INTERVAL);
        self.summary_due = now + self.interval;
        let count = std::mem::take(&mut self.left_out);
        Some(format!("{count} lines about unknown clients left out; the last: {}", self.last))
    }
}

const SHARE: u64 = 4;
const FIRST_INTERVAL: Duration = Duration::from_secs(60);
const LAST_INTERVAL: Duration = Duration::from_secs(24 * 60 * 60);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strangers_get_a_quarter_of_what_is_free_and_a_few_lines_a_day() {
        let start = Instant::now();
        let mut share = UnauthenticatedShare::new(2000, start);
        assert!((0..10).all(|_| share.admit("a", 100, 6000)));
        assert!(!share.admit("b", 100, 6000));
        assert_eq!(share.summary(start), None, "not yet");

        let (mut now, mut lines) = (start, Vec::new());
        for _ in 0..48 * 60 {
            now += Duration::from_secs(60);
            share.admit("c", 100, 6000);
            lines.extend(share.summary(now));
        }
        assert_eq!(lines.first().unwrap(), "2 lines about unknown clients left out; the last: c");
        assert!((11..=13).contains(&lines.len()), "{lines:?}");
        let counted: u64 = lines.iter().map(|line| line.split(' ').next().unwrap().parse::<u64>().unwrap()).sum();
        assert!(counted > 24 * 60, "{counted}");
    }
}
