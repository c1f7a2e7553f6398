use std::collections::BTreeSet;

use chrono::DateTime;
use opcua_configurator::model::{Language, SecurityPolicy};
use opcua_configurator::pki::{Certificate, Csr, ExpectedServer, MAX_CERTIFICATE_BYTES, check_import};

use super::assert_printable;

/// [`Certificate::from_any`]: what was read is read again in both forms, can be judged, and shows no control character.
pub fn certificate(bytes: &[u8]) {
    let Ok(certificate) = Certificate::from_any(bytes) else { return };
    assert_certificate(&certificate);
}

pub(super) fn assert_certificate(certificate: &Certificate) {
    assert!(certificate.der().len() <= MAX_CERTIFICATE_BYTES);
    assert_eq!(Certificate::from_any(certificate.der()).as_ref(), Ok(certificate));
    assert_eq!(Certificate::from_any(certificate.to_pem().as_bytes()).as_ref(), Ok(certificate));
    let summary = certificate.summary();
    for text in [&summary.issued_to, &summary.issued_by].into_iter().chain(&summary.application_uri) {
        assert_printable(text);
    }
    let policies = BTreeSet::from(SecurityPolicy::ALL);
    let hosts = ["192.168.10.1".to_owned(), "robot".to_owned()];
    let expected = ExpectedServer {
        application_uri: "urn:EpsonRC:SN0000123",
        hosts: &hosts,
        policies: &policies,
        now: DateTime::from_timestamp(1_900_000_000, 0).expect("a time"),
    };
    for finding in check_import(certificate, &expected) {
        for language in Language::ALL {
            assert_printable(&finding.explain(language));
        }
    }
}

/// [`Csr::from_any`]: what was read is read again in both forms.
pub fn certificate_request(bytes: &[u8]) {
    let Ok(csr) = Csr::from_any(bytes) else { return };
    assert!(csr.der().len() <= MAX_CERTIFICATE_BYTES && csr.key_bits() >= 1024);
    assert_eq!(Csr::from_any(csr.der()).as_ref(), Ok(&csr));
    assert_eq!(Csr::from_any(csr.to_pem().as_bytes()).as_ref(), Ok(&csr));
    if let Some(name) = csr.common_name() {
        assert_printable(name);
    }
}
