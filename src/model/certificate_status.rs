use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::Language;

/// Why a certificate is refused, by the status codes of OPC 10000-4 §6.1.3, in the order of its steps.
///
/// Written by its OPC UA name, also by serde. `Good` is not one of them: a certificate that is accepted has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "&'static str")]
pub enum CertificateStatus {
    CertificateInvalid,
    ChainIncomplete,
    /// What a peer is told instead of the truth, so that it learns nothing. The validator never gives it.
    SecurityChecksFailed,
    PolicyCheckFailed,
    Untrusted,
    TimeInvalid,
    IssuerTimeInvalid,
    HostNameInvalid,
    UriInvalid,
    UseNotAllowed,
    IssuerUseNotAllowed,
    RevocationUnknown,
    IssuerRevocationUnknown,
    Revoked,
    IssuerRevoked,
}

/// A text that is no status of a certificate.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("\"{0}\" is not the OPC UA status of a refused certificate")]
pub struct UnknownCertificateStatus(String);

impl CertificateStatus {
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

    /// What it means and what helps, in one sentence for a person.
    pub const fn explain(self, language: Language) -> &'static str {
        match language {
            Language::En => self.english(),
            Language::Zh => self.chinese(),
        }
    }

    const fn english(self) -> &'static str {
        match self {
            Self::CertificateInvalid => "The certificate is damaged or its signature is wrong; ask for a new one.",
            Self::ChainIncomplete => {
                "The certificate of an authority that issued it is missing; add it to the issuers or to the trusted ones."
            }
            Self::SecurityChecksFailed => "The certificate was refused; the peer does not say why.",
            Self::PolicyCheckFailed => {
                "Its key or its signature is too weak, or of another kind than the security policy wants; make a new one."
            }
            Self::Untrusted => {
                "Nobody trusts it here yet; add it, or the authority that issued it, to the trusted ones."
            }
            Self::TimeInvalid => "It is expired or not yet valid; check the clocks, or renew it.",
            Self::IssuerTimeInvalid => {
                "An authority that issued it is expired or not yet valid; check the clocks, or renew the authority."
            }
            Self::HostNameInvalid => {
                "It is for another host than the one connected to; use that name, or make a new one."
            }
            Self::UriInvalid => {
                "Its application URI is not the one the application gives; make one for this application."
            }
            Self::UseNotAllowed => "It may not be used for an OPC UA application; ask for one with the right usages.",
            Self::IssuerUseNotAllowed => "A certificate in its chain may not issue certificates; it is no authority.",
            Self::RevocationUnknown => {
                "There is no valid revocation list of the authority that issued it; add an up-to-date one."
            }
            Self::IssuerRevocationUnknown => {
                "There is no valid revocation list for an authority in its chain; add an up-to-date one."
            }
            Self::Revoked => "The authority has revoked it; it must not be used any more.",
            Self::IssuerRevoked => {
                "An authority in its chain has been revoked; nothing it issued may be used any more."
            }
        }
    }

    const fn chinese(self) -> &'static str {
        match self {
            Self::CertificateInvalid => "证书已损坏或签名错误，请重新申请证书。",
            Self::ChainIncomplete => "缺少签发该证书的 CA 证书，请将其添加到发行人列表或信任列表。",
            Self::SecurityChecksFailed => "证书被拒绝，对方未说明原因。",
            Self::PolicyCheckFailed => "密钥或签名强度不足，或与安全策略要求的类型不符，请重新创建证书。",
            Self::Untrusted => "该证书尚未受信任，请将其或签发它的 CA 添加到信任列表。",
            Self::TimeInvalid => "证书已过期或尚未生效，请检查时钟或更新证书。",
            Self::IssuerTimeInvalid => "签发该证书的 CA 已过期或尚未生效，请检查时钟或更新 CA 证书。",
            Self::HostNameInvalid => "证书用于其他主机，请使用证书中的名称连接或重新创建证书。",
            Self::UriInvalid => "证书中的应用程序 URI 与应用程序提供的不一致，请为该应用程序创建证书。",
            Self::UseNotAllowed => "该证书不能用于 OPC UA 应用程序，请申请具有正确用法的证书。",
            Self::IssuerUseNotAllowed => "证书链中有证书不能签发证书，它不是 CA。",
            Self::RevocationUnknown => "没有签发该证书的 CA 的有效吊销列表，请添加最新的吊销列表。",
            Self::IssuerRevocationUnknown => "没有证书链中某个 CA 的有效吊销列表，请添加最新的吊销列表。",
            Self::Revoked => "该证书已被 CA 吊销，不得继续使用。",
            Self::IssuerRevoked => "证书链中的某个 CA 已被吊销，其签发的证书均不得使用。",
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
    fn every_status_is_read_back_from_its_name_and_has_its_own_code_and_words() {
        let mut codes = std::collections::BTreeSet::new();
        let mut words = std::collections::BTreeSet::new();
        for status in CertificateStatus::ALL {
            assert_eq!(status.as_str().parse(), Ok(status));
            let json = serde_json::to_string(&status).unwrap();
            assert_eq!(json, format!("\"{status}\""));
            assert_eq!(serde_json::from_str::<CertificateStatus>(&json).unwrap(), status);
            codes.insert(status.code());
            words.extend(Language::ALL.map(|language| status.explain(language)));
        }
        assert_eq!((codes.len(), words.len()), (15, 30));
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
