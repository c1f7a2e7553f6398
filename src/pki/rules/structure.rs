use crate::pki::{Certificate, CertificateFlaw};

/// Critical extensions that OpenSSL supports and small OPC UA stacks do not.
const RARELY_SUPPORTED: [&str; 5] =
    ["nameConstraints", "policyMappings", "policyConstraints", "inhibitAnyPolicy", "cRLDistributionPoints"];

/// An extension that is critical and not supported or contradicts its definition (RFC 5280 §4.2), or a validity that ends
/// before it begins.
pub(in crate::pki) fn structure_flaw(certificate: &Certificate) -> Option<CertificateFlaw> {
    let ends_early = certificate.not_after() < certificate.not_before();
    let not_understood = certificate.facts().extensions.not_understood.clone();
    not_understood.or_else(|| ends_early.then_some(CertificateFlaw::EndsBeforeItBegins))
}

/// Critical extensions that are supported here, but not by every OPC UA client. OPC 10000-4 does not forbid them.
pub(in crate::pki) fn rare_critical_extensions(certificate: &Certificate) -> impl Iterator<Item = CertificateFlaw> {
    let critical = certificate.facts().extensions.critical.iter();
    let rare = critical.filter(|extension| RARELY_SUPPORTED.contains(&extension.as_str()));
    rare.map(|extension| CertificateFlaw::RareCriticalExtension { extension: extension.clone() })
}
