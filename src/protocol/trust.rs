//! Messages about whom a controller's OPC UA server trusts: its client certificate lists and its CRLs (manual 2.7.3).

use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};

use super::{Base64Bytes, Changed};
use crate::model::{CertificateStatus, CertificateSummary, ClientList, CrlSummary, Language};
use crate::pki::{RefusalCause, explain_refusal};

/// A certificate in the trusted or issuers list.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ListedCertificate {
    /// The name the file had on the PC; only for people to recognise it by.
    pub file_name: String,
    /// DER.
    pub certificate: Base64Bytes,
    pub summary: CertificateSummary,
    pub added: DateTime<Utc>,
}

/// A client certificate that was refused, kept so that a person can decide about it. One entry a certificate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RejectedClient {
    /// DER.
    pub certificate: Base64Bytes,
    /// What the client sent besides: its issuers, DER, in the order sent. May be cut short.
    pub chain: Vec<Base64Bytes>,
    pub summary: CertificateSummary,
    /// Why it was refused last.
    pub status: CertificateStatus,
    /// The same, with what is wrong in particular; left out where the controller does not tell it.
    #[serde(default, deserialize_with = "RefusalCause::if_known", skip_serializing_if = "Option::is_none")]
    pub cause: Option<RefusalCause>,
    /// The same in English words.
    pub reason: String,
    /// The IP address it came from last; empty when it was moved here from another list and has not come since.
    pub address: String,
    pub first_seen: DateTime<Utc>,
    pub last_seen: DateTime<Utc>,
    /// How often it was refused; 0 when it was moved here from another list and has not come since.
    pub count: u64,
}

impl RejectedClient {
    /// What the refusal means and what to do.
    pub fn explain(&self, language: Language) -> String {
        explain_refusal(self.status, self.cause.as_ref(), language)
    }
}

/// A CRL in a controller.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ListedCrl {
    /// The name the file had on the PC; only for people to recognise it by.
    pub file_name: String,
    /// DER; left out where the answer would become too large: [`super::crl_path`] gives it then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub crl: Option<Base64Bytes>,
    pub summary: CrlSummary,
    pub added: DateTime<Utc>,
}

/// Tells whether anything in the lists is another than before, without sending them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct TrustStamp {
    /// Of the configuration, which holds the trusted and issuers lists and the CRLs.
    pub revision: u64,
    /// Another number after each change of the rejected list, which the controller fills by itself and which is no part
    /// of the configuration.
    pub rejected: u64,
}

/// Changes lists and CRLs: all steps, one after the other, or none.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EditTrust {
    pub revision: u64,
    /// 1 to [`MAX_TRUST_STEPS`].
    pub steps: Vec<TrustStep>,
}

/// One step of [`EditTrust`].
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum TrustStep {
    /// DER certificates for the trusted or the issuers list, each with the file name it is to be shown under. A list
    /// never holds the same certificate twice.
    Add { list: ClientList, certificates: Vec<(String, Base64Bytes)> },
    /// By thumbprint, each of which must be in the list.
    Remove { list: ClientList, thumbprints: Vec<String> },
    /// By thumbprint, from one list into another.
    Move { from: ClientList, to: ClientList, thumbprints: Vec<String> },
    /// DER CRLs, each with the file name it is to be shown under. One takes the place of the CRL of the same issuer (same
    /// name, same authority key identifier) about the same certificates (same issuing distribution point) if it is
    /// newer: by its `thisUpdate`, then by CRL number; otherwise it is refused with [`ErrorCode::CrlOutdated`](crate::model::ErrorCode::CrlOutdated).
    AddCrls { crls: Vec<(String, Base64Bytes)> },
    /// By [`CrlSummary::id`], each of which must be held.
    RemoveCrls { ids: Vec<String> },
}

/// Lists and CRLs were changed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TrustChanged {
    pub changed: Changed,
    /// Whose open connections were ended because of it.
    pub cut: Vec<CutClient>,
}

/// A client whose open connection was ended because it is not accepted any more.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CutClient {
    /// IP address and port.
    pub address: String,
    pub issued_to: String,
    pub thumbprint: String,
    pub status: CertificateStatus,
}

pub const MAX_TRUST_STEPS: usize = 16;
/// The largest CRL a controller takes, in bytes of DER: what fits into a request.
pub const MAX_SENT_CRL_BYTES: usize = 700 * 1024;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_written_by_its_name() {
        let step =
            TrustStep::Move { from: ClientList::Rejected, to: ClientList::Trusted, thumbprints: vec!["AB".to_owned()] };
        let json = r#"{"move":{"from":"rejected","to":"trusted","thumbprints":["AB"]}}"#;
        assert_eq!(serde_json::to_string(&step).unwrap(), json);
        assert_eq!(serde_json::from_str::<TrustStep>(json).unwrap(), step);
        assert!(serde_json::from_str::<TrustStep>(r#"{"remove-crls":{"ids":[],"force":true}}"#).is_err());
    }
}
