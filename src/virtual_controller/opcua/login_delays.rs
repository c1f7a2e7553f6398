use std::collections::{HashMap, HashSet};
use std::time::{Duration, Instant};

use super::admission::PasswordLogin;
use crate::pki::Fingerprint;
use crate::virtual_controller::connection_limits::SourceNetwork;

/// Slows down clients that guess passwords, and no others.
///
/// Wrong passwords are counted by where they come from (source and certificate) and the name tried, and by where they
/// come from alone. After some, each attempt has to wait, twice as long every time. A client whose trusted certificate
/// has logged in as a user never waits for that name.
#[derive(Debug, Default)]
pub(super) struct LoginDelays {
    wrong: HashMap<(DelayKey, Option<String>), WrongPasswords>,
    welcome: HashSet<(Fingerprint, String)>,
}

type DelayKey = (SourceNetwork, Option<Fingerprint>);

#[derive(Debug)]
struct WrongPasswords {
    count: u32,
    last: Instant,
    /// When the next attempt may be made.
    next: Instant,
}

impl LoginDelays {
    /// How long an attempt has to wait. `None` if too many are waiting already, so that it is refused.
    pub(super) fn delay(&mut self, login: &PasswordLogin, now: Instant) -> Option<Duration> {
        if self.is_welcome(login) {
            return Some(Duration::ZERO);
        }
        let mut wait = Duration::ZERO;
        for (key, free) in keys(login) {
            let Some(wrong) = self.wrong.get_mut(&key).filter(|wrong| !wrong.is_forgotten(now)) else { continue };
            let pause = wrong.pause(free);
            if pause.is_zero() {
                continue;
            }
            let begin = wrong.next.max(now);
            wait = wait.max(begin - now);
            if wait > LONGEST_WAIT {
                return None;
            }
            wrong.next = begin + pause;
        }
        Some(wait)
    }

    /// Whether a client with a trusted certificate logged in with this name before.
    fn is_welcome(&self, login: &PasswordLogin) -> bool {
        login.certificate.is_some_and(|certificate| self.welcome.contains(&(certificate, login.name.clone())))
    }

    pub(super) fn right(&mut self, login: &PasswordLogin) {
        for (key, _) in keys(login) {
            self.wrong.remove(&key);
        }
        if let Some(certificate) = login.certificate
            && self.welcome.len() < MAX_WELCOME
        {
            self.welcome.insert((certificate, login.name.clone()));
        }
    }

    pub(super) fn wrong(&mut self, login: &PasswordLogin, now: Instant) {
        for (key, free) in keys(login) {
            if self.wrong.len() >= MAX_WRONG && !self.wrong.contains_key(&key) {
                self.wrong.retain(|_, wrong| !wrong.is_forgotten(now));
                let oldest = self.wrong.iter().min_by_key(|(_, wrong)| wrong.last).map(|(key, _)| key.clone());
                if self.wrong.len() >= MAX_WRONG
                    && let Some(oldest) = oldest
                {
                    self.wrong.remove(&oldest);
                }
            }
            let wrong = self.wrong.entry(key).or_insert(WrongPasswords { count: 0, last: now, next: now });
            if wrong.is_forgotten(now) {
                wrong.count = 0;
            }
            wrong.count = wrong.count.saturating_add(1);
            wrong.last = now;
            wrong.next = wrong.next.max(now + wrong.pause(free));
        }
    }
}

impl WrongPasswords {
    fn is_forgotten(&self, now: Instant) -> bool {
        now.saturating_duration_since(self.last) >= FORGOTTEN_AFTER
    }

    /// Between two attempts, of which `free` need none.
    fn pause(&self, free: u32) -> Duration {
        match self.count.checked_sub(free) {
            Some(more) => (FIRST_PAUSE * 2_u32.pow(more.min(10))).min(LONGEST_PAUSE),
            None => Duration::ZERO,
        }
    }
}

/// Under what an attempt is counted, each with how many wrong ones cost nothing.
fn keys(login: &PasswordLogin) -> [((DelayKey, Option<String>), u32); 2] {
    let client = (login.source, login.certificate);
    [((client, Some(login.name.clone())), FREE_FOR_A_NAME), ((client, None), FREE)]
}

const FREE_FOR_A_NAME: u32 = 5;
const FREE: u32 = 20;
const FIRST_PAUSE: Duration = Duration::from_secs(1);
const LONGEST_PAUSE: Duration = Duration::from_secs(60);
/// Less than what clients wait for an answer.
const LONGEST_WAIT: Duration = Duration::from_secs(4);
const FORGOTTEN_AFTER: Duration = Duration::from_secs(10 * 60);
const MAX_WRONG: usize = 2048;
const MAX_WELCOME: usize = 1024;

#[cfg(test)]
mod tests {
    use super::*;

    fn login(address: u8, certificate: Option<u8>, name: &str) -> PasswordLogin {
        let client = std::net::SocketAddr::from(([192, 168, 0, address], 50_000));
        let certificate = certificate.map(|byte| Fingerprint::of(&[byte]));
        PasswordLogin { name: name.to_owned(), client, source: SourceNetwork::new(client.ip()), certificate }
    }

    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn who_guesses_waits_longer_every_time_and_nobody_else_does() {
        let (mut delays, start) = (LoginDelays::default(), Instant::now());
        let stranger = login(77, None, "operator1");
        let mut now = start;
        for pause in [0, 0, 0, 0, 0, 1, 2, 4] {
            assert_eq!(delays.delay(&stranger, now), Some(SECOND * pause));
            now += SECOND * pause;
            delays.wrong(&stranger, now);
        }
        assert_eq!(delays.delay(&stranger, now), None, "eight seconds is too long to wait for");
        for other in [login(1, None, "operator1"), login(77, Some(1), "operator1"), login(77, None, "operator2")] {
            assert_eq!(delays.delay(&other, now), Some(Duration::ZERO), "{other:?}");
        }
        assert_eq!(delays.delay(&stranger, now + SECOND * 8), Some(Duration::ZERO));
        assert_eq!(delays.delay(&stranger, now + FORGOTTEN_AFTER), Some(Duration::ZERO));
    }

    #[test]
    fn guesses_at_the_same_time_wait_for_each_other() {
        let (mut delays, now, stranger) = (LoginDelays::default(), Instant::now(), login(77, None, "operator1"));
        (0..6).for_each(|_| delays.wrong(&stranger, now));
        assert_eq!(delays.delay(&stranger, now), Some(SECOND * 2));
        assert_eq!(delays.delay(&stranger, now), Some(SECOND * 4));
        assert_eq!(delays.delay(&stranger, now), None);
    }

    #[test]
    fn many_names_are_guessing_too_and_a_right_password_ends_it() {
        let (mut delays, now) = (LoginDelays::default(), Instant::now());
        for number in 0..20 {
            delays.wrong(&login(77, None, &format!("user{number}")), now);
        }
        assert_eq!(delays.delay(&login(77, None, "another"), now), Some(SECOND));
        delays.right(&login(77, None, "another"));
        assert_eq!(delays.delay(&login(77, None, "another"), now), Some(Duration::ZERO));
    }

    #[test]
    fn a_client_that_has_logged_in_with_its_certificate_never_waits() {
        let (mut delays, now, operator) = (LoginDelays::default(), Instant::now(), login(1, Some(1), "operator1"));
        delays.right(&operator);
        for _ in 0..30 {
            delays.wrong(&operator, now);
        }
        assert_eq!(delays.delay(&operator, now), Some(Duration::ZERO));
        assert_eq!(delays.delay(&login(1, Some(1), "operator2"), now), None);
    }

    #[test]
    fn names_without_end_take_no_memory_without_end() {
        let (mut delays, now) = (LoginDelays::default(), Instant::now());
        for number in 0..5000 {
            delays.wrong(&login(77, None, &number.to_string()), now);
        }
        assert_eq!(delays.wrong.len(), MAX_WRONG);
    }
}
