use chrono::DateTime;
use opcua_configurator::model::{Language, SecurityPolicy};
use opcua_configurator::pki::{
    Bundle, Certificate, Crl, MAX_BUNDLE_BYTES, MAX_CRL_BYTES, PeerRole, PresentedCertificate, TrustLists, TrustPolicy,
    read_bundle,
};

use super::assert_printable;
use super::certificates::assert_certificate;

/// [`Crl::from_der`]: what was read is read again, can be asked, and shows no control character.
pub fn revocation_list(bytes: &[u8]) {
    if let Ok(crl) = Crl::from_der(bytes) {
        assert_crl(&crl);
    }
}

/// [`read_bundle`]: everything in it is whole.
pub fn bundle(bytes: &[u8]) {
    let Ok(Bundle { certificates, crls }) = read_bundle(bytes) else { return };
    assert!(bytes.len() <= MAX_BUNDLE_BYTES && (1..=1000).contains(&(certificates.len() + crls.len())));
    certificates.iter().for_each(assert_certificate);
    crls.iter().for_each(assert_crl);
    let ders = certificates.iter().map(Certificate::der).chain(crls.iter().map(Crl::der)).collect::<Vec<_>>();
    assert_eq!(read_bundle(&ders.concat()), Ok(Bundle { certificates, crls }), "one behind the other");
}

/// [`TrustLists::validate`] of the first certificate of a bundle. Before the bundle stand four bytes: which of the
/// certificates are trusted, which are issuers, which were sent (bit by bit, from the second on and round again), and
/// what the policy allows.
///
/// An empty list trusts no certificate, a chain ends in a trusted one, and a chain that passes a strict policy passes a
/// lax one.
pub fn trust(bytes: &[u8]) {
    let [trusted, issuers, sent, allowed, bundle @ ..] = bytes else { return };
    let Ok(Bundle { certificates, crls }) = read_bundle(bundle) else { return };
    let Some(certificate) = certificates.first() else { return };
    let chosen = |bits: u8| -> Vec<Certificate> {
        let others = certificates.iter().cycle().skip(1).take(certificates.len()).enumerate();
        others.filter(|(number, _)| bits >> (number % 8) & 1 == 1).map(|(_, chosen)| chosen.clone()).collect()
    };
    let (trusted, issuers, sent) = (chosen(*trusted), chosen(*issuers), chosen(*sent));
    let allows = |bit: u8| allowed >> bit & 1 == 1;
    let policy = TrustPolicy {
        allow_unknown_revocation: allows(0),
        allow_expired_crls: allows(1),
        allow_expired_certificates: allows(2),
        allow_sha1: allows(3),
        allow_incomplete_chain: allows(4),
        allow_any_usage: allows(5),
        allow_partial_key_usage: allows(6),
    };
    let presented = PresentedCertificate {
        certificate,
        chain: &sent,
        role: if allows(6) { PeerRole::Client } else { PeerRole::Either },
        now: DateTime::from_timestamp(1_900_000_000, 0).expect("a time"),
        application_uri: None,
        host: None,
        security_policy: allows(7).then_some(SecurityPolicy::Basic256),
    };
    let lists = TrustLists::new(trusted, issuers.clone(), crls.clone());
    let verdict = lists.validate(&presented, &policy);
    match &verdict {
        Ok(chain) => {
            assert!(chain.first() == Some(certificate) && chain.len() <= 10);
            assert!(chain.iter().any(|member| lists.is_trusted(member)));
            for pair in chain.windows(2) {
                assert!(pair[0].verify_signed_by(&pair[1]));
            }
            let lax = TrustPolicy {
                allow_unknown_revocation: true,
                allow_expired_crls: true,
                allow_expired_certificates: true,
                allow_sha1: true,
                allow_incomplete_chain: true,
                allow_any_usage: true,
                allow_partial_key_usage: true,
            };
            assert!(lists.validate(&presented, &lax).is_ok());
        }
        Err(rejection) => {
            assert_printable(&rejection.cause().explain(Language::En));
            assert_printable(&rejection.subject);
        }
    }
    assert_eq!(lists.validate(&presented, &policy), verdict, "asked again");
    let nobody = TrustLists::new(vec![], issuers, crls);
    assert!(nobody.validate(&presented, &policy).is_err());
}

fn assert_crl(crl: &Crl) {
    assert!(crl.der().len() <= MAX_CRL_BYTES);
    assert_eq!(Crl::from_der(crl.der()).as_ref(), Ok(crl));
    assert!(!crl.is_newer_than(crl) && crl.has_same_scope_as(crl));
    let summary = crl.summary();
    assert_printable(&summary.issuer);
    assert_printable(crl.issuer());
    assert_printable(crl.signature_algorithm());
    crl.unusable().into_iter().for_each(|why| assert_printable(&why.to_string()));
    let serials: Vec<String> = crl.entries().map(|(serial, _)| serial).collect();
    assert_eq!(serials.len(), summary.entries);
}
