//! What is wrong with certificate revocation lists, in English.

use super::{LANGUAGE, signatures};
use crate::pki::{CrlFlaw as F, CrlUnusable, OutOfScope};
use crate::texts::certificates::date;

pub fn reason(flaw: &F, authority: &str) -> String {
    let list = format!("the revocation list of {authority}");
    match flaw {
        F::Missing => format!("there is no revocation list of {authority}"),
        F::NotSigned => format!("the signature of {list} is wrong"),
        F::SignatureUnverifiable { because } => {
            format!("the signature of {list} cannot be checked: {}", signatures::unverifiable(because))
        }
        F::KeyNotHeld => format!(
            "{list} is signed with another key of this authority than the one that signed the certificate, and no \
         certificate with that key is there"
        ),
        F::KeyNotAccepted { subject, because } => format!(
            "{list} is signed with another key of this authority, and the certificate of that key is not accepted: \
         {subject}: {}",
            because.reason(LANGUAGE)
        ),
        F::MayNotSign => {
            format!("{list} is there, but the key usage of {authority} does not allow the signing of such lists")
        }
        F::WeakHash { algorithm } => format!("{list} is signed with {algorithm}, which is too weak"),
        F::Unusable { because } => format!("{list} cannot be used: {}", unusable(because)),
        F::OutOfScope { because } => format!("{list} does not cover this certificate: {}", out_of_scope(because)),
        F::NotYetValid { from, now } => {
            format!("{list} is valid only from {} on; the clock says {}", date(from), date(now))
        }
        F::NoEnd => format!("{list} does not say until when it is valid"),
        F::Expired { until, now } => {
            format!("{list} was valid until {}; the clock says {}", date(until), date(now))
        }
        F::SomeReasons => format!(
            "{list} is a partitioned list, only about some reasons for a revocation, and there is none about the \
         others"
        ),
    }
}

pub fn remedy(flaw: &F) -> String {
    match flaw {
        F::Missing => "add the current revocation list of this authority",
        F::NotSigned => "do not use this list, it is damaged or forged; get it from the authority again",
        F::SignatureUnverifiable { .. } => {
            "ask the authority for a revocation list with a signature of another kind, as RSA with SHA-256"
        }
        F::KeyNotHeld => {
            "add the authority's certificate with the key that signed the list, or a list that is signed with the key \
         that signed the certificate"
        }
        F::KeyNotAccepted { because, .. } => {
            return format!(
                "for the certificate of that key, {}; or add a list that is signed with the key that signed the \
             certificate",
                because.remedy(LANGUAGE)
            );
        }
        F::MayNotSign => {
            "ask the authority for a certificate of its own with the key usage cRLSign, and add that certificate"
        }
        F::WeakHash { .. } => "ask the authority for a revocation list that is signed with SHA-256",
        F::Unusable { because } => match because {
            CrlUnusable::Delta => "add the full revocation list of the authority, which delta lists only complete",
            CrlUnusable::Indirect => "add a revocation list that this authority issues about its own certificates only",
            CrlUnusable::OnlyAttributeCertificates => {
                "add the authority's revocation list about public key certificates"
            }
            CrlUnusable::AboutNothing => "ask the authority for a revocation list without these limits",
            CrlUnusable::OnlySomeReasons => "add a revocation list of the authority about all reasons",
            CrlUnusable::CriticalExtension(_) | CrlUnusable::CriticalEntryExtension(_) => {
                "ask the authority for a revocation list without this extension, or with the extension not critical"
            }
        },
        F::OutOfScope { because } => match because {
            OutOfScope::OnlyApplications => "add the authority's revocation list about certificates of authorities",
            OutOfScope::OnlyAuthorities => "add the authority's revocation list about certificates of applications",
            OutOfScope::OnlyAttributeCertificates => {
                "add the authority's revocation list about public key certificates"
            }
            OutOfScope::OtherDistributionPoint(_) => {
                "add the list of a distribution point that the certificate names, or the full list of the authority"
            }
        },
        F::NotYetValid { .. } => "check the clocks, or wait until the list is valid",
        F::NoEnd => "ask the authority for a revocation list with a next update (RFC 5280 §5.1.2.5)",
        F::Expired { .. } => "add the current revocation list of this authority, or check the clocks",
        F::SomeReasons => "add the authority's lists about the other reasons too, or one about all reasons",
    }
    .to_owned()
}

pub fn unusable(reason: &CrlUnusable) -> String {
    match reason {
        CrlUnusable::Delta => "it is a delta list, which says only what changed since another list",
        CrlUnusable::Indirect => "it is an indirect list, which speaks for other authorities",
        CrlUnusable::OnlyAttributeCertificates => "it is only about attribute certificates",
        CrlUnusable::AboutNothing => {
            "it is limited to applications and to authorities at once, so it covers no certificate"
        }
        CrlUnusable::OnlySomeReasons => "it is a partitioned list, only about some reasons",
        CrlUnusable::CriticalExtension(oid) => return format!("its extension {oid} is critical and not supported"),
        CrlUnusable::CriticalEntryExtension(oid) => {
            return format!("the extension {oid} of one of its entries is critical and not supported");
        }
    }
    .to_owned()
}

pub fn out_of_scope(reason: &OutOfScope) -> String {
    match reason {
        OutOfScope::OnlyApplications => "it is only about certificates of applications".to_owned(),
        OutOfScope::OnlyAuthorities => "it is only about certificates of authorities".to_owned(),
        OutOfScope::OnlyAttributeCertificates => "it is only about attribute certificates".to_owned(),
        OutOfScope::OtherDistributionPoint(point) => {
            format!("it is only about certificates with the distribution point {point}")
        }
    }
}
