//! What OPC UA clients would say about a server certificate, found out before it is installed.

use std::collections::BTreeSet;
use std::net::IpAddr;

use chrono::{DateTime, Duration, SecondsFormat, Utc};
use x509_parser::prelude::{FromDer, GeneralName, X509Certificate};

use super::signature::Verdict;
use super::{Certificate, PkiError, name};
use crate::model::{Language, SecurityPolicy, offered_key_lengths};

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
    /// Some clients complain, or ask their user.
    Warning,
}

/// One thing about a certificate that is not as OPC UA wants it (OPC 10000-4 §6.1.3, OPC 10000-6 §6.2.2).
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Finding {
    ApplicationUriMissing {
        expected: String,
    },
    ApplicationUri {
        expected: String,
        found: String,
    },
    /// None of the hosts is named.
    HostName {
        expected: Vec<String>,
        found: Vec<String>,
    },
    /// Some of digitalSignature, keyEncipherment and dataEncipherment are missing.
    KeyUsage {
        missing: Vec<&'static str>,
    },
    NonRepudiationMissing,
    KeyUsageMissing,
    /// There are extended key usages, and server authentication is not one of them.
    ServerAuthMissing,
    ExtendedKeyUsageMissing,
    CertificateAuthority,
    /// It calls itself self-signed, but the signature is not that of its key: a damaged certificate.
    Signature,
    NotRsa,
    KeyLength {
        bits: u16,
    },
    /// Signed with MD5, or with SHA-1 although a ticked policy wants better.
    WeakSignature {
        hash: &'static str,
        severity: Severity,
    },
    Expired {
        not_after: DateTime<Utc>,
        now: DateTime<Utc>,
    },
    ExpiresSoon {
        not_after: DateTime<Utc>,
    },
    /// A day or less is a matter of clocks, and a warning.
    NotYetValid {
        not_before: DateTime<Utc>,
        now: DateTime<Utc>,
    },
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

/// Looks at everything a client looks at, but for the CA that signed it: errors first.
pub fn preflight(certificate: &Certificate, expected: &Expected<'_>) -> Result<Vec<Finding>, PkiError> {
    let (_, parsed) = X509Certificate::from_der(certificate.der()).map_err(|_| PkiError::NotACertificate)?;
    let mut findings = Vec::new();
    names(&parsed, certificate, expected, &mut findings);
    usage(&parsed, &mut findings);
    strength(&parsed, certificate, expected.policies, &mut findings);
    dates(certificate, expected.now, &mut findings);
    findings.sort_by_key(Finding::severity);
    Ok(findings)
}

impl Finding {
    pub fn severity(&self) -> Severity {
        match self {
            Self::ApplicationUriMissing { .. }
            | Self::ApplicationUri { .. }
            | Self::KeyUsage { .. }
            | Self::ServerAuthMissing
            | Self::CertificateAuthority
            | Self::Signature
            | Self::NotRsa
            | Self::KeyLength { .. }
            | Self::Expired { .. } => Severity::Error,
            Self::HostName { .. }
            | Self::NonRepudiationMissing
            | Self::KeyUsageMissing
            | Self::ExtendedKeyUsageMissing
            | Self::ExpiresSoon { .. } => Severity::Warning,
            Self::WeakSignature { severity, .. } => *severity,
            Self::NotYetValid { not_before, now } if *not_before - *now > CLOCK_TOLERANCE => Severity::Error,
            Self::NotYetValid { .. } => Severity::Warning,
        }
    }

    /// The OPC UA status a client would give.
    pub const fn status(&self) -> &'static str {
        match self {
            Self::ApplicationUriMissing { .. } | Self::ApplicationUri { .. } => "BadCertificateUriInvalid",
            Self::HostName { .. } => "BadCertificateHostNameInvalid",
            Self::KeyUsage { .. }
            | Self::NonRepudiationMissing
            | Self::KeyUsageMissing
            | Self::ServerAuthMissing
            | Self::ExtendedKeyUsageMissing
            | Self::CertificateAuthority => "BadCertificateUseNotAllowed",
            Self::Signature => "BadCertificateInvalid",
            Self::NotRsa | Self::KeyLength { .. } | Self::WeakSignature { .. } => "BadCertificatePolicyCheckFailed",
            Self::Expired { .. } | Self::ExpiresSoon { .. } | Self::NotYetValid { .. } => "BadCertificateTimeInvalid",
        }
    }

    /// What a person reads.
    pub fn explain(&self, language: Language) -> String {
        match language {
            Language::En => self.english(),
            Language::Zh => self.chinese(),
        }
    }

    fn english(&self) -> String {
        match self {
            Self::ApplicationUriMissing { expected } => {
                format!("the certificate names no application URI; \"{expected}\" is needed")
            }
            Self::ApplicationUri { expected, found } => {
                format!("the application URI is \"{found}\", but the server announces \"{expected}\"")
            }
            Self::HostName { expected, found } if found.is_empty() => {
                format!("the certificate names no address or host; the server is reached as {}", expected.join(", "))
            }
            Self::HostName { expected, found } => {
                format!("the certificate is for {}; the server is reached as {}", found.join(", "), expected.join(", "))
            }
            Self::KeyUsage { missing } => format!("the key usage lacks {}", missing.join(", ")),
            Self::NonRepudiationMissing => "the key usage lacks nonRepudiation".to_owned(),
            Self::KeyUsageMissing => "the certificate does not say what its key may be used for".to_owned(),
            Self::ServerAuthMissing => "the extended key usage lacks server authentication".to_owned(),
            Self::ExtendedKeyUsageMissing => "the certificate has no extended key usage".to_owned(),
            Self::CertificateAuthority => "it is the certificate of a CA, not of a server".to_owned(),
            Self::Signature => "the signature is wrong; the certificate is damaged".to_owned(),
            Self::NotRsa => "the key is not an RSA key".to_owned(),
            Self::KeyLength { bits } => format!("the ticked security policies do not allow {bits}-bit keys"),
            Self::WeakSignature { hash, .. } => format!("the certificate is signed with {hash}"),
            Self::Expired { not_after, now } => {
                format!("it was valid until {}; the controller's clock says {}", date(*not_after), date(*now))
            }
            Self::ExpiresSoon { not_after } => format!("it is valid only until {}", date(*not_after)),
            Self::NotYetValid { not_before, now } => {
                format!("it is valid from {} on; the controller's clock says {}", date(*not_before), date(*now))
            }
        }
    }

    fn chinese(&self) -> String {
        match self {
            Self::ApplicationUriMissing { expected } => format!("证书中没有应用程序 URI，应为“{expected}”"),
            Self::ApplicationUri { expected, found } => {
                format!("应用程序 URI 为“{found}”，而服务器公布的是“{expected}”")
            }
            Self::HostName { expected, found } if found.is_empty() => {
                format!("证书中没有地址或主机名，服务器的连接地址为 {}", expected.join("、"))
            }
            Self::HostName { expected, found } => {
                format!("证书用于 {}，而服务器的连接地址为 {}", found.join("、"), expected.join("、"))
            }
            Self::KeyUsage { missing } => format!("密钥用法缺少 {}", missing.join("、")),
            Self::NonRepudiationMissing => "密钥用法缺少 nonRepudiation".to_owned(),
            Self::KeyUsageMissing => "证书未说明密钥用法".to_owned(),
            Self::ServerAuthMissing => "扩展密钥用法缺少服务器身份验证".to_owned(),
            Self::ExtendedKeyUsageMissing => "证书没有扩展密钥用法".to_owned(),
            Self::CertificateAuthority => "这是 CA 的证书，而不是服务器证书".to_owned(),
            Self::Signature => "签名错误，证书已损坏".to_owned(),
            Self::NotRsa => "密钥不是 RSA 密钥".to_owned(),
            Self::KeyLength { bits } => format!("所选的安全策略不允许 {bits} 位密钥"),
            Self::WeakSignature { hash, .. } => format!("证书使用 {hash} 签名"),
            Self::Expired { not_after, now } => {
                format!("有效期至 {}，控制器时钟为 {}", date(*not_after), date(*now))
            }
            Self::ExpiresSoon { not_after } => format!("有效期仅至 {}", date(*not_after)),
            Self::NotYetValid { not_before, now } => {
                format!("有效期从 {} 开始，控制器时钟为 {}", date(*not_before), date(*now))
            }
        }
    }
}

fn names(
    parsed: &X509Certificate<'_>,
    certificate: &Certificate,
    expected: &Expected<'_>,
    findings: &mut Vec<Finding>,
) {
    let uri = expected.application_uri.to_owned();
    match certificate.application_uri() {
        None => findings.push(Finding::ApplicationUriMissing { expected: uri }),
        Some(found) if found != uri => findings.push(Finding::ApplicationUri { expected: uri, found }),
        Some(_) => {}
    }
    let found = hosts(parsed);
    if !expected.hosts.iter().any(|host| certificate.names_host(host)) {
        findings.push(Finding::HostName { expected: expected.hosts.to_vec(), found });
    }
}

/// The addresses and DNS names of the subject alternative name.
fn hosts(parsed: &X509Certificate<'_>) -> Vec<String> {
    let Some(names) = parsed.subject_alternative_name().ok().flatten() else { return Vec::new() };
    names
        .value
        .general_names
        .iter()
        .filter_map(|general_name| match general_name {
            GeneralName::DNSName(dns) => Some(name::printable(dns)),
            GeneralName::IPAddress(bytes) => match bytes.len() {
                4 => <[u8; 4]>::try_from(*bytes).ok().map(|ip| IpAddr::from(ip).to_string()),
                _ => <[u8; 16]>::try_from(*bytes).ok().map(|ip| IpAddr::from(ip).to_string()),
            },
            _ => None,
        })
        .collect()
}

fn usage(parsed: &X509Certificate<'_>, findings: &mut Vec<Finding>) {
    match parsed.key_usage().ok().flatten() {
        None => findings.push(Finding::KeyUsageMissing),
        Some(usage) => {
            let usage = usage.value;
            let missing: Vec<&'static str> = [
                (usage.digital_signature(), "digitalSignature"),
                (usage.key_encipherment(), "keyEncipherment"),
                (usage.data_encipherment(), "dataEncipherment"),
            ]
            .into_iter()
            .filter_map(|(allowed, what)| (!allowed).then_some(what))
            .collect();
            if !missing.is_empty() {
                findings.push(Finding::KeyUsage { missing });
            }
            if !usage.non_repudiation() {
                findings.push(Finding::NonRepudiationMissing);
            }
        }
    }
    match parsed.extended_key_usage().ok().flatten() {
        None => findings.push(Finding::ExtendedKeyUsageMissing),
        Some(usage) if !usage.value.server_auth && !usage.value.any => findings.push(Finding::ServerAuthMissing),
        Some(_) => {}
    }
    if parsed.basic_constraints().ok().flatten().is_some_and(|constraints| constraints.value.ca) {
        findings.push(Finding::CertificateAuthority);
    }
}

fn strength(
    parsed: &X509Certificate<'_>,
    certificate: &Certificate,
    policies: &BTreeSet<SecurityPolicy>,
    findings: &mut Vec<Finding>,
) {
    if certificate.rsa_public_key().is_none() {
        findings.push(Finding::NotRsa);
    } else if !length_fits(certificate.key_bits(), policies) {
        findings.push(Finding::KeyLength { bits: certificate.key_bits() });
    }
    if certificate.is_self_signed() && certificate.signature_by(certificate) == Verdict::Wrong {
        findings.push(Finding::Signature);
    }
    let wants_better = policies.iter().any(|policy| !policy.is_weak());
    match parsed.signature_algorithm.algorithm.to_id_string().as_str() {
        "1.2.840.113549.1.1.2" | "1.2.840.113549.1.1.4" => {
            findings.push(Finding::WeakSignature { hash: "MD5", severity: Severity::Error });
        }
        "1.2.840.113549.1.1.5" | "1.2.840.10045.4.1" => {
            let severity = if wants_better { Severity::Error } else { Severity::Warning };
            findings.push(Finding::WeakSignature { hash: "SHA-1", severity });
        }
        _ => {}
    }
}

fn dates(certificate: &Certificate, now: DateTime<Utc>, findings: &mut Vec<Finding>) {
    let (not_before, not_after) = (certificate.not_before(), certificate.not_after());
    if not_after < now {
        findings.push(Finding::Expired { not_after, now });
    } else if not_after - now < SOON {
        findings.push(Finding::ExpiresSoon { not_after });
    }
    if now < not_before {
        findings.push(Finding::NotYetValid { not_before, now });
    }
}

fn length_fits(bits: u16, policies: &BTreeSet<SecurityPolicy>) -> bool {
    offered_key_lengths(policies).iter().any(|length| length.bits() == bits)
}

fn date(when: DateTime<Utc>) -> String {
    when.to_rfc3339_opts(SecondsFormat::Secs, true)
}

const SOON: Duration = Duration::days(30);
/// How far clocks and time zones may be apart.
const CLOCK_TOLERANCE: Duration = Duration::days(1);

#[cfg(test)]
mod tests {
    use super::*;
    use rcgen::{CertificateParams, ExtendedKeyUsagePurpose, IsCa, KeyUsagePurpose, SanType};
    use time::OffsetDateTime;

    use crate::pki::samples::{self, now};

    const URI: &str = "urn:EpsonRC:SN0000123";

    fn checked(certificate: &Certificate, policies: &[SecurityPolicy], now: DateTime<Utc>) -> Vec<Finding> {
        let hosts = ["192.168.10.1".to_owned(), "robot-9".to_owned()];
        let policies = policies.iter().copied().collect();
        preflight(certificate, &Expected { application_uri: URI, hosts: &hosts, policies: &policies, now }).unwrap()
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
            [Finding::ApplicationUri { expected: URI.into(), found: "urn:other".into() }]
        );
        assert_eq!(
            found(|p| drop(p.subject_alt_names.remove(0))),
            [Finding::ApplicationUriMissing { expected: URI.into() }]
        );
        let hosts = vec!["192.168.10.1".to_owned(), "robot-9".to_owned()];
        assert_eq!(
            found(|p| drop(p.subject_alt_names.pop())),
            [Finding::HostName { expected: hosts.clone(), found: vec![] }]
        );
        let elsewhere = SanType::DnsName("elsewhere".try_into().unwrap());
        assert_eq!(
            found(|p| p.subject_alt_names[1] = elsewhere),
            [Finding::HostName { expected: hosts, found: vec!["elsewhere".into()] }]
        );
        let one_is_enough = SanType::DnsName("ROBOT-9".try_into().unwrap());
        assert_eq!(found(|p| p.subject_alt_names[1] = one_is_enough), []);
    }

    #[test]
    fn usages_are_those_of_a_server() {
        assert_eq!(
            found(|p| p.key_usages = vec![KeyUsagePurpose::KeyEncipherment, KeyUsagePurpose::ContentCommitment]),
            [Finding::KeyUsage { missing: vec!["digitalSignature", "dataEncipherment"] }]
        );
        assert_eq!(
            found(|p| p.key_usages.retain(|usage| *usage != KeyUsagePurpose::ContentCommitment)),
            [Finding::NonRepudiationMissing]
        );
        assert_eq!(found(|p| p.key_usages.clear()), [Finding::KeyUsageMissing]);
        assert_eq!(
            found(|p| p.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth]),
            [Finding::ServerAuthMissing]
        );
        assert_eq!(found(|p| p.extended_key_usages.clear()), [Finding::ExtendedKeyUsageMissing]);
        assert_eq!(found(|p| p.extended_key_usages = vec![ExtendedKeyUsagePurpose::Any]), []);
        let ca = |p: &mut CertificateParams| p.is_ca = IsCa::Ca(rcgen::BasicConstraints::Unconstrained);
        assert_eq!(found(ca), [Finding::CertificateAuthority]);
    }

    #[test]
    fn a_key_fits_the_policies() {
        let legacy = samples::certificate_for(samples::legacy_key());
        assert_eq!(checked(&legacy, &[SecurityPolicy::Basic256Sha256], now()), [Finding::KeyLength { bits: 1024 }]);
        let policies = BTreeSet::from([SecurityPolicy::Basic256Sha256]);
        assert_eq!(check_usable(&legacy, &policies, now()), Err(PkiError::KeyLengthNotAllowed(1024)));
        assert_eq!(check_usable(samples::certificate(), &policies, now()), Ok(()));
        let elliptic = crate::pki::tls_identity("robot", now()).unwrap();
        let elliptic = Certificate::from_der(&elliptic.certificate_der).unwrap();
        assert!(checked(&elliptic, &[SecurityPolicy::None], now()).contains(&Finding::NotRsa));
    }

    #[test]
    fn a_damaged_self_signed_certificate_is_noticed() {
        let mut der = made(|_| {}).der().to_vec();
        let last = der.len() - 1;
        der[last] ^= 1;
        let damaged = Certificate::from_der(&der).unwrap();
        assert_eq!(checked(&damaged, &[SecurityPolicy::Basic256Sha256], now()), [Finding::Signature]);
    }

    #[test]
    fn dates_are_compared_with_the_controllers_clock() {
        let certificate = made(|_| {});
        let at = |days: i64| checked(&certificate, &[SecurityPolicy::Basic256Sha256], now() + Duration::days(days));
        let (not_before, not_after) = (certificate.not_before(), certificate.not_after());
        assert_eq!(at(399), [Finding::ExpiresSoon { not_after }]);
        assert_eq!(at(401), [Finding::Expired { not_after, now: now() + Duration::days(401) }]);
        let early = |days| Finding::NotYetValid { not_before, now: now() - Duration::days(days) };
        assert_eq!((at(-1), at(-1)[0].severity()), (vec![early(1)], Severity::Warning));
        assert_eq!((at(-2), at(-2)[0].severity()), (vec![early(2)], Severity::Error));
        let policies = BTreeSet::from([SecurityPolicy::None]);
        let late = now() + Duration::days(401);
        assert_eq!(check_usable(&certificate, &policies, late), Err(PkiError::Expired(not_after)));
    }

    #[test]
    fn every_finding_has_a_status_and_two_texts_and_errors_come_first() {
        let findings = found(|p| {
            p.subject_alt_names.clear();
            p.key_usages = vec![KeyUsagePurpose::KeyCertSign];
            p.extended_key_usages.clear();
        });
        assert_eq!(findings.len(), 5, "{findings:?}");
        assert!(findings.is_sorted_by_key(Finding::severity));
        assert_eq!(findings[0].severity(), Severity::Error);
        for finding in findings {
            assert!(finding.status().starts_with("BadCertificate"));
            assert!(finding.explain(Language::En).is_ascii() && !finding.explain(Language::Zh).is_ascii());
        }
    }
}
