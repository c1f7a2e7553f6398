use std::fmt;
use std::sync::Arc;

use chrono::{DateTime, Utc};
use opcua::crypto::SecurityPolicy as WirePolicy;
use opcua::types::StatusCode;
use parking_lot::RwLock;

use super::fault::Fault;
use super::frame::split_certificates;
use crate::model::{SecurityPolicy, clock};
use crate::pki::{Certificate, CertificateRejection, PeerRole, PresentedCertificate, TrustLists, TrustPolicy};

/// The clock certificates are checked by; this machine's by default.
#[derive(Clone)]
pub struct CertificateClock(Arc<dyn Fn() -> DateTime<Utc> + Send + Sync>);

impl CertificateClock {
    /// A clock that calls this function each time.
    pub fn new(clock: impl Fn() -> DateTime<Utc> + Send + Sync + 'static) -> Self {
        Self(Arc::new(clock))
    }

    fn now(&self) -> DateTime<Utc> {
        (self.0)()
    }
}

impl Default for CertificateClock {
    fn default() -> Self {
        Self::new(clock::now)
    }
}

impl fmt::Debug for CertificateClock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Clock")
    }
}

/// Says which certificates are let in, by the lists in force (OPC 10000-4 §6.1.3).
#[derive(Debug)]
pub(in super::super) struct ClientVerifier {
    lists: RwLock<TrustLists>,
    policy: TrustPolicy,
    clock: CertificateClock,
}

impl ClientVerifier {
    pub(in super::super) fn new(lists: TrustLists, policy: TrustPolicy, clock: CertificateClock) -> Self {
        Self { lists: RwLock::new(lists), policy, clock }
    }

    /// Puts other lists in force. Waits for admissions that are judged by the old ones.
    pub(super) fn replace(&self, lists: TrustLists) {
        *self.lists.write() = lists;
    }

    /// `chain` is what a client sent, leaf first. If it is in order, `then` runs before the lists can change.
    ///
    /// Blocks as [`TrustLists::validate`] does.
    pub(super) fn admit<T>(
        &self,
        chain: &[Certificate],
        policy: WirePolicy,
        then: impl FnOnce() -> T,
    ) -> Result<T, CertificateRejection> {
        let lists = self.lists.read();
        let Some((certificate, chain)) = chain.split_first() else {
            return Err(invalid("no certificate was sent"));
        };
        let presented = PresentedCertificate {
            certificate,
            chain,
            role: PeerRole::Client,
            now: self.clock.now(),
            // Not known before the session.
            application_uri: None,
            host: None,
            security_policy: model_policy(policy),
        };
        lists.validate(&presented, &self.policy)?;
        Ok(then())
    }
}

/// The certificates a client sent, leaf first.
pub(super) fn read_chain(sent: &[u8]) -> Result<Vec<Certificate>, CertificateRejection> {
    let ders = split_certificates(sent).ok_or_else(|| invalid("what was sent is not a chain of certificates"))?;
    ders.into_iter().map(|der| Certificate::from_der(der).map_err(|e| invalid(&e.to_string()))).collect()
}

/// A rejection that does not need the lists.
pub(super) fn invalid(reason: &str) -> CertificateRejection {
    CertificateRejection::unreadable(reason, "")
}

/// The error that the peer gets. It says only that the peer was refused, unless `detailed`: the reason would help an
/// attacker to find a usable certificate (OPC 10000-6 §6.7.6).
pub(super) fn fault(rejection: &CertificateRejection, detailed: bool) -> Fault {
    if detailed {
        Fault::new(StatusCode::from(rejection.status().code()), rejection.to_string())
    } else {
        Fault::new(StatusCode::BadSecurityChecksFailed, "the certificate is not accepted")
    }
}

/// `None` for no security and for what is not known here.
fn model_policy(policy: WirePolicy) -> Option<SecurityPolicy> {
    SecurityPolicy::ALL
        .into_iter()
        .filter(|p| *p != SecurityPolicy::None)
        .find(|p| super::super::endpoints::wire(*p) == policy)
}
