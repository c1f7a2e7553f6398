use std::collections::BTreeSet;

use chrono::{DateTime, Utc};

use super::report::CertificateVerdict;
use crate::model::SecurityPolicy;
use crate::pki::{Certificate, Expected, Presented, Rejection, Role, TrustLists, TrustPolicy, preflight};

/// What the certificate of a server is compared with.
pub(super) struct Wanted<'a> {
    /// What the management session says is selected: the one certificate that is trusted here.
    pub selected: Option<&'a Certificate>,
    /// As the server announces it.
    pub application_uri: &'a str,
    /// As the engineer wrote it.
    pub host: &'a str,
    /// Those offered.
    pub policies: &'a BTreeSet<SecurityPolicy>,
    /// This computer's clock.
    pub now: DateTime<Utc>,
    /// What the findings speak of.
    pub controllers_clock: DateTime<Utc>,
}

/// Judges what a server shows as a careful client does. Blocks for some signature checks.
///
/// The session with the controller vouches for the certificate itself, so neither its issuer nor a revocation list is
/// asked for.
pub(super) fn judge(shown: &Certificate, chain: &[Certificate], wanted: &Wanted<'_>) -> CertificateVerdict {
    let lists = TrustLists::new(wanted.selected.cloned().into_iter().collect(), Vec::new(), Vec::new());
    let vouched =
        TrustPolicy { allow_unknown_revocation: true, allow_incomplete_chain: true, ..TrustPolicy::default() };
    let check = |security_policy| -> Option<Rejection> {
        let presented = Presented {
            certificate: shown,
            chain,
            role: Role::Server,
            now: wanted.now,
            application_uri: Some(wanted.application_uri),
            host: Some(wanted.host),
            security_policy,
        };
        lists.validate(&presented, &vouched).err()
    };
    let mut secured = wanted.policies.iter().copied().filter(|policy| *policy != SecurityPolicy::None).peekable();
    let rejection = if secured.peek().is_some() { secured.find_map(|policy| check(Some(policy))) } else { check(None) };
    let hosts = [wanted.host.to_owned()];
    let expected = Expected {
        application_uri: wanted.application_uri,
        hosts: &hosts,
        policies: wanted.policies,
        now: wanted.controllers_clock,
    };
    CertificateVerdict {
        summary: shown.summary(),
        refused: rejection.map(|rejection| (rejection.status, rejection.reason)),
        // It was parsed before.
        findings: preflight(shown, &expected).unwrap_or_default(),
    }
}
