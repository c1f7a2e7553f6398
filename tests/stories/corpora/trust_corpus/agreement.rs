//! What is said when a server certificate is imported and what a client says when the server shows it agree, for every
//! certificate of the corpus and of `tests/cases`.

use std::collections::BTreeSet;
use std::path::Path;

use chrono::{DateTime, Utc};
use opcua_configurator::model::SecurityPolicy;
use opcua_configurator::pki::{
    Certificate, CertificateFlaw, ExpectedServer, PeerRole, PresentedCertificate, Severity, TrustLists, TrustPolicy,
    check_import, check_server, read_bundle,
};

use super::table;
use super::world::APPLICATION_URI;

/// `None` if they agree.
fn disagreement(certificate: &Certificate, expected: &ExpectedServer<'_>) -> Option<String> {
    let import = check_import(certificate, expected);
    let server = check_server(certificate, Some(certificate), expected, expected.now);
    let says = |what: &str| Some(format!("{what}: import says {import:?}, the client {server:?}"));
    if let Some(refused) = &server.refused
        && !import.iter().any(|finding| finding.status() == refused.status())
    {
        return says("the import does not say what the client refuses");
    }
    let is_about_the_controller = |flaw: &CertificateFlaw| matches!(flaw, CertificateFlaw::KeyLengthNotTicked { .. });
    let is_error = |place: &[opcua_configurator::pki::CertificateFinding]| {
        place.iter().any(|finding| finding.severity == Severity::Error && !is_about_the_controller(&finding.flaw))
    };
    if is_error(&import) && server.refused.is_none() {
        return says("the client accepts an error of the import");
    }
    if is_error(&server.findings) != server.refused.is_some()
        && !import.iter().any(|finding| is_about_the_controller(&finding.flaw))
    {
        return says("the client's findings contradict its answer");
    }
    let depends_on_the_client =
        |flaw: &CertificateFlaw| matches!(flaw, CertificateFlaw::HostName { .. } | CertificateFlaw::NotYetValid { .. });
    if server.refused.as_ref().is_some_and(|refused| !depends_on_the_client(&refused.flaw))
        && import.iter().all(|finding| finding.severity == Severity::Warning)
    {
        return says("the client refuses what is only a warning of the import");
    }
    // A client that excuses nothing may refuse more, but nothing that the import does not mention.
    let lists = TrustLists::new(vec![certificate.clone()], Vec::new(), Vec::new());
    let allowed =
        TrustPolicy { allow_incomplete_chain: true, allow_unknown_revocation: true, ..TrustPolicy::default() };
    let presented = PresentedCertificate {
        certificate,
        chain: &[],
        role: PeerRole::Server,
        now: expected.now,
        application_uri: Some(expected.application_uri),
        host: expected.hosts.first().map(String::as_str),
        security_policy: expected.policies.last().copied(),
    };
    let strict = lists.validate(&presented, &allowed).err();
    if let Some(strict) = strict
        && !import.iter().any(|finding| finding.status() == strict.status())
    {
        return says(&format!("the import does not say what a strict client refuses, {strict:?}"));
    }
    None
}

fn disagreements(name: &str, certificate: &Certificate, now: DateTime<Utc>, uri: &str, host: &str) -> Vec<String> {
    let hosts = [host.to_owned()];
    let some = [
        &[][..],
        &[SecurityPolicy::None],
        &[SecurityPolicy::Basic256],
        &[SecurityPolicy::Basic256Sha256],
        &SecurityPolicy::ALL,
    ];
    let of_policies = |policies: &[SecurityPolicy]| {
        let policies: BTreeSet<SecurityPolicy> = policies.iter().copied().collect();
        let expected = ExpectedServer { application_uri: uri, hosts: &hosts, policies: &policies, now };
        disagreement(certificate, &expected).map(|why| format!("{name}, {policies:?}: {why}"))
    };
    some.into_iter().filter_map(of_policies).collect()
}

#[test]
fn import_and_client_agree_about_every_certificate_of_the_corpus() {
    let (mut judged, mut wrong) = (0, Vec::new());
    for case in table::cases() {
        let Ok(leaf) = Certificate::from_der(&case.world.built().leaf) else { continue };
        let uri = case.world.uri.unwrap_or(APPLICATION_URI);
        let host = case.world.host.unwrap_or("192.168.10.1");
        wrong.extend(disagreements(&case.name, &leaf, super::forge::now(), uri, host));
        judged += 1;
    }
    assert!(judged >= 280, "{judged} certificates");
    assert!(wrong.is_empty(), "{} of {judged}:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn import_and_client_agree_about_every_certificate_of_practice() {
    let (mut judged, mut wrong) = (0, Vec::new());
    let now = "2026-12-01T00:00:00Z".parse().expect("a time");
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let Ok(bundle) = read_bundle(&std::fs::read(&path).expect("a file")) else { continue };
            for certificate in &bundle.certificates {
                let uri = certificate.application_uri().unwrap_or_else(|| APPLICATION_URI.to_owned());
                for (uri, host) in [(uri.as_str(), "127.0.0.1"), (APPLICATION_URI, "other")] {
                    wrong.extend(disagreements(&path.display().to_string(), certificate, now, uri, host));
                }
                judged += 1;
            }
        }
    }
    assert!(judged >= 30, "{judged} certificates");
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}
