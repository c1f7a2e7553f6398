use std::collections::BTreeSet;

use crate::model::{SecurityPolicy, offered_key_lengths};
use crate::pki::name::quoted;
use crate::pki::signature::{Hash, PublicKey, SignatureAlgorithm};
use crate::pki::{Certificate, CertificateFlaw, UnverifiableSignature};

/// What a security policy (OPC 10000-7) requires of keys and signatures.
struct StrengthRequirements {
    min_rsa_bits: u16,
    /// Of the application's key; keys of authorities may be longer.
    max_rsa_bits: u16,
    sha1_allowed: bool,
}

impl StrengthRequirements {
    /// `None`: what the policies that are not deprecated require.
    const fn by(policy: Option<SecurityPolicy>) -> Self {
        match policy {
            Some(SecurityPolicy::Basic128Rsa15 | SecurityPolicy::Basic256) => {
                Self { min_rsa_bits: 1024, max_rsa_bits: 2048, sha1_allowed: true }
            }
            // The policy "None" signs nothing, so that it does not say what is enough for a certificate.
            None
            | Some(
                SecurityPolicy::None
                | SecurityPolicy::Basic256Sha256
                | SecurityPolicy::Aes128Sha256RsaOaep
                | SecurityPolicy::Aes256Sha256RsaPss,
            ) => Self { min_rsa_bits: 2048, max_rsa_bits: 4096, sha1_allowed: false },
        }
    }
}

/// The kind of the key: RSA with a possible exponent. An issuer may also have a key on a supported elliptic curve.
pub(in crate::pki) fn key_kind_flaw(certificate: &Certificate, is_issuer: bool) -> Option<CertificateFlaw> {
    match &certificate.facts().public_key {
        PublicKey::Rsa { exponent_fits: false, .. } => Some(CertificateFlaw::KeyExponent),
        PublicKey::Rsa { .. } => None,
        PublicKey::Ec { curve: Some(_), .. } if is_issuer => None,
        PublicKey::Ec { .. } | PublicKey::Other { .. } => Some(CertificateFlaw::KeyNotRsa),
    }
}

/// The length of an RSA key, by MinAsymmetricKeyLength and MaxAsymmetricKeyLength of the security policy (OPC 10000-7);
/// `None` stands for the policies that are not deprecated.
pub(in crate::pki) fn key_length_flaw(
    certificate: &Certificate,
    is_issuer: bool,
    security_policy: Option<SecurityPolicy>,
) -> Option<CertificateFlaw> {
    let PublicKey::Rsa { bits, .. } = certificate.facts().public_key else { return None };
    let StrengthRequirements { min_rsa_bits, max_rsa_bits, .. } = StrengthRequirements::by(security_policy);
    if bits < min_rsa_bits {
        Some(CertificateFlaw::KeyTooShort { bits, least: min_rsa_bits })
    } else if !is_issuer && bits > max_rsa_bits {
        Some(CertificateFlaw::KeyTooLong { bits, most: max_rsa_bits })
    } else {
        None
    }
}

/// A length of the key that the controller does not offer with its ticked security policies (manual 2.7.1.2).
pub(in crate::pki) fn key_length_not_ticked(
    certificate: &Certificate,
    ticked: &BTreeSet<SecurityPolicy>,
) -> Option<CertificateFlaw> {
    let bits = certificate.key_bits();
    let is_offered = offered_key_lengths(ticked).iter().any(|length| length.bits() == bits);
    (!is_offered).then_some(CertificateFlaw::KeyLengthNotTicked { bits })
}

/// The hash of the certificate's signature, by CertificateSignatureAlgorithm of the security policy (OPC 10000-7).
/// `allow_sha1`: SHA-1 is good enough for every policy.
pub(in crate::pki) fn hash_flaw(
    certificate: &Certificate,
    security_policy: Option<SecurityPolicy>,
    allow_sha1: bool,
) -> Option<CertificateFlaw> {
    signature_hash_flaw(&certificate.facts().signature_algorithm, security_policy, allow_sha1)
}

/// As [`hash_flaw`], for the signature of anything.
pub(in crate::pki) fn signature_hash_flaw(
    algorithm: &SignatureAlgorithm,
    security_policy: Option<SecurityPolicy>,
    allow_sha1: bool,
) -> Option<CertificateFlaw> {
    let is_strong = match algorithm.hash() {
        None => {
            let because = UnverifiableSignature::AlgorithmNotSupported(quoted(algorithm.name()));
            return Some(CertificateFlaw::SignatureUnverifiable { because });
        }
        Some(Hash::Md5) => false,
        Some(Hash::Sha1) => allow_sha1 || StrengthRequirements::by(security_policy).sha1_allowed,
        Some(Hash::Sha256 | Hash::Sha384 | Hash::Sha512) => true,
    };
    (!is_strong).then(|| CertificateFlaw::WeakHash { algorithm: algorithm.name().to_owned() })
}
