use super::chain::{ChainSearch, SearchBudget};
use super::checks::{StepFailure, ValidationStep};
use super::{CertificateRejection, PresentedCertificate, TrustLists, TrustPolicy};
use crate::pki::crl::RevocationEntry;
use crate::pki::distribution_point::RevocationReasons;
use crate::pki::name::quoted;
use crate::pki::signature::{PublicKey, SignatureCheck};
use crate::pki::{Certificate, CertificateFlaw, Crl, CrlFlaw, rules};

/// How many other certificates of an issuer are tried as the signer of one list.
const MAX_SIGNERS: usize = 8;

/// What the revocation lists say of one certificate.
enum RevocationAnswer {
    NotRevoked,
    Revoked(RevocationEntry),
    /// No list is at hand that can be believed.
    Unknown(CrlFlaw),
}

/// Which keys of an authority may have signed its lists, besides the one that signed the certificate asked about.
pub(super) enum OtherKeys<'b> {
    /// Those of the same name whose own chain is good and ends in the same root (RFC 5280 §6.3.3 (f)).
    WithAGoodChain(&'b mut SearchBudget),
    /// Those of the chain itself. For the chain of such a signer, whose lists need no further chains.
    OfTheChain,
}

/// Steps 10 and 11 of OPC 10000-4 §6.1.3.
pub(super) struct RevocationCheck<'a, 'b> {
    pub lists: &'a TrustLists,
    pub presented: &'a PresentedCertificate<'a>,
    pub policy: &'a TrustPolicy,
    pub other_keys: OtherKeys<'b>,
}

impl RevocationCheck<'_, '_> {
    /// Of a chain that is good so far. A root is not asked about: no certificate stands above it.
    pub fn check(mut self, chain: &[&Certificate]) -> Result<(), StepFailure> {
        let mut unknown = None;
        for (depth, pair) in chain.windows(2).enumerate() {
            let (certificate, issuer) = (pair[0], pair[1]);
            match self.ask(chain, depth) {
                RevocationAnswer::NotRevoked => {}
                RevocationAnswer::Revoked(revoked) => {
                    let flaw = CertificateFlaw::Revoked { on: revoked.date, because: revoked.reason };
                    return Err((ValidationStep::Revocation, CertificateRejection::new(flaw, certificate, depth)));
                }
                RevocationAnswer::Unknown(crl) => {
                    let flaw = CertificateFlaw::RevocationUnknown { authority: quoted(issuer.subject()), crl };
                    unknown.get_or_insert((
                        ValidationStep::FindRevocationList,
                        CertificateRejection::new(flaw, certificate, depth),
                    ));
                }
            }
        }
        match unknown {
            Some(failure) if !self.policy.allow_unknown_revocation => Err(failure),
            _ => Ok(()),
        }
    }

    /// Asks the lists of the issuer about the certificate at that depth.
    fn ask(&mut self, chain: &[&Certificate], depth: usize) -> RevocationAnswer {
        let (certificate, issuer) = (chain[depth], chain[depth + 1]);
        let lists = self.lists;
        let mut flaw = CrlFlaw::Missing;
        // By the key that signed the lists.
        let mut covered: Vec<(PublicKey, RevocationReasons)> = Vec::new();
        for (index, crl) in lists.crls_of(issuer) {
            let key = match self.signer(index, crl, chain, depth) {
                Ok(signer) => signer.facts().public_key.clone(),
                Err(why) => {
                    flaw = flaw.or_nearer(why);
                    continue;
                }
            };
            // Newer lists stand first. What the newest one does not say any more is not so any more, as far as it
            // covers the certificate and one key signed both: some authorities keep one list for each key. What a list
            // says that cannot be used for a full check is true all the same.
            let newer =
                covered.iter().find(|(of, _)| *of == key).map_or(RevocationReasons::NONE, |(_, reasons)| *reasons);
            if let Some(revoked) = crl.revoked(certificate).filter(|revoked| !newer.contains(revoked.reason)) {
                return RevocationAnswer::Revoked(revoked);
            }
            match self.covers(crl, certificate) {
                Ok(reasons) => match covered.iter_mut().find(|(of, _)| *of == key) {
                    Some((_, before)) => *before = before.or(reasons),
                    None => covered.push((key, reasons)),
                },
                Err(why) => flaw = flaw.or_nearer(why),
            }
        }
        match covered.into_iter().fold(RevocationReasons::NONE, |all, (_, reasons)| all.or(reasons)) {
            RevocationReasons::ALL => RevocationAnswer::NotRevoked,
            RevocationReasons::NONE => RevocationAnswer::Unknown(flaw),
            _ => RevocationAnswer::Unknown(flaw.or_nearer(CrlFlaw::SomeReasons)),
        }
    }

    /// The certificate with the key that signed the list, if the list counts for the certificate at that depth.
    fn signer(
        &mut self,
        index: usize,
        crl: &Crl,
        chain: &[&Certificate],
        depth: usize,
    ) -> Result<Certificate, CrlFlaw> {
        let issuer = chain[depth + 1];
        let mut flaw = match self.is_signed_by(index, crl, issuer) {
            Ok(()) => return Ok(issuer.clone()),
            Err(flaw) => flaw,
        };
        let name = &issuer.facts().subject_folded;
        let above = chain[depth + 2..].iter().filter(|other| other.facts().subject_folded == *name);
        for other in above {
            match self.is_signed_by(index, crl, other) {
                Ok(()) => return Ok((*other).clone()),
                Err(why) => flaw = flaw.or_nearer(why),
            }
        }
        let lists = self.lists;
        match &mut self.other_keys {
            OtherKeys::OfTheChain => {
                // The list of a new key may say that the new key itself was not revoked, where that key is trusted by
                // itself.
                let signer = chain[depth];
                if signer.facts().subject_folded == *name && lists.trusts_key_of(signer) {
                    return self.is_signed_by(index, crl, signer).map(|()| signer.clone());
                }
            }
            OtherKeys::WithAGoodChain(_) => {
                let others = lists.with_subject(name).iter().filter(|other| *other != issuer && crl.is_of(other));
                for other in others.take(MAX_SIGNERS) {
                    match self.is_signed_by(index, crl, other).and_then(|()| self.has_a_good_chain(other, chain, depth))
                    {
                        Ok(()) => return Ok(other.clone()),
                        Err(why) => flaw = why.or_nearer(flaw),
                    }
                }
            }
        }
        Err(flaw)
    }

    /// Whether the signer's own chain is good and ends as that of the certificate at that depth.
    fn has_a_good_chain(&mut self, signer: &Certificate, chain: &[&Certificate], depth: usize) -> Result<(), CrlFlaw> {
        let OtherKeys::WithAGoodChain(budget) = &mut self.other_keys else { return Ok(()) };
        let Some(root) = chain.last() else { return Ok(()) };
        let above: Vec<Certificate> = chain[depth + 1..].iter().map(|member| (*member).clone()).collect();
        let presented = PresentedCertificate {
            certificate: signer,
            chain: &above,
            application_uri: None,
            host: None,
            ..*self.presented
        };
        match ChainSearch::for_a_signer_of_lists(self.lists, &presented, self.policy, root, budget).run() {
            Ok(_) => Ok(()),
            Err(rejection) => {
                Err(CrlFlaw::KeyNotAccepted { subject: quoted(&rejection.subject), because: Box::new(rejection.flaw) })
            }
        }
    }

    /// Whether the list is what the owner of that certificate says.
    fn is_signed_by(&self, index: usize, crl: &Crl, signer: &Certificate) -> Result<(), CrlFlaw> {
        if !crl.is_of(signer) {
            return Err(CrlFlaw::KeyNotHeld);
        }
        match self.lists.crl_signature(index, signer) {
            SignatureCheck::Valid if !rules::may_sign_lists(signer) => Err(CrlFlaw::MayNotSign),
            SignatureCheck::Valid => self.hash_is_strong(crl),
            SignatureCheck::Invalid => Err(CrlFlaw::NotSigned),
            SignatureCheck::CannotVerify(because) => Err(CrlFlaw::SignatureUnverifiable { because }),
        }
    }

    fn hash_is_strong(&self, crl: &Crl) -> Result<(), CrlFlaw> {
        let security_policy = self.presented.security_policy;
        match rules::signature_hash_flaw(crl.algorithm(), security_policy, self.policy.allow_sha1) {
            None => Ok(()),
            Some(CertificateFlaw::SignatureUnverifiable { because }) => Err(CrlFlaw::SignatureUnverifiable { because }),
            Some(_) => Err(CrlFlaw::WeakHash { algorithm: quoted(crl.signature_algorithm()) }),
        }
    }

    /// The reasons for which the list would name the certificate.
    fn covers(&self, crl: &Crl, certificate: &Certificate) -> Result<RevocationReasons, CrlFlaw> {
        if let Some(because) = crl.not_understood() {
            return Err(CrlFlaw::Unusable { because });
        }
        let reasons = crl.covers(certificate).map_err(|because| CrlFlaw::OutOfScope { because })?;
        match rules::crl_date_flaw(crl, self.presented.now) {
            Some(CrlFlaw::NoEnd | CrlFlaw::Expired { .. }) if self.policy.allow_expired_crls => Ok(reasons),
            Some(flaw) => Err(flaw),
            None => Ok(reasons),
        }
    }
}
