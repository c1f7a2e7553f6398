use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Why a certificate is refused, by the status codes of OPC 10000-4 §6.1.3, in the order of its steps.
///
/// Written by its OPC UA name, also by serde. `Good` is not one of them: a certificate that is accepted has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "&'static str")]
pub enum CertificateStatus {
    /// `BadCertificateInvalid`: the structure, an extension or the signature is wrong.
    CertificateInvalid,
    /// `BadCertificateChainIncomplete`: no chain to a trusted certificate was found.
    ChainIncomplete,
    /// The answer to a peer in place of the true reason (OPC 10000-6 §6.7.6). The validator never gives it.
    SecurityChecksFailed,
    /// `BadCertificatePolicyCheckFailed`: the key or the signature does not satisfy the security policy.
    PolicyCheckFailed,
    /// `BadCertificateUntrusted`: neither the certificate nor a CA above it is trusted.
    Untrusted,
    /// `BadCertificateTimeInvalid`: the certificate is expired or not valid yet.
    TimeInvalid,
    /// `BadCertificateIssuerTimeInvalid`: a CA certificate of the chain is expired or not valid yet.
    IssuerTimeInvalid,
    /// `BadCertificateHostNameInvalid`: the certificate does not name the host.
    HostNameInvalid,
    /// `BadCertificateUriInvalid`: the certificate does not name the application URI.
    UriInvalid,
    /// `BadCertificateUseNotAllowed`: key usage or extended key usage do not allow the use.
    UseNotAllowed,
    /// `BadCertificateIssuerUseNotAllowed`: a certificate of the chain may not issue others.
    IssuerUseNotAllowed,
    /// `BadCertificateRevocationUnknown`: no usable CRL says whether the certificate is revoked.
    RevocationUnknown,
    /// `BadCertificateIssuerRevocationUnknown`: no usable CRL says whether a CA of the chain is revoked.
    IssuerRevocationUnknown,
    /// `BadCertificateRevoked`: a CRL revokes the certificate.
    Revoked,
    /// `BadCertificateIssuerRevoked`: a CRL revokes a CA of the chain.
    IssuerRevoked,
}

/// A text that is no status of a certificate.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("\"{0}\" is not the OPC UA status of a refused certificate")]
pub struct UnknownCertificateStatus(String);

impl CertificateStatus {
    /// All statuses, in the order of the steps of OPC 10000-4 §6.1.3.
    pub const ALL: [Self; 15] = [
        Self::CertificateInvalid,
        Self::ChainIncomplete,
        Self::SecurityChecksFailed,
        Self::PolicyCheckFailed,
        Self::Untrusted,
        Self::TimeInvalid,
        Self::IssuerTimeInvalid,
        Self::HostNameInvalid,
        Self::UriInvalid,
        Self::UseNotAllowed,
        Self::IssuerUseNotAllowed,
        Self::RevocationUnknown,
        Self::IssuerRevocationUnknown,
        Self::Revoked,
        Self::IssuerRevoked,
    ];

    /// The name of OPC 10000-4, without its underscore.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::CertificateInvalid => "BadCertificateInvalid",
            Self::ChainIncomplete => "BadCertificateChainIncomplete",
            Self::SecurityChecksFailed => "BadSecurityChecksFailed",
            Self::PolicyCheckFailed => "BadCertificatePolicyCheckFailed",
            Self::Untrusted => "BadCertificateUntrusted",
            Self::TimeInvalid => "BadCertificateTimeInvalid",
            Self::IssuerTimeInvalid => "BadCertificateIssuerTimeInvalid",
            Self::HostNameInvalid => "BadCertificateHostNameInvalid",
            Self::UriInvalid => "BadCertificateUriInvalid",
            Self::UseNotAllowed => "BadCertificateUseNotAllowed",
            Self::IssuerUseNotAllowed => "BadCertificateIssuerUseNotAllowed",
            Self::RevocationUnknown => "BadCertificateRevocationUnknown",
            Self::IssuerRevocationUnknown => "BadCertificateIssuerRevocationUnknown",
            Self::Revoked => "BadCertificateRevoked",
            Self::IssuerRevoked => "BadCertificateIssuerRevoked",
        }
    }

    /// The numeric status code (OPC 10000-6, StatusCodes.csv).
    pub const fn code(self) -> u32 {
        match self {
            Self::CertificateInvalid => 0x8012_0000,
            Self::ChainIncomplete => 0x810D_0000,
            Self::SecurityChecksFailed => 0x8013_0000,
            Self::PolicyCheckFailed => 0x8114_0000,
            Self::Untrusted => 0x801A_0000,
            Self::TimeInvalid => 0x8014_0000,
            Self::IssuerTimeInvalid => 0x8015_0000,
            Self::HostNameInvalid => 0x8016_0000,
            Self::UriInvalid => 0x8017_0000,
            Self::UseNotAllowed => 0x8018_0000,
            Self::IssuerUseNotAllowed => 0x8019_0000,
            Self::RevocationUnknown => 0x801B_0000,
            Self::IssuerRevocationUnknown => 0x801C_0000,
            Self::Revoked => 0x801D_0000,
            Self::IssuerRevoked => 0x801E_0000,
        }
    }
}

impl fmt::Display for CertificateStatus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl FromStr for CertificateStatus {
    type Err = UnknownCertificateStatus;

    fn from_str(text: &str) -> Result<Self, UnknownCertificateStatus> {
        Self::ALL
            .into_iter()
            .find(|status| status.as_str() == text)
            .ok_or_else(|| UnknownCertificateStatus(text.to_owned()))
    }
}

impl TryFrom<String> for CertificateStatus {
    type Error = UnknownCertificateStatus;
    fn try_from(text: String) -> Result<Self, UnknownCertificateStatus> {
        text.parse()
    }
}

impl From<CertificateStatus> for &'static str {
    fn from(status: CertificateStatus) -> Self {
        status.as_str()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_status_is_read_back_from_its_name_and_has_its_own_code() {
        let mut codes = std::collections::BTreeSet::new();
        for status in CertificateStatus::ALL {
            assert_eq!(status.as_str().parse(), Ok(status));
            let json = serde_json::to_string(&status).unwrap();
            assert_eq!(json, format!("\"{status}\""));
            assert_eq!(serde_json::from_str::<CertificateStatus>(&json).unwrap(), status);
            codes.insert(status.code());
        }
        assert_eq!(codes.len(), 15);
        assert!("Good".parse::<CertificateStatus>().is_err());
        assert!(serde_json::from_str::<CertificateStatus>("\"BadCertificate\"").is_err());
    }

    /// The OPC UA library has the same table, from the specification's own file.
    #[test]
    fn the_codes_are_those_of_the_specification() {
        use opcua::types::StatusCode as S;
        for (status, code) in [
            (CertificateStatus::CertificateInvalid, S::BadCertificateInvalid),
            (CertificateStatus::ChainIncomplete, S::BadCertificateChainIncomplete),
            (CertificateStatus::SecurityChecksFailed, S::BadSecurityChecksFailed),
            (CertificateStatus::PolicyCheckFailed, S::BadCertificatePolicyCheckFailed),
            (CertificateStatus::Untrusted, S::BadCertificateUntrusted),
            (CertificateStatus::TimeInvalid, S::BadCertificateTimeInvalid),
            (CertificateStatus::IssuerTimeInvalid, S::BadCertificateIssuerTimeInvalid),
            (CertificateStatus::HostNameInvalid, S::BadCertificateHostNameInvalid),
            (CertificateStatus::UriInvalid, S::BadCertificateUriInvalid),
            (CertificateStatus::UseNotAllowed, S::BadCertificateUseNotAllowed),
            (CertificateStatus::IssuerUseNotAllowed, S::BadCertificateIssuerUseNotAllowed),
            (CertificateStatus::RevocationUnknown, S::BadCertificateRevocationUnknown),
            (CertificateStatus::IssuerRevocationUnknown, S::BadCertificateIssuerRevocationUnknown),
            (CertificateStatus::Revoked, S::BadCertificateRevoked),
            (CertificateStatus::IssuerRevoked, S::BadCertificateIssuerRevoked),
        ] {
            assert_eq!(status.code(), code.bits(), "{status}");
        }
    }
}
