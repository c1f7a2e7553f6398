use chrono::{DateTime, Utc};

use super::PeerRole;
use crate::model::SecurityPolicy;
use crate::pki::{Certificate, CertificateFlaw, KeyUsage};

/// What a peer shows of itself, and what it is compared with.
#[derive(Debug, Clone, Copy)]
pub struct PresentedCertificate<'a> {
    /// The certificate to be checked.
    pub certificate: &'a Certificate,
    /// What the peer sent besides, in any order.
    pub chain: &'a [Certificate],
    /// What its owner is to us.
    pub role: PeerRole,
    /// The time of the check.
    pub now: DateTime<Utc>,
    /// The ApplicationUri of the peer's ApplicationDescription; `None` skips the check.
    pub application_uri: Option<&'a str>,
    /// The host of the URL that was connected to; `None` skips the check, as servers do for their clients.
    pub host: Option<&'a str>,
    /// The one of the secure channel; without one, what today's policies want.
    pub security_policy: Option<SecurityPolicy>,
}

/// What is let pass although OPC 10000-4 §6.1.3 advises against it. Nothing is, by default.
///
/// Signatures, trust, the application URI, issuers that are no CAs and revocations cannot be excused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TrustPolicy {
    /// A certificate is accepted though no valid revocation list of its issuer is at hand.
    pub allow_unknown_revocation: bool,
    /// A revocation list counts although the date it promised the next one for is past, or it promised none.
    pub allow_expired_crls: bool,
    /// Certificates are accepted before and after their time, and those of issuers too.
    pub allow_expired_certificates: bool,
    /// SHA-1 is accepted under every security policy. MD5 never is.
    pub allow_sha1: bool,
    /// A chain may end in a certificate that is itself trusted, although its issuer is missing. Its own revocation can
    /// then not be checked.
    pub allow_incomplete_chain: bool,
    /// The key usages, and extended key usages, of the application's certificate do not matter.
    pub allow_any_usage: bool,
    /// An application's certificate is accepted without a key usage, and with one that lacks only nonRepudiation, which
    /// many applications do not miss.
    pub allow_partial_key_usage: bool,
}

impl TrustPolicy {
    /// Whether a flaw of the application's key usage is excused.
    pub(in crate::pki) fn excuses_key_usage(&self, flaw: &CertificateFlaw) -> bool {
        let is_partial = match flaw {
            CertificateFlaw::KeyUsageMissing => true,
            CertificateFlaw::KeyUsageLacks { missing } => *missing == [KeyUsage::NonRepudiation],
            _ => false,
        };
        self.allow_any_usage || self.allow_partial_key_usage && is_partial
    }
}
