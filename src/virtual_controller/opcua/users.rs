use std::collections::HashMap;
use std::sync::Arc;
use std::time::Instant;

use argon2::password_hash::{PasswordHash, PasswordHasher, PasswordVerifier, SaltString};
use argon2::{Algorithm, Argon2, Params, Version};
use async_trait::async_trait;
use opcua::server::ServerEndpoint;
use opcua::server::authenticator::{AuthManager, Password, UserToken};
use opcua::types::{Error, StatusCode};
use parking_lot::Mutex;
use tokio::sync::Semaphore;
use zeroize::Zeroizing;

use super::admission::{Gate, PasswordLogin};
use super::config::OpcUaUser;
use super::endpoints::UserTokens;
use super::events::{ServerEvent, ServerEvents};
use super::login_delays::LoginDelays;
use crate::model::{Cause, with_told_cause};

/// Why a password could not be hashed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum HashError {
    /// The operating system gave no random numbers; holds its error.
    #[error("the system gives no random numbers: {0}")]
    Random(#[source] Cause),
    /// Argon2id failed.
    #[error("the password cannot be hashed: {0}")]
    Hash(#[source] Cause),
}

/// The argon2id hash of a password under a fresh salt, in the PHC string format.
///
/// Takes 19 MiB and two passes (the OWASP minimum, fit for a controller): tens of milliseconds, so not for an async
/// task or the UI thread.
pub fn hash_password(password: &str) -> Result<String, HashError> {
    let mut salt = [0; 16];
    getrandom::fill(&mut salt).map_err(with_told_cause(HashError::Random))?;
    let salt = SaltString::encode_b64(&salt).map_err(with_told_cause(HashError::Hash))?;
    let params = Params::new(MEMORY_KIB, PASSES, LANES, None).map_err(with_told_cause(HashError::Hash))?;
    Argon2::new(Algorithm::Argon2id, Version::V0x13, params)
        .hash_password(password.as_bytes(), &salt)
        .map(|hash| hash.to_string())
        .map_err(with_told_cause(HashError::Hash))
}

/// Decides who may log in (OPC 10000-4 §5.7.3 ActivateSession).
///
/// A wrong password and an unknown user cannot be told apart: both are refused with the same status after the same
/// work.
pub(super) struct Users {
    tokens: UserTokens,
    hashes: HashMap<String, String>,
    delays: Mutex<LoginDelays>,
    gate: Arc<Gate>,
    events: ServerEvents,
}

impl Users {
    /// `gate`: where the names of users come from, marked with their connections.
    pub(super) fn new(tokens: UserTokens, users: &[OpcUaUser], gate: Arc<Gate>, events: ServerEvents) -> Self {
        Self {
            tokens,
            hashes: users.iter().map(|user| (user.name.clone(), user.password_hash.clone())).collect(),
            delays: Mutex::default(),
            gate,
            events,
        }
    }

    async fn log_in(&self, login: &PasswordLogin, password: Zeroizing<String>) -> bool {
        let known = self.hashes.get(&login.name);
        // The name of an unknown user may be a password in the wrong field.
        let user = known.is_some().then_some(login.name.as_str());
        let delay = self.delays.lock().delay(login, Instant::now());
        let Some(delay) = delay else {
            self.gate.login_refused(login.client, user, "too soon after too many wrong passwords");
            return false;
        };
        tokio::time::sleep(delay).await;
        let hash = known.map_or(NOBODYS_HASH, String::as_str).to_owned();
        let is_right = verify(hash, password).await && known.is_some();
        if is_right {
            self.delays.lock().right(login);
        } else {
            self.delays.lock().wrong(login, Instant::now());
            let reason = if known.is_some() { "wrong password" } else { "no such user" };
            self.gate.login_refused(login.client, user, reason);
        }
        is_right
    }

    fn welcome(&self, user: Option<&str>, endpoint: &ServerEndpoint) {
        let (policy, mode) = (&endpoint.security_policy, &endpoint.security_mode);
        self.events.tell(ServerEvent::LoggedIn { user, policy, mode });
    }
}

#[async_trait]
impl AuthManager for Users {
    async fn authenticate_anonymous_token(&self, endpoint: &ServerEndpoint) -> Result<(), Error> {
        if self.tokens.anonymous() {
            self.welcome(None, endpoint);
            Ok(())
        } else {
            let reason = "anonymous users are not let in";
            self.events.tell(ServerEvent::LoginRefused { client: None, user: None, reason });
            Err(Error::new(StatusCode::BadIdentityTokenRejected, reason))
        }
    }

    async fn authenticate_username_identity_token(
        &self,
        endpoint: &ServerEndpoint,
        name: &str,
        password: &Password,
    ) -> Result<UserToken, Error> {
        let password = Zeroizing::new(password.get().to_owned());
        if self.tokens.user_name()
            && let Some(login) = self.gate.login(name)
            && self.log_in(&login, password).await
        {
            self.welcome(Some(&login.name), endpoint);
            Ok(UserToken(login.name))
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
}
