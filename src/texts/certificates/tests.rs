use std::collections::BTreeSet;

use super::*;
use crate::model::CertificateStatus as Status;
use crate::pki::{PeerRole, RevocationReason};

fn all() -> Vec<CertificateFlaw> {
    use CertificateFlaw as F;
    let when = || "2030-01-01T00:00:00Z".parse::<DateTime<Utc>>().unwrap();
    let text = || "x".to_owned();
    vec![
        F::Unreadable { why: text() },
        F::UnknownCriticalExtension { extension: text() },
        F::RareCriticalExtension { extension: text() },
        F::DamagedExtension { extension: text() },
        F::NameNotAscii { name: text() },
        F::EndsBeforeItBegins,
        F::ChainTooLong { most: 10 },
        F::TooManyIssuers,
        F::IssuerMissing { issuer: text() },
        F::IssuerKeyIdentifier { issuer: text(), wanted: text() },
        F::IssuerKey { issuer: text() },
        F::SignatureWrong { issuer: text() },
        F::SelfSignatureWrong,
        F::NameNotPermitted { name: text(), authority: text() },
        F::NameConstraintUnsupported { name: text(), authority: text() },
        F::TooManyNames { authority: text() },
        F::PolicyMissing,
        F::PolicyMappingOfAny,
        F::KeyNotRsa,
        F::KeyExponent,
        F::KeyTooShort { bits: 1024, least: 2048 },
        F::KeyTooShort { bits: 512, least: 1024 },
        F::KeyTooLong { bits: 8192, most: 4096 },
        F::KeyLengthNotTicked { bits: 3072 },
        F::WeakHash { algorithm: text() },
        F::Untrusted,
        F::NotYetValid { from: when(), now: when() },
        F::Expired { until: when(), now: when() },
        F::ExpiresSoon { until: when() },
        F::HostName { hosts: vec![text()], names: vec![text()] },
        F::HostName { hosts: vec![text()], names: vec![] },
        F::UriMissing { announced: None },
        F::UriMissing { announced: Some(text()) },
        F::UriDiffers { certificate: text(), announced: text() },
        F::UriNotAscii { uri: text() },
        F::CertificateOfAuthority,
        F::ClaimsToBeAuthority,
        F::KeyUsageMissing,
        F::KeyUsageLacks { missing: vec![KeyUsage::DigitalSignature] },
        F::NotForRole { role: PeerRole::Client },
        F::NotForRole { role: PeerRole::Server },
        F::NotForRole { role: PeerRole::Either },
        F::ExtendedKeyUsageMissing,
        F::NotAnAuthority,
        F::MayNotIssue,
        F::MayNotIssueFor { role: PeerRole::Client },
        F::TooManyAuthoritiesBelow { most: 0, found: 2 },
        F::Revoked { on: when(), because: RevocationReason::KeyCompromise },
        F::NotThatOfTheChannel,
    ]
    .into_iter()
    .chain(unverifiable(&text()).map(|because| F::SignatureUnverifiable { because }))
    .chain(of_lists(&text()).map(|crl| F::RevocationUnknown { authority: text(), crl }))
    .collect()
}

/// Every way in which a list is of no use; the texts in it are that one.
fn of_lists(text: &str) -> impl Iterator<Item = CrlFlaw> {
    let text = || text.to_owned();
    let (from, until, now) = (DateTime::UNIX_EPOCH, DateTime::UNIX_EPOCH, DateTime::UNIX_EPOCH);
    let unusable = [
        CrlUnusable::Delta,
        CrlUnusable::Indirect,
        CrlUnusable::OnlyAttributeCertificates,
        CrlUnusable::AboutNothing,
        CrlUnusable::OnlySomeReasons,
        CrlUnusable::CriticalExtension(text()),
        CrlUnusable::CriticalEntryExtension(text()),
    ];
    let out_of_scope = [
        OutOfScope::OnlyApplications,
        OutOfScope::OnlyAuthorities,
        OutOfScope::OnlyAttributeCertificates,
        OutOfScope::OtherDistributionPoint(text()),
    ];
    let nested = CrlFlaw::OutOfScope { because: OutOfScope::OtherDistributionPoint(text()) };
    let nested = CertificateFlaw::RevocationUnknown { authority: text(), crl: nested };
    let others = [
        CrlFlaw::Missing,
        CrlFlaw::NotSigned,
        CrlFlaw::KeyNotHeld,
        CrlFlaw::KeyNotAccepted { subject: text(), because: Box::new(CertificateFlaw::NotAnAuthority) },
        CrlFlaw::KeyNotAccepted { subject: text(), because: Box::new(nested) },
        CrlFlaw::MayNotSign,
        CrlFlaw::WeakHash { algorithm: text() },
        CrlFlaw::NotYetValid { from, now },
        CrlFlaw::NoEnd,
        CrlFlaw::Expired { until, now },
        CrlFlaw::SomeReasons,
    ];
    let unusable = unusable.map(|because| CrlFlaw::Unusable { because });
    let out_of_scope = out_of_scope.map(|because| CrlFlaw::OutOfScope { because });
    let unverifiable = unverifiable(&text()).map(|because| CrlFlaw::SignatureUnverifiable { because });
    unusable.into_iter().chain(out_of_scope).chain(others).chain(unverifiable)
}

fn unverifiable(text: &str) -> impl Iterator<Item = UnverifiableSignature> + use<> {
    use UnverifiableSignature as U;
    let text = text.to_owned();
    [
        U::AlgorithmNotSupported(text.clone()),
        U::AlgorithmForgeable(text.clone()),
        U::KeyLength(512),
        U::KeyExponent,
        U::CurveNotSupported,
        U::NotWithCurve { algorithm: text.clone(), curve: text },
        U::TooManyIssuers,
    ]
    .into_iter()
}

#[test]
fn each_flaw_of_a_list_has_a_remedy_of_its_own() {
    for language in Language::ALL {
        let mut remedies = BTreeSet::new();
        for crl in of_lists("x") {
            let flaw = CertificateFlaw::RevocationUnknown { authority: "CN=Plant CA".to_owned(), crl };
            assert!(flaw.reason(language).contains("CN=Plant CA"), "{flaw:?}");
            remedies.insert(flaw.remedy(language));
        }
        // A list about attribute certificates is of no use and out of scope; the two extensions have one remedy, and so
        // have all signatures that prove nothing.
        let shared = 2 + unverifiable("x").count() - 1;
        assert_eq!(remedies.len() + shared, of_lists("x").count(), "{remedies:#?}");
    }
}

#[test]
fn what_is_said_of_a_list_is_whole_however_long_the_names_are() {
    let of_list = CertificateFlaw::of_list(CrlFlaw::Missing, &"长".repeat(300));
    let CertificateFlaw::RevocationUnknown { authority: name, .. } = of_list else { panic!("{of_list:?}") };
    for language in Language::ALL {
        for crl in of_lists(&name) {
            let flaw = CertificateFlaw::RevocationUnknown { authority: name.clone(), crl: crl.clone() };
            let long = in_language!(language, revocation_lists::reason(&crl, &name));
            assert!(flaw.reason(language).ends_with(&long), "{long}");
            let cause = RefusalCause { flaw, at_fault: Some(name.clone()) };
            assert!(cause.explain(language).contains(&long), "{long}");
        }
    }
}

#[test]
fn every_flaw_has_words_of_its_own_in_every_language_and_is_read_back() {
    let mut reasons = BTreeSet::new();
    for flaw in all() {
        for language in Language::ALL {
            let said = flaw.explain(language);
            assert!(reasons.insert(said.clone()), "{said} is said twice");
            assert!(!flaw.remedy(language).is_empty() && said.ends_with(['.', '。']), "{said}");
            assert_eq!(
                said.contains(|c: char| ('\u{4e00}'..'\u{9fff}').contains(&c)),
                language != Language::En,
                "{said}"
            );
        }
        for at_fault in [None, Some("CN=Plant CA".to_owned())] {
            let cause = RefusalCause { flaw: flaw.clone(), at_fault };
            let json = serde_json::to_string(&cause).unwrap();
            assert_eq!(serde_json::from_str::<RefusalCause>(&json).unwrap(), cause, "{json}");
        }
    }
}

#[test]
fn the_flaw_decides_the_status_and_the_remedy() {
    let unknown = CertificateFlaw::UnknownCriticalExtension { extension: "1.2.3".to_owned() };
    let damaged = CertificateFlaw::SignatureWrong { issuer: "CN=Plant CA".to_owned() };
    assert_eq!(
        (unknown.status(false), damaged.status(false)),
        (Status::CertificateInvalid, Status::CertificateInvalid)
    );
    assert_ne!(unknown.remedy(Language::En), damaged.remedy(Language::En));
    let expired = CertificateFlaw::Expired { until: DateTime::UNIX_EPOCH, now: DateTime::UNIX_EPOCH };
    assert_eq!((expired.status(false), expired.status(true)), (Status::TimeInvalid, Status::IssuerTimeInvalid));
    let of_issuer = RefusalCause { flaw: expired, at_fault: Some("CN=Plant CA".to_owned()) };
    assert_eq!(of_issuer.status(), Status::IssuerTimeInvalid);
    assert!(of_issuer.explain(Language::En).starts_with("Its issuer CN=Plant CA is at fault: it was valid until 1970"));
}

#[test]
fn a_refusal_without_a_cause_is_explained_by_its_status() {
    assert_eq!(explain_refusal(Status::Untrusted, None, Language::En), Status::Untrusted.explain(Language::En));
}

#[test]
fn texts_of_strangers_command_no_terminal() {
    let told = CertificateFlaw::IssuerMissing { issuer: "\u{1b}[2J".repeat(1000) };
    let said = told.explain(Language::En);
    assert!(!said.contains(char::is_control) && said.len() < 5000, "{}", said.len());
}
