use super::{CrlFlaw, CrlUnusable, date};
use crate::model::Language;
use crate::pki::OutOfScope;

impl CrlFlaw {
    pub(super) fn english(&self, authority: &str) -> String {
        let list = format!("the revocation list of {authority}");
        match self {
            Self::Missing => format!("there is no revocation list of {authority}"),
            Self::NotSigned => format!("the signature of {list} is wrong"),
            Self::SignatureUnverifiable { why } => format!("the signature of {list} cannot be checked: {why}"),
            Self::KeyNotHeld => format!(
                "{list} is signed with another key of this authority than the one that signed the certificate, and no \
                 certificate with that key is there"
            ),
            Self::KeyNotAccepted { subject, because } => format!(
                "{list} is signed with another key of this authority, and the certificate of that key is not accepted: \
                 {subject}: {}",
                because.reason(Language::En)
            ),
            Self::MayNotSign => {
                format!("{list} is there, but the key usage of {authority} does not allow the signing of such lists")
            }
            Self::WeakHash { algorithm } => format!("{list} is signed with {algorithm}, which is too weak"),
            Self::Unusable { because } => format!("{list} cannot be used: {}", because.english()),
            Self::OutOfScope { because } => format!("{list} does not cover this certificate: {}", because.english()),
            Self::NotYetValid { from, now } => {
                format!("{list} is valid only from {} on; the clock says {}", date(from), date(now))
            }
            Self::NoEnd => format!("{list} does not say until when it is valid"),
            Self::Expired { until, now } => {
                format!("{list} was valid until {}; the clock says {}", date(until), date(now))
            }
            Self::SomeReasons => format!(
                "{list} is a partitioned list, only about some reasons for a revocation, and there is none about the \
                 others"
            ),
        }
    }

    pub(super) fn english_remedy(&self) -> String {
        match self {
            Self::Missing => "add the current revocation list of this authority",
            Self::NotSigned => "do not use this list, it is damaged or forged; get it from the authority again",
            Self::SignatureUnverifiable { .. } => {
                "ask the authority for a revocation list with a signature of another kind, as RSA with SHA-256"
            }
            Self::KeyNotHeld => {
                "add the authority's certificate with the key that signed the list, or a list that is signed with the key \
                 that signed the certificate"
            }
            Self::KeyNotAccepted { because, .. } => {
                return format!(
                    "for the certificate of that key, {}; or add a list that is signed with the key that signed the \
                     certificate",
                    because.remedy(Language::En)
                );
            }
            Self::MayNotSign => {
                "ask the authority for a certificate of its own with the key usage cRLSign, and add that certificate"
            }
            Self::WeakHash { .. } => "ask the authority for a revocation list that is signed with SHA-256",
            Self::Unusable { because } => match because {
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
            Self::OutOfScope { because } => match because {
                OutOfScope::OnlyApplications => "add the authority's revocation list about certificates of authorities",
                OutOfScope::OnlyAuthorities => "add the authority's revocation list about certificates of applications",
                OutOfScope::OnlyAttributeCertificates => {
                    "add the authority's revocation list about public key certificates"
                }
                OutOfScope::OtherDistributionPoint(_) => {
                    "add the list of a distribution point that the certificate names, or the full list of the authority"
                }
            },
            Self::NotYetValid { .. } => "check the clocks, or wait until the list is valid",
            Self::NoEnd => "ask the authority for a revocation list with a next update (RFC 5280 §5.1.2.5)",
            Self::Expired { .. } => "add the current revocation list of this authority, or check the clocks",
            Self::SomeReasons => "add the authority's lists about the other reasons too, or one about all reasons",
        }
        .to_owned()
    }
}

impl CrlUnusable {
    pub(super) fn english(&self) -> String {
        match self {
            Self::Delta => "it is a delta list, which says only what changed since another list",
            Self::Indirect => "it is an indirect list, which speaks for other authorities",
            Self::OnlyAttributeCertificates => "it is only about attribute certificates",
            Self::AboutNothing => "it is only about applications and only about authorities, which is about nothing",
            Self::OnlySomeReasons => "it is a partitioned list, only about some reasons",
            Self::CriticalExtension(oid) => return format!("its extension {oid} is critical and not supported"),
            Self::CriticalEntryExtension(oid) => {
                return format!("the extension {oid} of one of its entries is critical and not supported");
            }
        }
        .to_owned()
    }
}

impl OutOfScope {
    pub(super) fn english(&self) -> String {
        match self {
            Self::OnlyApplications => "it is only about certificates of applications".to_owned(),
            Self::OnlyAuthorities => "it is only about certificates of authorities".to_owned(),
            Self::OnlyAttributeCertificates => "it is only about attribute certificates".to_owned(),
            Self::OtherDistributionPoint(point) => {
                format!("it is only about certificates with the distribution point {point}")
            }
        }
    }
}
