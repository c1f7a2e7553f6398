use super::checks::{application_flaw, may_issue_flaw, strength_flaw, structure_flaw};
use super::{Role, TrustPolicy};
use crate::pki::signature::Verdict;
use crate::pki::{Certificate, CertificateFlaw};

/// Why no client is ever let in with this certificate, or with one from this authority, whatever the lists hold and
/// whatever time it is; by the checks of [`TrustLists::validate`](super::TrustLists::validate).
///
/// Keys and signatures that only the deprecated security policies take count as not taken.
pub fn never_accepted(certificate: &Certificate, is_authority: bool) -> Option<CertificateFlaw> {
    let policy = TrustPolicy::default();
    structure_flaw(certificate)
        .or_else(|| strength_flaw(certificate, is_authority, None, &policy))
        .or_else(|| signature_flaw(certificate, is_authority))
        .or_else(|| {
            if is_authority {
                return may_issue_flaw(certificate, Role::Client);
            }
            let facts = certificate.facts();
            let is_issued = facts.subject_folded != facts.issuer_folded;
            application_flaw(certificate, is_issued, Role::Client, &policy).or_else(|| uri_flaw(certificate))
        })
}

/// A session needs the URI, which the secure channel does not ask for.
fn uri_flaw(certificate: &Certificate) -> Option<CertificateFlaw> {
    match certificate.application_uri() {
        None => Some(CertificateFlaw::UriMissing { announced: None }),
        Some(uri) => super::checks::uri_flaw(certificate, &uri),
    }
}

/// Of a self-signed one; the issuer of any other may not be at hand.
fn signature_flaw(certificate: &Certificate, is_authority: bool) -> Option<CertificateFlaw> {
    let facts = certificate.facts();
    let names_own_key = certificate.authority_key_id().is_some_and(|id| Some(id) == certificate.subject_key_id());
    if facts.subject_folded != facts.issuer_folded {
        return None;
    }
    match certificate.signature_by(certificate) {
        Verdict::Right => None,
        // Another key of the same authority may have issued it.
        Verdict::Wrong if is_authority && !names_own_key => None,
        Verdict::Wrong => Some(CertificateFlaw::SelfSignatureWrong),
        Verdict::CannotSay(why) => Some(CertificateFlaw::SignatureUnverifiable { why }),
    }
}
