//! Messages about the server certificates a controller holds, beyond making and importing one with its key.

use serde::{Deserialize, Serialize};

use super::{Base64Bytes, Changed, WireSecret};
use crate::model::{CertificateType, CsrRequest};

/// What a controller holds to show its clients. Private keys are never told.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct HeldCertificates {
    /// The type the OPC UA server uses, whether one is held or not.
    pub selected: CertificateType,
    /// At most one of each type.
    pub held: Vec<HeldCertificate>,
    /// The CSR made last, in DER: what a CA-signed certificate must be for. It stays after the import, so that the CA
    /// can renew the certificate.
    pub csr: Option<Base64Bytes>,
}

impl HeldCertificates {
    /// The certificate of a type, in DER.
    pub fn of(&self, kind: CertificateType) -> Option<&[u8]> {
        self.held.iter().find(|held| held.kind == kind).map(|held| held.certificate.0.as_slice())
    }
}

/// One server certificate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct HeldCertificate {
    #[serde(rename = "type")]
    pub kind: CertificateType,
    /// DER.
    pub certificate: Base64Bytes,
}

/// Current firmware: the controller makes a new key and its CSR. The CA-signed certificate in use stays in use, with
/// its own key, until one for the new key is imported.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MakeCsr {
    pub revision: u64,
    pub request: CsrRequest,
}

/// Legacy firmware: key and CSR made on the PC, now or earlier (a backup). The controller has room for one key only, so
/// its CA-signed certificate is gone from then on unless it is for the same key; a server that used it stops.
///
/// With `certificate`, key and certificate are replaced in one change: the certificate is installed and selected as by
/// [`ImportCaSigned`], and a server that runs is started again with it.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImportCsr {
    pub revision: u64,
    /// DER.
    pub csr: Base64Bytes,
    /// The key of `csr`, without a certificate.
    pub pkcs12: Base64Bytes,
    /// The password of `pkcs12`, made up for this one transfer.
    pub password: WireSecret,
    /// What a CA issued for `csr`, in DER.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificate: Option<Base64Bytes>,
}

/// The controller holds a new CSR.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CsrMade {
    pub changed: Changed,
    /// DER.
    pub csr: Base64Bytes,
}

/// The certificate a CA issued for the CSR the controller holds.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImportCaSigned {
    pub revision: u64,
    /// DER.
    pub certificate: Base64Bytes,
}

/// Which of the certificates held the OPC UA server is to use (manual 2.7.2).
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SelectCertificate {
    pub revision: u64,
    #[serde(rename = "type")]
    pub kind: CertificateType,
}
