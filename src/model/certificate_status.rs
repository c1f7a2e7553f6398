use serde::{Deserialize, Serialize};

/// Why a certificate is not accepted: the status codes of OPC 10000-4 §6.1.3.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum CertificateStatus {
    #[serde(rename = "BadCertificateUntrusted")]
    Untrusted,
    #[serde(rename = "BadCertificateRevoked")]
    Revoked,
}

impl CertificateStatus {
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Untrusted => "BadCertificateUntrusted",
            Self::Revoked => "BadCertificateRevoked",
        }
    }
}
