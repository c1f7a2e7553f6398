//! The server certificates of a controller and its signing request (manual 2.7.1, 2.7.2).

use serde::{Deserialize, Serialize};

use super::request::requests;
use super::response::check_count;
use super::{Response, WireSecret};
use crate::model::{
    Base64Bytes, CertificateType, Changed, CsrRequest, RevisionToken, Revisioned, SelfSignedRequest,
    StoredServerCertificates,
};

requests! {
    /// Server certificates.
    CERTIFICATE_REQUESTS
    GET "/v1/certificates" GetCertificates { none } session -> Revisioned<StoredServerCertificates>, "";
    POST "/v1/certificates/select" SelectCertificate { json } revision -> Changed, "";
    POST "/v1/certificates/self-signed" MakeSelfSigned { json } revision -> CertificateInstalled, "current firmware";
    POST "/v1/certificates/import" ImportCertificate { json } revision -> CertificateInstalled, "legacy firmware";
    POST "/v1/certificates/csr" MakeCsr { json } revision -> CsrMade, "current firmware";
    POST "/v1/certificates/csr/import" ImportCsr { json } revision -> CsrMade, "legacy firmware";
    POST "/v1/certificates/ca-signed" ImportCaSigned { json } revision -> CertificateInstalled, "";
}

/// Reads the server certificates.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GetCertificates;

impl Response for StoredServerCertificates {
    fn check(&mut self) -> Result<(), &'static str> {
        check_count(&self.held)
    }
}

/// Selects the certificate that the OPC UA server uses, among those in the controller (manual 2.7.2).
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SelectCertificate {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// The certificate to be used.
    #[serde(rename = "type")]
    pub kind: CertificateType,
}

/// Current firmware: the controller makes key and certificate itself; the key never leaves it.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MakeSelfSigned {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// What the certificate is to be made of.
    pub request: SelfSignedRequest,
}

/// Legacy firmware: key and certificate made on the PC, sent as PKCS#12. [`CertificateType::CaSigned`] is refused: such a
/// certificate belongs to the key of a signing request ([`ImportCaSigned`]).
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImportCertificate {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// The type it is stored as.
    pub kind: CertificateType,
    /// Key and certificate, encrypted with the password beside it.
    pub pkcs12: Base64Bytes,
    /// The password of `pkcs12`, made for this transfer only.
    pub password: WireSecret,
}

/// A server certificate was installed and selected.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CertificateInstalled {
    /// The server's state and the new revision.
    pub changed: Changed,
    /// DER.
    pub certificate: Base64Bytes,
}

impl Response for CertificateInstalled {}

/// Current firmware: the controller makes a new key and its CSR. The CA-signed certificate in use stays in use, with
/// its own key, until one for the new key is imported.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MakeCsr {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// What the request is to be made of.
    pub request: CsrRequest,
}

/// Legacy firmware: a key and its CSR, made on the PC now or earlier (a backup). The controller has room for one such key:
/// its CA-signed certificate is removed unless it is for the same key. A server that used it stops.
///
/// With `certificate`, key and certificate are replaced in one change: the certificate is installed and selected as by
/// [`ImportCaSigned`], and a server that runs is started again with it.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImportCsr {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// DER.
    pub csr: Base64Bytes,
    /// The key of `csr`, without a certificate.
    pub pkcs12: Base64Bytes,
    /// The password of `pkcs12`, made for this transfer only.
    pub password: WireSecret,
    /// The certificate that a CA issued for `csr`, in DER.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificate: Option<Base64Bytes>,
}

/// The controller has a new CSR.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CsrMade {
    /// The server's state and the new revision.
    pub changed: Changed,
    /// DER.
    pub csr: Base64Bytes,
}

impl Response for CsrMade {}

/// Installs and selects the certificate that a CA issued for the CSR in the controller (manual 2.7.1.5).
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImportCaSigned {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// DER.
    pub certificate: Base64Bytes,
}
