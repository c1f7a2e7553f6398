use std::collections::HashMap;

use super::checks::{self, Step};
use super::{Presented, Rejection, TrustLists, TrustPolicy, revocation};
use crate::model::CertificateStatus;
use crate::pki::Certificate;
use crate::pki::signature::Verdict;

/// How many certificates a chain may have, from the application's to the root.
const MAX_CHAIN: usize = 10;
/// How many signatures are checked for one peer, whatever it sends.
const MAX_SIGNATURES: usize = 64;
/// How many steps up a chain are made for one peer: CAs that certified one another make more chains than certificates.
const MAX_STEPS: usize = 256;

/// The search for a chain without a flaw: depth first, and bounded.
pub(super) struct Search<'a> {
    lists: &'a TrustLists,
    presented: &'a Presented<'a>,
    policy: &'a TrustPolicy,
    /// Who signed what, by SHA-256 of both.
    signatures: HashMap<([u8; 32], [u8; 32]), Verdict>,
    steps: usize,
    exhausted: bool,
    best: Option<(Step, Rejection)>,
}

impl<'a> Search<'a> {
    pub fn new(lists: &'a TrustLists, presented: &'a Presented<'a>, policy: &'a TrustPolicy) -> Self {
        Self { lists, presented, policy, signatures: HashMap::new(), steps: 0, exhausted: false, best: None }
    }

    pub fn run(mut self) -> Result<Vec<Certificate>, Rejection> {
        let leaf = self.presented.certificate;
        checks::structure(leaf, 0)?;
        let mut chain = vec![leaf];
        if self.extend(&mut chain) {
            return Ok(chain.into_iter().cloned().collect());
        }
        let nothing = || Rejection::new(CertificateStatus::ChainIncomplete, leaf, 0, "no chain of issuers was found");
        Err(self.best.map_or_else(nothing, |(_, rejection)| rejection))
    }

    /// Whether the chain is good, or can be made so; it then is.
    fn extend(&mut self, chain: &mut Vec<&'a Certificate>) -> bool {
        let Some(&last) = chain.last() else { return false };
        self.steps += 1;
        if self.steps > MAX_STEPS {
            self.exhausted = true;
            return false;
        }
        let depth = chain.len() - 1;
        let itself = if self.names_equal(last) { Some(self.signature(last, last)) } else { None };
        if itself == Some(Verdict::Right) {
            return self.check(chain);
        }
        if chain.len() == MAX_CHAIN {
            self.fail(Step::Chain, last, depth, format!("the chain has more than {MAX_CHAIN} certificates"));
            return false;
        }
        let mut has_issuer = false;
        for issuer in self.issuers(last) {
            if chain.contains(&issuer) {
                continue;
            }
            match self.signature(last, issuer) {
                Verdict::Right => {
                    has_issuer = true;
                    if let Err(rejection) = checks::structure(issuer, depth + 1) {
                        self.note(Step::Structure, rejection);
                        continue;
                    }
                    chain.push(issuer);
                    if self.extend(chain) {
                        return true;
                    }
                    chain.pop();
                }
                Verdict::Wrong => {
                    let why = format!("its signature is not that of its issuer, {}", issuer.subject());
                    self.fail(Step::Signature, last, depth, why);
                }
                Verdict::CannotSay(why) => self.fail(Step::Policy, last, depth, why),
            }
        }
        match itself {
            _ if has_issuer => {}
            Some(Verdict::CannotSay(why)) => self.fail(Step::Policy, last, depth, why),
            Some(_) => self.fail(Step::Signature, last, depth, "it is not signed with its own key".to_owned()),
            None if self.policy.allow_incomplete_chain && self.lists.is_trusted(last) => return self.check(chain),
            None => self.fail(Step::Chain, last, depth, format!("its issuer, {}, is missing", last.issuer())),
        }
        false
    }

    /// Whether the chain, which is complete, has no flaw.
    fn check(&mut self, chain: &[&'a Certificate]) -> bool {
        let checked = checks::chain(chain, self.lists, self.presented, self.policy)
            .and_then(|()| revocation::check(chain, self.lists, self.presented, self.policy));
        match checked {
            Ok(()) => true,
            Err((step, rejection)) => {
                self.note(step, rejection);
                false
            }
        }
    }

    /// Whoever may have issued it, by name and key identifier: trusted ones first, what was sent last.
    fn issuers(&self, certificate: &Certificate) -> Vec<&'a Certificate> {
        let facts = certificate.facts();
        let sent = self.presented.chain.iter().filter(|sent| sent.facts().subject_folded == facts.issuer_folded);
        let mut issuers: Vec<&'a Certificate> = Vec::new();
        for issuer in self.lists.with_subject(&facts.issuer_folded).iter().chain(sent) {
            let keys_fit = match (certificate.authority_key_id(), issuer.subject_key_id()) {
                (Some(wanted), Some(has)) => wanted == has,
                _ => true,
            };
            if keys_fit && !issuers.contains(&issuer) {
                issuers.push(issuer);
            }
        }
        issuers
    }

    fn names_equal(&self, certificate: &Certificate) -> bool {
        certificate.facts().subject_folded == certificate.facts().issuer_folded
    }

    fn signature(&mut self, certificate: &Certificate, issuer: &Certificate) -> Verdict {
        let key = (certificate.sha256(), issuer.sha256());
        if let Some(known) = self.signatures.get(&key) {
            return known.clone();
        }
        if self.signatures.len() >= MAX_SIGNATURES {
            self.exhausted = true;
            return Verdict::CannotSay("there are too many possible issuers to check them all".to_owned());
        }
        let verdict = certificate.signature_by(issuer);
        self.signatures.insert(key, verdict.clone());
        verdict
    }

    fn fail(&mut self, step: Step, certificate: &Certificate, depth: usize, reason: String) {
        let status = match step {
            Step::Chain => CertificateStatus::ChainIncomplete,
            Step::Policy => CertificateStatus::PolicyCheckFailed,
            _ => CertificateStatus::CertificateInvalid,
        };
        // Out of budget, nothing is known about the signature; the chain was not found, that is all.
        let (step, status) =
            if self.exhausted { (Step::Chain, CertificateStatus::ChainIncomplete) } else { (step, status) };
        self.note(step, Rejection::new(status, certificate, depth, reason));
    }

    fn note(&mut self, step: Step, rejection: Rejection) {
        if self.best.as_ref().is_none_or(|(furthest, _)| step > *furthest) {
            self.best = Some((step, rejection));
        }
    }
}
