use std::collections::HashMap;
use std::sync::LazyLock;

use argon2::Argon2;
use argon2::password_hash::{PasswordHash, PasswordVerifier as _};
use aws_lc_rs::hmac;
use parking_lot::Mutex;
use secrecy::{ExposeSecret, SecretString};
use tokio::sync::Semaphore;
use tokio::task::spawn_blocking;

use super::opcua::{HashError, hash_password};

/// As the password of an OPC UA user: Argon2id with a fresh salt, as a PHC string. Takes tens of milliseconds and 19
/// MiB.
pub fn hash_connection_password(password: &SecretString) -> Result<String, HashError> {
    hash_password(password.expose_secret())
}

/// Whether `password` is the one behind `hash`.
pub async fn is_password(hash: &str, password: &SecretString) -> bool {
    CHECKER.check(hash, password).await
}

/// Compares passwords with their Argon2id hashes, and remembers each right one for the life of the process as a tag
/// under a key of that process, so that a configurator that logs in every minute costs Argon2id once. Shared by all
/// controllers of the process: a fleet has one password.
struct PasswordChecker {
    key: hmac::Key,
    /// PHC string → tag of the right password.
    known: Mutex<HashMap<String, hmac::Tag>>,
    /// Argon2id takes 19 MiB a time; hundreds of controllers may be asked at once.
    slots: Semaphore,
}

static CHECKER: LazyLock<PasswordChecker> = LazyLock::new(PasswordChecker::new);

const MAX_KNOWN: usize = 4096;
const ARGON2_AT_ONCE: usize = 4;

impl PasswordChecker {
    fn new() -> Self {
        let mut key = [0; 32];
        getrandom::fill(&mut key).expect("the operating system gives random bytes");
        Self {
            key: hmac::Key::new(hmac::HMAC_SHA256, &key),
            known: Mutex::default(),
            slots: Semaphore::new(ARGON2_AT_ONCE),
        }
    }

    async fn check(&self, hash: &str, password: &SecretString) -> bool {
        if let Some(right) = self.recall(hash, password) {
            return right;
        }
        let Ok(_slot) = self.slots.acquire().await else { return false };
        // Another thread may have computed the same while this one waited.
        if let Some(right) = self.recall(hash, password) {
            return right;
        }
        let (owned_hash, owned_password) = (hash.to_owned(), password.clone());
        let right = spawn_blocking(move || verify(&owned_hash, &owned_password)).await.unwrap_or(false);
        if right {
            let mut known = self.known.lock();
            if known.len() >= MAX_KNOWN {
                known.clear();
            }
            known.insert(hash.to_owned(), self.tag(hash, password));
        }
        right
    }

    /// `None` when the right password has not been seen yet.
    fn recall(&self, hash: &str, password: &SecretString) -> Option<bool> {
        let known = self.known.lock();
        let tag = known.get(hash)?;
        Some(subtle::ConstantTimeEq::ct_eq(tag.as_ref(), self.tag(hash, password).as_ref()).into())
    }

    fn tag(&self, hash: &str, password: &SecretString) -> hmac::Tag {
        let mut context = hmac::Context::with_key(&self.key);
        context.update(hash.as_bytes());
        context.update(&[0]);
        context.update(password.expose_secret().as_bytes());
        context.sign()
    }
}

fn verify(hash: &str, password: &SecretString) -> bool {
    PasswordHash::new(hash)
        .and_then(|hash| Argon2::default().verify_password(password.expose_secret().as_bytes(), &hash))
        .is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn the_right_password_is_known_the_first_time_and_after() {
        let right = SecretString::from("焊接 secret");
        let hash = hash_connection_password(&right).unwrap();
        assert!(hash.starts_with("$argon2id$"));
        for _ in 0..2 {
            assert!(!is_password(&hash, &SecretString::from("wrong")).await);
            assert!(is_password(&hash, &right).await);
        }
        let other = hash_connection_password(&SecretString::from("")).unwrap();
        assert!(!is_password(&other, &right).await);
        assert!(is_password(&other, &SecretString::from("")).await);
        assert!(!is_password("no hash at all", &right).await);
    }
}
