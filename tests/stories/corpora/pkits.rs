//! The Public Key Interoperability Test Suite of NIST (PKITS 1.0.1, https://csrc.nist.gov/projects/pki-testing), as far
//! as it is about changed keys and about revocation lists for some certificates: sections 4.5 and 4.14.
//!
//! The certificates and lists are works of the United States government, in the public domain. The name of a certificate
//! says what becomes of its chain; all authorities and lists are at hand at once, as they are in a controller.

use std::path::Path;

use opcua_configurator::model::CertificateStatus::{self, *};
use opcua_configurator::pki::{
    Certificate, CertificateRejection, Crl, PeerRole, PresentedCertificate, TrustLists, TrustPolicy,
};

/// What is not valid, and how.
const INVALID: &[(&str, CertificateStatus)] = &[
    ("InvalidBasicSelfIssuedCRLSigningKeyTest7EE", Revoked),
    // The key that issued it may only sign lists.
    ("InvalidBasicSelfIssuedCRLSigningKeyTest8EE", IssuerUseNotAllowed),
    ("InvalidBasicSelfIssuedNewWithOldTest5EE", Revoked),
    ("InvalidBasicSelfIssuedOldWithNewTest2EE", Revoked),
    ("InvaliddistributionPointTest2EE", Revoked),
    ("InvaliddistributionPointTest3EE", RevocationUnknown),
    ("InvaliddistributionPointTest6EE", Revoked),
    ("InvaliddistributionPointTest8EE", RevocationUnknown),
    ("InvaliddistributionPointTest9EE", RevocationUnknown),
    ("InvalidonlyContainsAttributeCertsTest14EE", RevocationUnknown),
    ("InvalidonlyContainsCACertsTest12EE", RevocationUnknown),
    ("InvalidonlySomeReasonsTest15EE", Revoked),
    ("InvalidonlySomeReasonsTest16EE", Revoked),
    ("InvalidonlySomeReasonsTest17EE", RevocationUnknown),
    ("InvalidonlySomeReasonsTest20EE", Revoked),
    ("InvalidonlySomeReasonsTest21EE", Revoked),
];

fn read(folder: &str) -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/pkits").join(folder);
    let mut files: Vec<(String, Vec<u8>)> = std::fs::read_dir(&folder)
        .expect("the folder is there")
        .map(|entry| {
            let path = entry.expect("an entry").path();
            let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
            (name, std::fs::read(&path).expect("readable"))
        })
        .collect();
    files.sort();
    files
}

#[test]
fn every_chain_of_pkits_is_valid_or_invalid_as_it_is_called() {
    let certificate = |(name, der): (String, Vec<u8>)| (name, Certificate::from_der(&der).expect("a certificate"));
    let crls: Vec<Crl> = read("crls").iter().map(|(_, der)| Crl::from_der(der).expect("a list")).collect();
    let certificates = read("certs").into_iter().map(certificate);
    let (ends, others): (Vec<_>, Vec<_>) = certificates.partition(|(name, _)| name.ends_with("EE"));
    let (anchors, issuers): (Vec<_>, Vec<_>) =
        others.into_iter().partition(|(name, _)| name.starts_with("TrustAnchor"));
    let all = |named: Vec<(String, Certificate)>| named.into_iter().map(|(_, certificate)| certificate).collect();
    let lists = TrustLists::new(all(anchors), all(issuers), crls);
    let mut wrong = Vec::new();
    for (name, certificate) in &ends {
        let is_invalid = INVALID.iter().any(|(invalid, _)| invalid == name);
        assert_eq!(is_invalid, name.starts_with("Invalid"), "the table does not fit {name}");
        let presented = PresentedCertificate {
            certificate,
            chain: &[],
            role: PeerRole::Either,
            now: "2020-01-01T00:00:00Z".parse().expect("a time"),
            application_uri: None,
            host: None,
            security_policy: None,
        };
        let judged = lists.validate(&presented, &TrustPolicy::default());
        let expected = INVALID.iter().find(|(invalid, _)| invalid == name).map(|(_, status)| *status);
        if judged.as_ref().err().map(CertificateRejection::status) != expected {
            wrong.push(format!("{name}: {judged:?} instead of {expected:?}"));
        }
    }
    assert!(ends.len() > 20, "{} chains", ends.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
