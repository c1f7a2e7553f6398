use chrono::Duration;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{KeyLength, Subject};

/// What a certificate of the small CA is for (OPC 10000-6 §6.2.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CertificateProfile {
    /// An OPC UA server, which may also connect to others, such as a discovery server.
    #[default]
    Server,
    /// An OPC UA client.
    Client,
}

impl CertificateProfile {
    /// Both, in the order of the dialogs.
    pub const ALL: [Self; 2] = [Self::Server, Self::Client];

    /// `server` or `client`: the word in JSON and on the command line.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Server => "server",
            Self::Client => "client",
        }
    }
}

/// How long the certificate of a CA is valid: 1–30 years.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "u8", into = "u8")]
pub struct AuthorityValidity(u8);

/// The number is no [`AuthorityValidity`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("{0} years is not a validity of a CA; choose 1 to 30")]
pub struct InvalidAuthorityValidity(pub u8);

impl AuthorityValidity {
    /// Shortest validity, in years.
    pub const MIN_YEARS: u8 = 1;
    /// Longest validity, in years.
    pub const MAX_YEARS: u8 = 30;

    /// The validity in years, 1–30.
    pub const fn years(self) -> u8 {
        self.0
    }

    /// Years of 365.25 days.
    pub fn duration(self) -> Duration {
        Duration::hours(i64::from(self.0) * 8766)
    }
}

impl Default for AuthorityValidity {
    /// 20 years: longer than the certificates it signs, and than most cells stand.
    fn default() -> Self {
        Self(20)
    }
}

impl TryFrom<u8> for AuthorityValidity {
    type Error = InvalidAuthorityValidity;

    fn try_from(years: u8) -> Result<Self, InvalidAuthorityValidity> {
        if (Self::MIN_YEARS..=Self::MAX_YEARS).contains(&years) {
            Ok(Self(years))
        } else {
            Err(InvalidAuthorityValidity(years))
        }
    }
}

impl From<AuthorityValidity> for u8 {
    fn from(validity: AuthorityValidity) -> Self {
        validity.0
    }
}

/// What the certificate of a CA is to be made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AuthorityRequest {
    /// Name of the CA. The common name is required.
    pub subject: Subject,
    /// 2048 or 4096 bits.
    pub key_length: KeyLength,
    /// How long the certificate of the CA is valid.
    pub validity: AuthorityValidity,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ca_is_valid_for_1_to_30_years() {
        assert_eq!(AuthorityValidity::try_from(0), Err(InvalidAuthorityValidity(0)));
        assert_eq!(AuthorityValidity::try_from(31), Err(InvalidAuthorityValidity(31)));
        assert_eq!(AuthorityValidity::try_from(30).map(AuthorityValidity::years), Ok(30));
    }
}
