use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};

/// What a list shows of one CRL without holding it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrlSummary {
    pub issuer: String,
    pub this_update: DateTime<Utc>,
    pub next_update: Option<DateTime<Utc>>,
    /// Revoked certificates in it.
    pub entries: usize,
    /// The CRL number, if it has one.
    pub number: Option<String>,
    /// SHA-1 of the DER, upper-case hexadecimal.
    pub id: String,
}
