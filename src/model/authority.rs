use std::fmt;
use std::str::FromStr;

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
    pub const ALL: [Self; 2] = [Self::Server, Self::Client];

    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Server => "server",
            Self::Client => "client",
        }
    }
}

/// Why a certificate is revoked (RFC 5280 §5.3.1).
///
/// Without those that mean nothing here: a hold, which this CA would have to lift again, what only delta CRLs say, and
/// attribute authorities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RevocationReason {
    Unspecified,
    KeyCompromise,
    CaCompromise,
    AffiliationChanged,
    Superseded,
    CessationOfOperation,
    PrivilegeWithdrawn,
}

impl RevocationReason {
    pub const ALL: [Self; 7] = [
        Self::Unspecified,
        Self::KeyCompromise,
        Self::CaCompromise,
        Self::AffiliationChanged,
        Self::Superseded,
        Self::CessationOfOperation,
        Self::PrivilegeWithdrawn,
    ];

    /// As the command line and the files of the CA write it.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Unspecified => "unspecified",
            Self::KeyCompromise => "key-compromise",
            Self::CaCompromise => "ca-compromise",
            Self::AffiliationChanged => "affiliation-changed",
            Self::Superseded => "superseded",
            Self::CessationOfOperation => "cessation-of-operation",
            Self::PrivilegeWithdrawn => "privilege-withdrawn",
        }
    }
}

impl fmt::Display for RevocationReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// The text is no [`RevocationReason`].
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("\"{0}\" is not a reason; known are {known}", known = RevocationReason::ALL.map(RevocationReason::as_str).join(", "))]
pub struct UnknownReason(pub String);

impl FromStr for RevocationReason {
    type Err = UnknownReason;

    /// Also as RFC 5280 and OpenSSL write it: `keyCompromise`.
    fn from_str(text: &str) -> Result<Self, UnknownReason> {
        let plain = |text: &str| text.replace('-', "").to_ascii_lowercase();
        Self::ALL
            .into_iter()
            .find(|reason| plain(reason.as_str()) == plain(text))
            .ok_or_else(|| UnknownReason(text.to_owned()))
    }
}

/// How long the certificate of a CA is valid: 1–30 years.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "u8", into = "u8")]
pub struct AuthorityValidity(u8);

/// The number is no [`AuthorityValidity`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("{0} years is not a validity of a CA; choose 1 to 30")]
pub struct AuthorityYears(pub u8);

impl AuthorityValidity {
    pub const MIN_YEARS: u8 = 1;
    pub const MAX_YEARS: u8 = 30;

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
    type Error = AuthorityYears;

    fn try_from(years: u8) -> Result<Self, AuthorityYears> {
        if (Self::MIN_YEARS..=Self::MAX_YEARS).contains(&years) { Ok(Self(years)) } else { Err(AuthorityYears(years)) }
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
    pub subject: Subject,
    /// 2048 or 4096 bits.
    pub key_length: KeyLength,
    pub validity: AuthorityValidity,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_are_read_as_they_are_written_and_as_others_write_them() {
        for reason in RevocationReason::ALL {
            assert_eq!(reason.as_str().parse(), Ok(reason));
            assert_eq!(serde_json::to_value(reason).unwrap(), reason.as_str());
        }
        assert_eq!("keyCompromise".parse(), Ok(RevocationReason::KeyCompromise));
        assert_eq!("CACompromise".parse(), Ok(RevocationReason::CaCompromise));
        for other in ["", "certificateHold", "removeFromCRL", "7"] {
            assert_eq!(other.parse::<RevocationReason>(), Err(UnknownReason(other.into())));
        }
    }

    #[test]
    fn a_ca_is_valid_for_1_to_30_years() {
        assert_eq!(AuthorityValidity::try_from(0), Err(AuthorityYears(0)));
        assert_eq!(AuthorityValidity::try_from(31), Err(AuthorityYears(31)));
        assert_eq!(AuthorityValidity::try_from(30).map(AuthorityValidity::years), Ok(30));
    }
}
