//! Which certificate of a file signed what else is in it.

use std::collections::HashMap;

use super::{Certificate, Crl, PkiError};

/// The certificates of one file, by subject. Checks a bounded number of signatures.
pub(super) struct Signers<'a> {
    by_subject: HashMap<&'a [u8], Vec<&'a Certificate>>,
    checked: usize,
}

/// How a certificate was signed.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct SignedBy<'a> {
    /// Its own key signed it.
    pub by_itself: bool,
    /// Another certificate with the key that signed it.
    pub by: Option<&'a Certificate>,
}

impl<'a> Signers<'a> {
    pub fn new(certificates: impl IntoIterator<Item = &'a Certificate>) -> Self {
        let mut by_subject: HashMap<&'a [u8], Vec<&'a Certificate>> = HashMap::new();
        for certificate in certificates {
            by_subject.entry(&certificate.facts().subject_folded).or_default().push(certificate);
        }
        Self { by_subject, checked: 0 }
    }

    /// [`PkiError::TooManySigners`] once too many had to be tried.
    pub fn of_certificate(&mut self, certificate: &Certificate) -> Result<SignedBy<'a>, PkiError> {
        let facts = certificate.facts();
        let by_itself =
            facts.subject_folded == facts.issuer_folded && self.check(|| certificate.verify_signed_by(certificate))?;
        let candidates = self.named(&facts.issuer_folded);
        let others = candidates.into_iter().filter(|other| *other != certificate);
        if by_itself {
            // The signature fits no other key: hundreds of applications that all have the same name cost nothing.
            let by = others.into_iter().find(|other| other.facts().public_key == facts.public_key);
            return Ok(SignedBy { by_itself, by });
        }
        let key_id = certificate.authority_key_id();
        Ok(SignedBy { by_itself, by: self.first(others, key_id, |other| certificate.verify_signed_by(other))? })
    }

    /// [`PkiError::TooManySigners`] once too many had to be tried.
    pub fn of_crl(&mut self, crl: &Crl) -> Result<Option<&'a Certificate>, PkiError> {
        let candidates = self.named(crl.issuer_folded());
        self.first(candidates, crl.authority_key_id(), |one| crl.verify_signed_by(one))
    }

    fn named(&self, subject: &[u8]) -> Vec<&'a Certificate> {
        self.by_subject.get(subject).cloned().unwrap_or_default()
    }

    /// Those with the key identifier that is asked for are tried first: it is a hint that need not be followed.
    fn first(
        &mut self,
        candidates: impl IntoIterator<Item = &'a Certificate>,
        key_id: Option<&[u8]>,
        signed_by: impl Fn(&Certificate) -> bool,
    ) -> Result<Option<&'a Certificate>, PkiError> {
        let fits = |one: &&Certificate| key_id.is_some() && one.subject_key_id() == key_id;
        let (likely, others): (Vec<_>, Vec<_>) = candidates.into_iter().partition(fits);
        for candidate in likely.into_iter().chain(others) {
            if self.check(|| signed_by(candidate))? {
                return Ok(Some(candidate));
            }
        }
        Ok(None)
    }

    fn check(&mut self, signature_is_right: impl FnOnce() -> bool) -> Result<bool, PkiError> {
        if self.checked == MAX_CHECKED {
            return Err(PkiError::TooManySigners);
        }
        self.checked += 1;
        Ok(signature_is_right())
    }
}

/// Twice as many as a file has things: one for its own key, one for its signer.
const MAX_CHECKED: usize = 2000;

#[cfg(test)]
mod tests {
    use rcgen::{CertificateParams, DnType, KeyPair};

    use super::*;

    fn params() -> CertificateParams {
        let mut params = CertificateParams::default();
        params.distinguished_name.push(DnType::CommonName, "OPC UA Server");
        params
    }

    fn certificate(made: &rcgen::Certificate) -> Certificate {
        Certificate::from_der(made.der()).unwrap()
    }

    #[test]
    fn a_self_signed_certificate_is_signed_by_another_with_the_same_name_only_if_the_key_is_the_same() {
        let [one, two] = [(); 2].map(|()| KeyPair::generate().unwrap());
        let old = certificate(&params().self_signed(&one).unwrap());
        let mut renewed = params();
        renewed.serial_number = Some(rcgen::SerialNumber::from(77_u64));
        let renewed = certificate(&renewed.self_signed(&one).unwrap());
        let other = certificate(&params().self_signed(&two).unwrap());
        let mut signers = Signers::new([&other, &old, &renewed]);
        assert_eq!(signers.of_certificate(&old), Ok(SignedBy { by_itself: true, by: Some(&renewed) }));
        assert_eq!(signers.of_certificate(&other), Ok(SignedBy { by_itself: true, by: None }));
    }

    #[test]
    fn a_file_of_namesakes_is_not_worked_on_for_hours() {
        let key = KeyPair::generate().unwrap();
        let unknown = rcgen::Issuer::new(params(), KeyPair::generate().unwrap());
        let namesakes: Vec<Certificate> =
            (0..50).map(|_| certificate(&params().signed_by(&key, &unknown).unwrap())).collect();
        let mut signers = Signers::new(&namesakes);
        let done = namesakes.iter().take_while(|one| signers.of_certificate(one).is_ok()).count();
        assert_eq!(done, 40, "each asks itself and 49 others");
        assert_eq!(signers.checked, MAX_CHECKED);
        assert_eq!(signers.of_certificate(&namesakes[0]), Err(PkiError::TooManySigners));
    }
}
