use serde::{Deserialize, Serialize};

/// What a key may be used for (RFC 5280 §4.2.1.3), by the names of that document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum KeyUsage {
    /// Signatures other than on certificates and CRLs; required by OPC UA.
    DigitalSignature,
    /// Signatures that cannot be denied later (contentCommitment); required by OPC UA.
    NonRepudiation,
    /// Encryption of keys; required by OPC UA.
    KeyEncipherment,
    /// Encryption of data; required by OPC UA.
    DataEncipherment,
    /// Agreement on keys.
    KeyAgreement,
    /// Signatures on certificates.
    KeyCertSign,
    /// Signatures on CRLs.
    #[serde(rename = "cRLSign")]
    CrlSign,
    /// With key agreement: encryption only.
    EncipherOnly,
    /// With key agreement: decryption only.
    DecipherOnly,
}

impl KeyUsage {
    /// In the order of their bits.
    pub const ALL: [Self; 9] = [
        Self::DigitalSignature,
        Self::NonRepudiation,
        Self::KeyEncipherment,
        Self::DataEncipherment,
        Self::KeyAgreement,
        Self::KeyCertSign,
        Self::CrlSign,
        Self::EncipherOnly,
        Self::DecipherOnly,
    ];

    /// As RFC 5280 writes it.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::DigitalSignature => "digitalSignature",
            Self::NonRepudiation => "nonRepudiation",
            Self::KeyEncipherment => "keyEncipherment",
            Self::DataEncipherment => "dataEncipherment",
            Self::KeyAgreement => "keyAgreement",
            Self::KeyCertSign => "keyCertSign",
            Self::CrlSign => "cRLSign",
            Self::EncipherOnly => "encipherOnly",
            Self::DecipherOnly => "decipherOnly",
        }
    }
}
