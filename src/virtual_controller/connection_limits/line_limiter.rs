use std::collections::HashMap;
use std::time::{Duration, Instant};

use super::SourceNetwork;

/// Limits the log lines about each source in a minute, so that no peer floods a log or the list of rejected clients.
///
/// A source that is refused too often is quiet for a minute: its refusals are counted, but neither written nor
/// recorded, and its connections end without an explanation. A client of the same source that is in order is served as
/// always, since the clients of a robot cell often share one address.
#[derive(Debug, Default)]
pub struct LineLimiter(HashMap<SourceNetwork, SourceAccount>);

#[derive(Debug)]
struct SourceAccount {
    window: Instant,
    refusals: u32,
    lines: u32,
    quiet_until: Option<Instant>,
    /// Lines of this source that were not written.
    left_out: u64,
}

/// What to do about one more refusal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RefusalDecision {
    /// To be written. `left_out` is how many lines of the source were not, before it.
    Tell {
        left_out: u64,
    },
    /// To be written, as the last one for a minute.
    TellLast,
    Quiet,
}

/// What to do about one more line that is not about a refusal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineDecision {
    /// To be written. `left_out` as in [`RefusalDecision::Tell`].
    Tell {
        left_out: u64,
    },
    /// Instead of it, write that lines are left out.
    LastOne,
    Quiet,
}

impl LineLimiter {
    pub fn refused(&mut self, source: SourceNetwork, now: Instant) -> RefusalDecision {
        let account = self.account(source, now);
        if account.quiet_until.is_some() {
            account.left_out += 1;
            return RefusalDecision::Quiet;
        }
        account.refusals += 1;
        if account.refusals >= REFUSALS_ALLOWED {
            account.quiet_until = Some(now + QUIET_FOR);
            return RefusalDecision::TellLast;
        }
        RefusalDecision::Tell { left_out: std::mem::take(&mut account.left_out) }
    }

    pub fn line(&mut self, source: SourceNetwork, now: Instant) -> LineDecision {
        let account = self.account(source, now);
        account.lines = account.lines.saturating_add(1);
        match account.lines {
            0..=LINES_ALLOWED => LineDecision::Tell { left_out: std::mem::take(&mut account.left_out) },
            lines => {
                account.left_out += 1;
                if lines == LINES_ALLOWED + 1 { LineDecision::LastOne } else { LineDecision::Quiet }
            }
        }
    }

    fn account(&mut self, source: SourceNetwork, now: Instant) -> &mut SourceAccount {
        if self.0.len() >= MAX_SOURCES && !self.0.contains_key(&source) {
            self.0.retain(|_, account| !account.is_stale(now));
            // Still too many: the one that began longest ago is forgotten.
            if self.0.len() >= MAX_SOURCES
                && let Some(oldest) = self.0.iter().min_by_key(|(_, account)| account.window).map(|(source, _)| *source)
            {
                self.0.remove(&oldest);
            }
        }
        let new = || SourceAccount { window: now, refusals: 0, lines: 0, quiet_until: None, left_out: 0 };
        let account = self.0.entry(source).or_insert_with(new);
        if account.is_stale(now) {
            *account = SourceAccount { left_out: account.left_out, ..new() };
        }
        account
    }
}

impl SourceAccount {
    /// Whether what it remembers no longer counts.
    fn is_stale(&self, now: Instant) -> bool {
        match self.quiet_until {
            Some(until) => now >= until,
            None => now.duration_since(self.window) >= WINDOW,
        }
    }
}

/// A client that tries again every two seconds is always told.
const REFUSALS_ALLOWED: u32 = 30;
const WINDOW: Duration = Duration::from_secs(60);
const QUIET_FOR: Duration = Duration::from_secs(60);
/// Opened and closed, for a connection every two seconds.
const LINES_ALLOWED: u32 = 60;
const MAX_SOURCES: usize = 1024;

#[cfg(test)]
mod tests {
    use std::net::Ipv4Addr;

    use super::*;

    fn source(address: impl Into<Ipv4Addr>) -> SourceNetwork {
        SourceNetwork::new(address.into().into())
    }

    #[test]
    fn refusals_are_kept_quiet_for_a_minute_once_they_are_too_many() {
        let (mut lines, start, peer) = (LineLimiter::default(), Instant::now(), source(Ipv4Addr::LOCALHOST));
        for _ in 0..29 {
            assert_eq!(lines.refused(peer, start), RefusalDecision::Tell { left_out: 0 });
        }
        assert_eq!(lines.refused(peer, start), RefusalDecision::TellLast);
        for _ in 0..5 {
            assert_eq!(lines.refused(peer, start + Duration::from_secs(59)), RefusalDecision::Quiet);
        }
        assert_eq!(lines.refused(source(Ipv4Addr::BROADCAST), start), RefusalDecision::Tell { left_out: 0 });
        let later = start + Duration::from_secs(60);
        assert_eq!(lines.refused(peer, later), RefusalDecision::Tell { left_out: 5 });
        assert_eq!(lines.refused(peer, later), RefusalDecision::Tell { left_out: 0 });
    }

    #[test]
    fn a_client_that_tries_every_two_seconds_is_always_told() {
        let (mut lines, mut now) = (LineLimiter::default(), Instant::now());
        for _ in 0..200 {
            assert_eq!(lines.refused(source(1), now), RefusalDecision::Tell { left_out: 0 });
            now += Duration::from_millis(2100);
        }
    }

    #[test]
    fn lines_about_connections_are_bounded_and_counted() {
        let (mut lines, start) = (LineLimiter::default(), Instant::now());
        let said: Vec<LineDecision> = (0..65).map(|_| lines.line(source(1), start)).collect();
        assert!(said[..60].iter().all(|line| *line == LineDecision::Tell { left_out: 0 }));
        assert_eq!(
            said[60..],
            [LineDecision::LastOne, LineDecision::Quiet, LineDecision::Quiet, LineDecision::Quiet, LineDecision::Quiet]
        );
        assert_eq!(lines.line(source(1), start + Duration::from_secs(61)), LineDecision::Tell { left_out: 5 });
    }

    #[test]
    fn a_flood_of_sources_takes_no_more_memory() {
        let (mut lines, now) = (LineLimiter::default(), Instant::now());
        for number in 0..5000_u32 {
            lines.refused(source(number), now);
        }
        assert_eq!(lines.0.len(), MAX_SOURCES);
    }
}
