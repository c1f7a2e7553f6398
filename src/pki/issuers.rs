//! Who issued a certificate, as far as the issuers are at hand.

use x509_parser::prelude::{FromDer, X509Certificate};

use super::certificate::check_size;
use super::{Certificate, MAX_CERTIFICATE_FILE_BYTES, PkiError, pem};

/// The longest chain that is followed, and the most certificates that are read from one file.
pub const MAX_CHAIN: usize = 20;

/// The certificates above one, from its own issuer upwards, as far as they are known. Said for a person to read: nothing
/// is decided about trust.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Issuers {
    pub chain: Vec<Certificate>,
    /// The last one issued itself: nothing is missing.
    pub complete: bool,
}

/// The certificates of a file of at most [`MAX_CERTIFICATE_FILE_BYTES`], in its order: one in DER, or some in PEM. A file
/// with a private key in it is refused.
pub fn read_certificates(bytes: &[u8]) -> Result<Vec<Certificate>, PkiError> {
    check_size(bytes, MAX_CERTIFICATE_FILE_BYTES)?;
    if !pem::is_pem(bytes) {
        return Ok(vec![Certificate::from_any(bytes)?]);
    }
    let found = pem::certificates(bytes)?;
    match found.len() {
        0 => Err(PkiError::NoCertificate),
        1..=MAX_CHAIN => found.iter().map(|der| Certificate::from_der(der)).collect(),
        many => Err(PkiError::SeveralCertificates(many)),
    }
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
    let (Ok((_, below)), Ok((_, above))) =
        (X509Certificate::from_der(certificate.der()), X509Certificate::from_der(issuer.der()))
    else {
        return false;
    };
    below.issuer().as_raw() == above.subject().as_raw() && below.verify_signature(Some(above.public_key())).is_ok()
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

    #[test]
    fn some_certificates_of_one_file_are_read_in_order() {
        let Plant { root, middle, leaf, .. } = plant();
        let text = format!("{}\n{}subject=CN = Root\n{}", leaf.to_pem(), middle.to_pem(), root.to_pem());
        assert_eq!(read_certificates(text.as_bytes()), Ok(vec![leaf.clone(), middle, root]));
        assert_eq!(read_certificates(leaf.der()), Ok(vec![leaf.clone()]));
        let many = leaf.to_pem().repeat(MAX_CHAIN + 1);
        assert_eq!(read_certificates(many.as_bytes()), Err(PkiError::SeveralCertificates(MAX_CHAIN + 1)));
        let with_key = leaf.to_pem() + "-----BEGIN PRIVATE KEY-----\nMA==\n-----END PRIVATE KEY-----\n";
        assert_eq!(read_certificates(with_key.as_bytes()), Err(PkiError::PrivateKeyInside));
    }
}
