//! Who issued a certificate, as far as the issuers are at hand.

use super::Certificate;

/// The longest chain that is followed.
const MAX_CHAIN: usize = 20;

/// The certificates above one, from its own issuer upwards, as far as they are known. Said for a person to read: nothing
/// is decided about trust.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Issuers {
    /// The certificates above it, its own issuer first.
    pub chain: Vec<Certificate>,
    /// The last one issued itself: nothing is missing.
    pub complete: bool,
}

/// Follows the signatures upwards from a certificate. Names alone prove nothing: each signature is checked.
pub fn issuers_of(certificate: &Certificate, known: &[Certificate]) -> Issuers {
    let mut chain: Vec<Certificate> = Vec::new();
    let mut complete = is_signed_by(certificate, certificate);
    while !complete && chain.len() < MAX_CHAIN {
        let last = chain.last().unwrap_or(certificate);
        let next = known.iter().find(|other| *other != last && !chain.contains(other) && is_signed_by(last, other));
        let Some(issuer) = next.cloned() else { break };
        complete = is_signed_by(&issuer, &issuer);
        chain.push(issuer);
    }
    Issuers { chain, complete }
}

fn is_signed_by(certificate: &Certificate, issuer: &Certificate) -> bool {
    let (below, above) = (certificate.facts(), issuer.facts());
    below.issuer_folded == above.subject_folded && certificate.verify_signed_by(issuer)
}

#[cfg(test)]
mod tests {
    use rcgen::{BasicConstraints, CertificateParams, DnType, IsCa, Issuer, KeyPair};

    use super::*;
    use crate::pki::samples;

    fn params(name: &str, ca: bool) -> CertificateParams {
        let mut params = CertificateParams::default();
        params.distinguished_name.push(DnType::CommonName, name);
        params.is_ca = if ca { IsCa::Ca(BasicConstraints::Unconstrained) } else { IsCa::ExplicitNoCa };
        params
    }

    struct Plant {
        root: Certificate,
        middle: Certificate,
        leaf: Certificate,
        /// Named as the middle one, but not the one that signed.
        impostor: Certificate,
    }

    fn plant() -> Plant {
        let certificate = |made: rcgen::Certificate| Certificate::from_der(made.der()).unwrap();
        let [root_key, middle_key, leaf_key, other_key] = [(); 4].map(|()| KeyPair::generate().unwrap());
        let root = certificate(params("Root", true).self_signed(&root_key).unwrap());
        let root_issuer = Issuer::new(params("Root", true), root_key);
        let middle = certificate(params("Middle", true).signed_by(&middle_key, &root_issuer).unwrap());
        let impostor = certificate(params("Middle", true).signed_by(&other_key, &root_issuer).unwrap());
        let middle_issuer = Issuer::new(params("Middle", true), middle_key);
        let leaf = certificate(params("robot", false).signed_by(&leaf_key, &middle_issuer).unwrap());
        Plant { root, middle, leaf, impostor }
    }

    #[test]
    fn a_chain_is_followed_by_its_signatures_whatever_the_order() {
        let Plant { root, middle, leaf, impostor } = plant();
        let known = [root.clone(), impostor.clone(), leaf.clone(), middle.clone()];
        let issuers = issuers_of(&leaf, &known);
        assert_eq!(issuers, Issuers { chain: vec![middle.clone(), root], complete: true });
        assert_eq!(issuers_of(&leaf, &[impostor]), Issuers { chain: vec![], complete: false });
        assert_eq!(issuers_of(&leaf, std::slice::from_ref(&middle)), Issuers { chain: vec![middle], complete: false });
        assert_eq!(issuers_of(samples::certificate(), &[]), Issuers { chain: vec![], complete: true });
    }
}
