use super::CertificateRejection;
use crate::pki::general_name::{GeneralName, NotAllowed};
use crate::pki::name::quoted;
use crate::pki::{Certificate, CertificateFlaw};

/// The most comparisons of names with constraints for one certificate and one authority.
const MAX_COMPARISONS: usize = 1 << 20;

/// RFC 5280 §6.1.3 (b), (c) and §6.1.4 (g): every name of every certificate, by the constraints of every authority
/// above it. Those of a self-signed root count like any others: RFC 5280 §6.2 leaves that open, and they were written
/// to hold.
pub(super) fn check(chain: &[&Certificate]) -> Result<(), CertificateRejection> {
    for (depth, certificate) in chain.iter().enumerate() {
        let facts = certificate.facts();
        // An authority that issued itself a new certificate, unless it stands at the end of the path.
        if depth > 0 && facts.subject_folded == facts.issuer_folded {
            continue;
        }
        let subject = GeneralName::Directory { folded: facts.subject_folded.clone(), text: facts.subject.clone() };
        let subject = (!facts.subject_folded.is_empty()).then_some(&subject);
        let names: Vec<&GeneralName> =
            subject.into_iter().chain(&facts.subject_emails).chain(&facts.extensions.names).collect();
        for authority in &chain[depth + 1..] {
            let Some(constraints) = &authority.facts().extensions.name_constraints else { continue };
            let by = quoted(authority.subject());
            let refused = |flaw| Err(CertificateRejection::new(flaw, certificate, depth));
            if names.len() * constraints.len() > MAX_COMPARISONS {
                return refused(CertificateFlaw::TooManyNames { authority: by });
            }
            for name in &names {
                let text = || quoted(&name.text());
                match constraints.allow(name) {
                    Ok(()) => {}
                    Err(NotAllowed::NotPermitted) => {
                        return refused(CertificateFlaw::NameNotPermitted { name: text(), authority: by });
                    }
                    Err(NotAllowed::CannotSay) => {
                        return refused(CertificateFlaw::NameConstraintUnsupported { name: text(), authority: by });
                    }
                }
            }
        }
    }
    Ok(())
}
