use std::error::Error;

use serde::{Deserialize, Serialize};

/// Why a signature proves nothing, whether it is right or not. Texts in it are cut to 200 characters.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum UnverifiableSignature {
    /// The name of the algorithm as OpenSSL writes it, or its object identifier.
    AlgorithmNotSupported(String),
    /// MD2, MD4 or MD5: a signature can be forged. The name of the algorithm.
    AlgorithmForgeable(String),
    /// In bits: an RSA key of the signer that is too short for its algorithm, or longer than 8192 bits.
    KeyLength(u16),
    /// The exponent of the signer's RSA key is even or 1.
    KeyExponent,
    /// The signer's key lies on an elliptic curve other than P-256, P-384 and P-521.
    CurveNotSupported,
    /// The algorithm is not supported with the elliptic curve of the signer's key.
    NotWithCurve {
        /// Name of the algorithm.
        algorithm: String,
        /// Name of the curve.
        curve: String,
    },
    /// More certificates carry the name of the issuer than are tried.
    TooManyIssuers,
}

impl Error for UnverifiableSignature {}
