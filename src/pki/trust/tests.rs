use chrono::Duration;

use super::*;
use crate::model::CertificateStatus as Status;
use crate::pki::samples::{self, TestCa};
use crate::pki::{Certificate, CertificateFlaw, Crl, CrlFlaw};

fn presented(certificate: &Certificate) -> PresentedCertificate<'_> {
    PresentedCertificate {
        certificate,
        chain: &[],
        role: PeerRole::Client,
        now: samples::now(),
        application_uri: None,
        host: None,
        security_policy: None,
    }
}

/// Why the lists do not say whether the certificate was revoked.
fn flaw_of_lists(lists: &TrustLists, presented: &PresentedCertificate<'_>) -> CrlFlaw {
    match lists.validate(presented, &TrustPolicy::default()).unwrap_err().flaw {
        CertificateFlaw::RevocationUnknown { crl, .. } => crl,
        flaw => panic!("{flaw:?}"),
    }
}

fn status(lists: &TrustLists, presented: &PresentedCertificate<'_>) -> Option<Status> {
    lists.validate(presented, &TrustPolicy::default()).err().map(|rejection| rejection.status())
}

#[test]
fn a_self_signed_certificate_is_trusted_only_if_it_is_in_the_list_itself() {
    let certificate = samples::certificate();
    let empty = TrustLists::default();
    assert_eq!(status(&empty, &presented(certificate)), Some(Status::Untrusted));
    let as_issuer = TrustLists::new(vec![], vec![certificate.clone()], vec![]);
    assert_eq!(status(&as_issuer, &presented(certificate)), Some(Status::Untrusted));
    let lists = TrustLists::new(vec![certificate.clone()], vec![], vec![]);
    let chain = lists.validate(&presented(certificate), &TrustPolicy::default()).unwrap();
    assert_eq!(chain, std::slice::from_ref(certificate));
    let later = PresentedCertificate { now: samples::now() + Duration::days(3660), ..presented(certificate) };
    assert_eq!(status(&lists, &later), Some(Status::TimeInvalid));
    let earlier = PresentedCertificate { now: samples::now() - Duration::days(3660), ..presented(certificate) };
    assert_eq!(status(&lists, &earlier), Some(Status::TimeInvalid));
}

#[test]
fn a_rejection_names_the_certificate_at_fault_and_how_far_up_it_stands() {
    let (root, middle) = (TestCa::new("Root CA"), TestCa::new("Plant CA"));
    let middle_certificate = root.certify(&middle);
    let application = middle.application(&[0x11]);
    let crls = || [root.crl(1, [middle_certificate.facts().serial.clone()]), middle.crl(1, [])];
    let crls: Vec<Crl> = crls().iter().map(|der| Crl::from_der(der).unwrap()).collect();
    let sent = [middle_certificate];
    let presented = PresentedCertificate { chain: &sent, ..presented(&application) };
    let lists = TrustLists::new(vec![root.certificate.clone()], vec![], crls.clone());
    let rejection = lists.validate(&presented, &TrustPolicy::default()).unwrap_err();
    assert_eq!((rejection.status(), rejection.depth), (Status::IssuerRevoked, 1));
    assert!(rejection.subject.contains("Plant CA"), "{rejection}");
    assert!(rejection.to_string().contains("keyCompromise"), "{rejection}");
    let without = TrustLists::new(vec![root.certificate.clone()], vec![], crls[1..].to_vec());
    let rejection = without.validate(&presented, &TrustPolicy::default()).unwrap_err();
    assert_eq!((rejection.status(), rejection.depth), (Status::IssuerRevocationUnknown, 1));
    let policy = TrustPolicy { allow_unknown_revocation: true, ..TrustPolicy::default() };
    assert_eq!(without.validate(&presented, &policy).map(|chain| chain.len()), Ok(3));
}

/// CAs that all certified one another make millions of chains, none of which ends.
#[test]
fn whoever_sends_a_maze_is_refused_soon() {
    let cas: Vec<TestCa> = (0..8).map(|number| TestCa::new(&format!("CA {number}"))).collect();
    let crossed = |issuer: &TestCa| {
        let others = cas.iter().filter(|ca| ca.certificate != issuer.certificate);
        others.map(|ca| issuer.certify(ca)).collect::<Vec<_>>()
    };
    let sent: Vec<Certificate> = cas.iter().flat_map(crossed).collect();
    let application = cas[0].application(&[0x11]);
    let presented = PresentedCertificate { chain: &sent, ..presented(&application) };
    let start = std::time::Instant::now();
    assert_eq!(status(&TrustLists::default(), &presented), Some(Status::ChainIncomplete));
    assert!(start.elapsed() < std::time::Duration::from_secs(60), "{:?}", start.elapsed());
}

/// Made by OpenSSL on 2026-11-26; the chain is one of a root and what it issued.
struct Files {
    certificate: &'static [u8],
    root: &'static [u8],
    crls: &'static [&'static [u8]],
}

macro_rules! files {
    ($folder:literal, $($crl:literal),*) => {
        Files {
            certificate: include_bytes!(concat!("../../../tests/cases/", $folder, "/cert.der")),
            root: include_bytes!(concat!("../../../tests/cases/", $folder, "/trusted/0.der")),
            crls: &[$(include_bytes!(concat!("../../../tests/cases/", $folder, "/crls/", $crl))),*],
        }
    };
}

#[test]
fn a_list_about_some_certificates_counts_where_it_covers_the_one_asked_about() {
    for (files, expected) in [
        (files!("07-crl-idp/crl-idp-usercerts-only", "0.crl"), None),
        (files!("07-crl-idp/crl-idp-usercerts-stepca-cdp", "0.crl"), None),
        (files!("07-crl-idp/crl-idp-dp-only-no-cdp", "0.crl"), Some(Status::RevocationUnknown)),
        (files!("12-crl-number-reset", "0.crl"), Some(Status::RevocationUnknown)),
        (files!("12-crl-number-reset", "0.crl", "1.crl"), None),
    ] {
        let crls = files.crls.iter().map(|der| Crl::from_der(der).unwrap()).collect();
        let lists = TrustLists::new(vec![Certificate::from_der(files.root).unwrap()], vec![], crls);
        let certificate = Certificate::from_der(files.certificate).unwrap();
        let now = "2026-11-27T12:00:00Z".parse().unwrap();
        assert_eq!(
            status(&lists, &PresentedCertificate { now, ..presented(&certificate) }),
            expected,
            "{:?}",
            lists.crls()
        );
    }
}

#[test]
fn a_list_that_is_of_no_use_says_why() {
    let (ca, new) = (TestCa::new("Plant CA"), TestCa::new("Plant CA"));
    let application = ca.application(&[0x11]);
    let lists = |issuers: &[&Certificate], crls: &[&[u8]]| {
        let issuers = issuers.iter().map(|one| (*one).clone()).collect();
        let crls = crls.iter().map(|der| Crl::from_der(der).unwrap()).collect();
        TrustLists::new(vec![ca.certificate.clone()], issuers, crls)
    };
    let now = samples::now();
    let at = |day: i64| PresentedCertificate { now: now + Duration::days(day), ..presented(&application) };
    assert_eq!(flaw_of_lists(&lists(&[], &[]), &at(0)), CrlFlaw::Missing);

    let good = ca.crl(1, []);
    let (from, until) = (now - Duration::days(1), now + Duration::days(30));
    let held = lists(&[], &[&good]);
    assert_eq!(status(&held, &at(0)), None);
    let later = at(31);
    assert_eq!(flaw_of_lists(&held, &later), CrlFlaw::Expired { until, now: later.now });
    let earlier = at(-2);
    assert_eq!(flaw_of_lists(&held, &earlier), CrlFlaw::NotYetValid { from, now: earlier.now });
    let mut forged = good.clone();
    *forged.last_mut().unwrap() ^= 1;
    assert_eq!(flaw_of_lists(&lists(&[], &[&forged]), &at(0)), CrlFlaw::NotSigned);

    let of_new_key = new.crl(1, []);
    assert_eq!(flaw_of_lists(&lists(&[], &[&of_new_key]), &at(0)), CrlFlaw::KeyNotHeld);
    let flaw = flaw_of_lists(&lists(&[&new.certificate], &[&of_new_key]), &at(0));
    let CrlFlaw::KeyNotAccepted { because, .. } = &flaw else { panic!("{flaw:?}") };
    let expected = CertificateFlaw::IssuerMissing { issuer: "CN=Plant CA".to_owned() };
    assert_eq!(**because, expected, "another authority of the same name, which the root did not certify");
}

/// Sixty certificates of the name of the issuer, each of another key and none of them the signer.
#[test]
fn a_list_of_an_unknown_key_is_not_tried_with_every_namesake() {
    let (ca, stranger) = (TestCa::new("Plant CA"), TestCa::new("Plant CA"));
    let namesakes: Vec<Certificate> = (0..60).map(|_| ca.certify(&TestCa::new("Plant CA"))).collect();
    let application = ca.application(&[0x11]);
    let crls = (0..20).map(|number| Crl::from_der(&stranger.crl(number, [])).unwrap()).collect();
    let lists = TrustLists::new(vec![ca.certificate.clone()], namesakes, crls);
    let start = std::time::Instant::now();
    assert_eq!(status(&lists, &presented(&application)), Some(Status::RevocationUnknown));
    assert!(start.elapsed() < std::time::Duration::from_secs(60), "{:?}", start.elapsed());
}
