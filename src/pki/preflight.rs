//! What OPC UA clients would say about a server certificate, found out before it is installed.

use std::collections::BTreeSet;

use chrono::{DateTime, Duration, Utc};

use super::flaw::quoted;
use super::signature::{Hash, PublicKey, Verdict};
use super::trust::checks;
use super::{AlternativeName, Certificate, CertificateFlaw, KeyUsage, PkiError, Role};
use crate::model::{SecurityPolicy, offered_key_lengths};

/// What a certificate is to be compared with.
#[derive(Debug, Clone, Copy)]
pub struct Expected<'a> {
    /// The ApplicationUri the server announces.
    pub application_uri: &'a str,
    /// The addresses and host names the server is reached by; one of them is enough.
    pub hosts: &'a [String],
    /// Those that are ticked.
    pub policies: &'a BTreeSet<SecurityPolicy>,
    /// The controller's clock.
    pub now: DateTime<Utc>,
}

/// Whether a certificate may be installed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Severity {
    /// Clients refuse it.
    Error,
    /// Strict clients refuse it; others accept it, or ask their user.
    Warning,
}

/// One thing about a certificate that is not as OPC UA wants it (OPC 10000-4 §6.1.3, OPC 10000-6 §6.2.2).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    pub flaw: CertificateFlaw,
    pub severity: Severity,
}

impl Finding {
    /// The OPC UA status a client would give.
    pub const fn status(&self) -> &'static str {
        self.flaw.status(false).as_str()
    }
}

/// Whether a certificate can be used at all: not expired, and with a key that every ticked policy allows. The rules a
/// controller enforces itself.
pub fn check_usable(
    certificate: &Certificate,
    policies: &BTreeSet<SecurityPolicy>,
    now: DateTime<Utc>,
) -> Result<(), PkiError> {
    if certificate.not_after() < now {
        return Err(PkiError::Expired(certificate.not_after()));
    }
    if !length_fits(certificate.key_bits(), policies) {
        return Err(PkiError::KeyLengthNotAllowed(certificate.key_bits()));
    }
    Ok(())
}

/// Looks at everything a client looks at by itself, with the checks of [`TrustLists`](super::TrustLists): errors first.
/// The CA that signed it is not asked about.
pub fn preflight(certificate: &Certificate, expected: &Expected<'_>) -> Vec<Finding> {
    let mut findings = Findings(Vec::new());
    findings.add(Severity::Error, checks::structure_flaw(certificate));
    findings.add(Severity::Error, checks::uri_flaw(certificate, expected.application_uri));
    findings.add(Severity::Warning, checks::host_flaw(certificate, expected.hosts));
    names(certificate, &mut findings);
    usage(certificate, &mut findings);
    strength(certificate, expected.policies, &mut findings);
    dates(certificate, expected.now, &mut findings);
    findings.0.sort_by_key(|finding| finding.severity);
    findings.0
}

struct Findings(Vec<Finding>);

impl Findings {
    fn add(&mut self, severity: Severity, flaw: Option<CertificateFlaw>) {
        self.0.extend(flaw.map(|flaw| Finding { flaw, severity }));
    }

    fn warn_if(&mut self, applies: bool, flaw: CertificateFlaw) {
        self.add(Severity::Warning, applies.then_some(flaw));
    }
}

/// Names and extensions that some clients cannot read.
fn names(certificate: &Certificate, findings: &mut Findings) {
    let is_text = |name: &&AlternativeName| matches!(name, AlternativeName::Dns(_) | AlternativeName::Email(_));
    let mut names = certificate.alternative_names().iter().filter(is_text).map(ToString::to_string);
    let odd = names.find(|name| !name.is_ascii());
    findings.add(Severity::Warning, odd.map(|name| CertificateFlaw::NameNotAscii { name: quoted(&name) }));
    for extension in &certificate.facts().extensions.critical {
        let flaw = CertificateFlaw::RareCriticalExtension { extension: extension.clone() };
        findings.warn_if(RARELY_SUPPORTED.contains(&extension.as_str()), flaw);
    }
}

fn usage(certificate: &Certificate, findings: &mut Findings) {
    let is_ca = certificate.basic_constraints().is_some_and(|constraints| constraints.ca);
    let flaw = checks::key_usage_flaw(certificate);
    if is_ca && !certificate.is_self_signed() || flaw == Some(CertificateFlaw::CertificateOfAuthority) {
        findings.add(Severity::Error, Some(CertificateFlaw::CertificateOfAuthority));
    } else {
        findings.warn_if(is_ca, CertificateFlaw::ClaimsToBeAuthority);
        let severity = match &flaw {
            // Many clients accept these.
            Some(CertificateFlaw::KeyUsageMissing) => Severity::Warning,
            Some(CertificateFlaw::KeyUsageLacks { missing }) if *missing == [KeyUsage::NonRepudiation] => {
                Severity::Warning
            }
            _ => Severity::Error,
        };
        findings.add(severity, flaw);
    }
    findings.add(Severity::Error, checks::role_flaw(certificate, Role::Server));
    findings.warn_if(certificate.extended_key_usages().is_none(), CertificateFlaw::ExtendedKeyUsageMissing);
}

fn strength(certificate: &Certificate, policies: &BTreeSet<SecurityPolicy>, findings: &mut Findings) {
    let facts = certificate.facts();
    let key = match &facts.public_key {
        PublicKey::Rsa { exponent_fits: false, .. } => Some(CertificateFlaw::KeyExponent),
        PublicKey::Rsa { bits, .. } if !length_fits(*bits, policies) => {
            Some(CertificateFlaw::KeyLengthNotTicked { bits: *bits })
        }
        PublicKey::Rsa { .. } => None,
        PublicKey::Ec { .. } | PublicKey::Other { .. } => Some(CertificateFlaw::KeyNotRsa),
    };
    findings.add(Severity::Error, key);
    if certificate.is_self_signed() && certificate.signature_by(certificate) == Verdict::Wrong {
        findings.add(Severity::Error, Some(CertificateFlaw::SelfSignatureWrong));
    }
    let algorithm = facts.signature_algorithm.name().to_owned();
    let wants_better = policies.iter().any(|policy| !policy.is_weak());
    match facts.signature_algorithm.hash() {
        None => {
            let why = quoted(&format!("the signature algorithm {algorithm} is not supported"));
            findings.add(Severity::Error, Some(CertificateFlaw::SignatureUnverifiable { why }));
        }
        Some(Hash::Md5) => findings.add(Severity::Error, Some(CertificateFlaw::WeakHash { algorithm })),
        Some(Hash::Sha1) => {
            let severity = if wants_better { Severity::Error } else { Severity::Warning };
            findings.add(severity, Some(CertificateFlaw::WeakHash { algorithm }));
        }
        Some(Hash::Sha256 | Hash::Sha384 | Hash::Sha512) => {}
    }
}

fn dates(certificate: &Certificate, now: DateTime<Utc>, findings: &mut Findings) {
    let until = certificate.not_after();
    let flaw = checks::validity_flaw(certificate, now);
    let is_expired = matches!(flaw, Some(CertificateFlaw::Expired { .. }));
    let severity = match &flaw {
        // A day or less is a matter of clocks.
        Some(CertificateFlaw::NotYetValid { from, .. }) if *from - now <= CLOCK_TOLERANCE => Severity::Warning,
        _ => Severity::Error,
    };
    findings.warn_if(!is_expired && until - now < SOON, CertificateFlaw::ExpiresSoon { until });
    findings.add(severity, flaw);
}

fn length_fits(bits: u16, policies: &BTreeSet<SecurityPolicy>) -> bool {
    offered_key_lengths(policies).iter().any(|length| length.bits() == bits)
}

/// Critical extensions that OpenSSL supports and small OPC UA stacks do not.
const RARELY_SUPPORTED: [&str; 5] =
    ["nameConstraints", "policyMappings", "policyConstraints", "inhibitAnyPolicy", "cRLDistributionPoints"];
const SOON: Duration = Duration::days(30);
/// How far clocks and time zones may be apart.
const CLOCK_TOLERANCE: Duration = Duration::days(1);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pki::{Presented, TrustLists, TrustPolicy};
    use rcgen::{CertificateParams, ExtendedKeyUsagePurpose, IsCa, KeyUsagePurpose, SanType};
    use time::OffsetDateTime;

    use crate::pki::samples::{self, now};

    const URI: &str = "urn:EpsonRC:SN0000123";

    fn checked(certificate: &Certificate, policies: &[SecurityPolicy], now: DateTime<Utc>) -> Vec<Finding> {
        let hosts = ["192.168.10.1".to_owned(), "robot-9".to_owned()];
        let policies = policies.iter().copied().collect();
        preflight(certificate, &Expected { application_uri: URI, hosts: &hosts, policies: &policies, now })
    }

    /// A certificate with nothing to find, and then changed.
    fn made(change: impl FnOnce(&mut CertificateParams)) -> Certificate {
        let mut params = CertificateParams::default();
        let ip = SanType::IpAddress("192.168.10.1".parse().unwrap());
        params.subject_alt_names = vec![SanType::URI(URI.try_into().unwrap()), ip];
        params.key_usages = vec![
            KeyUsagePurpose::DigitalSignature,
            KeyUsagePurpose::ContentCommitment,
            KeyUsagePurpose::KeyEncipherment,
            KeyUsagePurpose::DataEncipherment,
        ];
        params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth];
        params.not_before = OffsetDateTime::from_unix_timestamp(now().timestamp() - 3600).unwrap();
        params.not_after = OffsetDateTime::from_unix_timestamp(now().timestamp() + 400 * 86_400).unwrap();
        change(&mut params);
        Certificate::from_der(params.self_signed(samples::key()).unwrap().der()).unwrap()
    }

    fn error(flaw: CertificateFlaw) -> Finding {
        Finding { flaw, severity: Severity::Error }
    }

    fn warning(flaw: CertificateFlaw) -> Finding {
        Finding { flaw, severity: Severity::Warning }
    }

    fn found(change: impl FnOnce(&mut CertificateParams)) -> Vec<Finding> {
        checked(&made(change), &[SecurityPolicy::Basic256Sha256], now())
    }

    #[test]
    fn what_this_program_makes_has_nothing_to_find() {
        assert_eq!(checked(samples::certificate(), &[SecurityPolicy::Basic256Sha256], now()), []);
        assert_eq!(checked(&samples::certificate_for(samples::legacy_key()), &[SecurityPolicy::Basic256], now()), []);
        assert_eq!(found(|_| {}), []);
    }

    #[test]
    fn names_are_those_of_the_server() {
        let other = || SanType::URI("urn:other".try_into().unwrap());
        assert_eq!(
            found(|p| p.subject_alt_names[0] = other()),
            [error(CertificateFlaw::UriDiffers { certificate: "urn:other".into(), announced: URI.into() })]
        );
        assert_eq!(
            found(|p| drop(p.subject_alt_names.remove(0))),
            [error(CertificateFlaw::UriMissing { announced: Some(URI.into()) })]
        );
        let hosts = vec!["192.168.10.1".to_owned(), "robot-9".to_owned()];
        assert_eq!(
            found(|p| drop(p.subject_alt_names.pop())),
            [warning(CertificateFlaw::HostName { hosts: hosts.clone(), names: vec![] })]
        );
        let elsewhere = SanType::DnsName("elsewhere".try_into().unwrap());
        assert_eq!(
            found(|p| p.subject_alt_names[1] = elsewhere),
            [warning(CertificateFlaw::HostName { hosts, names: vec!["elsewhere".into()] })]
        );
        let one_is_enough = SanType::DnsName("ROBOT-9".try_into().unwrap());
        assert_eq!(found(|p| p.subject_alt_names[1] = one_is_enough), []);
    }

    #[test]
    fn usages_are_those_of_a_server() {
        assert_eq!(
            found(|p| p.key_usages = vec![KeyUsagePurpose::KeyEncipherment, KeyUsagePurpose::ContentCommitment]),
            [error(CertificateFlaw::KeyUsageLacks {
                missing: vec![KeyUsage::DigitalSignature, KeyUsage::DataEncipherment]
            })]
        );
        assert_eq!(
            found(|p| p.key_usages.retain(|usage| *usage != KeyUsagePurpose::ContentCommitment)),
            [warning(CertificateFlaw::KeyUsageLacks { missing: vec![KeyUsage::NonRepudiation] })]
        );
        assert_eq!(found(|p| p.key_usages.clear()), [warning(CertificateFlaw::KeyUsageMissing)]);
        assert_eq!(
            found(|p| p.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth]),
            [error(CertificateFlaw::NotForRole { role: Role::Server })]
        );
        assert_eq!(found(|p| p.extended_key_usages.clear()), [warning(CertificateFlaw::ExtendedKeyUsageMissing)]);
        assert_eq!(found(|p| p.extended_key_usages = vec![ExtendedKeyUsagePurpose::Any]), []);
        let ca = |p: &mut CertificateParams| p.is_ca = IsCa::Ca(rcgen::BasicConstraints::Unconstrained);
        assert_eq!(found(ca), [warning(CertificateFlaw::ClaimsToBeAuthority)], "the validator accepts it as well");
        let authority = |p: &mut CertificateParams| {
            ca(p);
            p.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
        };
        assert_eq!(found(authority), [error(CertificateFlaw::CertificateOfAuthority)]);
    }

    #[test]
    fn a_key_fits_the_policies() {
        let legacy = samples::certificate_for(samples::legacy_key());
        assert_eq!(
            checked(&legacy, &[SecurityPolicy::Basic256Sha256], now()),
            [error(CertificateFlaw::KeyLengthNotTicked { bits: 1024 })]
        );
        let policies = BTreeSet::from([SecurityPolicy::Basic256Sha256]);
        assert_eq!(check_usable(&legacy, &policies, now()), Err(PkiError::KeyLengthNotAllowed(1024)));
        assert_eq!(check_usable(samples::certificate(), &policies, now()), Ok(()));
        let elliptic = crate::pki::tls_identity("robot", now()).unwrap();
        let elliptic = Certificate::from_der(&elliptic.certificate_der).unwrap();
        assert!(checked(&elliptic, &[SecurityPolicy::None], now()).contains(&error(CertificateFlaw::KeyNotRsa)));
    }

    #[test]
    fn a_damaged_self_signed_certificate_is_noticed() {
        let mut der = made(|_| {}).der().to_vec();
        let last = der.len() - 1;
        der[last] ^= 1;
        let damaged = Certificate::from_der(&der).unwrap();
        assert_eq!(
            checked(&damaged, &[SecurityPolicy::Basic256Sha256], now()),
            [error(CertificateFlaw::SelfSignatureWrong)]
        );
    }

    #[test]
    fn dates_are_compared_with_the_controllers_clock() {
        let certificate = made(|_| {});
        let at = |days: i64| checked(&certificate, &[SecurityPolicy::Basic256Sha256], now() + Duration::days(days));
        let (not_before, not_after) = (certificate.not_before(), certificate.not_after());
        assert_eq!(at(399), [warning(CertificateFlaw::ExpiresSoon { until: not_after })]);
        assert_eq!(at(401), [error(CertificateFlaw::Expired { until: not_after, now: now() + Duration::days(401) })]);
        let early = |days| CertificateFlaw::NotYetValid { from: not_before, now: now() - Duration::days(days) };
        assert_eq!((at(-1), at(-2)), (vec![warning(early(1))], vec![error(early(2))]));
        let policies = BTreeSet::from([SecurityPolicy::None]);
        let late = now() + Duration::days(401);
        assert_eq!(check_usable(&certificate, &policies, late), Err(PkiError::Expired(not_after)));
    }

    #[test]
    fn every_finding_has_a_status_and_errors_come_first() {
        let findings = found(|p| {
            p.subject_alt_names.clear();
            p.key_usages = vec![KeyUsagePurpose::KeyCertSign];
            p.extended_key_usages.clear();
        });
        assert_eq!(findings.len(), 4, "{findings:?}");
        assert!(findings.is_sorted_by_key(|finding| finding.severity));
        assert_eq!(findings[0].severity, Severity::Error);
        for finding in findings {
            assert!(finding.status().starts_with("BadCertificate"));
        }
    }

    /// Certificates that another tool made for the virtual controller R7A0010001.
    #[test]
    fn it_agrees_with_the_validator_about_names_and_critical_extensions() {
        const URI: &str = "urn:EpsonRC.R7A0010001.127.000.000.001";
        let policies = BTreeSet::from([SecurityPolicy::Basic256Sha256]);
        let now = "2026-12-01T00:00:00Z".parse().unwrap();
        for (der, expected) in [
            (
                &include_bytes!("../../tests/cases/09-critical-extensions/umlaut-san.der")[..],
                error(CertificateFlaw::NameNotAscii { name: "DNS:b\u{fffd}ro".into() }),
            ),
            (
                include_bytes!("../../tests/cases/09-critical-extensions/policyconstraints.der"),
                warning(CertificateFlaw::RareCriticalExtension { extension: "policyConstraints".into() }),
            ),
        ] {
            let certificate = Certificate::from_der(der).unwrap();
            let hosts = ["127.0.0.1".to_owned()];
            let expected_names = Expected { application_uri: URI, hosts: &hosts, policies: &policies, now };
            assert_eq!(preflight(&certificate, &expected_names), std::slice::from_ref(&expected));
            let lists = TrustLists::new(vec![certificate.clone()], vec![], vec![]);
            let presented = Presented {
                certificate: &certificate,
                chain: &[],
                role: Role::Server,
                now,
                application_uri: Some(URI),
                host: Some("127.0.0.1"),
                security_policy: Some(SecurityPolicy::Basic256Sha256),
            };
            let refused = lists.validate(&presented, &TrustPolicy::default()).err().map(|rejection| rejection.flaw);
            assert_eq!(refused, (expected.severity == Severity::Error).then_some(expected.flaw));
        }
    }
}
