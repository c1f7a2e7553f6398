use std::collections::{BTreeMap, BTreeSet};

use super::CertificateRejection;
use crate::pki::certificate_fields::CertificatePolicies;
use crate::pki::{Certificate, CertificateFlaw};

const ANY_POLICY: &str = "2.5.29.32.0";

/// RFC 5280 §6.1.2 to §6.1.5, for certificate policies. OPC UA asks for no policy, so that the user-initial-policy-set is
/// anyPolicy and none of the initial indicators is set: a chain fails only where an authority in it asks for a policy.
///
/// The uppermost certificate is the trust anchor and not part of the path (RFC 5280 §6.1): what it says about policies
/// is not asked.
pub(super) fn check(chain: &[&Certificate]) -> Result<(), CertificateRejection> {
    let length = chain.len().saturating_sub(1);
    let mut state = PolicyState::new(length);
    for depth in (0..length).rev() {
        let certificate = chain[depth];
        let facts = certificate.facts();
        let policies = &facts.extensions.policies;
        let is_self_issued = facts.subject_folded == facts.issuer_folded;
        let is_last = depth == 0;
        let refused = |flaw| Err(CertificateRejection::new(flaw, certificate, depth));
        state.assert(policies, is_self_issued && !is_last);
        if !state.holds() {
            return refused(CertificateFlaw::PolicyMissing);
        }
        if is_last {
            state.wrap_up(policies);
            if !state.holds() {
                return refused(CertificateFlaw::PolicyMissing);
            }
        } else {
            if policies.mappings.iter().any(|(issuer, subject)| [issuer, subject].iter().any(|oid| *oid == ANY_POLICY))
            {
                return refused(CertificateFlaw::PolicyMappingOfAny);
            }
            state.map(policies);
            state.count_down(policies, is_self_issued);
        }
    }
    Ok(())
}

/// The state variables of RFC 5280 §6.1.2.
struct PolicyState {
    /// The lowest level of the valid policy tree: each policy that holds, with those a certificate may name for it. A
    /// policy that has several places in the tree has the same expected ones in all of them (RFC 9618), so that one place
    /// is enough. Empty is the tree that is null.
    valid: BTreeMap<String, BTreeSet<String>>,
    explicit: usize,
    inhibit_any: usize,
    mapping: usize,
}

impl PolicyState {
    fn new(length: usize) -> Self {
        let any = ANY_POLICY.to_owned();
        let valid = BTreeMap::from([(any.clone(), BTreeSet::from([any]))]);
        Self { valid, explicit: length + 1, inhibit_any: length + 1, mapping: length + 1 }
    }

    /// §6.1.3 (f), §6.1.5.
    fn holds(&self) -> bool {
        self.explicit > 0 || !self.valid.is_empty()
    }

    /// §6.1.3 (d), (e).
    fn assert(&mut self, policies: &CertificatePolicies, any_counts: bool) {
        let above = std::mem::take(&mut self.valid);
        let Some(asserted) = &policies.asserted else { return };
        let any_is_valid = above.contains_key(ANY_POLICY);
        let itself = |policy: &String| (policy.clone(), BTreeSet::from([policy.clone()]));
        let expected: BTreeSet<&String> = above.values().flatten().collect();
        let named = asserted.iter().filter(|policy| *policy != ANY_POLICY);
        self.valid = named.filter(|policy| any_is_valid || expected.contains(policy)).map(itself).collect();
        let names_any = asserted.iter().any(|policy| policy == ANY_POLICY);
        if names_any && (self.inhibit_any > 0 || any_counts) {
            for policy in expected {
                let (policy, expected) = itself(policy);
                self.valid.entry(policy).or_insert(expected);
            }
        }
    }

    /// §6.1.4 (b).
    fn map(&mut self, policies: &CertificatePolicies) {
        let mut mapped: BTreeMap<&String, BTreeSet<String>> = BTreeMap::new();
        for (issuer, subject) in &policies.mappings {
            mapped.entry(issuer).or_default().insert(subject.clone());
        }
        let any_is_valid = self.valid.contains_key(ANY_POLICY);
        for (issuer, subjects) in mapped {
            if self.mapping == 0 {
                self.valid.remove(issuer);
            } else if any_is_valid || self.valid.contains_key(issuer) {
                self.valid.insert(issuer.clone(), subjects);
            }
        }
    }

    /// §6.1.4 (h), (i), (j).
    fn count_down(&mut self, policies: &CertificatePolicies, is_self_issued: bool) {
        if !is_self_issued {
            for counter in [&mut self.explicit, &mut self.inhibit_any, &mut self.mapping] {
                *counter = counter.saturating_sub(1);
            }
        }
        for (counter, limit) in [
            (&mut self.explicit, policies.require_explicit),
            (&mut self.mapping, policies.inhibit_mapping),
            (&mut self.inhibit_any, policies.inhibit_any),
        ] {
            if let Some(limit) = limit {
                *counter = (*counter).min(limit as usize);
            }
        }
    }

    /// §6.1.5 (a), (b).
    fn wrap_up(&mut self, policies: &CertificatePolicies) {
        self.explicit = self.explicit.saturating_sub(1);
        if policies.require_explicit == Some(0) {
            self.explicit = 0;
        }
    }
}
