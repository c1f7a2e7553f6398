use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};

use super::RefusalCause;
use crate::model::{Base64Bytes, CertificateStatus, CertificateSummary};

/// A client certificate that a controller refused and keeps, so that a person can decide about it (manual 2.7.3). There is
/// one entry for each certificate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RejectedClient {
    /// DER.
    pub certificate: Base64Bytes,
    /// The issuer certificates that the client sent with it, in DER, in the order sent. The controller may keep only the
    /// first few.
    pub chain: Vec<Base64Bytes>,
    /// Names, dates and thumbprint of the certificate.
    pub summary: CertificateSummary,
    /// The reason of the latest refusal, as an OPC UA status code.
    pub status: CertificateStatus,
    /// The reason with its details. `None` where the controller does not tell it.
    #[serde(default, deserialize_with = "RefusalCause::if_known", skip_serializing_if = "Option::is_none")]
    pub cause: Option<RefusalCause>,
    /// The reason in English words.
    pub reason: String,
    /// The IP address of the latest refused connection. Empty when the certificate was moved here from another list and
    /// was not refused since.
    pub address: String,
    /// By the controller's clock.
    pub first_seen: DateTime<Utc>,
    /// By the controller's clock.
    pub last_seen: DateTime<Utc>,
    /// The number of refusals. 0 when the certificate was moved here from another list and was not refused since.
    pub count: u64,
}
