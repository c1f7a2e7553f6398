use std::collections::HashMap;
use std::time::{Duration, Instant};

use argon2::password_hash::{PasswordHash, PasswordHasher, PasswordVerifier, SaltString};
use argon2::{Algorithm, Argon2, Params, Version};
use async_trait::async_trait;
use opcua::server::ServerEndpoint;
use opcua::server::authenticator::{AuthManager, Password, UserToken};
use opcua::types::{Error, StatusCode};
use parking_lot::Mutex;
use tokio::sync::Semaphore;
use zeroize::Zeroizing;

use super::config::OpcUaUser;
use super::endpoints::UserTokens;
use super::events::{Event, Events};

/// Why a password could not be hashed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum HashError {
    #[error("the system gives no random numbers: {0}")]
    Random(String),
    #[error("the password cannot be hashed: {0}")]
    Hash(argon2::password_hash::Error),
}

/// The argon2id hash of a password under a fresh salt, in the PHC string format.
///
/// Takes 19 MiB and two passes (the OWASP minimum, fit for a controller): tens of milliseconds, so not for an async
/// task or the UI thread.
pub fn hash_password(password: &str) -> Result<String, HashError> {
    let mut salt = [0; 16];
    getrandom::fill(&mut salt).map_err(|e| HashError::Random(e.to_string()))?;
    let salt = SaltString::encode_b64(&salt).map_err(HashError::Hash)?;
    let params = Params::new(MEMORY_KIB, PASSES, LANES, None).map_err(|e| HashError::Hash(e.into()))?;
    Argon2::new(Algorithm::Argon2id, Version::V0x13, params)
        .hash_password(password.as_bytes(), &salt)
        .map(|hash| hash.to_string())
        .map_err(HashError::Hash)
}

/// Decides who may log in (OPC 10000-4, 5.6.3 ActivateSession).
///
/// A wrong password, a locked and an unknown user cannot be told apart: all are refused with the same status after
/// the same work.
pub(super) struct Users {
    tokens: UserTokens,
    hashes: HashMap<String, String>,
    lockouts: Mutex<HashMap<String, Lockout>>,
    events: Events,
}

impl Users {
    pub(super) fn new(tokens: UserTokens, users: &[OpcUaUser], events: Events) -> Self {
        Self {
            tokens,
            hashes: users.iter().map(|user| (user.name.clone(), user.password_hash.clone())).collect(),
            lockouts: Mutex::default(),
            events,
        }
    }

    async fn log_in(&self, name: &str, password: Zeroizing<String>) -> bool {
        let known = self.hashes.get(name);
        let hash = known.map_or(NOBODYS_HASH, String::as_str).to_owned();
        let right = verify(hash, password).await;
        if known.is_none() {
            tracing::warn!("login of an unknown user refused");
            self.refused(None, "no such user");
            return false;
        }
        let verdict = self.lockouts.lock().entry(name.to_owned()).or_default().judge(right, Instant::now());
        match verdict {
            Verdict::Welcome => {}
            Verdict::Wrong => {
                tracing::warn!(user = name, "login refused: wrong password");
                self.refused(Some(name), "wrong password");
            }
            Verdict::Locked => {
                tracing::warn!(user = name, "login refused: locked out after wrong passwords");
                self.refused(Some(name), "locked out after wrong passwords");
            }
        }
        verdict == Verdict::Welcome
    }

    fn refused(&self, user: Option<&str>, reason: &str) {
        self.events.tell(Event::LoginRefused { user, reason });
    }

    fn welcome(&self, user: Option<&str>, endpoint: &ServerEndpoint) {
        let (policy, mode) = (&endpoint.security_policy, &endpoint.security_mode);
        self.events.tell(Event::LoggedIn { user, policy, mode });
    }
}

#[async_trait]
impl AuthManager for Users {
    async fn authenticate_anonymous_token(&self, endpoint: &ServerEndpoint) -> Result<(), Error> {
        if self.tokens.anonymous() {
            self.welcome(None, endpoint);
            Ok(())
        } else {
            self.refused(None, "anonymous users are not let in");
            Err(Error::new(StatusCode::BadIdentityTokenRejected, "anonymous users are not let in"))
        }
    }

    async fn authenticate_username_identity_token(
        &self,
        endpoint: &ServerEndpoint,
        name: &str,
        password: &Password,
    ) -> Result<UserToken, Error> {
        if self.tokens.user_name() && self.log_in(name, Zeroizing::new(password.get().to_owned())).await {
            self.welcome(Some(name), endpoint);
            Ok(UserToken(name.to_owned()))
        } else {
            Err(Error::new(StatusCode::BadUserAccessDenied, "user name or password wrong"))
        }
    }

    fn user_token_policies(&self, endpoint: &ServerEndpoint) -> Vec<opcua::types::UserTokenPolicy> {
        self.tokens.policies(endpoint)
    }
}

async fn verify(hash: String, password: Zeroizing<String>) -> bool {
    // Never closed, so always granted.
    let _turn = HASHING.acquire().await;
    tokio::task::spawn_blocking(move || {
        PasswordHash::new(&hash).is_ok_and(|hash| Argon2::default().verify_password(password.as_bytes(), &hash).is_ok())
    })
    .await
    .unwrap_or(false)
}

/// How many wrong passwords in a row a user has given, and until when nobody is let in under that name.
#[derive(Debug, Default)]
struct Lockout {
    wrong: u32,
    until: Option<Instant>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Welcome,
    Wrong,
    Locked,
}

impl Lockout {
    /// Called once the password was verified, so that attempts made side by side count like those made in turn.
    fn judge(&mut self, right: bool, now: Instant) -> Verdict {
        if let Some(until) = self.until {
            if now < until {
                return Verdict::Locked;
            }
            *self = Self::default();
        }
        if right {
            self.wrong = 0;
            return Verdict::Welcome;
        }
        self.wrong += 1;
        if self.wrong >= WRONG_PASSWORDS_ALLOWED {
            self.until = Some(now + LOCKED_FOR);
        }
        Verdict::Wrong
    }
}

const WRONG_PASSWORDS_ALLOWED: u32 = 5;
const LOCKED_FOR: Duration = Duration::from_secs(60);

const MEMORY_KIB: u32 = 19_456;
const PASSES: u32 = 2;
const LANES: u32 = 1;

/// No password has this hash; it makes an unknown user cost what a known one costs.
const NOBODYS_HASH: &str =
    "$argon2id$v=19$m=19456,t=2,p=1$bm9ib2R5bm9ib2R5bm9ibw$AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA";

/// However many clients log in at once, at all servers of the process, they take the memory of these few.
static HASHING: Semaphore = Semaphore::const_new(2);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_password_is_recognised_by_its_hash_and_salted() {
        let hash = hash_password("Passw0rd").unwrap();
        assert!(hash.starts_with("$argon2id$v=19$m=19456,t=2,p=1$"));
        assert_ne!(hash, hash_password("Passw0rd").unwrap());
        let parsed = PasswordHash::new(&hash).unwrap();
        assert!(Argon2::default().verify_password(b"Passw0rd", &parsed).is_ok());
        assert!(Argon2::default().verify_password(b"passw0rd", &parsed).is_err());
    }

    #[test]
    fn an_unknown_user_costs_a_real_hash() {
        let nobody = PasswordHash::new(NOBODYS_HASH).unwrap();
        assert_eq!(nobody.algorithm, argon2::ARGON2ID_IDENT);
        assert_eq!(
            Argon2::default().verify_password(b"Passw0rd", &nobody),
            Err(argon2::password_hash::Error::Password)
        );
    }

    #[test]
    fn five_wrong_passwords_lock_a_user_out_for_a_minute() {
        let start = Instant::now();
        let mut lockout = Lockout::default();
        for _ in 0..4 {
            assert_eq!(lockout.judge(false, start), Verdict::Wrong);
        }
        assert_eq!(lockout.judge(true, start), Verdict::Welcome);
        for _ in 0..5 {
            assert_eq!(lockout.judge(false, start), Verdict::Wrong);
        }
        assert_eq!(lockout.judge(true, start + Duration::from_secs(59)), Verdict::Locked);
        assert_eq!(lockout.judge(true, start + Duration::from_secs(60)), Verdict::Welcome);
    }
}
