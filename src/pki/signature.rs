//! Signatures of certificates and revocation lists: which there are, and whether one is right.

use aws_lc_rs::signature::{self, UnparsedPublicKey, VerificationAlgorithm};
use rsa::pkcs1::DecodeRsaPublicKey as _;
use rsa::{Pkcs1v15Sign, RsaPublicKey};
use sha2::{Digest as _, Sha384};
use x509_parser::prelude::{AlgorithmIdentifier, FromDer as _, SubjectPublicKeyInfo};
use x509_parser::public_key::{PublicKey as Parsed, RSAPublicKey};
use x509_parser::signature_algorithm::RsaSsaPssParams;

use super::name::quoted;
use super::{PkiError, UnverifiableSignature};
use crate::model::with_cause;

/// How strong the hash within a signature is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Hash {
    /// MD2, MD4 and MD5: signatures with them can be forged.
    Md5,
    Sha1,
    Sha256,
    Sha384,
    Sha512,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scheme {
    RsaPkcs1,
    RsaPss,
    Ecdsa,
}

/// The algorithm a certificate or a revocation list is signed with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct SignatureAlgorithm {
    /// `None` if the algorithm is not supported.
    known: Option<(Scheme, Hash)>,
    /// As OpenSSL writes it, or its object identifier.
    name: String,
}

/// A public key, as far as it is of use here.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum PublicKey {
    Rsa {
        pkcs1: Vec<u8>,
        bits: u16,
        /// Whether the exponent is odd and at least 3, without which it is no RSA.
        exponent_fits: bool,
    },
    Ec {
        curve: Option<Curve>,
        point: Vec<u8>,
        bits: u16,
    },
    Other {
        oid: String,
    },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Curve {
    P256,
    P384,
    P521,
}

/// The result of verifying one signature.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum SignatureCheck {
    Valid,
    Invalid,
    /// The algorithm or the key of the signer is not supported, or too weak to prove anything.
    CannotVerify(UnverifiableSignature),
}

impl SignatureAlgorithm {
    pub fn of(identifier: &AlgorithmIdentifier<'_>) -> Self {
        let oid = identifier.algorithm.to_id_string();
        let (known, name) = match oid.as_str() {
            "1.2.840.113549.1.1.2" => (Some((Scheme::RsaPkcs1, Hash::Md5)), "md2WithRSAEncryption"),
            "1.2.840.113549.1.1.3" => (Some((Scheme::RsaPkcs1, Hash::Md5)), "md4WithRSAEncryption"),
            "1.2.840.113549.1.1.4" => (Some((Scheme::RsaPkcs1, Hash::Md5)), "md5WithRSAEncryption"),
            "1.2.840.113549.1.1.5" => (Some((Scheme::RsaPkcs1, Hash::Sha1)), "sha1WithRSAEncryption"),
            "1.2.840.113549.1.1.11" => (Some((Scheme::RsaPkcs1, Hash::Sha256)), "sha256WithRSAEncryption"),
            "1.2.840.113549.1.1.12" => (Some((Scheme::RsaPkcs1, Hash::Sha384)), "sha384WithRSAEncryption"),
            "1.2.840.113549.1.1.13" => (Some((Scheme::RsaPkcs1, Hash::Sha512)), "sha512WithRSAEncryption"),
            "1.2.840.113549.1.1.10" => (pss_hash(identifier).map(|hash| (Scheme::RsaPss, hash)), "rsassaPss"),
            "1.2.840.10045.4.1" => (Some((Scheme::Ecdsa, Hash::Sha1)), "ecdsa-with-SHA1"),
            "1.2.840.10045.4.3.2" => (Some((Scheme::Ecdsa, Hash::Sha256)), "ecdsa-with-SHA256"),
            "1.2.840.10045.4.3.3" => (Some((Scheme::Ecdsa, Hash::Sha384)), "ecdsa-with-SHA384"),
            "1.2.840.10045.4.3.4" => (Some((Scheme::Ecdsa, Hash::Sha512)), "ecdsa-with-SHA512"),
            other => (None, other),
        };
        Self { known, name: name.to_owned() }
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// `None` if the algorithm is not known.
    pub fn hash(&self) -> Option<Hash> {
        self.known.map(|(_, hash)| hash)
    }

    /// Whether `signature` over `message` was made with this algorithm and the private half of `key`.
    pub fn verify(&self, key: &PublicKey, message: &[u8], signature: &[u8]) -> SignatureCheck {
        use UnverifiableSignature as Because;
        let algorithm = || quoted(&self.name);
        let Some((scheme, hash)) = self.known else {
            return SignatureCheck::CannotVerify(Because::AlgorithmNotSupported(algorithm()));
        };
        if hash == Hash::Md5 {
            return SignatureCheck::CannotVerify(Because::AlgorithmForgeable(algorithm()));
        }
        match (scheme, key) {
            (Scheme::RsaPkcs1 | Scheme::RsaPss, PublicKey::Rsa { pkcs1, bits, exponent_fits }) => {
                let fewest = if scheme == Scheme::RsaPss { 2048 } else { 1024 };
                if !(fewest..=8192).contains(bits) {
                    return SignatureCheck::CannotVerify(Because::KeyLength(*bits));
                }
                if !exponent_fits {
                    return SignatureCheck::CannotVerify(Because::KeyExponent);
                }
                // Only the combination of a short key and a middle-sized hash is missing in AWS-LC.
                if scheme == Scheme::RsaPkcs1 && hash == Hash::Sha384 && *bits < 2048 {
                    return checked(short_sha384(pkcs1, message, signature));
                }
                checked(accepts(rsa(scheme, hash), pkcs1, message, signature))
            }
            (Scheme::Ecdsa, PublicKey::Ec { curve: Some(curve), point, .. }) => match ecdsa(*curve, hash) {
                Some(algorithm) => checked(accepts(algorithm, point, message, signature)),
                None => {
                    let curve = curve.name().to_owned();
                    SignatureCheck::CannotVerify(Because::NotWithCurve { algorithm: algorithm(), curve })
                }
            },
            (Scheme::Ecdsa, PublicKey::Ec { curve: None, .. }) => {
                SignatureCheck::CannotVerify(Because::CurveNotSupported)
            }
            // A signature of one kind cannot be that of a key of another kind.
            _ => SignatureCheck::Invalid,
        }
    }
}

impl PublicKey {
    pub fn of(info: &SubjectPublicKeyInfo<'_>) -> Result<Self, PkiError> {
        let bytes = info.subject_public_key.data.to_vec();
        match info.parsed().map_err(with_cause(PkiError::NotACertificate))? {
            Parsed::RSA(_) => Self::rsa(&bytes),
            Parsed::EC(point) => {
                let oid = info.algorithm.parameters.as_ref().and_then(|parameters| parameters.as_oid().ok());
                let curve = oid.and_then(|oid| Curve::from_oid(&oid.to_id_string()));
                let bits = curve.map_or_else(|| u16::try_from(point.key_size()).unwrap_or(u16::MAX), Curve::bits);
                Ok(Self::Ec { curve, bits, point: bytes })
            }
            _ => Ok(Self::Other { oid: info.algorithm.algorithm.to_id_string() }),
        }
    }

    /// From PKCS#1.
    pub fn rsa(pkcs1: &[u8]) -> Result<Self, PkiError> {
        let (_, rsa) = RSAPublicKey::from_der(pkcs1).map_err(with_cause(PkiError::NotACertificate))?;
        Ok(Self::Rsa {
            pkcs1: pkcs1.to_vec(),
            bits: u16::try_from(bit_length(rsa.modulus)).unwrap_or(u16::MAX),
            exponent_fits: rsa.exponent.last().is_some_and(|last| last & 1 == 1) && bit_length(rsa.exponent) > 1,
        })
    }

    /// 0 if its kind is not known.
    pub fn bits(&self) -> u16 {
        match self {
            Self::Rsa { bits, .. } | Self::Ec { bits, .. } => *bits,
            Self::Other { .. } => 0,
        }
    }
}

impl Curve {
    pub fn from_oid(oid: &str) -> Option<Self> {
        match oid {
            "1.2.840.10045.3.1.7" => Some(Self::P256),
            "1.3.132.0.34" => Some(Self::P384),
            "1.3.132.0.35" => Some(Self::P521),
            _ => None,
        }
    }

    pub const fn bits(self) -> u16 {
        match self {
            Self::P256 => 256,
            Self::P384 => 384,
            Self::P521 => 521,
        }
    }

    /// As NIST writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::P256 => "P-256",
            Self::P384 => "P-384",
            Self::P521 => "P-521",
        }
    }
}

fn checked(valid: bool) -> SignatureCheck {
    if valid { SignatureCheck::Valid } else { SignatureCheck::Invalid }
}

fn accepts(algorithm: &'static dyn VerificationAlgorithm, key: &[u8], message: &[u8], signature: &[u8]) -> bool {
    UnparsedPublicKey::new(algorithm, key).verify(message, signature).is_ok()
}

fn rsa(scheme: Scheme, hash: Hash) -> &'static dyn VerificationAlgorithm {
    match (scheme, hash) {
        (Scheme::RsaPss, Hash::Sha384) => &signature::RSA_PSS_2048_8192_SHA384,
        (Scheme::RsaPss, Hash::Sha512) => &signature::RSA_PSS_2048_8192_SHA512,
        (Scheme::RsaPss, _) => &signature::RSA_PSS_2048_8192_SHA256,
        (_, Hash::Md5 | Hash::Sha1) => &signature::RSA_PKCS1_1024_8192_SHA1_FOR_LEGACY_USE_ONLY,
        (_, Hash::Sha256) => &signature::RSA_PKCS1_1024_8192_SHA256_FOR_LEGACY_USE_ONLY,
        (_, Hash::Sha384) => &signature::RSA_PKCS1_2048_8192_SHA384,
        (_, Hash::Sha512) => &signature::RSA_PKCS1_1024_8192_SHA512_FOR_LEGACY_USE_ONLY,
    }
}

fn ecdsa(curve: Curve, hash: Hash) -> Option<&'static dyn VerificationAlgorithm> {
    Some(match (curve, hash) {
        (Curve::P256, Hash::Sha1) => &signature::ECDSA_P256_SHA1_ASN1,
        (Curve::P256, Hash::Sha256) => &signature::ECDSA_P256_SHA256_ASN1,
        (Curve::P256, Hash::Sha384) => &signature::ECDSA_P256_SHA384_ASN1,
        (Curve::P256, Hash::Sha512) => &signature::ECDSA_P256_SHA512_ASN1,
        (Curve::P384, Hash::Sha256) => &signature::ECDSA_P384_SHA256_ASN1,
        (Curve::P384, Hash::Sha384) => &signature::ECDSA_P384_SHA384_ASN1,
        (Curve::P384, Hash::Sha512) => &signature::ECDSA_P384_SHA512_ASN1,
        (Curve::P521, Hash::Sha1) => &signature::ECDSA_P521_SHA1_ASN1,
        (Curve::P521, Hash::Sha256) => &signature::ECDSA_P521_SHA256_ASN1,
        (Curve::P521, Hash::Sha384) => &signature::ECDSA_P521_SHA384_ASN1,
        (Curve::P521, Hash::Sha512) => &signature::ECDSA_P521_SHA512_ASN1,
        (_, Hash::Md5) | (Curve::P384, Hash::Sha1) => return None,
    })
}

fn short_sha384(pkcs1: &[u8], message: &[u8], signature: &[u8]) -> bool {
    RsaPublicKey::from_pkcs1_der(pkcs1)
        .is_ok_and(|key| key.verify(Pkcs1v15Sign::new::<Sha384>(), &Sha384::digest(message), signature).is_ok())
}

/// The hash of an RSA-PSS signature, if it is used the only way that makes sense: the same for the mask, and a salt
/// as long as the hash (RFC 8017 §9.1).
fn pss_hash(identifier: &AlgorithmIdentifier<'_>) -> Option<Hash> {
    let params = RsaSsaPssParams::try_from(identifier.parameters.as_ref()?).ok()?;
    let oid = params.hash_algorithm_oid().to_id_string();
    let mask = params.mask_gen_algorithm().ok()?;
    let (hash, salt) = match oid.as_str() {
        "2.16.840.1.101.3.4.2.1" => (Hash::Sha256, 32),
        "2.16.840.1.101.3.4.2.2" => (Hash::Sha384, 48),
        "2.16.840.1.101.3.4.2.3" => (Hash::Sha512, 64),
        _ => return None,
    };
    (mask.hash.to_id_string() == oid && params.salt_length() == salt && params.trailer_field() == 1).then_some(hash)
}

/// The bits of a big-endian number, however many zeros stand before it.
fn bit_length(number: &[u8]) -> usize {
    match number.iter().position(|byte| *byte != 0) {
        Some(first) => (number.len() - first) * 8 - number[first].leading_zeros() as usize,
        None => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_lose_the_zeros_before_them() {
        assert_eq!(bit_length(&[0, 0x80, 0]), 16);
        assert_eq!(bit_length(&[0x7f, 0xff]), 15);
        assert_eq!(bit_length(&[0, 0]), 0);
    }
}
