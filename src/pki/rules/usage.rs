use crate::pki::{Certificate, CertificateFlaw, ExtendedKeyUsage, KeyUsage, PeerRole, is_authority};

/// What an application's key is used for (OPC 10000-6 §6.2.2).
const NEEDED: [KeyUsage; 4] =
    [KeyUsage::DigitalSignature, KeyUsage::NonRepudiation, KeyUsage::KeyEncipherment, KeyUsage::DataEncipherment];

/// CA:TRUE in a certificate that another authority issued to an application.
///
/// A self-signed certificate of an application may have it (OPC 10000-6 §6.2.2). `is_issued`: whether an issuer stands
/// above it.
pub(in crate::pki) fn authority_flaw(certificate: &Certificate, is_issued: bool) -> Option<CertificateFlaw> {
    (is_issued && says_ca(certificate)).then_some(CertificateFlaw::CertificateOfAuthority)
}

/// CA:TRUE in the self-signed certificate of an application: allowed, but not taken by every client.
pub(in crate::pki) fn claims_to_be_authority(certificate: &Certificate) -> Option<CertificateFlaw> {
    says_ca(certificate).then_some(CertificateFlaw::ClaimsToBeAuthority)
}

fn says_ca(certificate: &Certificate) -> bool {
    certificate.basic_constraints().is_some_and(|constraints| constraints.ca)
}

/// The key usages that an application needs (OPC 10000-6 §6.2.2). Where they are missing from the certificate of an
/// authority, that is the flaw.
pub(in crate::pki) fn key_usage_flaw(certificate: &Certificate) -> Option<CertificateFlaw> {
    let missing: Vec<KeyUsage> = match certificate.key_usages() {
        Some(usages) => NEEDED.into_iter().filter(|usage| !usages.contains(usage)).collect(),
        None => NEEDED.to_vec(),
    };
    if missing.is_empty() {
        None
    } else if is_authority(certificate, []) {
        Some(CertificateFlaw::CertificateOfAuthority)
    } else if certificate.key_usages().is_none() {
        Some(CertificateFlaw::KeyUsageMissing)
    } else {
        Some(CertificateFlaw::KeyUsageLacks { missing })
    }
}

/// Extended key usages that do not contain what the application is (OPC 10000-6 §6.2.2). Without the extension every
/// role is allowed (RFC 5280 §4.2.1.12).
pub(in crate::pki) fn role_flaw(certificate: &Certificate, role: PeerRole) -> Option<CertificateFlaw> {
    excludes_role(certificate, role).then_some(CertificateFlaw::NotForRole { role })
}

/// No extended key usages, which OPC 10000-6 §6.2.2 asks for and most clients do not miss.
pub(in crate::pki) fn extended_key_usage_missing(certificate: &Certificate) -> Option<CertificateFlaw> {
    certificate.extended_key_usages().is_none().then_some(CertificateFlaw::ExtendedKeyUsageMissing)
}

fn excludes_role(certificate: &Certificate, role: PeerRole) -> bool {
    let Some(purposes) = certificate.extended_key_usages() else { return false };
    let allows = |purpose| purposes.contains(&purpose) || purposes.contains(&ExtendedKeyUsage::AnyExtendedKeyUsage);
    let (client, server) = (allows(ExtendedKeyUsage::ClientAuth), allows(ExtendedKeyUsage::ServerAuth));
    match role {
        PeerRole::Client => !client,
        PeerRole::Server => !server,
        PeerRole::Either => !client && !server,
    }
}

/// Whether an authority may issue certificates for that role (RFC 5280 §4.2.1.9, §4.2.1.3). The extended key usages of an
/// authority apply to what it issues, as OpenSSL and Windows read them.
pub(in crate::pki) fn issuer_usage_flaw(certificate: &Certificate, role: PeerRole) -> Option<CertificateFlaw> {
    if !says_ca(certificate) {
        return Some(CertificateFlaw::NotAnAuthority);
    }
    if !certificate.is_ca() {
        return Some(CertificateFlaw::MayNotIssue);
    }
    excludes_role(certificate, role).then_some(CertificateFlaw::MayNotIssueFor { role })
}

/// The path length of an authority (RFC 5280 §4.2.1.9). `below`: the authorities between it and the application's
/// certificate. One that was issued by an authority to itself does not count.
pub(in crate::pki) fn path_length_flaw(certificate: &Certificate, below: &[&Certificate]) -> Option<CertificateFlaw> {
    let most = certificate.basic_constraints()?.path_length?;
    let found = below.iter().filter(|authority| !authority.is_self_signed()).count();
    (found as u64 > u64::from(most)).then_some(CertificateFlaw::TooManyAuthoritiesBelow { most, found })
}

/// Whether the key may sign revocation lists (RFC 5280 §4.2.1.3).
pub(in crate::pki) fn may_sign_lists(certificate: &Certificate) -> bool {
    certificate.key_usages().is_none_or(|usages| usages.contains(&KeyUsage::CrlSign))
}
