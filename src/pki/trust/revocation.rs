use chrono::SecondsFormat;

use super::checks::{Failure, Step, accepts_hash};
use super::{Presented, Rejection, TrustLists, TrustPolicy};
use crate::pki::crl::Revoked;
use crate::pki::flaw::quoted;
use crate::pki::signature::Verdict;
use crate::pki::{Certificate, CertificateFlaw, Crl, KeyUsage};

/// What the revocation lists say of one certificate.
enum Answer {
    NotRevoked,
    Revoked(Revoked),
    /// No list is at hand that can be believed.
    Unknown(String),
}

/// Steps 10 and 11, of a chain that is good so far. A root is not asked about: nobody stands above it.
pub(super) fn check(
    chain: &[&Certificate],
    lists: &TrustLists,
    presented: &Presented<'_>,
    policy: &TrustPolicy,
) -> Result<(), Failure> {
    let mut unknown = None;
    for (depth, pair) in chain.windows(2).enumerate() {
        let (certificate, issuer) = (pair[0], pair[1]);
        match ask(certificate, issuer, lists, presented, policy) {
            Answer::NotRevoked => {}
            Answer::Revoked(revoked) => {
                let flaw = CertificateFlaw::Revoked { on: revoked.date, because: revoked.reason };
                return Err((Step::Revocation, Rejection::new(flaw, certificate, depth)));
            }
            Answer::Unknown(why) => {
                let flaw = CertificateFlaw::RevocationUnknown { why: quoted(&why) };
                let rejection = Rejection::new(flaw, certificate, depth);
                unknown.get_or_insert((Step::FindRevocationList, rejection));
            }
        }
    }
    match unknown {
        Some(failure) if !policy.allow_unknown_revocation => Err(failure),
        _ => Ok(()),
    }
}

fn ask(
    certificate: &Certificate,
    issuer: &Certificate,
    lists: &TrustLists,
    presented: &Presented<'_>,
    policy: &TrustPolicy,
) -> Answer {
    let mut why = format!("there is no revocation list of {}", issuer.subject());
    let mut newest_is_known = false;
    for (index, crl) in lists.crls_of(issuer) {
        if let Err(reason) = is_signed(index, crl, issuer, lists, presented, policy) {
            why = reason;
            continue;
        }
        // Newer lists stand first. What the newest whole one does not say any more is not so any more; what a list
        // says that cannot be used for a full check is true all the same.
        if let Some(revoked) = crl.revoked(certificate).filter(|_| !newest_is_known) {
            return Answer::Revoked(revoked);
        }
        if newest_is_known {
            continue;
        }
        match is_usable(crl, presented, policy) {
            Ok(()) => newest_is_known = true,
            Err(reason) => why = reason,
        }
    }
    if newest_is_known { Answer::NotRevoked } else { Answer::Unknown(why) }
}

/// Whether the list is what that issuer says.
fn is_signed(
    index: usize,
    crl: &Crl,
    issuer: &Certificate,
    lists: &TrustLists,
    presented: &Presented<'_>,
    policy: &TrustPolicy,
) -> Result<(), String> {
    let of = issuer.subject();
    if let (Some(wanted), Some(has)) = (crl.authority_key_id(), issuer.subject_key_id())
        && wanted != has
    {
        return Err(format!("the revocation list of {of} is signed with another of its keys"));
    }
    if issuer.key_usages().is_some_and(|usages| !usages.contains(&KeyUsage::CrlSign)) {
        return Err(format!("{of} may not sign revocation lists, but there is one"));
    }
    match lists.crl_signature(index, issuer) {
        Verdict::Right if accepts_hash(crl.algorithm().hash(), presented, policy) => Ok(()),
        Verdict::Right => {
            Err(format!("the revocation list of {of} is signed with {}, which is too weak", crl.signature_algorithm()))
        }
        Verdict::Wrong => Err(format!("the signature of the revocation list of {of} is wrong")),
        Verdict::CannotSay(why) => Err(format!("the revocation list of {of} cannot be believed: {why}")),
    }
}

/// Whether a list that does not name a certificate says that it is not revoked.
fn is_usable(crl: &Crl, presented: &Presented<'_>, policy: &TrustPolicy) -> Result<(), String> {
    let of = crl.issuer();
    let text = |time: chrono::DateTime<chrono::Utc>| time.to_rfc3339_opts(SecondsFormat::Secs, true);
    if let Some(why) = crl.unusable() {
        return Err(format!("the revocation list of {of} cannot be used: {why}"));
    }
    if presented.now < crl.this_update() {
        return Err(format!("the revocation list of {of} is valid only from {} on", text(crl.this_update())));
    }
    match crl.next_update() {
        _ if policy.allow_expired_crls => Ok(()),
        None => Err(format!("the revocation list of {of} does not say until when it is valid")),
        Some(until) if presented.now.timestamp() > until.timestamp() => {
            Err(format!("the revocation list of {of} was valid until {}", text(until)))
        }
        Some(_) => Ok(()),
    }
}
