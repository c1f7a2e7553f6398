use serde::{Deserialize, Serialize};
use x509_parser::prelude::ReasonCode;

/// Why a certificate was revoked (RFC 5280 §5.3.1), by the names of that document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum RevocationReason {
    /// No reason is given.
    Unspecified,
    /// The private key is known to others, or may be.
    KeyCompromise,
    /// The key of the CA is known to others, or may be.
    #[serde(rename = "cACompromise")]
    CaCompromise,
    /// The name of the subject has changed.
    AffiliationChanged,
    /// Another certificate has taken its place.
    Superseded,
    /// The certificate is not needed any more.
    CessationOfOperation,
    /// The certificate is suspended, and may come back.
    CertificateHold,
    /// Only in a delta list: it is not revoked any more.
    #[serde(rename = "removeFromCRL")]
    RemoveFromCrl,
    /// A right that the certificate gave was withdrawn.
    PrivilegeWithdrawn,
    /// The key of the attribute authority is known to others, or may be.
    #[serde(rename = "aACompromise")]
    AaCompromise,
}

impl RevocationReason {
    pub(super) fn of(code: ReasonCode) -> Option<Self> {
        Some(match code.0 {
            0 => Self::Unspecified,
            1 => Self::KeyCompromise,
            2 => Self::CaCompromise,
            3 => Self::AffiliationChanged,
            4 => Self::Superseded,
            5 => Self::CessationOfOperation,
            6 => Self::CertificateHold,
            8 => Self::RemoveFromCrl,
            9 => Self::PrivilegeWithdrawn,
            10 => Self::AaCompromise,
            _ => return None,
        })
    }

    /// As RFC 5280 writes it.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Unspecified => "unspecified",
            Self::KeyCompromise => "keyCompromise",
            Self::CaCompromise => "cACompromise",
            Self::AffiliationChanged => "affiliationChanged",
            Self::Superseded => "superseded",
            Self::CessationOfOperation => "cessationOfOperation",
            Self::CertificateHold => "certificateHold",
            Self::RemoveFromCrl => "removeFromCRL",
            Self::PrivilegeWithdrawn => "privilegeWithdrawn",
            Self::AaCompromise => "aACompromise",
        }
    }
}
