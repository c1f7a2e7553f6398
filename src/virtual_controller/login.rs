use std::collections::HashMap;
use std::net::IpAddr;
use std::time::{Duration, Instant};

use base64::Engine as _;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use secrecy::SecretString;
use sha2::{Digest, Sha256};
use subtle::ConstantTimeEq as _;
use thiserror::Error;
use zeroize::Zeroizing;

use super::connection_limits::SourceNetwork;
use crate::model::{Cause, with_told_cause};
use crate::protocol::{LOCK_OUT_SECS, LOGIN_ATTEMPTS, SESSION_IDLE_SECS};

/// Why a session does not begin.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum LoginError {
    #[error("too many wrong passwords came from this address")]
    LockedOut,
    #[error("the password is wrong")]
    WrongPassword,
    #[error("the system gives no random numbers: {0}")]
    Random(#[source] Cause),
}

/// Counts wrong passwords by source, and locks a source out after [`LOGIN_ATTEMPTS`] of them.
///
/// The count begins anew after a right password, and after [`LOCK_OUT_SECS`] without a wrong one.
#[derive(Debug, Default)]
pub struct LoginThrottle(HashMap<SourceNetwork, FailedLogins>);

#[derive(Debug)]
struct FailedLogins {
    count: u32,
    last: Instant,
}

/// The sessions of one controller. When one too many begins, the one idle for longest ends.
#[derive(Debug, Default)]
pub struct ManagementSessions(Vec<ManagementSession>);

#[derive(Debug)]
struct ManagementSession {
    /// SHA-256 of the token, which itself is kept nowhere.
    digest: [u8; 32],
    used: Instant,
}

const MAX_ADDRESSES: usize = 1024;
const MAX_SESSIONS: usize = 64;
const LOCK_OUT: Duration = Duration::from_secs(LOCK_OUT_SECS);
const IDLE: Duration = Duration::from_secs(SESSION_IDLE_SECS);

impl LoginThrottle {
    pub fn admit(&self, from: IpAddr, now: Instant) -> Result<(), LoginError> {
        match self.0.get(&SourceNetwork::new(from)) {
            Some(failures) if failures.count >= LOGIN_ATTEMPTS && !failures.forgotten(now) => {
                Err(LoginError::LockedOut)
            }
            _ => Ok(()),
        }
    }

    pub fn wrong(&mut self, from: IpAddr, now: Instant) {
        let from = SourceNetwork::new(from);
        self.0.retain(|_, failures| !failures.forgotten(now));
        if self.0.len() >= MAX_ADDRESSES && !self.0.contains_key(&from) {
            let oldest = self.0.iter().min_by_key(|(_, failures)| failures.last).map(|(address, _)| *address);
            oldest.and_then(|address| self.0.remove(&address));
        }
        let failures = self.0.entry(from).or_insert(FailedLogins { count: 0, last: now });
        failures.count += 1;
        failures.last = now;
    }

    pub fn right(&mut self, from: IpAddr) {
        self.0.remove(&SourceNetwork::new(from));
    }
}

impl FailedLogins {
    fn forgotten(&self, now: Instant) -> bool {
        now.saturating_duration_since(self.last) >= LOCK_OUT
    }
}

impl ManagementSessions {
    /// A new session's token: 32 random bytes, base64url.
    pub fn open(&mut self, now: Instant) -> Result<SecretString, LoginError> {
        let mut random = Zeroizing::new([0; 32]);
        getrandom::fill(&mut *random).map_err(with_told_cause(LoginError::Random))?;
        let token = URL_SAFE_NO_PAD.encode(*random);
        self.expire(now);
        if self.0.len() >= MAX_SESSIONS
            && let Some(idlest) = (0..self.0.len()).min_by_key(|index| self.0[*index].used)
        {
            self.0.swap_remove(idlest);
        }
        self.0.push(ManagementSession { digest: digest(&token), used: now });
        Ok(token.into())
    }

    /// Whether the token's session lives; if so, its idle time begins anew.
    pub fn touch(&mut self, token: &str, now: Instant) -> bool {
        self.expire(now);
        match self.find(token) {
            Some(index) => {
                self.0[index].used = now;
                true
            }
            None => false,
        }
    }

    pub fn close(&mut self, token: &str) {
        if let Some(index) = self.find(token) {
            self.0.swap_remove(index);
        }
    }

    fn expire(&mut self, now: Instant) {
        self.0.retain(|session| now.saturating_duration_since(session.used) < IDLE);
    }

    /// Looks at every session, each in constant time.
    fn find(&self, token: &str) -> Option<usize> {
        let digest = digest(token);
        self.0.iter().enumerate().fold(None, |found, (index, session)| {
            if bool::from(session.digest.ct_eq(&digest)) { Some(index) } else { found }
        })
    }
}

fn digest(token: &str) -> [u8; 32] {
    Sha256::digest(token.as_bytes()).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use secrecy::ExposeSecret as _;

    const HERE: IpAddr = IpAddr::V4(std::net::Ipv4Addr::new(10, 0, 0, 1));

    #[test]
    fn five_wrong_passwords_lock_an_address_out_for_a_minute() {
        let (mut throttle, start) = (LoginThrottle::default(), Instant::now());
        for _ in 0..LOGIN_ATTEMPTS {
            assert_eq!(throttle.admit(HERE, start), Ok(()));
            throttle.wrong(HERE, start);
        }
        assert_eq!(throttle.admit(HERE, start), Err(LoginError::LockedOut));
        assert_eq!(throttle.admit("::ffff:10.0.0.1".parse().unwrap(), start), Err(LoginError::LockedOut));
        assert_eq!(throttle.admit("10.0.0.2".parse().unwrap(), start), Ok(()));
        assert!(throttle.admit(HERE, start + LOCK_OUT - Duration::from_secs(1)).is_err());
        assert_eq!(throttle.admit(HERE, start + LOCK_OUT), Ok(()));
        throttle.wrong(HERE, start + LOCK_OUT);
        assert_eq!(throttle.admit(HERE, start + LOCK_OUT), Ok(()), "the count began anew");
    }

    #[test]
    fn a_right_password_clears_the_count() {
        let (mut throttle, now) = (LoginThrottle::default(), Instant::now());
        for _ in 0..LOGIN_ATTEMPTS - 1 {
            throttle.wrong(HERE, now);
        }
        throttle.right(HERE);
        throttle.wrong(HERE, now);
        assert_eq!(throttle.admit(HERE, now), Ok(()));
    }

    #[test]
    fn addresses_without_end_take_no_memory_without_end() {
        let (mut throttle, now) = (LoginThrottle::default(), Instant::now());
        for i in 0..5000_u32 {
            throttle.wrong(IpAddr::V4(i.into()), now);
        }
        assert_eq!(throttle.0.len(), MAX_ADDRESSES);
    }

    #[test]
    fn a_session_lives_while_it_is_used() {
        let (mut sessions, start) = (ManagementSessions::default(), Instant::now());
        let token = sessions.open(start).unwrap();
        let token = token.expose_secret();
        assert_eq!(token.len(), 43);
        let later = start + IDLE - Duration::from_secs(1);
        assert!(sessions.touch(token, later));
        assert!(sessions.touch(token, later + IDLE - Duration::from_secs(1)));
        assert!(!sessions.touch("", later));
        assert!(!sessions.touch(token, later + IDLE * 2));
        assert!(!sessions.touch(token, later), "it ended for good");
    }

    #[test]
    fn a_closed_session_is_over_and_the_idlest_gives_way() {
        let (mut sessions, start) = (ManagementSessions::default(), Instant::now());
        let token = sessions.open(start).unwrap();
        sessions.close(token.expose_secret());
        assert!(!sessions.touch(token.expose_secret(), start));
        let tokens: Vec<SecretString> = (0..=MAX_SESSIONS as u32)
            .map(|i| sessions.open(start + Duration::from_millis(i.into())).unwrap())
            .collect();
        assert!(!sessions.touch(tokens[0].expose_secret(), start));
        assert!(tokens[1..].iter().all(|token| sessions.touch(token.expose_secret(), start)));
    }
}
