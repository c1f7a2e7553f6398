use std::fmt;

use aws_lc_rs::encoding::AsDer as _;
use aws_lc_rs::rand::SystemRandom;
use aws_lc_rs::rsa::{KeyPair, KeySize};
use aws_lc_rs::signature::{KeyPair as _, RSA_PKCS1_SHA256};
use rsa::RsaPrivateKey;
use rsa::pkcs1::EncodeRsaPublicKey as _;
use rsa::pkcs1v15::Pkcs1v15Sign;
use rsa::pkcs8::{DecodePrivateKey as _, EncodePrivateKey as _, PrivateKeyInfo};
use rsa::rand_core::OsRng;
use sha2::{Digest as _, Sha256};
use zeroize::Zeroizing;

use super::{Certificate, PkiError};
use crate::model::{Cause, KeyLength, with_cause};

/// An RSA private key of 1024, 2048 or 4096 bits, the key of an OPC UA application.
///
/// `Debug` shows its length only; the key material is wiped when it is dropped. As an [`rcgen::SigningKey`] it signs
/// with PKCS#1 v1.5 and SHA-256 at every length.
pub struct PrivateKey {
    material: KeyMaterial,
    length: KeyLength,
    /// In PKCS#1.
    public_key: Vec<u8>,
}

enum KeyMaterial {
    /// From 2048 bits up: AWS-LC, fast and constant-time. It wipes what it frees.
    Current(KeyPair),
    /// 1024 bits, for the deprecated policies only. AWS-LC rightly refuses to make or use them.
    Legacy(Box<RsaPrivateKey>),
}

impl PrivateKey {
    /// Makes a new key.
    ///
    /// Blocks and is slow: on one core about 0.1 s for 2048 bits, but 1 s and at times several for 4096.
    pub fn generate(length: KeyLength) -> Result<Self, PkiError> {
        let material = match length {
            KeyLength::Rsa1024 => {
                let key = RsaPrivateKey::new(&mut OsRng, 1024).map_err(with_cause(PkiError::KeyGeneration))?;
                KeyMaterial::Legacy(Box::new(key))
            }
            KeyLength::Rsa2048 => KeyMaterial::Current(generate(KeySize::Rsa2048)?),
            KeyLength::Rsa4096 => KeyMaterial::Current(generate(KeySize::Rsa4096)?),
        };
        Self::new(material, length)
    }

    /// From an unencrypted PKCS#8 and nothing after it. The key is checked to be consistent in itself.
    pub fn from_pkcs8_der(der: &[u8]) -> Result<Self, PkiError> {
        let bits = modulus_bits(der)?;
        // Its error repeats the number.
        let length = KeyLength::try_from(bits).map_err(|_| PkiError::KeyLength(bits))?;
        let material = match length {
            // Checks the primes against the modulus, and computes anew what follows from them.
            KeyLength::Rsa1024 => {
                let key = RsaPrivateKey::from_pkcs8_der(der).map_err(with_cause(PkiError::NotAPrivateKey))?;
                KeyMaterial::Legacy(Box::new(key))
            }
            KeyLength::Rsa2048 | KeyLength::Rsa4096 => {
                KeyMaterial::Current(KeyPair::from_pkcs8(der).map_err(with_cause(PkiError::NotAPrivateKey))?)
            }
        };
        Self::new(material, length)
    }

    /// As an unencrypted PKCS#8.
    pub fn to_pkcs8_der(&self) -> Result<Zeroizing<Vec<u8>>, PkiError> {
        match &self.material {
            KeyMaterial::Current(pair) => {
                let der = pair.as_der().map_err(with_cause(PkiError::KeyEncoding))?;
                Ok(Zeroizing::new(der.as_ref().to_vec()))
            }
            KeyMaterial::Legacy(key) => Ok(key.to_pkcs8_der().map_err(with_cause(PkiError::KeyEncoding))?.to_bytes()),
        }
    }

    /// 1024, 2048 or 4096.
    pub const fn bits(&self) -> u16 {
        self.length.bits()
    }

    /// Whether the certificate is for this key.
    pub fn matches(&self, certificate: &Certificate) -> bool {
        certificate.rsa_public_key() == Some(self.public_key.as_slice())
    }

    /// The certificate for this key, of a file that may hold its chain; [`PkiError::NotAPair`] if there is none.
    pub fn certificate_among(&self, certificates: Vec<Certificate>) -> Result<Certificate, PkiError> {
        certificates.into_iter().find(|certificate| self.matches(certificate)).ok_or(PkiError::NotAPair)
    }

    /// The public key in PKCS#1.
    pub(super) fn public_key(&self) -> &[u8] {
        &self.public_key
    }

    fn new(material: KeyMaterial, length: KeyLength) -> Result<Self, PkiError> {
        let public_key = match &material {
            KeyMaterial::Current(pair) => pair.public_key().as_ref().to_vec(),
            KeyMaterial::Legacy(key) => {
                key.to_public_key().to_pkcs1_der().map_err(with_cause(PkiError::KeyEncoding))?.into_vec()
            }
        };
        Ok(Self { material, length, public_key })
    }

    /// PKCS#1 v1.5 with SHA-256.
    pub(super) fn sign_sha256(&self, message: &[u8]) -> Result<Vec<u8>, PkiError> {
        match &self.material {
            KeyMaterial::Current(pair) => {
                let mut signature = vec![0; pair.public_modulus_len()];
                pair.sign(&RSA_PKCS1_SHA256, &SystemRandom::new(), message, &mut signature)
                    .map_err(with_cause(PkiError::Signing))?;
                Ok(signature)
            }
            // With random numbers it blinds the operation, so that its duration tells nothing about the key.
            KeyMaterial::Legacy(key) => key
                .sign_with_rng(&mut OsRng, Pkcs1v15Sign::new::<Sha256>(), &Sha256::digest(message))
                .map_err(with_cause(PkiError::Signing)),
        }
    }
}

impl rcgen::PublicKeyData for PrivateKey {
    fn der_bytes(&self) -> &[u8] {
        &self.public_key
    }

    fn algorithm(&self) -> &'static rcgen::SignatureAlgorithm {
        &rcgen::PKCS_RSA_SHA256
    }
}

impl rcgen::SigningKey for PrivateKey {
    fn sign(&self, message: &[u8]) -> Result<Vec<u8>, rcgen::Error> {
        // An error of rcgen holds no other error.
        self.sign_sha256(message).map_err(|_| rcgen::Error::RemoteKeyError)
    }
}

impl fmt::Debug for PrivateKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "PrivateKey({} bits)", self.bits())
    }
}

fn generate(size: KeySize) -> Result<KeyPair, PkiError> {
    KeyPair::generate(size).map_err(with_cause(PkiError::KeyGeneration))
}

/// The length of the RSA key in a PKCS#8, which must be whole and end where it says.
fn modulus_bits(der: &[u8]) -> Result<u16, PkiError> {
    let info = PrivateKeyInfo::try_from(der).map_err(with_cause(PkiError::NotAPrivateKey))?;
    if info.algorithm.oid != rsa::pkcs1::ALGORITHM_OID {
        return Err(PkiError::NotAPrivateKey(Cause::finding("it is of another kind than RSA")));
    }
    let key = rsa::pkcs1::RsaPrivateKey::try_from(info.private_key).map_err(with_cause(PkiError::NotAPrivateKey))?;
    let modulus = rsa::BigUint::from_bytes_be(key.modulus.as_bytes());
    u16::try_from(modulus.bits()).map_err(with_cause(PkiError::NotAPrivateKey))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pki::samples;

    #[test]
    fn a_key_survives_being_written_and_read() {
        for key in [samples::legacy_key(), samples::key()] {
            let der = key.to_pkcs8_der().unwrap();
            let read = PrivateKey::from_pkcs8_der(&der).unwrap();
            assert_eq!(read.bits(), key.bits());
            assert_eq!(*read.to_pkcs8_der().unwrap(), *der);
            assert!(read.matches(&samples::certificate_for(key)));
        }
    }

    #[test]
    fn a_key_matches_only_its_own_certificate() {
        assert!(samples::key().matches(samples::certificate()));
        assert!(!samples::other_key().matches(samples::certificate()));
        assert!(!samples::legacy_key().matches(samples::certificate()));
    }

    #[test]
    fn only_a_whole_rsa_key_is_taken() {
        for key in [samples::legacy_key(), samples::key()] {
            let der = key.to_pkcs8_der().unwrap();
            for bad in [&b""[..], b"hello", &der[..der.len() - 1], &[&der[..], b"\0"].concat()] {
                assert_eq!(PrivateKey::from_pkcs8_der(bad).err(), Some(PkiError::NotAPrivateKey(Cause::any())));
            }
        }
        let elliptic = crate::pki::tls_identity("robot", samples::now()).unwrap().private_key_pkcs8;
        assert_eq!(PrivateKey::from_pkcs8_der(&elliptic).err(), Some(PkiError::NotAPrivateKey(Cause::any())));
    }

    #[test]
    fn a_key_whose_parts_do_not_fit_together_is_refused() {
        for key in [samples::legacy_key(), samples::key()] {
            let mut der = key.to_pkcs8_der().unwrap();
            let inside_d = der.len() / 3;
            der[inside_d] ^= 0x10;
            assert_eq!(PrivateKey::from_pkcs8_der(&der).err(), Some(PkiError::NotAPrivateKey(Cause::any())), "{key:?}");
        }
    }

    #[test]
    fn other_lengths_are_refused_by_name() {
        let der = KeyPair::generate(KeySize::Rsa3072).unwrap().as_der().unwrap();
        assert_eq!(PrivateKey::from_pkcs8_der(der.as_ref()).err(), Some(PkiError::KeyLength(3072)));
    }

    #[test]
    fn debug_shows_the_length_only() {
        assert_eq!(format!("{:?}", samples::key()), "PrivateKey(2048 bits)");
        assert_eq!(format!("{:#?}", samples::legacy_key()), "PrivateKey(1024 bits)");
    }

    #[test]
    fn a_key_can_be_made_on_one_thread_and_used_on_others() {
        fn shared<T: Send + Sync>() {}
        shared::<PrivateKey>();
    }
}
