//! What can be wrong with a certificate, as values. They decide the OPC UA status; `texts` has the words and the
//! remedy.

mod crl;
mod unverifiable;

pub use crl::{CrlFlaw, CrlUnusable, OutOfScope};
pub use unverifiable::UnverifiableSignature;

use chrono::{DateTime, Utc};
use serde::{Deserialize, Deserializer, Serialize};

use super::name::quoted;
use super::{KeyUsage, PeerRole, RevocationReason};
use crate::model::CertificateStatus as Status;

/// One thing that is wrong with a certificate.
///
/// Texts in it come from certificates; they hold no control characters and are cut to 200 characters. In JSON it has
/// the field `flaw` with its name in kebab case, and its own fields beside it.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "flaw", rename_all = "kebab-case")]
pub enum CertificateFlaw {
    // OPC 10000-4 §6.1.3, step 1: the certificate itself
    /// What was sent or read is not a certificate.
    Unreadable {
        /// What cannot be read.
        why: String,
    },
    /// RFC 5280 §4.2: critical, and of a kind that is not supported. The object identifier.
    UnknownCriticalExtension {
        /// Its object identifier.
        extension: String,
    },
    /// One that is supported here, but not by every client.
    RareCriticalExtension {
        /// Its name.
        extension: String,
    },
    /// Its content contradicts its definition. A name, or the object identifier.
    DamagedExtension {
        /// Its name, or its object identifier.
        extension: String,
    },
    /// A name of the subject alternative name is not ASCII (RFC 5280 §4.2.1.6), and neither is it UTF-8.
    NameNotAscii {
        /// The name, with other characters replaced.
        name: String,
    },
    /// `notAfter` is before `notBefore`.
    EndsBeforeItBegins,

    // steps 2 and 3: the chain and its signatures
    /// The chain has more certificates than are followed.
    ChainTooLong {
        /// Most certificates of a chain.
        most: usize,
    },
    /// More authorities carry the names in question than are tried.
    TooManyIssuers,
    /// No certificate of the issuer is at hand.
    IssuerMissing {
        /// Name of the issuer.
        issuer: String,
    },
    /// The authority at hand signed it, but has another key identifier than it names (RFC 5280 §4.2.1.1).
    IssuerKeyIdentifier {
        /// Name of the authority.
        issuer: String,
        /// The key identifier that the certificate names.
        wanted: String,
    },
    /// An authority of that name is at hand, but with another key than the one that is named.
    IssuerKey {
        /// Name of the authority.
        issuer: String,
    },
    /// The key of the issuer did not sign the certificate, or the certificate was changed.
    SignatureWrong {
        /// Name of the issuer.
        issuer: String,
    },
    /// It carries its own name as that of its issuer, but another key signed it.
    SelfSignatureWrong,
    /// The algorithm is not supported, or proves nothing.
    SignatureUnverifiable {
        /// Why.
        because: UnverifiableSignature,
    },

    // RFC 5280 §6.1.3 and §6.1.4: what authorities above it say about names and policies
    /// RFC 5280 §4.2.1.10: the authority may not certify this name.
    NameNotPermitted {
        /// The name in the certificate.
        name: String,
        /// Name of the authority that does not permit it.
        authority: String,
    },
    /// The authority constrains names of this kind in a way that cannot be checked.
    NameConstraintUnsupported {
        /// The name in the certificate.
        name: String,
        /// Name of the authority that constrains it.
        authority: String,
    },
    /// More names and constraints than are compared.
    TooManyNames {
        /// Name of the authority with the constraints.
        authority: String,
    },
    /// RFC 5280 §6.1.5 (g): an authority above it wants a certificate policy, and none holds for the whole chain.
    PolicyMissing,
    /// RFC 5280 §6.1.4 (a): a policy mapping from or to anyPolicy.
    PolicyMappingOfAny,

    // step 4: the security policy
    /// The key is not an RSA key, which every OPC UA security policy here requires.
    KeyNotRsa,
    /// The public exponent of the RSA key is not one that is accepted.
    KeyExponent,
    /// In bits. Only the deprecated Basic128Rsa15 and Basic256 take 1024 bits.
    KeyTooShort {
        /// Length of the key.
        bits: u16,
        /// Shortest length that is accepted.
        least: u16,
    },
    /// The key is longer than security policies allow.
    KeyTooLong {
        /// Length of the key in bits.
        bits: u16,
        /// Greatest length in bits.
        most: u16,
    },
    /// A length that no security policy ticked in the controller uses.
    KeyLengthNotTicked {
        /// Length of the key.
        bits: u16,
    },
    /// The signature uses a hash that can be forged, or that the security policy does not allow.
    WeakHash {
        /// Name of the algorithm.
        algorithm: String,
    },

    // step 5: the trust list
    /// Neither the certificate nor an authority above it is trusted.
    Untrusted,

    // step 6: validity
    /// The certificate is not valid yet.
    NotYetValid {
        /// First moment of its validity.
        from: DateTime<Utc>,
        /// The time of the check.
        now: DateTime<Utc>,
    },
    /// The certificate has expired.
    Expired {
        /// Last moment of its validity.
        until: DateTime<Utc>,
        /// The time of the check.
        now: DateTime<Utc>,
    },
    /// Still valid, but not for long.
    ExpiresSoon {
        /// Last moment of its validity.
        until: DateTime<Utc>,
    },

    // steps 7 and 8: host name and application URI
    /// It names none of the hosts.
    HostName {
        /// The addresses and names that the server is reached by.
        hosts: Vec<String>,
        /// The addresses and names in the certificate.
        names: Vec<String>,
    },
    /// `announced`: what the application says of itself, if it was asked.
    UriMissing {
        /// The application URI that the application reports.
        announced: Option<String>,
    },
    /// The application URI in the certificate is not the one that the application reports.
    UriDiffers {
        /// The URI in the certificate.
        certificate: String,
        /// The URI that the application reports.
        announced: String,
    },
    /// RFC 5280 §4.2.1.6: a URI is ASCII; other characters may stand for ones that were replaced.
    UriNotAscii {
        /// The URI, with other characters replaced.
        uri: String,
    },

    // step 9: usages
    /// The certificate of an authority where one of an application belongs.
    CertificateOfAuthority,
    /// A self-signed certificate of an application says that it is a CA.
    ClaimsToBeAuthority,
    /// The certificate has no key usage extension.
    KeyUsageMissing,
    /// The key usage leaves out what OPC UA needs (OPC 10000-6 §6.2.2).
    KeyUsageLacks {
        /// The usages that are missing.
        missing: Vec<KeyUsage>,
    },
    /// Its extended key usages leave out what the application is.
    NotForRole {
        /// What the application is.
        role: PeerRole,
    },
    /// The certificate has no extended key usage extension.
    ExtendedKeyUsageMissing,
    /// It issued a certificate, but is not a CA.
    NotAnAuthority,
    /// It issued a certificate, but its key may not sign certificates.
    MayNotIssue,
    /// Its extended key usages leave out what it issued a certificate for.
    MayNotIssueFor {
        /// What the certificate was issued for.
        role: PeerRole,
    },
    /// The path length of an authority does not allow the chain below it (RFC 5280 §4.2.1.9).
    TooManyAuthoritiesBelow {
        /// Most authorities that may be below it.
        most: u32,
        /// Authorities that are below it.
        found: usize,
    },

    // steps 10 and 11: revocation
    /// No list that counts says whether it was revoked. `authority`: its issuer; `crl`: the flaw of the list that comes
    /// nearest to saying it.
    RevocationUnknown {
        /// Name of its issuer.
        authority: String,
        /// The flaw of the list that comes nearest to being usable.
        crl: CrlFlaw,
    },
    /// A CRL revokes the certificate.
    Revoked {
        /// When it was revoked.
        on: DateTime<Utc>,
        /// Why it was revoked.
        because: RevocationReason,
    },

    /// A session was opened with another certificate than its secure channel (OPC 10000-4 §5.7.2).
    NotThatOfTheChannel,
}

impl CertificateFlaw {
    /// The OPC UA status; `of_issuer`: of a certificate above the one that is checked.
    pub const fn status(&self, of_issuer: bool) -> Status {
        match self {
            Self::Unreadable { .. }
            | Self::UnknownCriticalExtension { .. }
            | Self::RareCriticalExtension { .. }
            | Self::DamagedExtension { .. }
            | Self::NameNotAscii { .. }
            | Self::EndsBeforeItBegins
            | Self::SignatureWrong { .. }
            | Self::SelfSignatureWrong
            | Self::NameNotPermitted { .. }
            | Self::NameConstraintUnsupported { .. }
            | Self::TooManyNames { .. }
            | Self::PolicyMissing
            | Self::PolicyMappingOfAny
            | Self::NotThatOfTheChannel => Status::CertificateInvalid,
            Self::ChainTooLong { .. }
            | Self::TooManyIssuers
            | Self::IssuerMissing { .. }
            | Self::IssuerKeyIdentifier { .. }
            | Self::IssuerKey { .. } => Status::ChainIncomplete,
            Self::SignatureUnverifiable { .. }
            | Self::KeyNotRsa
            | Self::KeyExponent
            | Self::KeyTooShort { .. }
            | Self::KeyTooLong { .. }
            | Self::KeyLengthNotTicked { .. }
            | Self::WeakHash { .. } => Status::PolicyCheckFailed,
            Self::Untrusted => Status::Untrusted,
            Self::NotYetValid { .. } | Self::Expired { .. } | Self::ExpiresSoon { .. } if of_issuer => {
                Status::IssuerTimeInvalid
            }
            Self::NotYetValid { .. } | Self::Expired { .. } | Self::ExpiresSoon { .. } => Status::TimeInvalid,
            Self::HostName { .. } => Status::HostNameInvalid,
            Self::UriMissing { .. } | Self::UriDiffers { .. } | Self::UriNotAscii { .. } => Status::UriInvalid,
            Self::CertificateOfAuthority
            | Self::ClaimsToBeAuthority
            | Self::KeyUsageMissing
            | Self::KeyUsageLacks { .. }
            | Self::NotForRole { .. }
            | Self::ExtendedKeyUsageMissing => Status::UseNotAllowed,
            Self::NotAnAuthority
            | Self::MayNotIssue
            | Self::MayNotIssueFor { .. }
            | Self::TooManyAuthoritiesBelow { .. } => Status::IssuerUseNotAllowed,
            Self::RevocationUnknown { .. } if of_issuer => Status::IssuerRevocationUnknown,
            Self::RevocationUnknown { .. } => Status::RevocationUnknown,
            Self::Revoked { .. } if of_issuer => Status::IssuerRevoked,
            Self::Revoked { .. } => Status::Revoked,
        }
    }

    /// That the list of an authority does not say whether a certificate was revoked. The name is cut to 200 characters.
    pub fn of_list(crl: CrlFlaw, authority: &str) -> Self {
        Self::RevocationUnknown { authority: quoted(authority), crl }
    }
}

/// Why a certificate is refused: what is wrong, and with which certificate of its chain.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RefusalCause {
    /// What is wrong.
    #[serde(flatten)]
    pub flaw: CertificateFlaw,
    /// The name of the issuer at fault; `None`: the certificate itself is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_fault: Option<String>,
}

impl RefusalCause {
    /// The OPC UA status, which tells a flaw of the certificate from one of an authority above it.
    pub const fn status(&self) -> Status {
        self.flaw.status(self.at_fault.is_some())
    }

    /// For serde: a cause that is not known, as a newer controller may send, is none.
    pub fn if_known<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Self>, D::Error> {
        let value = serde_json::Value::deserialize(from)?;
        Ok(serde_json::from_value(value).ok())
    }
}

#[cfg(test)]
mod tests;
