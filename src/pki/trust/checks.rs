use chrono::SecondsFormat;

use super::policy::Strength;
use super::{Presented, Rejection, Role, TrustLists, TrustPolicy};
use crate::model::CertificateStatus as Status;
use crate::pki::signature::{Hash, PublicKey};
use crate::pki::{Certificate, ExtendedKeyUsage, KeyUsage};

/// The steps of OPC 10000-4 §6.1.3, in its order: a chain that fails at a later one came further.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Step {
    Structure,
    Chain,
    Signature,
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
    let invalid = |reason: &str| Err(Rejection::new(Status::CertificateInvalid, certificate, depth, reason));
    match &certificate.facts().extensions.not_understood {
        Some(why) => invalid(why),
        None if certificate.not_after() < certificate.not_before() => invalid("it ends before it begins"),
        None => Ok(()),
    }
}

/// Steps 4 to 9, of a chain that is complete and whose signatures are right.
pub(super) fn chain(
    chain: &[&Certificate],
    lists: &TrustLists,
    presented: &Presented<'_>,
    policy: &TrustPolicy,
) -> Result<(), Failure> {
    for (depth, certificate) in chain.iter().enumerate() {
        strength(certificate, depth, presented, policy).map_err(|rejection| (Step::Policy, rejection))?;
    }
    let Some(leaf) = chain.first() else { return Ok(()) };
    if !chain.iter().any(|certificate| lists.is_trusted(certificate)) {
        let reason = "neither it nor any of its issuers is in the trust list";
        return Err((Step::TrustList, Rejection::new(Status::Untrusted, leaf, 0, reason)));
    }
    if !policy.allow_expired_certificates {
        for (depth, certificate) in chain.iter().enumerate() {
            validity(certificate, depth, presented).map_err(|rejection| (Step::Validity, rejection))?;
        }
    }
    host(leaf, presented).map_err(|rejection| (Step::HostName, rejection))?;
    uri(leaf, presented).map_err(|rejection| (Step::Uri, rejection))?;
    application(leaf, chain.len() > 1, presented.role, policy).map_err(|rejection| (Step::Usage, rejection))?;
    for depth in 1..chain.len() {
        issuer(chain, depth, presented.role).map_err(|rejection| (Step::Usage, rejection))?;
    }
    Ok(())
}

fn strength(
    certificate: &Certificate,
    depth: usize,
    presented: &Presented<'_>,
    policy: &TrustPolicy,
) -> Result<(), Rejection> {
    let wanted = Strength::of(presented.security_policy);
    let weak = |reason: String| Err(Rejection::new(Status::PolicyCheckFailed, certificate, depth, reason));
    match &certificate.facts().public_key {
        PublicKey::Rsa { exponent_fits: false, .. } => {
            return weak("its RSA key has an impossible exponent".to_owned());
        }
        PublicKey::Rsa { bits, .. } if *bits < wanted.min_rsa_bits => {
            return weak(format!("its RSA key has {bits} bits; at least {} are needed", wanted.min_rsa_bits));
        }
        PublicKey::Rsa { bits, .. } if depth == 0 && *bits > wanted.max_rsa_bits => {
            return weak(format!("its RSA key has {bits} bits; at most {} are allowed", wanted.max_rsa_bits));
        }
        PublicKey::Rsa { .. } => {}
        // A CA may sign with what it likes, as long as it can be checked.
        PublicKey::Ec { curve: Some(_), .. } if depth > 0 => {}
        PublicKey::Ec { .. } | PublicKey::Other { .. } => {
            return weak("its key is not an RSA key, which the security policies need".to_owned());
        }
    }
    if !accepts_hash(certificate.facts().signature_algorithm.hash(), presented, policy) {
        let name = certificate.facts().signature_algorithm.name();
        return weak(format!("it is signed with {name}, which is too weak"));
    }
    Ok(())
}

/// Whether a signature with that hash is good enough.
pub(super) fn accepts_hash(hash: Option<Hash>, presented: &Presented<'_>, policy: &TrustPolicy) -> bool {
    match hash {
        Some(Hash::Md5) | None => false,
        Some(Hash::Sha1) => policy.allow_sha1 || Strength::of(presented.security_policy).sha1,
        Some(Hash::Sha256 | Hash::Sha384 | Hash::Sha512) => true,
    }
}

fn validity(certificate: &Certificate, depth: usize, presented: &Presented<'_>) -> Result<(), Rejection> {
    let status = if depth == 0 { Status::TimeInvalid } else { Status::IssuerTimeInvalid };
    let text = |time: chrono::DateTime<chrono::Utc>| time.to_rfc3339_opts(SecondsFormat::Secs, true);
    let (now, from, to) = (presented.now, certificate.not_before(), certificate.not_after());
    // The last second counts whole.
    let reason = if now < from {
        format!("it is valid from {} on; it is {}", text(from), text(now))
    } else if now.timestamp() > to.timestamp() {
        format!("it was valid until {}; it is {}", text(to), text(now))
    } else {
        return Ok(());
    };
    Err(Rejection::new(status, certificate, depth, reason))
}

fn host(leaf: &Certificate, presented: &Presented<'_>) -> Result<(), Rejection> {
    match presented.host {
        Some(host) if !leaf.names_host(host) => {
            let reason = format!("it is not for {}, but for {}", crate::pki::name::printable(host), names_of(leaf));
            Err(Rejection::new(Status::HostNameInvalid, leaf, 0, reason))
        }
        _ => Ok(()),
    }
}

fn uri(leaf: &Certificate, presented: &Presented<'_>) -> Result<(), Rejection> {
    let Some(announced) = presented.application_uri else { return Ok(()) };
    let found = leaf.application_uri();
    // A URI is ASCII; anything else may stand for a character that was replaced.
    if announced.is_ascii() && found.as_deref() == Some(announced) {
        return Ok(());
    }
    let reason = match found {
        Some(found) => {
            format!("its application URI is {found}; the application says {}", crate::pki::name::printable(announced))
        }
        None => "it has no application URI".to_owned(),
    };
    Err(Rejection::new(Status::UriInvalid, leaf, 0, reason))
}

/// OPC 10000-6 §6.2.2: what the certificate of an application must be for.
fn application(leaf: &Certificate, is_issued: bool, role: Role, policy: &TrustPolicy) -> Result<(), Rejection> {
    let refused = |reason: String| Err(Rejection::new(Status::UseNotAllowed, leaf, 0, reason));
    if is_issued && leaf.basic_constraints().is_some_and(|constraints| constraints.ca) {
        return refused("it is the certificate of a CA, not of an application".to_owned());
    }
    if policy.allow_any_usage {
        return Ok(());
    }
    let Some(usages) = leaf.key_usages() else {
        return refused("it does not say what its key may be used for".to_owned());
    };
    let missing: Vec<&str> =
        NEEDED.iter().filter(|usage| !usages.contains(usage)).map(|usage| usage.as_str()).collect();
    if !missing.is_empty() {
        return refused(format!("its key may not be used for {}", missing.join(", ")));
    }
    match excluded_role(leaf, role) {
        Some(who) => refused(format!("it is not for {who}")),
        None => Ok(()),
    }
}

/// Whom the extended key usages leave out, if they leave out the role.
fn excluded_role(certificate: &Certificate, role: Role) -> Option<&'static str> {
    let purposes = certificate.extended_key_usages()?;
    let allows = |purpose| purposes.contains(&purpose) || purposes.contains(&ExtendedKeyUsage::AnyExtendedKeyUsage);
    let (client, server) = (allows(ExtendedKeyUsage::ClientAuth), allows(ExtendedKeyUsage::ServerAuth));
    match role {
        Role::Client => (!client).then_some("clients"),
        Role::Server => (!server).then_some("servers"),
        Role::Either => (!client && !server).then_some("clients or servers"),
    }
}

/// Whether the certificate at that depth may have issued what stands below it (RFC 5280 §6.1.4).
fn issuer(chain: &[&Certificate], depth: usize, role: Role) -> Result<(), Rejection> {
    let certificate = chain[depth];
    let refused = |reason: String| Err(Rejection::new(Status::IssuerUseNotAllowed, certificate, depth, reason));
    let Some(constraints) = certificate.basic_constraints().filter(|constraints| constraints.ca) else {
        return refused("it issued a certificate, but is not a CA".to_owned());
    };
    if !certificate.is_ca() {
        return refused("it issued a certificate, but its key may not sign certificates".to_owned());
    }
    // Whoever gave a CA extended key usages wanted its certificates to be for nothing else; everybody reads it so.
    if let Some(who) = excluded_role(certificate, role) {
        return refused(format!("it may not issue certificates for {who}"));
    }
    if let Some(most) = constraints.path_length {
        // A CA that issued a new certificate to itself is the same CA, and does not count.
        let is_other = |below: &&&Certificate| below.facts().subject_folded != below.facts().issuer_folded;
        let cas_below = chain[1..depth].iter().filter(is_other).count();
        if cas_below as u64 > u64::from(most) {
            return refused(format!("at most {most} CAs may stand below it, but {cas_below} do"));
        }
    }
    Ok(())
}

fn names_of(leaf: &Certificate) -> String {
    let names: Vec<String> = leaf.alternative_names().iter().map(ToString::to_string).collect();
    if names.is_empty() { "no host".to_owned() } else { names.join(", ") }
}

const NEEDED: [KeyUsage; 4] =
    [KeyUsage::DigitalSignature, KeyUsage::NonRepudiation, KeyUsage::KeyEncipherment, KeyUsage::DataEncipherment];
