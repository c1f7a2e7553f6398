use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};
use thiserror::Error;

use crate::model::{ErrorCode, Problem};

/// The SHA-256 of a certificate's DER: what is pinned of a controller's management identity.
///
/// Written in lower-case hexadecimal, also by serde; [`Fingerprint::grouped`] is the form a person compares. Read in
/// either case, with or without colons and spaces.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Fingerprint([u8; 32]);

/// Why a text is not a fingerprint.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum FingerprintError {
    /// A character that is neither a hexadecimal digit nor a separator.
    #[error("{0:?} is not a hexadecimal digit")]
    Character(char),
    /// The number of hexadecimal digits is not 64; holds it.
    #[error("a fingerprint has 64 hexadecimal digits, not {0}")]
    Length(usize),
}

impl Fingerprint {
    /// The fingerprint of the certificate with this DER.
    pub fn of(der: &[u8]) -> Self {
        Self(Sha256::digest(der).into())
    }

    /// The hash itself, as [`Fingerprint::as_bytes`] gave it.
    pub const fn from_bytes(hash: [u8; 32]) -> Self {
        Self(hash)
    }

    /// The hash itself.
    pub const fn as_bytes(&self) -> &[u8; 32] {
        &self.0
    }

    /// `AB:CD:…`, as browsers and OpenSSL show it.
    pub fn grouped(&self) -> String {
        self.0.map(|byte| format!("{byte:02X}")).join(":")
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&hex::encode(self.0))
    }
}

impl fmt::Debug for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Fingerprint({self})")
    }
}

impl FromStr for Fingerprint {
    type Err = FingerprintError;

    fn from_str(text: &str) -> Result<Self, FingerprintError> {
        let digits: String = text.chars().filter(|c| *c != ':' && !c.is_whitespace()).collect();
        if let Some(other) = digits.chars().find(|c| !c.is_ascii_hexdigit()) {
            return Err(FingerprintError::Character(other));
        }
        let mut bytes = [0; 32];
        // Only their number can be wrong: each of them is a hexadecimal digit.
        hex::decode_to_slice(&digits, &mut bytes).map_err(|_| FingerprintError::Length(digits.len()))?;
        Ok(Self(bytes))
    }
}

impl TryFrom<String> for Fingerprint {
    type Error = FingerprintError;
    fn try_from(text: String) -> Result<Self, FingerprintError> {
        text.parse()
    }
}

impl From<Fingerprint> for String {
    fn from(fingerprint: Fingerprint) -> Self {
        fingerprint.to_string()
    }
}

impl From<FingerprintError> for Problem {
    fn from(error: FingerprintError) -> Self {
        Self::with_detail(ErrorCode::BadFingerprint, error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OF_NOTHING: &str = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";

    #[test]
    fn every_way_of_writing_it_is_the_same_fingerprint() {
        let fingerprint = Fingerprint::of(b"");
        assert_eq!(fingerprint.to_string(), OF_NOTHING);
        assert!(fingerprint.grouped().starts_with("E3:B0:C4:42:98"));
        for text in [OF_NOTHING, &OF_NOTHING.to_uppercase(), &fingerprint.grouped(), &format!(" {OF_NOTHING}\n")] {
            assert_eq!(text.parse(), Ok(fingerprint), "{text}");
        }
        let spaced = fingerprint.grouped().replace(':', " ");
        assert_eq!(spaced.parse(), Ok(fingerprint));
    }

    #[test]
    fn what_is_not_a_fingerprint_says_why() {
        assert_eq!("".parse::<Fingerprint>(), Err(FingerprintError::Length(0)));
        assert_eq!(OF_NOTHING[1..].parse::<Fingerprint>(), Err(FingerprintError::Length(63)));
        assert_eq!(format!("{OF_NOTHING}00").parse::<Fingerprint>(), Err(FingerprintError::Length(66)));
        assert_eq!("e3:bg".parse::<Fingerprint>(), Err(FingerprintError::Character('g')));
        assert_eq!("e3１".parse::<Fingerprint>(), Err(FingerprintError::Character('１')));
        assert_eq!(Problem::from(FingerprintError::Length(1)).code, ErrorCode::BadFingerprint);
    }

    #[test]
    fn in_json_it_is_a_string() {
        let json = serde_json::to_string(&Fingerprint::of(b"")).unwrap();
        assert_eq!(json, format!("\"{OF_NOTHING}\""));
        assert_eq!(serde_json::from_str::<Fingerprint>(&json).unwrap(), Fingerprint::of(b""));
        assert!(serde_json::from_str::<Fingerprint>("\"abcd\"").is_err());
    }
}
