use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};

use super::{CertificateFlaw, UnverifiableSignature};

/// Why a revocation list does not say whether a certificate was revoked.
///
/// Part of [`CertificateFlaw::RevocationUnknown`], which names the authority. In JSON it has the field `flaw` with its
/// name in kebab case, and its own fields beside it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "flaw", rename_all = "kebab-case")]
pub enum CrlFlaw {
    /// There is no list of the authority.
    Missing,
    /// It has the name of the authority, but the key of the authority did not sign it.
    NotSigned,
    /// The algorithm is not supported, or proves nothing.
    SignatureUnverifiable {
        /// Why.
        because: UnverifiableSignature,
    },
    /// It names another key of the authority than the one that signed the certificate, and no certificate of that key
    /// is at hand.
    KeyNotHeld,
    /// It is signed with another key of the authority, and the chain of that key's certificate is not good (RFC 5280
    /// §6.3.3 (f)). `subject`: the certificate of that chain which is at fault.
    KeyNotAccepted {
        /// Subject of the certificate at fault.
        subject: String,
        /// What is wrong with it.
        because: Box<CertificateFlaw>,
    },
    /// The certificate of its signer does not allow the signing of lists.
    MayNotSign,
    /// The signature uses a hash that can be forged.
    WeakHash {
        /// Name of the algorithm.
        algorithm: String,
    },
    /// The list does not count by itself for any certificate.
    Unusable {
        /// Why it does not count.
        because: CrlUnusable,
    },
    /// It is about other certificates.
    OutOfScope {
        /// Which certificates it is about.
        because: OutOfScope,
    },
    /// The list is from the future.
    NotYetValid {
        /// `thisUpdate` of the list.
        from: DateTime<Utc>,
        /// The time of the check.
        now: DateTime<Utc>,
    },
    /// It does not say until when it is valid.
    NoEnd,
    /// A newer list is due.
    Expired {
        /// `nextUpdate` of the list.
        until: DateTime<Utc>,
        /// The time of the check.
        now: DateTime<Utc>,
    },
    /// The lists that count are only about some reasons for a revocation, and there is none about the others.
    SomeReasons,
}

/// Why a revocation list can say of no certificate by itself that it is not revoked (RFC 5280 §5.2).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CrlUnusable {
    /// RFC 5280 §5.2.4.
    Delta,
    /// RFC 5280 §5.2.5.
    Indirect,
    /// The list is only about attribute certificates.
    OnlyAttributeCertificates,
    /// Only about applications, and only about authorities.
    AboutNothing,
    /// The list is only about some reasons for a revocation.
    OnlySomeReasons,
    /// The object identifier of an extension that is critical and not supported.
    CriticalExtension(String),
    /// The same, of an entry.
    CriticalEntryExtension(String),
}

impl CrlFlaw {
    /// The one to tell of two lists: the one that comes nearer to an answer, the first if none does.
    pub(in crate::pki) fn or_nearer(self, other: Self) -> Self {
        if other.rank() > self.rank() { other } else { self }
    }

    fn rank(&self) -> u8 {
        match self {
            Self::Missing => 0,
            Self::NotSigned => 1,
            Self::SignatureUnverifiable { .. } => 2,
            Self::KeyNotHeld => 3,
            Self::KeyNotAccepted { .. } => 4,
            Self::MayNotSign => 5,
            Self::WeakHash { .. } => 6,
            Self::Unusable { .. } => 7,
            Self::OutOfScope { .. } => 8,
            Self::NotYetValid { .. } => 9,
            Self::NoEnd => 10,
            Self::Expired { .. } => 11,
            Self::SomeReasons => 12,
        }
    }
}

/// Which certificates a list leaves out.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OutOfScope {
    /// It is only about certificates of applications; this one is an authority's.
    OnlyApplications,
    /// It is only about certificates of authorities; this one is not.
    OnlyAuthorities,
    /// It is only about attribute certificates.
    OnlyAttributeCertificates,
    /// It is only about certificates with this distribution point; this one has another or none.
    OtherDistributionPoint(String),
}
