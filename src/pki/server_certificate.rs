//! Everything that OPC UA clients would say about the certificate of a server: before it is installed, and when the
//! server shows it.
//!
//! Both use the [`rules`](super::rules), and differ only in severity:
//!
//! | flaw | import | a server shows it |
//! |---|---|---|
//! | refused by OPC 10000-4 §6.1.3 | error | error |
//! | no key usage, or only nonRepudiation missing (step 9; a client may suppress it, and many do) | warning | warning |
//! | other host name (step 7) | warning: clients may use other names | error: this is the name that was used |
//! | valid from up to a day after now (step 6) | warning: clocks differ | error |
//! | a key length that the controller does not offer | error: the controller refuses it | warning |
//! | not a rule of §6.1.3: SHA-1 where every ticked policy takes it, CA:TRUE in a self-signed certificate, no extended key usage, … | warning | warning |
//!
//! So an import without a finding is never refused by a client that trusts the certificate, and what such a client refuses
//! is a finding of the import.

use std::collections::BTreeSet;

use chrono::{DateTime, Duration, Utc};

use super::{
    Certificate, CertificateFlaw, CertificateRejection, PeerRole, PkiError, PresentedCertificate, TrustLists,
    TrustPolicy, rules,
};
use crate::model::{CertificateStatus, SecurityPolicy};

/// What the certificate of a server is compared with.
#[derive(Debug, Clone, Copy)]
pub struct ExpectedServer<'a> {
    /// The ApplicationUri the server announces.
    pub application_uri: &'a str,
    /// The addresses and host names the server is reached by; one of them is enough.
    pub hosts: &'a [String],
    /// The security policies the server offers, or is to offer.
    pub policies: &'a BTreeSet<SecurityPolicy>,
    /// The clock that validity is compared with.
    pub now: DateTime<Utc>,
}

/// How severe a flaw is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Severity {
    /// Clients, or the controller, refuse the certificate.
    Error,
    /// Strict clients refuse it; others accept it, or ask their user.
    Warning,
}

/// One thing about a certificate that is not as OPC UA wants it (OPC 10000-4 §6.1.3, OPC 10000-6 §6.2.2).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CertificateFinding {
    /// What is wrong.
    pub flaw: CertificateFlaw,
    /// How severe that is in this place.
    pub severity: Severity,
}

impl CertificateFinding {
    /// The OPC UA status a client would give.
    pub const fn status(&self) -> CertificateStatus {
        self.flaw.status(false)
    }
}

/// How a client judges the certificate that a server shows.
#[derive(Debug, Clone, PartialEq)]
pub struct ServerCheck {
    /// Why the client refuses it (OPC 10000-4 §6.1.3); `None`: it accepts it.
    pub refused: Option<CertificateRejection>,
    /// Everything that clients may say about it, errors first.
    pub findings: Vec<CertificateFinding>,
}

/// Whether a controller takes the certificate: not expired, and with a key length that its ticked policies offer.
///
/// # Errors
/// [`PkiError::Expired`] or [`PkiError::KeyLengthNotAllowed`].
pub fn check_usable(
    certificate: &Certificate,
    policies: &BTreeSet<SecurityPolicy>,
    now: DateTime<Utc>,
) -> Result<(), PkiError> {
    if let Some(CertificateFlaw::Expired { until, .. }) = rules::validity_flaw(certificate, now) {
        return Err(PkiError::Expired(until));
    }
    match rules::key_length_not_ticked(certificate, policies) {
        Some(CertificateFlaw::KeyLengthNotTicked { bits }) => Err(PkiError::KeyLengthNotAllowed(bits)),
        _ => Ok(()),
    }
}

/// Everything that clients would say about a certificate that is to be installed in a server, errors first. The authority
/// that issued it is not asked about. Blocks for one signature check.
pub fn check_import(certificate: &Certificate, expected: &ExpectedServer<'_>) -> Vec<CertificateFinding> {
    findings(certificate, expected, JudgedFor::Import)
}

/// Judges the certificate that a server shows as a client does that trusts `selected` and nothing else: neither issuers
/// nor revocation lists are asked for. Blocks for some signature checks.
///
/// `controllers_clock` is the clock that the findings speak of; `expected.now`, the client's, decides about the refusal.
pub fn check_server(
    shown: &Certificate,
    selected: Option<&Certificate>,
    expected: &ExpectedServer<'_>,
    controllers_clock: DateTime<Utc>,
) -> ServerCheck {
    let findings = findings(shown, &ExpectedServer { now: controllers_clock, ..*expected }, JudgedFor::Server);
    let refused = if selected == Some(shown) {
        refusal(shown, expected)
    } else {
        Some(CertificateRejection::of(CertificateFlaw::Untrusted, shown))
    };
    ServerCheck { refused, findings }
}

/// Why a client that trusts this very certificate refuses it; under the first security policy that it is refused under.
fn refusal(certificate: &Certificate, expected: &ExpectedServer<'_>) -> Option<CertificateRejection> {
    let lists = TrustLists::new(vec![certificate.clone()], Vec::new(), Vec::new());
    let policies = secured(expected.policies);
    let policy = TrustPolicy {
        allow_unknown_revocation: true,
        allow_incomplete_chain: true,
        allow_partial_key_usage: true,
        allow_sha1: policies == [None],
        ..TrustPolicy::default()
    };
    let named = expected.hosts.iter().find(|host| certificate.names_host(host));
    let host = named.or(expected.hosts.first()).map(String::as_str);
    policies.into_iter().find_map(|security_policy| {
        let presented = PresentedCertificate {
            certificate,
            chain: &[],
            role: PeerRole::Server,
            now: expected.now,
            application_uri: Some(expected.application_uri),
            host,
            security_policy,
        };
        lists.validate(&presented, &policy).err()
    })
}

/// The policies under which a client looks at the certificate. Where there is only "None", which needs no certificate,
/// what the policies that are not deprecated require of keys; SHA-1 is then accepted.
fn secured(policies: &BTreeSet<SecurityPolicy>) -> Vec<Option<SecurityPolicy>> {
    let mut secured: Vec<_> =
        policies.iter().copied().filter(|policy| *policy != SecurityPolicy::None).map(Some).collect();
    if secured.is_empty() {
        secured.push(None);
    }
    secured
}

/// Where a certificate is judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum JudgedFor {
    /// It is to be installed in a controller.
    Import,
    /// A server shows it to a client.
    Server,
}

fn findings(certificate: &Certificate, expected: &ExpectedServer<'_>, place: JudgedFor) -> Vec<CertificateFinding> {
    let refused = refusing_flaws(certificate, expected).into_iter().map(|flaw| {
        let severity = severity(&flaw, place, expected.now);
        CertificateFinding { flaw, severity }
    });
    let mut findings: Vec<CertificateFinding> = refused.collect();
    for flaw in other_flaws(certificate, expected) {
        if !findings.iter().any(|finding| covers(&finding.flaw, &flaw)) {
            findings.push(CertificateFinding { flaw, severity: Severity::Warning });
        }
    }
    findings.sort_by_key(|finding| finding.severity);
    findings
}

/// What a strict client or the controller refuses the certificate for, without its chain.
fn refusing_flaws(certificate: &Certificate, expected: &ExpectedServer<'_>) -> Vec<CertificateFlaw> {
    let ExpectedServer { application_uri, hosts, policies, now } = *expected;
    let secured = secured(policies);
    let allow_sha1 = secured == [None];
    let signature = rules::self_signature_flaw(certificate, false);
    let is_verifiable = !matches!(signature, Some(CertificateFlaw::SignatureUnverifiable { .. }));
    let hash = secured.into_iter().find_map(|policy| rules::hash_flaw(certificate, policy, allow_sha1));
    let usage = rules::authority_flaw(certificate, !certificate.is_self_signed());
    [
        rules::structure_flaw(certificate),
        signature,
        rules::key_kind_flaw(certificate, false).or_else(|| rules::key_length_not_ticked(certificate, policies)),
        hash.filter(|_| is_verifiable),
        rules::validity_flaw(certificate, now),
        rules::host_flaw(certificate, hosts),
        rules::application_uri_flaw(certificate, Some(application_uri)),
        usage.or_else(|| rules::key_usage_flaw(certificate)),
        rules::role_flaw(certificate, PeerRole::Server),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// What OPC 10000-4 §6.1.3 does not refuse, but some clients mind.
fn other_flaws(certificate: &Certificate, expected: &ExpectedServer<'_>) -> Vec<CertificateFlaw> {
    let mut flaws: Vec<CertificateFlaw> = rules::rare_critical_extensions(certificate).collect();
    flaws.extend(rules::name_not_ascii(certificate));
    flaws.extend(rules::hash_flaw(certificate, None, false));
    flaws.extend(rules::claims_to_be_authority(certificate));
    flaws.extend(rules::extended_key_usage_missing(certificate));
    flaws.extend(rules::expires_soon(certificate, expected.now));
    flaws
}

/// Whether the second flaw need not be told beside the first.
fn covers(told: &CertificateFlaw, other: &CertificateFlaw) -> bool {
    use CertificateFlaw as F;
    told == other
        || matches!((told, other), (F::CertificateOfAuthority, F::ClaimsToBeAuthority))
        || matches!(
            (told, other),
            (F::SignatureUnverifiable { .. }, F::WeakHash { .. } | F::SignatureUnverifiable { .. })
        )
}

/// How severe a flaw is for which a strict client refuses the certificate.
fn severity(flaw: &CertificateFlaw, place: JudgedFor, now: DateTime<Utc>) -> Severity {
    let warns = match flaw {
        CertificateFlaw::KeyUsageMissing | CertificateFlaw::KeyUsageLacks { .. } => {
            TrustPolicy { allow_partial_key_usage: true, ..TrustPolicy::default() }.excuses_key_usage(flaw)
        }
        CertificateFlaw::HostName { .. } => place == JudgedFor::Import,
        CertificateFlaw::NotYetValid { from, .. } => place == JudgedFor::Import && *from - now <= CLOCK_TOLERANCE,
        CertificateFlaw::KeyLengthNotTicked { .. } => place == JudgedFor::Server,
        _ => false,
    };
    if warns { Severity::Warning } else { Severity::Error }
}

/// How far clocks and time zones may be apart.
const CLOCK_TOLERANCE: Duration = Duration::days(1);

#[cfg(test)]
mod tests;
