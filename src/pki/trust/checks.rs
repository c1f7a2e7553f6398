use chrono::{DateTime, Utc};

use super::policy::Strength;
use super::{Presented, Rejection, Role, TrustLists, TrustPolicy, names, policies};
use crate::model::SecurityPolicy;
use crate::pki::flaw::quoted;
use crate::pki::signature::{Hash, PublicKey};
use crate::pki::{AlternativeName, Certificate, CertificateFlaw as Flaw, ExtendedKeyUsage, KeyUsage, is_authority};

/// The steps of OPC 10000-4 §6.1.3, in its order: a chain that fails at a later one came further.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Step {
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

pub(super) type Failure = (Step, Rejection);

/// Step 1, of one certificate.
pub(super) fn structure(certificate: &Certificate, depth: usize) -> Result<(), Rejection> {
    structure_flaw(certificate).map_or(Ok(()), |flaw| Err(Rejection::new(flaw, certificate, depth)))
}

/// What is wrong with the certificate by itself.
pub(in crate::pki) fn structure_flaw(certificate: &Certificate) -> Option<Flaw> {
    let ends_early = certificate.not_after() < certificate.not_before();
    let not_understood = certificate.facts().extensions.not_understood.clone();
    not_understood.or_else(|| ends_early.then_some(Flaw::EndsBeforeItBegins))
}

/// Steps 4 to 9, of a chain that is complete and whose signatures are right.
pub(super) fn chain(
    chain: &[&Certificate],
    lists: &TrustLists,
    presented: &Presented<'_>,
    policy: &TrustPolicy,
) -> Result<(), Failure> {
    constraints(chain)?;
    for (depth, certificate) in chain.iter().enumerate() {
        let flaw = strength_flaw(certificate, depth > 0, presented.security_policy, policy);
        at(Step::Policy, certificate, depth, flaw)?;
    }
    let Some(leaf) = chain.first() else { return Ok(()) };
    trust(chain, lists)?;
    validity(chain, presented, policy)?;
    at(Step::HostName, leaf, 0, presented.host.and_then(|host| host_flaw(leaf, &[host])))?;
    at(Step::Uri, leaf, 0, presented.application_uri.and_then(|announced| uri_flaw(leaf, announced)))?;
    at(Step::Usage, leaf, 0, application_flaw(leaf, chain.len() > 1, presented.role, policy))?;
    issuers(chain, presented.role)
}

/// Steps 4 to 6 and 9, of the chain of an authority, or of the certificate that signs its revocation lists.
pub(super) fn authority(
    chain: &[&Certificate],
    lists: &TrustLists,
    presented: &Presented<'_>,
    policy: &TrustPolicy,
) -> Result<(), Failure> {
    constraints(chain)?;
    for (depth, certificate) in chain.iter().enumerate() {
        // What applications need of their own keys is not asked of it.
        let flaw = strength_flaw(certificate, true, presented.security_policy, policy);
        at(Step::Policy, certificate, depth, flaw)?;
    }
    trust(chain, lists)?;
    validity(chain, presented, policy)?;
    issuers(chain, presented.role)
}

fn constraints(chain: &[&Certificate]) -> Result<(), Failure> {
    names::check(chain).and_then(|()| policies::check(chain)).map_err(|rejection| (Step::Constraints, rejection))
}

/// Some certificate of the chain must be trusted.
fn trust(chain: &[&Certificate], lists: &TrustLists) -> Result<(), Failure> {
    match chain.first() {
        Some(leaf) if !chain.iter().any(|certificate| lists.is_trusted(certificate)) => {
            Err((Step::TrustList, Rejection::new(Flaw::Untrusted, leaf, 0)))
        }
        _ => Ok(()),
    }
}

fn validity(chain: &[&Certificate], presented: &Presented<'_>, policy: &TrustPolicy) -> Result<(), Failure> {
    if policy.allow_expired_certificates {
        return Ok(());
    }
    let mut all = chain.iter().enumerate();
    all.try_for_each(|(depth, one)| at(Step::Validity, one, depth, validity_flaw(one, presented.now)))
}

fn issuers(chain: &[&Certificate], role: Role) -> Result<(), Failure> {
    (1..chain.len()).try_for_each(|depth| at(Step::Usage, chain[depth], depth, issuer_flaw(chain, depth, role)))
}

fn at(step: Step, certificate: &Certificate, depth: usize, flaw: Option<Flaw>) -> Result<(), Failure> {
    flaw.map_or(Ok(()), |flaw| Err((step, Rejection::new(flaw, certificate, depth))))
}

/// What of the key and the signature the security policy does not take.
pub(super) fn strength_flaw(
    certificate: &Certificate,
    is_issuer: bool,
    security_policy: Option<SecurityPolicy>,
    policy: &TrustPolicy,
) -> Option<Flaw> {
    let wanted = Strength::of(security_policy);
    match &certificate.facts().public_key {
        PublicKey::Rsa { exponent_fits: false, .. } => return Some(Flaw::KeyExponent),
        PublicKey::Rsa { bits, .. } if *bits < wanted.min_rsa_bits => {
            return Some(Flaw::KeyTooShort { bits: *bits, least: wanted.min_rsa_bits });
        }
        PublicKey::Rsa { bits, .. } if !is_issuer && *bits > wanted.max_rsa_bits => {
            return Some(Flaw::KeyTooLong { bits: *bits, most: wanted.max_rsa_bits });
        }
        PublicKey::Rsa { .. } => {}
        // A CA may sign with what it likes, as long as it can be checked.
        PublicKey::Ec { curve: Some(_), .. } if is_issuer => {}
        PublicKey::Ec { .. } | PublicKey::Other { .. } => return Some(Flaw::KeyNotRsa),
    }
    let algorithm = &certificate.facts().signature_algorithm;
    let accepted = accepts(algorithm.hash(), security_policy, policy);
    (!accepted).then(|| Flaw::WeakHash { algorithm: algorithm.name().to_owned() })
}

/// Whether a signature with that hash is good enough.
pub(super) fn accepts_hash(hash: Option<Hash>, presented: &Presented<'_>, policy: &TrustPolicy) -> bool {
    accepts(hash, presented.security_policy, policy)
}

fn accepts(hash: Option<Hash>, security_policy: Option<SecurityPolicy>, policy: &TrustPolicy) -> bool {
    match hash {
        Some(Hash::Md5) | None => false,
        Some(Hash::Sha1) => policy.allow_sha1 || Strength::of(security_policy).sha1,
        Some(Hash::Sha256 | Hash::Sha384 | Hash::Sha512) => true,
    }
}

pub(in crate::pki) fn validity_flaw(certificate: &Certificate, now: DateTime<Utc>) -> Option<Flaw> {
    let (from, until) = (certificate.not_before(), certificate.not_after());
    if now < from {
        Some(Flaw::NotYetValid { from, now })
    } else if now.timestamp() > until.timestamp() {
        // The last second counts whole.
        Some(Flaw::Expired { until, now })
    } else {
        None
    }
}

/// One of the hosts is enough.
pub(in crate::pki) fn host_flaw(leaf: &Certificate, hosts: &[impl AsRef<str>]) -> Option<Flaw> {
    if hosts.iter().any(|host| leaf.names_host(host.as_ref())) {
        return None;
    }
    let is_host = |name: &&AlternativeName| matches!(name, AlternativeName::Dns(_) | AlternativeName::Ip(_));
    let names = leaf.alternative_names().iter().filter(is_host).take(MOST_NAMES);
    let names = names.map(|name| match name {
        AlternativeName::Dns(host) => quoted(host),
        other => other.to_string().trim_start_matches("IP:").to_owned(),
    });
    let hosts = hosts.iter().map(|host| quoted(host.as_ref()));
    Some(Flaw::HostName { hosts: hosts.collect(), names: names.collect() })
}

/// Whether a certificate is that of the application with this ApplicationUri (OPC 10000-4 §6.1.3, step 8).
pub fn check_application_uri(leaf: &Certificate, announced: &str) -> Result<(), Rejection> {
    uri_flaw(leaf, announced).map_or(Ok(()), |flaw| Err(Rejection::of(flaw, leaf)))
}

pub(in crate::pki) fn uri_flaw(leaf: &Certificate, announced: &str) -> Option<Flaw> {
    match leaf.facts().extensions.application_uri() {
        None => Some(Flaw::UriMissing { announced: Some(quoted(announced)) }),
        Some(found) if !found.is_ascii() => Some(Flaw::UriNotAscii { uri: quoted(found) }),
        Some(_) if !announced.is_ascii() => Some(Flaw::UriNotAscii { uri: quoted(announced) }),
        Some(found) if found == announced => None,
        Some(found) => Some(Flaw::UriDiffers { certificate: quoted(found), announced: quoted(announced) }),
    }
}

/// OPC 10000-6 §6.2.2: what the certificate of an application must be for.
pub(in crate::pki) fn application_flaw(
    leaf: &Certificate,
    is_issued: bool,
    role: Role,
    policy: &TrustPolicy,
) -> Option<Flaw> {
    if is_issued && leaf.basic_constraints().is_some_and(|constraints| constraints.ca) {
        return Some(Flaw::CertificateOfAuthority);
    }
    if policy.allow_any_usage {
        return None;
    }
    key_usage_flaw(leaf).or_else(|| role_flaw(leaf, role))
}

pub(in crate::pki) fn key_usage_flaw(leaf: &Certificate) -> Option<Flaw> {
    let missing: Vec<KeyUsage> = match leaf.key_usages() {
        Some(usages) => NEEDED.into_iter().filter(|usage| !usages.contains(usage)).collect(),
        None => NEEDED.to_vec(),
    };
    if missing.is_empty() {
        None
    } else if is_authority(leaf, []) {
        Some(Flaw::CertificateOfAuthority)
    } else if leaf.key_usages().is_none() {
        Some(Flaw::KeyUsageMissing)
    } else {
        Some(Flaw::KeyUsageLacks { missing })
    }
}

pub(in crate::pki) fn role_flaw(leaf: &Certificate, role: Role) -> Option<Flaw> {
    excluded_role(leaf, role).then_some(Flaw::NotForRole { role })
}

/// Whether the extended key usages leave out the role.
fn excluded_role(certificate: &Certificate, role: Role) -> bool {
    let Some(purposes) = certificate.extended_key_usages() else { return false };
    let allows = |purpose| purposes.contains(&purpose) || purposes.contains(&ExtendedKeyUsage::AnyExtendedKeyUsage);
    let (client, server) = (allows(ExtendedKeyUsage::ClientAuth), allows(ExtendedKeyUsage::ServerAuth));
    match role {
        Role::Client => !client,
        Role::Server => !server,
        Role::Either => !client && !server,
    }
}

/// Whether the certificate at that depth may have issued what stands below it (RFC 5280 §6.1.4).
fn issuer_flaw(chain: &[&Certificate], depth: usize, role: Role) -> Option<Flaw> {
    let certificate = chain[depth];
    if let Some(flaw) = may_issue_flaw(certificate, role) {
        return Some(flaw);
    }
    let most = certificate.basic_constraints()?.path_length?;
    // A CA that issued a new certificate to itself is the same CA, and does not count.
    let is_other = |below: &&&Certificate| below.facts().subject_folded != below.facts().issuer_folded;
    let found = chain[1..depth].iter().filter(is_other).count();
    (found as u64 > u64::from(most)).then_some(Flaw::TooManyAuthoritiesBelow { most, found })
}

/// Whether it may issue any certificates for that role.
pub(super) fn may_issue_flaw(certificate: &Certificate, role: Role) -> Option<Flaw> {
    if !certificate.basic_constraints().is_some_and(|constraints| constraints.ca) {
        return Some(Flaw::NotAnAuthority);
    }
    if !certificate.is_ca() {
        return Some(Flaw::MayNotIssue);
    }
    // Extended key usages of a CA say what its certificates are for; OpenSSL and Windows read them so as well.
    excluded_role(certificate, role).then_some(Flaw::MayNotIssueFor { role })
}

/// How many names of a certificate a message lists.
const MOST_NAMES: usize = 20;
const NEEDED: [KeyUsage; 4] =
    [KeyUsage::DigitalSignature, KeyUsage::NonRepudiation, KeyUsage::KeyEncipherment, KeyUsage::DataEncipherment];
