use std::collections::HashMap;

use super::checks::{self, StepFailure, ValidationStep};
use super::revocation::{OtherKeys, RevocationCheck};
use super::{CertificateRejection, PresentedCertificate, TrustLists, TrustPolicy};
use crate::pki::name::quoted;
use crate::pki::signature::SignatureCheck;
use crate::pki::{Certificate, CertificateFlaw, UnverifiableSignature};

/// How many certificates a chain may have, from the application's to the root.
const MAX_CHAIN: usize = 10;
/// The most signatures that are checked for one peer.
const MAX_SIGNATURES: usize = 64;
/// How many steps up a chain are made for one peer: CAs that certified one another make more chains than certificates.
const MAX_STEPS: usize = 256;

/// What may still be done for one peer, and what was found out so far.
#[derive(Debug, Default)]
pub(super) struct SearchBudget {
    /// Who signed what, by SHA-256 of both.
    signatures: HashMap<([u8; 32], [u8; 32]), SignatureCheck>,
    steps: usize,
    exhausted: bool,
}

/// What the chain is for.
#[derive(Clone, Copy)]
enum ChainPurpose<'a> {
    /// An application connects.
    Application,
    /// An authority, about which nothing but its chain is asked.
    Authority,
    /// The certificate's key signs the revocation lists of an authority whose chain ends in this root.
    SignsLists { root: &'a Certificate },
}

/// The search for a chain without a flaw: depth first, and bounded.
pub(super) struct ChainSearch<'a, 'b> {
    lists: &'a TrustLists,
    presented: &'a PresentedCertificate<'a>,
    policy: &'a TrustPolicy,
    purpose: ChainPurpose<'a>,
    budget: &'b mut SearchBudget,
    best: Option<(ValidationStep, CertificateRejection)>,
}

impl<'a, 'b> ChainSearch<'a, 'b> {
    /// For the certificate of an application.
    pub fn new(
        lists: &'a TrustLists,
        presented: &'a PresentedCertificate<'a>,
        policy: &'a TrustPolicy,
        budget: &'b mut SearchBudget,
    ) -> Self {
        Self { lists, presented, policy, purpose: ChainPurpose::Application, budget, best: None }
    }

    /// For an authority; its revocation is not asked about.
    pub fn for_an_authority(
        lists: &'a TrustLists,
        presented: &'a PresentedCertificate<'a>,
        policy: &'a TrustPolicy,
        budget: &'b mut SearchBudget,
    ) -> Self {
        Self { purpose: ChainPurpose::Authority, ..Self::new(lists, presented, policy, budget) }
    }

    /// For the certificate whose key signed revocation lists of an authority whose chain ends in `root`.
    pub fn for_a_signer_of_lists(
        lists: &'a TrustLists,
        presented: &'a PresentedCertificate<'a>,
        policy: &'a TrustPolicy,
        root: &'a Certificate,
        budget: &'b mut SearchBudget,
    ) -> Self {
        Self { purpose: ChainPurpose::SignsLists { root }, ..Self::new(lists, presented, policy, budget) }
    }

    pub fn run(mut self) -> Result<Vec<Certificate>, CertificateRejection> {
        let leaf = self.presented.certificate;
        checks::structure(leaf, 0)?;
        let mut chain = vec![leaf];
        if self.extend(&mut chain) {
            return Ok(chain.into_iter().cloned().collect());
        }
        let nothing = || CertificateRejection::new(CertificateFlaw::TooManyIssuers, leaf, 0);
        Err(self.best.map_or_else(nothing, |(_, rejection)| rejection))
    }

    /// Whether the chain is good, or can be made so; it then is.
    fn extend(&mut self, chain: &mut Vec<&'a Certificate>) -> bool {
        let Some(&last) = chain.last() else { return false };
        self.budget.steps += 1;
        if self.budget.steps > MAX_STEPS {
            self.budget.exhausted = true;
            return false;
        }
        let depth = chain.len() - 1;
        let itself = if self.names_equal(last) { Some(self.signature(last, last)) } else { None };
        if itself == Some(SignatureCheck::Valid) {
            return self.check(chain);
        }
        if chain.len() == MAX_CHAIN {
            self.fail(ValidationStep::Chain, last, depth, CertificateFlaw::ChainTooLong { most: MAX_CHAIN });
            return false;
        }
        let mut has_issuer = false;
        for issuer in self.issuers(last) {
            if chain.contains(&issuer) {
                continue;
            }
            match self.signature(last, issuer) {
                SignatureCheck::Valid => {
                    has_issuer = true;
                    if let Err(rejection) = checks::structure(issuer, depth + 1) {
                        self.note(ValidationStep::Structure, rejection);
                        continue;
                    }
                    chain.push(issuer);
                    if self.extend(chain) {
                        return true;
                    }
                    chain.pop();
                }
                SignatureCheck::Invalid => {
                    let issuer = quoted(issuer.subject());
                    self.fail(ValidationStep::Signature, last, depth, CertificateFlaw::SignatureWrong { issuer });
                }
                SignatureCheck::CannotVerify(because) => {
                    self.fail(ValidationStep::Policy, last, depth, CertificateFlaw::SignatureUnverifiable { because });
                }
            }
        }
        match itself {
            _ if has_issuer => {}
            Some(SignatureCheck::CannotVerify(because)) => {
                self.fail(ValidationStep::Policy, last, depth, CertificateFlaw::SignatureUnverifiable { because });
            }
            Some(_) => self.fail(ValidationStep::Signature, last, depth, CertificateFlaw::SelfSignatureWrong),
            None if self.policy.allow_incomplete_chain && self.lists.is_trusted(last) => return self.check(chain),
            None => {
                let flaw = self.why_no_issuer(last);
                self.fail(ValidationStep::Chain, last, depth, flaw);
            }
        }
        false
    }

    /// Why none of the certificates with the name of the issuer was tried, if there are any.
    fn why_no_issuer(&mut self, certificate: &'a Certificate) -> CertificateFlaw {
        let issuer = quoted(certificate.issuer());
        let wanted = certificate.authority_key_id().map(hex::encode_upper).unwrap_or_default();
        let mut flaw = CertificateFlaw::IssuerMissing { issuer: issuer.clone() };
        for namesake in self.named(certificate) {
            // Half of the signatures that may be checked are left for chains.
            let is_affordable = self.budget.signatures.len() < MAX_SIGNATURES / 2;
            if is_affordable && self.signature(certificate, namesake) == SignatureCheck::Valid {
                return CertificateFlaw::IssuerKeyIdentifier { issuer, wanted: quoted(&wanted) };
            }
            flaw = CertificateFlaw::IssuerKey { issuer: issuer.clone() };
        }
        flaw
    }

    /// Whether the chain, which is complete, has no flaw.
    fn check(&mut self, chain: &[&'a Certificate]) -> bool {
        let checked = match self.purpose {
            ChainPurpose::Application => checks::chain(chain, self.lists, self.presented, self.policy),
            ChainPurpose::SignsLists { root } if chain.last() != Some(&root) => {
                let flaw = CertificateFlaw::IssuerMissing { issuer: quoted(root.subject()) };
                Err((ValidationStep::Chain, CertificateRejection::new(flaw, self.presented.certificate, 0)))
            }
            ChainPurpose::Authority | ChainPurpose::SignsLists { .. } => {
                checks::authority(chain, self.lists, self.presented, self.policy)
            }
        };
        match checked.and_then(|()| self.revocation(chain)) {
            Ok(()) => true,
            Err((step, rejection)) => {
                self.note(step, rejection);
                false
            }
        }
    }

    fn revocation(&mut self, chain: &[&'a Certificate]) -> Result<(), StepFailure> {
        let other_keys = match self.purpose {
            ChainPurpose::Authority => return Ok(()),
            ChainPurpose::Application => OtherKeys::WithAGoodChain(&mut *self.budget),
            ChainPurpose::SignsLists { .. } => OtherKeys::OfTheChain,
        };
        let (lists, presented, policy) = (self.lists, self.presented, self.policy);
        RevocationCheck { lists, presented, policy, other_keys }.check(chain)
    }

    /// The certificates that may have issued this one, by name and key identifier: trusted ones first, those that the peer
    /// sent last.
    fn issuers(&self, certificate: &Certificate) -> Vec<&'a Certificate> {
        let keys_fit = |issuer: &&Certificate| match (certificate.authority_key_id(), issuer.subject_key_id()) {
            (Some(wanted), Some(has)) => wanted == has,
            _ => true,
        };
        self.named(certificate).into_iter().filter(keys_fit).collect()
    }

    /// Every certificate with the name of its issuer, each once: trusted ones first, what was sent last.
    fn named(&self, certificate: &Certificate) -> Vec<&'a Certificate> {
        let issuer = &certificate.facts().issuer_folded;
        let sent = self.presented.chain.iter().filter(|sent| sent.facts().subject_folded == *issuer);
        let mut named: Vec<&'a Certificate> = Vec::new();
        for one in self.lists.with_subject(issuer).iter().chain(sent) {
            if !named.contains(&one) {
                named.push(one);
            }
        }
        named
    }

    fn names_equal(&self, certificate: &Certificate) -> bool {
        certificate.facts().subject_folded == certificate.facts().issuer_folded
    }

    fn signature(&mut self, certificate: &Certificate, issuer: &Certificate) -> SignatureCheck {
        let key = (certificate.sha256(), issuer.sha256());
        if let Some(known) = self.budget.signatures.get(&key) {
            return known.clone();
        }
        if self.budget.signatures.len() >= MAX_SIGNATURES {
            self.budget.exhausted = true;
            return SignatureCheck::CannotVerify(UnverifiableSignature::TooManyIssuers);
        }
        let check = certificate.signature_by(issuer);
        self.budget.signatures.insert(key, check.clone());
        check
    }

    fn fail(&mut self, step: ValidationStep, certificate: &Certificate, depth: usize, flaw: CertificateFlaw) {
        // Out of budget, nothing is known about the signature; the chain was not found, that is all.
        let (step, flaw) =
            if self.budget.exhausted { (ValidationStep::Chain, CertificateFlaw::TooManyIssuers) } else { (step, flaw) };
        self.note(step, CertificateRejection::new(flaw, certificate, depth));
    }

    fn note(&mut self, step: ValidationStep, rejection: CertificateRejection) {
        if self.best.as_ref().is_none_or(|(furthest, _)| step > *furthest) {
            self.best = Some((step, rejection));
        }
    }
}
