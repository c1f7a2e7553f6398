use super::*;
use rcgen::{CertificateParams, ExtendedKeyUsagePurpose, IsCa, Issuer, KeyPair, KeyUsagePurpose, SanType};
use time::OffsetDateTime;

use crate::pki::KeyUsage;
use crate::pki::samples::{self, now};

const URI: &str = "urn:EpsonRC:SN0000123";

fn checked(certificate: &Certificate, policies: &[SecurityPolicy], now: DateTime<Utc>) -> Vec<CertificateFinding> {
    let hosts = ["192.168.10.1".to_owned(), "robot-9".to_owned()];
    let policies = policies.iter().copied().collect();
    check_import(certificate, &ExpectedServer { application_uri: URI, hosts: &hosts, policies: &policies, now })
}

/// Of a certificate with nothing to find.
fn params() -> CertificateParams {
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
    params
}

/// A certificate with nothing to find, and then changed.
fn made(change: impl FnOnce(&mut CertificateParams)) -> Certificate {
    let mut params = params();
    change(&mut params);
    Certificate::from_der(params.self_signed(samples::key()).unwrap().der()).unwrap()
}

fn error(flaw: CertificateFlaw) -> CertificateFinding {
    CertificateFinding { flaw, severity: Severity::Error }
}

fn warning(flaw: CertificateFlaw) -> CertificateFinding {
    CertificateFinding { flaw, severity: Severity::Warning }
}

fn found(change: impl FnOnce(&mut CertificateParams)) -> Vec<CertificateFinding> {
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
        [error(CertificateFlaw::NotForRole { role: PeerRole::Server })]
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
        assert!(finding.status().as_str().starts_with("BadCertificate"));
    }
}

/// Certificates that another tool made for the virtual controller R7A0010001.
#[test]
fn names_and_critical_extensions_are_judged_alike_by_a_client() {
    const URI: &str = "urn:EpsonRC.R7A0010001.127.000.000.001";
    let policies = BTreeSet::from([SecurityPolicy::Basic256Sha256]);
    let now = "2026-12-01T00:00:00Z".parse().unwrap();
    for (der, expected) in [
        (
            &include_bytes!("../../../tests/cases/09-critical-extensions/umlaut-san.der")[..],
            error(CertificateFlaw::NameNotAscii { name: "DNS:b\u{fffd}ro".into() }),
        ),
        (
            include_bytes!("../../../tests/cases/09-critical-extensions/policyconstraints.der"),
            warning(CertificateFlaw::RareCriticalExtension { extension: "policyConstraints".into() }),
        ),
    ] {
        let certificate = Certificate::from_der(der).unwrap();
        let hosts = ["127.0.0.1".to_owned()];
        let wanted = ExpectedServer { application_uri: URI, hosts: &hosts, policies: &policies, now };
        assert_eq!(check_import(&certificate, &wanted), std::slice::from_ref(&expected));
        let refused = check_server(&certificate, Some(&certificate), &wanted, now).refused.map(|refused| refused.flaw);
        assert_eq!(refused, (expected.severity == Severity::Error).then_some(expected.flaw));
    }
}

/// How a client judges a certificate that it trusts, with the same clock as the controller.
fn shown(certificate: &Certificate, policies: &[SecurityPolicy], now: DateTime<Utc>) -> ServerCheck {
    let hosts = ["192.168.10.1".to_owned()];
    let policies = policies.iter().copied().collect();
    let expected = ExpectedServer { application_uri: URI, hosts: &hosts, policies: &policies, now };
    check_server(certificate, Some(certificate), &expected, now)
}

fn status(certificate: &Certificate) -> Option<CertificateStatus> {
    let refused = shown(certificate, &[SecurityPolicy::None, SecurityPolicy::Basic256Sha256], now()).refused;
    refused.map(|rejection| rejection.status())
}

fn by_a_ca(serial: u8) -> Certificate {
    let mut params = params();
    params.serial_number = Some(vec![serial].into());
    let mut ca = CertificateParams::default();
    ca.is_ca = IsCa::Ca(rcgen::BasicConstraints::Unconstrained);
    ca.distinguished_name.push(rcgen::DnType::CommonName, "Site CA");
    let issuer = Issuer::new(ca, KeyPair::generate().unwrap());
    Certificate::from_der(params.signed_by(samples::key(), &issuer).unwrap().der()).unwrap()
}

#[test]
fn a_client_trusts_what_the_controller_names_and_nothing_else() {
    let (policies, hosts) = (BTreeSet::from([SecurityPolicy::Basic256Sha256]), ["192.168.10.1".to_owned()]);
    let expected = ExpectedServer { application_uri: URI, hosts: &hosts, policies: &policies, now: now() };
    for (certificate, other) in
        [(by_a_ca(1), by_a_ca(2)), (made(|_| {}), made(|params| params.serial_number = Some(vec![7].into())))]
    {
        let check = |selected| check_server(&certificate, selected, &expected, now()).refused;
        assert_eq!(check(Some(&certificate)), None, "its issuer is not asked for");
        for selected in [Some(&other), None] {
            assert_eq!(check(selected).unwrap().status(), CertificateStatus::Untrusted);
        }
    }
}

#[test]
fn a_client_refuses_by_the_first_flaw() {
    assert_eq!(status(&made(|_| {})), None);
    let elsewhere = made(|p| p.subject_alt_names[1] = SanType::DnsName("elsewhere".try_into().unwrap()));
    assert_eq!(status(&elsewhere), Some(CertificateStatus::HostNameInvalid));
    let other_uri = made(|p| p.subject_alt_names[0] = SanType::URI("urn:x".try_into().unwrap()));
    assert_eq!(status(&other_uri), Some(CertificateStatus::UriInvalid));
    let only_signs = made(|p| p.key_usages.truncate(1));
    assert_eq!(status(&only_signs), Some(CertificateStatus::UseNotAllowed));
    let past = made(|p| p.not_after = p.not_before + time::Duration::MINUTE);
    assert_eq!(status(&past), Some(CertificateStatus::TimeInvalid));
}

/// Import and client: one severity for the same flaw, but for the four rows of the module's table.
#[test]
fn a_key_usage_that_many_clients_do_not_miss_is_a_warning_in_both_places() {
    for (change, flaw) in [
        (
            (|p| p.key_usages.retain(|usage| *usage != KeyUsagePurpose::ContentCommitment))
                as fn(&mut CertificateParams),
            CertificateFlaw::KeyUsageLacks { missing: vec![KeyUsage::NonRepudiation] },
        ),
        (|p| p.key_usages.clear(), CertificateFlaw::KeyUsageMissing),
        (|p| p.is_ca = IsCa::Ca(rcgen::BasicConstraints::Unconstrained), CertificateFlaw::ClaimsToBeAuthority),
    ] {
        let certificate = made(change);
        assert_eq!(found(change), [warning(flaw.clone())]);
        let check = shown(&certificate, &[SecurityPolicy::Basic256Sha256], now());
        assert_eq!((check.refused, check.findings), (None, vec![warning(flaw)]));
    }
}

#[test]
fn a_length_that_is_offered_is_accepted_under_every_ticked_policy() {
    for policies in 0_usize..1 << SecurityPolicy::ALL.len() {
        let ticked: Vec<SecurityPolicy> =
            SecurityPolicy::ALL.iter().enumerate().filter(|(at, _)| policies & 1 << at != 0).map(|(_, p)| *p).collect();
        for key in [samples::key(), samples::legacy_key()] {
            let certificate = Certificate::from_der(params().self_signed(key).unwrap().der()).unwrap();
            let import = checked(&certificate, &ticked, now());
            let check = shown(&certificate, &ticked, now());
            assert!(!import.is_empty() || check.refused.is_none(), "{ticked:?}: {import:?}, {check:?}");
        }
    }
}
