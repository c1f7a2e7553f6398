use argon2::{Algorithm, Argon2, Params, Version};
use aws_lc_rs::aead::{AES_256_GCM, Aad, LessSafeKey, NONCE_LEN, Nonce, UnboundKey};
use secrecy::{ExposeSecret as _, SecretString};
use thiserror::Error;
use zeroize::Zeroizing;

use crate::model::{Cause, with_told_cause};

/// Bytes that only the passphrase opens: AES-256-GCM under a key that Argon2id makes of passphrase and salt.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sealed {
    /// Random, one for each passphrase.
    pub salt: [u8; SEAL_SALT_BYTES],
    /// Random, one for each sealing.
    pub nonce: [u8; NONCE_LEN],
    /// As long as what was sealed, and sixteen bytes.
    pub bytes: Vec<u8>,
}

/// Bytes of [`Sealed::salt`].
pub const SEAL_SALT_BYTES: usize = 16;
/// Bytes of [`Sealed::nonce`].
pub const SEAL_NONCE_BYTES: usize = NONCE_LEN;

/// Why data cannot be sealed or opened.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SealError {
    // The library does not say why it opens or seals nothing, so that no error helps an attacker.
    /// The passphrase is wrong, or the data was changed.
    #[error("the passphrase is wrong, or the data was changed")]
    NotOpened,
    /// The operating system gave no random numbers; holds its error.
    #[error("the system gives no random numbers: {0}")]
    Random(#[source] Cause),
    /// Argon2id made no key; holds its error.
    #[error("the passphrase cannot be made a key: {0}")]
    Key(#[source] Cause),
    /// AES-256-GCM did not encrypt.
    #[error("the data cannot be encrypted")]
    Encrypt,
}

/// What Argon2id takes to make a key of a passphrase. Both ends must use the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SealCost {
    memory_kib: u32,
    passes: u32,
    lanes: u32,
}

impl SealCost {
    /// 19 MiB, two passes, one lane: what a controller can afford. Tens of milliseconds.
    pub const CONTROLLER: Self = Self { memory_kib: 19_456, passes: 2, lanes: 1 };
    /// 64 MiB, three passes, four lanes: the second choice of RFC 9106 §4, for a PC. Some hundred milliseconds.
    pub const PC: Self = Self { memory_kib: 65_536, passes: 3, lanes: 4 };
}

/// Seals `plain` at [`SealCost::CONTROLLER`], under a fresh salt. `context` stays readable and is needed, unchanged, to
/// open it again. Blocks.
pub fn seal(plain: &[u8], context: &[u8], passphrase: &SecretString) -> Result<Sealed, SealError> {
    SealingKey::new(passphrase, SealCost::CONTROLLER)?.seal(plain, context)
}

/// What [`seal`] sealed, if passphrase, context and every byte are the same as then. Blocks.
pub fn open(sealed: &Sealed, context: &[u8], passphrase: &SecretString) -> Result<Zeroizing<Vec<u8>>, SealError> {
    SealingKey::with_salt(passphrase, sealed.salt, SealCost::CONTROLLER)?.open(sealed, context)
}

/// The key made of a passphrase and a salt, for data that is opened and sealed again several times. Wiped when dropped.
pub struct SealingKey {
    salt: [u8; SEAL_SALT_BYTES],
    key: Zeroizing<[u8; KEY_BYTES]>,
}

impl std::fmt::Debug for SealingKey {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("SealingKey(…)")
    }
}

impl SealingKey {
    /// Under a fresh salt. Blocks for as long as `cost` takes.
    pub fn new(passphrase: &SecretString, cost: SealCost) -> Result<Self, SealError> {
        let mut salt = [0; SEAL_SALT_BYTES];
        getrandom::fill(&mut salt).map_err(with_told_cause(SealError::Random))?;
        Self::with_salt(passphrase, salt, cost)
    }

    /// Under the salt of something sealed before. Blocks for as long as `cost` takes.
    pub fn with_salt(
        passphrase: &SecretString,
        salt: [u8; SEAL_SALT_BYTES],
        cost: SealCost,
    ) -> Result<Self, SealError> {
        let SealCost { memory_kib, passes, lanes } = cost;
        let params =
            Params::new(memory_kib, passes, lanes, Some(KEY_BYTES)).map_err(with_told_cause(SealError::Key))?;
        let mut key = Zeroizing::new([0; KEY_BYTES]);
        Argon2::new(Algorithm::Argon2id, Version::V0x13, params)
            .hash_password_into(passphrase.expose_secret().as_bytes(), &salt, &mut *key)
            .map_err(with_told_cause(SealError::Key))?;
        Ok(Self { salt, key })
    }

    /// Seals under a fresh nonce of 96 random bits, which allows 2^32 of them (NIST SP 800-38D §8.3).
    pub fn seal(&self, plain: &[u8], context: &[u8]) -> Result<Sealed, SealError> {
        let mut nonce = [0; NONCE_LEN];
        getrandom::fill(&mut nonce).map_err(with_told_cause(SealError::Random))?;
        // Room for the tag: bytes that are not sealed yet must not be left behind where the vector grows.
        let mut bytes = Vec::with_capacity(plain.len() + AES_256_GCM.tag_len());
        bytes.extend_from_slice(plain);
        self.cipher()?
            .seal_in_place_append_tag(Nonce::assume_unique_for_key(nonce), Aad::from(context), &mut bytes)
            .map_err(|_| SealError::Encrypt)?;
        Ok(Sealed { salt: self.salt, nonce, bytes })
    }

    /// What was sealed, if it was under this key and context and not a byte was changed since.
    pub fn open(&self, sealed: &Sealed, context: &[u8]) -> Result<Zeroizing<Vec<u8>>, SealError> {
        let mut bytes = Zeroizing::new(sealed.bytes.clone());
        let length = self
            .cipher()?
            .open_in_place(Nonce::assume_unique_for_key(sealed.nonce), Aad::from(context), &mut bytes)
            .map_err(|_| SealError::NotOpened)?
            .len();
        bytes.truncate(length);
        Ok(bytes)
    }

    /// Whether it was made under the salt of `sealed`.
    pub fn has_salt_of(&self, sealed: &Sealed) -> bool {
        self.salt == sealed.salt
    }

    fn cipher(&self) -> Result<LessSafeKey, SealError> {
        UnboundKey::new(&AES_256_GCM, &*self.key).map(LessSafeKey::new).map_err(|_| SealError::Encrypt)
    }
}

const KEY_BYTES: usize = 32;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_passphrase_and_the_context_open_it() {
        let (right, wrong) = (SecretString::from("correct horse"), SecretString::from("correct house"));
        let sealed = seal(b"secret settings", b"R7A0000001", &right).unwrap();
        assert!(!sealed.bytes.windows(6).any(|w| w == b"secret"));
        assert_ne!(sealed, seal(b"secret settings", b"R7A0000001", &right).unwrap(), "salted");
        assert_eq!(open(&sealed, b"R7A0000001", &right).unwrap().as_slice(), b"secret settings");
        assert_eq!(open(&sealed, b"R7A0000001", &wrong), Err(SealError::NotOpened));
        assert_eq!(open(&sealed, b"R7A0000002", &right), Err(SealError::NotOpened));
        for position in 0..sealed.bytes.len() {
            let mut changed = sealed.clone();
            changed.bytes[position] ^= 1;
            assert_eq!(open(&changed, b"R7A0000001", &right), Err(SealError::NotOpened));
        }
        for length in [0, 1, 15, 16, sealed.bytes.len() - 1] {
            let cut = Sealed { bytes: sealed.bytes[..length].to_vec(), ..sealed.clone() };
            assert_eq!(open(&cut, b"R7A0000001", &right), Err(SealError::NotOpened));
        }
    }
    #[test]
    fn a_key_seals_again_and_again_under_its_salt() {
        let passphrase = SecretString::from("correct horse");
        let key = SealingKey::new(&passphrase, SealCost::PC).unwrap();
        let (one, two) = (key.seal(b"secret", b"1").unwrap(), key.seal(b"secret", b"1").unwrap());
        assert!(key.has_salt_of(&one) && one.salt == two.salt && one.nonce != two.nonce && one.bytes != two.bytes);
        let again = SealingKey::with_salt(&passphrase, one.salt, SealCost::PC).unwrap();
        assert_eq!(again.open(&two, b"1").unwrap().as_slice(), b"secret");
        assert_eq!(again.open(&two, b"2"), Err(SealError::NotOpened));
        let cheaper = SealingKey::with_salt(&passphrase, one.salt, SealCost::CONTROLLER).unwrap();
        assert_eq!(cheaper.open(&one, b"1"), Err(SealError::NotOpened));
    }
}
