//! Why signatures cannot be checked, in English.

use crate::pki::UnverifiableSignature;

pub fn unverifiable(reason: &UnverifiableSignature) -> String {
    use UnverifiableSignature as U;
    match reason {
        U::AlgorithmNotSupported(algorithm) => format!("the signature algorithm {algorithm} is not supported"),
        U::AlgorithmForgeable(algorithm) => format!("a signature made with {algorithm} can be forged"),
        U::KeyLength(bits) => format!("the RSA key of the signer has {bits} bits, which is too short or too long"),
        U::KeyExponent => "the RSA key of the signer has an impossible exponent".to_owned(),
        U::CurveNotSupported => "the elliptic curve of the signer's key is not supported".to_owned(),
        U::NotWithCurve { algorithm, curve } => format!("{algorithm} with the elliptic curve {curve} is not supported"),
        U::TooManyIssuers => "too many authorities have the name of the issuer to try them all".to_owned(),
    }
}
