use super::{CertificateRejection, PeerRole, PresentedCertificate, TrustLists, TrustPolicy, names, policies};
use crate::model::SecurityPolicy;
use crate::pki::{Certificate, CertificateFlaw as Flaw, rules};

/// The steps of OPC 10000-4 §6.1.3, in its order: a chain that fails at a later one came further.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum ValidationStep {
    Structure,
    Chain,
    Signature,
    /// Name constraints and certificate policies (RFC 5280 §6.1).
    Constraints,
    Policy,
    TrustList,
    Validity,
    HostName,
    Uri,
    Usage,
    FindRevocationList,
    Revocation,
}

pub(super) type StepFailure = (ValidationStep, CertificateRejection);

/// Step 1, of one certificate.
pub(super) fn structure(certificate: &Certificate, depth: usize) -> Result<(), CertificateRejection> {
    rules::structure_flaw(certificate).map_or(Ok(()), |flaw| Err(CertificateRejection::new(flaw, certificate, depth)))
}

/// Steps 4 to 9, of a chain that is complete and whose signatures are right.
pub(super) fn chain(
    chain: &[&Certificate],
    lists: &TrustLists,
    presented: &PresentedCertificate<'_>,
    policy: &TrustPolicy,
) -> Result<(), StepFailure> {
    constraints(chain)?;
    for (depth, certificate) in chain.iter().enumerate() {
        let flaw = strength_flaw(certificate, depth > 0, presented.security_policy, policy);
        at(ValidationStep::Policy, certificate, depth, flaw)?;
    }
    let Some(leaf) = chain.first() else { return Ok(()) };
    trust(chain, lists)?;
    validity(chain, presented, policy)?;
    at(ValidationStep::HostName, leaf, 0, presented.host.and_then(|host| rules::host_flaw(leaf, &[host])))?;
    let uri = presented.application_uri.and_then(|announced| rules::application_uri_flaw(leaf, Some(announced)));
    at(ValidationStep::Uri, leaf, 0, uri)?;
    at(ValidationStep::Usage, leaf, 0, application_usage_flaw(leaf, chain.len() > 1, presented.role, policy))?;
    issuers(chain, presented.role)
}

/// Steps 4 to 6 and 9, of the chain of an authority, or of the certificate that signs its revocation lists.
pub(super) fn authority(
    chain: &[&Certificate],
    lists: &TrustLists,
    presented: &PresentedCertificate<'_>,
    policy: &TrustPolicy,
) -> Result<(), StepFailure> {
    constraints(chain)?;
    for (depth, certificate) in chain.iter().enumerate() {
        // What applications need of their own keys is not asked of it.
        let flaw = strength_flaw(certificate, true, presented.security_policy, policy);
        at(ValidationStep::Policy, certificate, depth, flaw)?;
    }
    trust(chain, lists)?;
    validity(chain, presented, policy)?;
    issuers(chain, presented.role)
}

fn constraints(chain: &[&Certificate]) -> Result<(), StepFailure> {
    names::check(chain)
        .and_then(|()| policies::check(chain))
        .map_err(|rejection| (ValidationStep::Constraints, rejection))
}

/// Some certificate of the chain must be trusted.
fn trust(chain: &[&Certificate], lists: &TrustLists) -> Result<(), StepFailure> {
    match chain.first() {
        Some(leaf) if !chain.iter().any(|certificate| lists.is_trusted(certificate)) => {
            Err((ValidationStep::TrustList, CertificateRejection::new(Flaw::Untrusted, leaf, 0)))
        }
        _ => Ok(()),
    }
}

fn validity(
    chain: &[&Certificate],
    presented: &PresentedCertificate<'_>,
    policy: &TrustPolicy,
) -> Result<(), StepFailure> {
    if policy.allow_expired_certificates {
        return Ok(());
    }
    let mut all = chain.iter().enumerate();
    all.try_for_each(|(depth, one)| at(ValidationStep::Validity, one, depth, rules::validity_flaw(one, presented.now)))
}

fn issuers(chain: &[&Certificate], role: PeerRole) -> Result<(), StepFailure> {
    (1..chain.len()).try_for_each(|depth| {
        let issuer = chain[depth];
        let flaw = rules::issuer_usage_flaw(issuer, role).or_else(|| rules::path_length_flaw(issuer, &chain[1..depth]));
        at(ValidationStep::Usage, issuer, depth, flaw)
    })
}

fn at(step: ValidationStep, certificate: &Certificate, depth: usize, flaw: Option<Flaw>) -> Result<(), StepFailure> {
    flaw.map_or(Ok(()), |flaw| Err((step, CertificateRejection::new(flaw, certificate, depth))))
}

/// Step 4, of one certificate.
fn strength_flaw(
    certificate: &Certificate,
    is_issuer: bool,
    security_policy: Option<SecurityPolicy>,
    policy: &TrustPolicy,
) -> Option<Flaw> {
    rules::key_kind_flaw(certificate, is_issuer)
        .or_else(|| rules::key_length_flaw(certificate, is_issuer, security_policy))
        .or_else(|| rules::hash_flaw(certificate, security_policy, policy.allow_sha1))
}

/// Step 9, of the application's certificate.
fn application_usage_flaw(leaf: &Certificate, is_issued: bool, role: PeerRole, policy: &TrustPolicy) -> Option<Flaw> {
    rules::authority_flaw(leaf, is_issued || !leaf.is_self_signed())
        .or_else(|| rules::key_usage_flaw(leaf).filter(|flaw| !policy.excuses_key_usage(flaw)))
        .or_else(|| rules::role_flaw(leaf, role).filter(|_| !policy.allow_any_usage))
}

/// Whether a certificate can be used by an application, or by an authority, regardless of its names and dates: steps 1, 4 and
/// 9, and step 3 if it is self-signed.
pub(super) fn lasting_flaw(certificate: &Certificate, is_authority: bool, role: PeerRole) -> Option<Flaw> {
    let policy = TrustPolicy::default();
    rules::structure_flaw(certificate)
        .or_else(|| strength_flaw(certificate, is_authority, None, &policy))
        .or_else(|| rules::self_signature_flaw(certificate, is_authority))
        .or_else(|| {
            if is_authority {
                rules::issuer_usage_flaw(certificate, role)
            } else {
                application_usage_flaw(certificate, false, role, &policy)
            }
        })
}

/// Whether a certificate is that of the application with this ApplicationUri (OPC 10000-4 §6.1.3, step 8).
pub fn check_application_uri(leaf: &Certificate, announced: &str) -> Result<(), CertificateRejection> {
    rules::application_uri_flaw(leaf, Some(announced)).map_or(Ok(()), |flaw| Err(CertificateRejection::of(flaw, leaf)))
}
