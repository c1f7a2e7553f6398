use serde::{Deserialize, Serialize};

use super::{Base64Bytes, CertificateType};

/// The server certificates that a controller has stored, and its signing request. Private keys are not part of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StoredServerCertificates {
    /// The type the OPC UA server uses, also while the controller has no certificate of this type.
    pub selected: CertificateType,
    /// At most one of each type.
    pub held: Vec<StoredServerCertificate>,
    /// The latest signing request, in DER. A CA-signed certificate must be for the key of this request. It stays after
    /// the import, so that the CA can renew the certificate.
    pub csr: Option<Base64Bytes>,
}

impl StoredServerCertificates {
    /// The certificate of a type, in DER.
    pub fn of(&self, kind: CertificateType) -> Option<&[u8]> {
        self.held.iter().find(|held| held.kind == kind).map(|held| held.certificate.0.as_slice())
    }
}

/// One server certificate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StoredServerCertificate {
    /// How the certificate came to be.
    #[serde(rename = "type")]
    pub kind: CertificateType,
    /// DER.
    pub certificate: Base64Bytes,
}
