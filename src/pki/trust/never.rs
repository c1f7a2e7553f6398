use super::PeerRole;
use super::checks::lasting_flaw;
use crate::pki::{Certificate, CertificateFlaw, rules};

/// Why no client is ever let in with this certificate, or with one from this authority, for any lists and
/// at any time; by the checks of [`TrustLists::validate`](super::TrustLists::validate).
///
/// Keys and signatures that only the deprecated security policies take count as not taken.
pub fn never_accepted(certificate: &Certificate, is_authority: bool) -> Option<CertificateFlaw> {
    lasting_flaw(certificate, is_authority, PeerRole::Client)
        // The secure channel does not ask for the URI, but every session does.
        .or_else(|| (!is_authority).then(|| rules::application_uri_flaw(certificate, None)).flatten())
}
