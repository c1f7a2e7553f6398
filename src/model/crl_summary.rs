use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};

/// What a list shows of one certificate revocation list without holding it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrlSummary {
    /// The common name of the authority, or its whole name where there is none.
    pub issuer: String,
    /// When the CRL was issued (`thisUpdate`).
    pub this_update: DateTime<Utc>,
    /// When the authority promised the next one; after that, this one says nothing any more.
    pub next_update: Option<DateTime<Utc>>,
    /// How many certificates are revoked by it.
    pub entries: usize,
    /// The CRL number, decimal.
    pub number: Option<String>,
    /// SHA-1 of the DER, upper-case hexadecimal: like the thumbprint of a certificate.
    pub id: String,
}
