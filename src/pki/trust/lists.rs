use std::collections::{HashMap, HashSet};
use std::fmt;
use std::sync::Arc;

use chrono::{DateTime, Utc};
use parking_lot::Mutex;

use super::chain::{ChainSearch, SearchBudget};
use super::{CertificateRejection, PeerRole, PresentedCertificate, TrustPolicy};
use crate::pki::signature::SignatureCheck;
use crate::pki::{Certificate, Crl};

/// The trusted certificates, the issuers that complete their chains, and revocation lists; parsed and indexed
/// once, and cheap to share.
#[derive(Clone)]
pub struct TrustLists(Arc<Inner>);

struct Inner {
    trusted: Vec<Certificate>,
    issuers: Vec<Certificate>,
    crls: Vec<Crl>,
    /// By their SHA-256.
    trusted_ids: HashSet<[u8; 32]>,
    /// Trusted ones first, then issuers, by subject.
    by_subject: HashMap<Vec<u8>, Vec<Certificate>>,
    /// By issuer, the newest first.
    crls_by_issuer: HashMap<Vec<u8>, Vec<usize>>,
    /// Who signed which list. Reading millions of bytes for every client would be slow.
    crl_signatures: Mutex<HashMap<(usize, [u8; 32]), SignatureCheck>>,
}

impl TrustLists {
    /// Duplicates do no harm.
    pub fn new(trusted: Vec<Certificate>, issuers: Vec<Certificate>, crls: Vec<Crl>) -> Self {
        let trusted_ids = trusted.iter().map(Certificate::sha256).collect();
        let mut by_subject: HashMap<Vec<u8>, Vec<Certificate>> = HashMap::new();
        for certificate in trusted.iter().chain(&issuers) {
            let same_subject = by_subject.entry(certificate.facts().subject_folded.clone()).or_default();
            if !same_subject.contains(certificate) {
                same_subject.push(certificate.clone());
            }
        }
        let mut crls_by_issuer: HashMap<Vec<u8>, Vec<usize>> = HashMap::new();
        for (index, crl) in crls.iter().enumerate() {
            crls_by_issuer.entry(crl.issuer_folded().to_vec()).or_default().push(index);
        }
        for same_issuer in crls_by_issuer.values_mut() {
            same_issuer.sort_by(|one, other| crls[*other].age_key().cmp(&crls[*one].age_key()));
        }
        let crl_signatures = Mutex::default();
        Self(Arc::new(Inner { trusted, issuers, crls, trusted_ids, by_subject, crls_by_issuer, crl_signatures }))
    }

    /// Those that are trusted, as they were given.
    pub fn trusted(&self) -> &[Certificate] {
        &self.0.trusted
    }

    /// Those that complete chains, as they were given.
    pub fn issuers(&self) -> &[Certificate] {
        &self.0.issuers
    }

    /// The revocation lists, as they were given.
    pub fn crls(&self) -> &[Crl] {
        &self.0.crls
    }

    /// Whether this very certificate is in the trust list. What it issued is not asked.
    pub fn is_trusted(&self, certificate: &Certificate) -> bool {
        self.0.trusted_ids.contains(&certificate.sha256())
    }

    /// Checks a certificate by OPC 10000-4 §6.1.3 and gives its chain, from the certificate itself to the root; or the
    /// best reason not to trust it.
    ///
    /// Blocks for some signature checks, 64 at most; and the first time a revocation list is used, while it is read.
    pub fn validate(
        &self,
        presented: &PresentedCertificate<'_>,
        policy: &TrustPolicy,
    ) -> Result<Vec<Certificate>, CertificateRejection> {
        ChainSearch::new(self, presented, policy, &mut SearchBudget::default()).run()
    }

    /// Whether revocation lists that are signed with the key of `signer` count for what `authority` issued, which has
    /// another key. Asks about no dates of lists.
    pub(in crate::pki) fn signs_lists_for(
        &self,
        signer: &Certificate,
        authority: &Certificate,
        now: DateTime<Utc>,
    ) -> bool {
        let presented = |certificate, chain| PresentedCertificate {
            certificate,
            chain,
            role: PeerRole::Either,
            now,
            application_uri: None,
            host: None,
            security_policy: None,
        };
        let (policy, mut budget) = (TrustPolicy::default(), SearchBudget::default());
        let asked = presented(authority, &[]);
        let Ok(chain) = ChainSearch::for_an_authority(self, &asked, &policy, &mut budget).run() else { return false };
        let Some(root) = chain.last() else { return false };
        let asked = presented(signer, &chain);
        ChainSearch::for_a_signer_of_lists(self, &asked, &policy, root, &mut budget).run().is_ok()
    }

    /// Whether a trusted certificate has the same name and key.
    pub(super) fn trusts_key_of(&self, certificate: &Certificate) -> bool {
        let (name, key) = (&certificate.facts().subject_folded, &certificate.facts().public_key);
        self.with_subject(name).iter().any(|other| other.facts().public_key == *key && self.is_trusted(other))
    }

    /// Those that are held under this subject.
    pub(in crate::pki) fn with_subject(&self, folded: &[u8]) -> &[Certificate] {
        self.0.by_subject.get(folded).map(Vec::as_slice).unwrap_or_default()
    }

    /// The revocation lists of this issuer, the newest first.
    pub(in crate::pki) fn crls_of(&self, issuer: &Certificate) -> impl Iterator<Item = (usize, &Crl)> {
        let indices = self.0.crls_by_issuer.get(&issuer.facts().subject_folded);
        indices.into_iter().flatten().map(|index| (*index, &self.0.crls[*index]))
    }

    /// Whether the revocation list is signed with the key of that certificate.
    pub(in crate::pki) fn crl_signature(&self, index: usize, signer: &Certificate) -> SignatureCheck {
        let key = (index, signer.sha256());
        if let Some(known) = self.0.crl_signatures.lock().get(&key) {
            return known.clone();
        }
        let check = self.0.crls[index].signature_by(signer);
        let mut signatures = self.0.crl_signatures.lock();
        if signatures.len() >= MAX_REMEMBERED {
            signatures.clear();
        }
        signatures.insert(key, check.clone());
        check
    }
}

impl Default for TrustLists {
    fn default() -> Self {
        Self::new(Vec::new(), Vec::new(), Vec::new())
    }
}

impl fmt::Debug for TrustLists {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Inner { trusted, issuers, crls, .. } = &*self.0;
        f.debug_struct("TrustLists").field("trusted", trusted).field("issuers", issuers).field("crls", crls).finish()
    }
}

/// Signers of revocation lists; peers can send issuers of their own, so that there must be a limit.
const MAX_REMEMBERED: usize = 1000;
