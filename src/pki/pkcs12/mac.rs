//! What proves that a PKCS#12 is whole and the password right (RFC 7292 §4; PBMAC1 as RFC 9579 has it).

use std::num::NonZeroU32;

use aws_lc_rs::{digest, hmac, pbkdf2};
use zeroize::Zeroizing;

use super::super::password_encryption::{
    self as encryption, DecryptError, EncodedPassword, algorithm_name, iterations_of,
};
use super::super::tlv::{self, Tlv};

/// MacData, read and not yet checked.
pub(super) struct MacData<'a> {
    hmac: hmac::Algorithm,
    derivation: Derivation<'a>,
    value: &'a [u8],
}

enum Derivation<'a> {
    Pkcs12 { hash: &'static digest::Algorithm, salt: &'a [u8], iterations: u32 },
    Pbkdf2 { hash: pbkdf2::Algorithm, salt: &'a [u8], iterations: u32, length: usize },
}

impl<'a> MacData<'a> {
    pub fn read(data: &Tlv<'a>) -> Result<Self, DecryptError> {
        let parts = tlv::all(data.content).ok_or(DecryptError::Failed)?;
        let (info, salt, iterations) = match parts.as_slice() {
            [info, salt] => (info, salt, 1),
            [info, salt, iterations] => (info, salt, iterations_of(iterations.content)?),
            _ => return Err(DecryptError::Failed),
        };
        let info = tlv::all(info.content).ok_or(DecryptError::Failed)?;
        let [algorithm, value] = info.as_slice() else { return Err(DecryptError::Failed) };
        let (identifier, parameters) = split(algorithm)?;
        if identifier == PBMAC1 {
            return Self::pbmac1(parameters, value.content);
        }
        let (_, hash, hmac) = HASHES
            .iter()
            .find(|(known, ..)| *known == identifier)
            .ok_or_else(|| DecryptError::Unsupported(algorithm_name(identifier)))?;
        let derivation = Derivation::Pkcs12 { hash, salt: salt.content, iterations };
        Ok(Self { hmac: *hmac, derivation, value: value.content })
    }

    /// The salt and the iterations beside it mean nothing.
    fn pbmac1(parameters: &'a [u8], value: &'a [u8]) -> Result<Self, DecryptError> {
        let parts =
            tlv::first(parameters).and_then(|(whole, _)| tlv::all(whole.content)).ok_or(DecryptError::Failed)?;
        let [derivation, mac] = parts.as_slice() else { return Err(DecryptError::Failed) };
        let (kdf, of_kdf) = split(derivation)?;
        if kdf != encryption::PBKDF2 {
            return Err(DecryptError::Unsupported(algorithm_name(kdf)));
        }
        let of_kdf = tlv::first(of_kdf).and_then(|(whole, _)| tlv::all(whole.content)).ok_or(DecryptError::Failed)?;
        // RFC 9579 §4: the length of the key is always there.
        let [salt, iterations, length, hash @ ..] = of_kdf.as_slice() else { return Err(DecryptError::Failed) };
        let length = iterations_of(length.content)? as usize;
        if length > MAX_KEY_BYTES {
            return Err(DecryptError::TooExpensive);
        }
        let hash = match hash {
            [] => HMAC_WITH_SHA1,
            [hash] => split(hash)?.0,
            _ => return Err(DecryptError::Failed),
        };
        let of = |identifier: &'a [u8]| {
            let known = HMACS.iter().find(|(known, ..)| *known == identifier);
            known.ok_or_else(|| DecryptError::Unsupported(algorithm_name(identifier)))
        };
        let derivation = Derivation::Pbkdf2 {
            hash: of(hash)?.1,
            salt: salt.content,
            iterations: iterations_of(iterations.content)?,
            length,
        };
        Ok(Self { hmac: of(split(mac)?.0)?.2, derivation, value })
    }

    /// Whether this is the MAC of `content` under the password. Hashes the password.
    pub fn is_of(&self, content: &[u8], password: &EncodedPassword<'_>) -> bool {
        let key = match self.derivation {
            Derivation::Pkcs12 { hash, salt, iterations } => {
                password.derive(hash, encryption::MAC, salt, iterations, hash.output_len)
            }
            Derivation::Pbkdf2 { hash, salt, iterations, length } => {
                let mut key = Zeroizing::new(vec![0; length]);
                let Some(iterations) = NonZeroU32::new(iterations) else { return false };
                pbkdf2::derive(hash, iterations, salt, password.utf8(), &mut key);
                key
            }
        };
        hmac::verify(&hmac::Key::new(self.hmac, &key), content, self.value).is_ok()
    }
}

/// The identifier of an AlgorithmIdentifier, and its parameters.
fn split<'a>(algorithm: &Tlv<'a>) -> Result<(&'a [u8], &'a [u8]), DecryptError> {
    tlv::first(algorithm.content).map(|(identifier, rest)| (identifier.content, rest)).ok_or(DecryptError::Failed)
}

const MAX_KEY_BYTES: usize = 256;
/// 1.2.840.113549.1.5.14
const PBMAC1: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 5, 14];
/// SHA-1, SHA-224, SHA-256, SHA-384 and SHA-512.
const HASHES: [(&[u8], &digest::Algorithm, hmac::Algorithm); 5] = [
    (&[0x2b, 14, 3, 2, 26], &digest::SHA1_FOR_LEGACY_USE_ONLY, hmac::HMAC_SHA1_FOR_LEGACY_USE_ONLY),
    (&[0x60, 0x86, 0x48, 1, 0x65, 3, 4, 2, 4], &digest::SHA224, hmac::HMAC_SHA224),
    (&[0x60, 0x86, 0x48, 1, 0x65, 3, 4, 2, 1], &digest::SHA256, hmac::HMAC_SHA256),
    (&[0x60, 0x86, 0x48, 1, 0x65, 3, 4, 2, 2], &digest::SHA384, hmac::HMAC_SHA384),
    (&[0x60, 0x86, 0x48, 1, 0x65, 3, 4, 2, 3], &digest::SHA512, hmac::HMAC_SHA512),
];
const HMAC_WITH_SHA1: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 2, 7];
/// 1.2.840.113549.2.7, .9, .10 and .11.
const HMACS: [(&[u8], pbkdf2::Algorithm, hmac::Algorithm); 4] = [
    (HMAC_WITH_SHA1, pbkdf2::PBKDF2_HMAC_SHA1, hmac::HMAC_SHA1_FOR_LEGACY_USE_ONLY),
    (&[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 2, 9], pbkdf2::PBKDF2_HMAC_SHA256, hmac::HMAC_SHA256),
    (&[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 2, 10], pbkdf2::PBKDF2_HMAC_SHA384, hmac::HMAC_SHA384),
    (&[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 2, 11], pbkdf2::PBKDF2_HMAC_SHA512, hmac::HMAC_SHA512),
];
