//! The entries of a controller's client certificate lists and CRLs, and how they are changed (manual 2.7.3).

use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};

use super::{Base64Bytes, CertificateStatus, CertificateSummary, ClientList, CrlSummary, RevisionToken};

/// A certificate in the trusted or issuers list.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ListedCertificate {
    /// The name of the file it came from. Not unique; it only helps people to recognise the certificate.
    pub file_name: String,
    /// DER.
    pub certificate: Base64Bytes,
    /// Names, dates and thumbprint of the certificate.
    pub summary: CertificateSummary,
    /// By the controller's clock.
    pub added: DateTime<Utc>,
}

/// A CRL in a controller.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ListedCrl {
    /// The name of the file it came from. Not unique; it only helps people to recognise the CRL.
    pub file_name: String,
    /// DER. `None` where the list would become too large: the CRL is read on its own then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub crl: Option<Base64Bytes>,
    /// Issuer, number and dates of the CRL.
    pub summary: CrlSummary,
    /// By the controller's clock.
    pub added: DateTime<Utc>,
}

/// Two equal stamps of one controller mean that its lists and CRLs have not changed in between. Cheap to read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct TrustStamp {
    /// Of the configuration, which holds the trusted and issuers lists and the CRLs.
    pub revision: RevisionToken,
    /// Changes with the rejected list, which the controller fills by itself and which is not part of the configuration.
    pub rejected: u64,
}

/// One step of a change of lists and CRLs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum TrustStep {
    /// Adds DER certificates to the trusted or the issuers list, each with the file name it is shown under. A list never
    /// holds the same certificate twice.
    Add {
        /// Trusted or issuers.
        list: ClientList,
        /// Certificate names and their DER.
        certificates: Vec<(String, Base64Bytes)>,
    },
    /// By thumbprint, each of which must be in the list.
    Remove {
        /// Any list.
        list: ClientList,
        /// SHA-1 of each certificate, in hexadecimal.
        thumbprints: Vec<String>,
    },
    /// By thumbprint, from one list into another.
    Move {
        /// The list that holds the certificates.
        from: ClientList,
        /// The list they go into.
        to: ClientList,
        /// SHA-1 of each certificate, in hexadecimal.
        thumbprints: Vec<String>,
    },
    /// Adds DER CRLs, each with the file name it is shown under. A CRL replaces the one of the same issuer (same name,
    /// same authority key identifier) for the same certificates (same issuing distribution point) if it is newer: by its
    /// `thisUpdate`, then by CRL number. An older one is refused with
    /// [`ErrorCode::CrlOutdated`](super::ErrorCode::CrlOutdated).
    AddCrls {
        /// CRL names and their DER.
        crls: Vec<(String, Base64Bytes)>,
    },
    /// By [`CrlSummary::id`], each of which must be in the controller.
    RemoveCrls {
        /// The identifier of each CRL in the controller.
        ids: Vec<String>,
    },
}

/// A client whose open connection the controller ended because the client is no longer accepted.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct DisconnectedClient {
    /// IP address and port.
    pub address: String,
    /// Common name of its certificate.
    pub issued_to: String,
    /// SHA-1 of its certificate, in hexadecimal.
    pub thumbprint: String,
    /// Why the certificate is not accepted any more.
    pub status: CertificateStatus,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_written_by_its_name() {
        let step =
            TrustStep::Move { from: ClientList::Rejected, to: ClientList::Trusted, thumbprints: vec!["AB".to_owned()] };
        let json = r#"{"move":{"from":"rejected","to":"trusted","thumbprints":["AB"]}}"#;
        assert_eq!(serde_json::to_string(&step).expect("json"), json);
        assert_eq!(serde_json::from_str::<TrustStep>(json).expect("a step"), step);
        assert!(serde_json::from_str::<TrustStep>(r#"{"remove-crls":{"ids":[],"force":true}}"#).is_err());
    }
}
