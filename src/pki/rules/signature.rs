use crate::pki::signature::SignatureCheck;
use crate::pki::{Certificate, CertificateFlaw};

/// The signature of a certificate that names itself as its issuer. `None` for any other: its issuer may not be at hand.
///
/// `is_authority`: an authority that changed its key may have signed the certificate with another key of its own
/// (self-issued, RFC 5280 §3.2), unless the certificate names its own key as the signer.
pub(in crate::pki) fn self_signature_flaw(certificate: &Certificate, is_authority: bool) -> Option<CertificateFlaw> {
    if !certificate.is_self_signed() {
        return None;
    }
    let names_own_key = certificate.authority_key_id().is_some_and(|id| Some(id) == certificate.subject_key_id());
    match certificate.signature_by(certificate) {
        SignatureCheck::Valid => None,
        SignatureCheck::Invalid if is_authority && !names_own_key => None,
        SignatureCheck::Invalid => Some(CertificateFlaw::SelfSignatureWrong),
        SignatureCheck::CannotVerify(because) => Some(CertificateFlaw::SignatureUnverifiable { because }),
    }
}
