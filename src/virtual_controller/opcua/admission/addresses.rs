use std::collections::HashMap;
use std::net::IpAddr;
use std::time::{Duration, Instant};

/// What each address has done of late, so that nobody floods the log or the list of rejected clients.
///
/// An address that is refused too often is locked for a minute. The lock falls on what is refused, never on the address
/// as a whole, since a robot cell's clients often share one: a proper client behind it is served as always, while a
/// refusal is neither told nor recorded, and ends the connection without a word.
#[derive(Debug, Default)]
pub(super) struct Addresses(HashMap<IpAddr, Account>);

#[derive(Debug)]
struct Account {
    window: Instant,
    refusals: u32,
    lines: u32,
    locked_until: Option<Instant>,
    /// Refusals nobody was told about.
    left_out: u64,
}

/// What to do about one more refusal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Toll {
    /// `left_out` is how many were kept quiet before it, while the address was locked.
    Tell {
        left_out: u64,
    },
    /// To be told, and the last one for a while.
    TellAndLock,
    Quiet,
}

/// What to do about one more line about a connection that is in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Line {
    Tell,
    /// Instead of it, say that lines are left out.
    LastOne,
    Quiet,
}

impl Addresses {
    pub(super) fn refused(&mut self, address: IpAddr, now: Instant) -> Toll {
        let account = self.account(address, now);
        if account.locked_until.is_some() {
            account.left_out += 1;
            return Toll::Quiet;
        }
        account.refusals += 1;
        if account.refusals >= REFUSALS_ALLOWED {
            account.locked_until = Some(now + LOCKED_FOR);
            return Toll::TellAndLock;
        }
        Toll::Tell { left_out: std::mem::take(&mut account.left_out) }
    }

    pub(super) fn line(&mut self, address: IpAddr, now: Instant) -> Line {
        let account = self.account(address, now);
        account.lines = account.lines.saturating_add(1);
        match account.lines {
            0..=LINES_ALLOWED => Line::Tell,
            lines if lines == LINES_ALLOWED + 1 => Line::LastOne,
            _ => Line::Quiet,
        }
    }

    fn account(&mut self, address: IpAddr, now: Instant) -> &mut Account {
        if self.0.len() >= MAX_ADDRESSES && !self.0.contains_key(&address) {
            self.0.retain(|_, account| !account.is_stale(now));
            // Still too many: the one that was quiet for longest is forgotten.
            if self.0.len() >= MAX_ADDRESSES
                && let Some(oldest) =
                    self.0.iter().min_by_key(|(_, account)| account.window).map(|(address, _)| *address)
            {
                self.0.remove(&oldest);
            }
        }
        let new = || Account { window: now, refusals: 0, lines: 0, locked_until: None, left_out: 0 };
        let account = self.0.entry(address).or_insert_with(new);
        if account.is_stale(now) {
            *account = Account { left_out: account.left_out, ..new() };
        }
        account
    }
}

impl Account {
    /// Whether what it remembers no longer counts.
    fn is_stale(&self, now: Instant) -> bool {
        match self.locked_until {
            Some(until) => now >= until,
            None => now.duration_since(self.window) >= WINDOW,
        }
    }
}

/// A client that tries again every two seconds is not locked out.
const REFUSALS_ALLOWED: u32 = 30;
const WINDOW: Duration = Duration::from_secs(60);
const LOCKED_FOR: Duration = Duration::from_secs(60);
/// Opened and closed, for one connection a second.
const LINES_ALLOWED: u32 = 120;
const MAX_ADDRESSES: usize = 1024;

#[cfg(test)]
mod tests {
    use super::*;

    const ADDRESS: IpAddr = IpAddr::V4(std::net::Ipv4Addr::LOCALHOST);

    #[test]
    fn refusals_are_kept_quiet_for_a_minute_once_they_are_too_many() {
        let (mut addresses, start) = (Addresses::default(), Instant::now());
        for _ in 0..29 {
            assert_eq!(addresses.refused(ADDRESS, start), Toll::Tell { left_out: 0 });
        }
        assert_eq!(addresses.refused(ADDRESS, start), Toll::TellAndLock);
        for _ in 0..5 {
            assert_eq!(addresses.refused(ADDRESS, start + Duration::from_secs(59)), Toll::Quiet);
        }
        let other = IpAddr::V4(std::net::Ipv4Addr::BROADCAST);
        assert_eq!(addresses.refused(other, start), Toll::Tell { left_out: 0 });
        let later = start + Duration::from_secs(60);
        assert_eq!(addresses.refused(ADDRESS, later), Toll::Tell { left_out: 5 });
        assert_eq!(addresses.refused(ADDRESS, later), Toll::Tell { left_out: 0 });
    }

    #[test]
    fn a_client_that_tries_every_two_seconds_is_never_locked() {
        let (mut addresses, mut now) = (Addresses::default(), Instant::now());
        for _ in 0..200 {
            assert_eq!(addresses.refused(ADDRESS, now), Toll::Tell { left_out: 0 });
            now += Duration::from_millis(2100);
        }
    }

    #[test]
    fn lines_about_connections_are_bounded_too() {
        let (mut addresses, start) = (Addresses::default(), Instant::now());
        let lines: Vec<Line> = (0..125).map(|_| addresses.line(ADDRESS, start)).collect();
        assert!(lines[..120].iter().all(|line| *line == Line::Tell));
        assert_eq!(lines[120..], [Line::LastOne, Line::Quiet, Line::Quiet, Line::Quiet, Line::Quiet]);
        assert_eq!(addresses.line(ADDRESS, start + Duration::from_secs(61)), Line::Tell);
    }

    #[test]
    fn a_flood_of_addresses_takes_no_more_memory() {
        let (mut addresses, now) = (Addresses::default(), Instant::now());
        for number in 0..5000_u32 {
            addresses.refused(IpAddr::V4(number.into()), now);
        }
        assert_eq!(addresses.0.len(), MAX_ADDRESSES);
    }
}
