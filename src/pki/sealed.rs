use argon2::{Algorithm, Argon2, Params, Version};
use aws_lc_rs::aead::{AES_256_GCM, Aad, LessSafeKey, NONCE_LEN, Nonce, UnboundKey};
use secrecy::{ExposeSecret as _, SecretString};
use thiserror::Error;
use zeroize::Zeroizing;

/// Bytes that only the passphrase opens: AES-256-GCM under a key that Argon2id makes of passphrase and salt.
///
/// Argon2id takes 19 MiB and two passes in one lane, which a controller can afford: tens of milliseconds, so not for
/// an async task. The salt is fresh each time, and with it the key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sealed {
    pub salt: [u8; SEAL_SALT_BYTES],
    pub nonce: [u8; NONCE_LEN],
    /// As long as what was sealed, and sixteen bytes.
    pub bytes: Vec<u8>,
}

pub const SEAL_SALT_BYTES: usize = 16;
pub const SEAL_NONCE_BYTES: usize = NONCE_LEN;

#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SealError {
    #[error("the passphrase is wrong, or the data was changed")]
    NotOpened,
    #[error("the system gives no random numbers: {0}")]
    Random(String),
    #[error("the passphrase cannot be made a key: {0}")]
    Key(String),
    #[error("the data cannot be encrypted")]
    Encrypt,
}

/// Seals `plain`. `context` stays readable and is needed, unchanged, to open it again.
pub fn seal(plain: &[u8], context: &[u8], passphrase: &SecretString) -> Result<Sealed, SealError> {
    let (mut salt, mut nonce) = ([0; SEAL_SALT_BYTES], [0; NONCE_LEN]);
    for bytes in [&mut salt[..], &mut nonce[..]] {
        getrandom::fill(bytes).map_err(|e| SealError::Random(e.to_string()))?;
    }
    let mut bytes = plain.to_vec();
    key(passphrase, &salt)?
        .seal_in_place_append_tag(Nonce::assume_unique_for_key(nonce), Aad::from(context), &mut bytes)
        .map_err(|_| SealError::Encrypt)?;
    Ok(Sealed { salt, nonce, bytes })
}

/// What was sealed, if passphrase, context and every byte are those of then.
pub fn open(sealed: &Sealed, context: &[u8], passphrase: &SecretString) -> Result<Zeroizing<Vec<u8>>, SealError> {
    let mut bytes = Zeroizing::new(sealed.bytes.clone());
    let length = key(passphrase, &sealed.salt)?
        .open_in_place(Nonce::assume_unique_for_key(sealed.nonce), Aad::from(context), &mut bytes)
        .map_err(|_| SealError::NotOpened)?
        .len();
    bytes.truncate(length);
    Ok(bytes)
}

fn key(passphrase: &SecretString, salt: &[u8]) -> Result<LessSafeKey, SealError> {
    let params = Params::new(MEMORY_KIB, PASSES, LANES, Some(KEY_BYTES)).map_err(|e| SealError::Key(e.to_string()))?;
    let mut key = Zeroizing::new([0; KEY_BYTES]);
    Argon2::new(Algorithm::Argon2id, Version::V0x13, params)
        .hash_password_into(passphrase.expose_secret().as_bytes(), salt, &mut *key)
        .map_err(|e| SealError::Key(e.to_string()))?;
    UnboundKey::new(&AES_256_GCM, &*key).map(LessSafeKey::new).map_err(|_| SealError::Encrypt)
}

const KEY_BYTES: usize = 32;
const MEMORY_KIB: u32 = 19_456;
const PASSES: u32 = 2;
const LANES: u32 = 1;

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
}
