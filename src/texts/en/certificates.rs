//! What is wrong with certificates, in English.

use super::{revocation_lists, signatures};
use crate::model::CertificateStatus as S;
use crate::pki::{CertificateFlaw as F, PeerRole};
use crate::texts::{
    capital,
    certificates::{date, usages},
};

pub fn flaw_reason(flaw: &F) -> String {
    match flaw {
        F::Unreadable { why } => why.clone(),
        F::UnknownCriticalExtension { extension } => {
            format!("its extension {extension} is critical and not supported")
        }
        F::RareCriticalExtension { extension } => {
            format!("its extension {extension} is critical; clients that do not support it refuse the certificate")
        }
        F::DamagedExtension { extension } => format!("its extension {extension} is damaged"),
        F::NameNotAscii { name } => {
            format!("the name {name} in it has characters that are not ASCII (RFC 5280 §4.2.1.6)")
        }
        F::EndsBeforeItBegins => "its validity ends before it begins".to_owned(),
        F::ChainTooLong { most } => format!("its chain has more than {most} certificates"),
        F::TooManyIssuers => "too many authorities have the name of its issuer to try them all".to_owned(),
        F::IssuerMissing { issuer } => format!("the certificate of its issuer, {issuer}, is missing"),
        F::IssuerKeyIdentifier { issuer, wanted } => format!(
            "its issuer {issuer} is there and signed it, but has another key identifier than the one it names, \
         {wanted} (RFC 5280 §4.2.1.1)"
        ),
        F::IssuerKey { issuer } => {
            format!("an authority called {issuer} is there, but with another key than the one that signed it")
        }
        F::SignatureWrong { issuer } => format!("its signature is not that of its issuer, {issuer}"),
        F::SelfSignatureWrong => "it is not signed with its own key, although it names itself as its issuer".to_owned(),
        F::SignatureUnverifiable { because } => {
            format!("its signature cannot be checked: {}", signatures::unverifiable(because))
        }
        F::NameNotPermitted { name, authority } => format!(
            "the name constraints of its authority {authority} do not allow the name {name} (RFC 5280 §4.2.1.10)"
        ),
        F::NameConstraintUnsupported { name, authority } => format!(
            "whether the name constraints of its authority {authority} allow the name {name} cannot be checked (RFC 5280 \
         §4.2.1.10)"
        ),
        F::TooManyNames { authority } => {
            format!("it has too many names to compare them with the name constraints of {authority}")
        }
        F::PolicyMissing => {
            "an authority above it asks for a certificate policy, and none holds for the whole chain (RFC 5280 §6.1.5)"
                .to_owned()
        }
        F::PolicyMappingOfAny => "it maps the policy anyPolicy, which RFC 5280 §4.2.1.5 forbids".to_owned(),
        F::KeyNotRsa => "its key is not an RSA key, which the security policies need".to_owned(),
        F::KeyExponent => "its RSA key has an impossible exponent".to_owned(),
        F::KeyTooShort { bits, least: least @ 2048.. } if *bits >= 1024 => format!(
            "its RSA key has {bits} bits; at least {least} are needed with all but the deprecated security policies"
        ),
        F::KeyTooShort { bits, least } => format!("its RSA key has {bits} bits; at least {least} are needed"),
        F::KeyTooLong { bits, most } => format!("its RSA key has {bits} bits; at most {most} are allowed"),
        F::KeyLengthNotTicked { bits } => format!("the ticked security policies do not allow {bits}-bit keys"),
        F::WeakHash { algorithm } => format!("it is signed with {algorithm}, which is too weak"),
        F::Untrusted => "neither it nor any of its issuers is in the trust list".to_owned(),
        F::NotYetValid { from, now } => format!("it is valid from {} on; the clock says {}", date(from), date(now)),
        F::Expired { until, now } => format!("it was valid until {}; the clock says {}", date(until), date(now)),
        F::ExpiresSoon { until } => format!("it is valid only until {}", date(until)),
        F::HostName { hosts, names } if names.is_empty() => {
            format!("it is for no host; the application is reached as {}", hosts.join(", "))
        }
        F::HostName { hosts, names } => {
            format!("it is not for {}, but for {}", hosts.join(", "), names.join(", "))
        }
        F::UriMissing { announced: None } => "it has no application URI".to_owned(),
        F::UriMissing { announced: Some(announced) } => {
            format!("it has no application URI; the application says {announced}")
        }
        F::UriDiffers { certificate, announced } => {
            format!("its application URI is {certificate}; the application says {announced}")
        }
        F::UriNotAscii { uri } => {
            format!("the application URI {uri} has characters that are not ASCII (RFC 5280 §4.2.1.6)")
        }
        F::CertificateOfAuthority => "it is the certificate of an authority (CA), not of an application".to_owned(),
        F::ClaimsToBeAuthority => "it says that it is a CA, although it is that of an application".to_owned(),
        F::KeyUsageMissing => "it does not say what its key may be used for".to_owned(),
        F::KeyUsageLacks { missing } => format!("its key may not be used for {}", usages(missing).join(", ")),
        F::NotForRole { role } => format!("its extended key usage is not for {}", who(*role)),
        F::ExtendedKeyUsageMissing => "it has no extended key usage".to_owned(),
        F::NotAnAuthority => "it issued a certificate, but is not a CA".to_owned(),
        F::MayNotIssue => "it issued a certificate, but its key may not sign certificates".to_owned(),
        F::MayNotIssueFor { role } => format!("it may not issue certificates for {}", who(*role)),
        F::TooManyAuthoritiesBelow { most, found } => {
            format!("at most {most} authorities may stand below it, but {found} do")
        }
        F::RevocationUnknown { authority, crl } => revocation_lists::reason(crl, authority),
        F::Revoked { on, because } => format!("it was revoked on {} ({})", date(on), because.as_str()),
        F::NotThatOfTheChannel => "the session was opened with another certificate than the secure channel".to_owned(),
    }
}

pub fn flaw_remedy(flaw: &F) -> String {
    match flaw {
        F::Unreadable { .. } => "send the certificate again in DER, or ask for a new one",
        F::UnknownCriticalExtension { .. } => {
            "ask the authority for a certificate without this extension, or with the extension not critical"
        }
        F::RareCriticalExtension { .. } => {
            "try the clients that connect, or ask the authority for a certificate without this extension"
        }
        F::DamagedExtension { .. } | F::EndsBeforeItBegins | F::KeyExponent => "ask for a new certificate",
        F::NameNotAscii { .. } => {
            "make a certificate with ASCII names only; the other characters of a host name are written as xn--…"
        }
        F::UriNotAscii { .. } => "give the application a URI of ASCII characters, and make a certificate with that URI",
        F::ChainTooLong { .. } => "have the certificate issued by an authority closer to the root",
        F::TooManyIssuers => "remove authorities of this name that are not needed any more",
        F::IssuerMissing { .. } => "add the authority to the issuers or to the trusted ones",
        F::IssuerKeyIdentifier { wanted, .. } => {
            return format!(
                "add the authority's certificate with the key identifier {wanted}, or have this certificate issued \
             again by the present authority"
            );
        }
        F::IssuerKey { .. } => "add the authority's certificate with the key that signed it",
        F::SignatureWrong { .. } | F::SelfSignatureWrong => {
            "do not trust it; it is damaged or forged, ask for a new certificate"
        }
        F::SignatureUnverifiable { .. } | F::WeakHash { .. } => {
            "ask for a certificate that is signed with SHA-256 and an RSA key of at least 2048 bits"
        }
        F::NameNotPermitted { .. } | F::NameConstraintUnsupported { .. } => {
            "ask for a certificate with names that this authority may certify, or from another authority"
        }
        F::TooManyNames { .. } => "ask for a certificate with fewer names",
        F::PolicyMissing => "ask for a certificate with a policy that the authority allows",
        F::PolicyMappingOfAny => "ask for a new certificate of this authority without that mapping",
        F::KeyNotRsa => "make a certificate with an RSA key of 2048 to 4096 bits",
        F::KeyTooShort { .. } | F::KeyTooLong { .. } => "make a certificate with a key of another length",
        F::KeyLengthNotTicked { .. } => {
            "make a certificate with a key of another length, or tick a security policy that uses this length"
        }
        F::Untrusted => "add it, or the authority that issued it, to the trusted ones",
        F::NotYetValid { .. } => "check the clocks, or wait until it is valid",
        F::Expired { .. } | F::ExpiresSoon { .. } => "renew it, or check the clocks",
        F::HostName { .. } => "connect by a name in the certificate, or make a certificate with this one",
        F::UriMissing { .. } => "make a certificate with the application's URI in its subject alternative name",
        F::UriDiffers { .. } => "make a certificate for this URI, or set this URI in the application",
        F::CertificateOfAuthority => "use the certificate of the application itself",
        F::ClaimsToBeAuthority => "make a certificate that is not for a CA (CA:FALSE)",
        F::KeyUsageMissing | F::KeyUsageLacks { .. } => {
            "make a certificate with the key usages digitalSignature, nonRepudiation, keyEncipherment and \
         dataEncipherment"
        }
        F::NotForRole { role: PeerRole::Client } => "make a certificate with the extended key usage clientAuth",
        F::NotForRole { role: PeerRole::Server } => "make a certificate with the extended key usage serverAuth",
        F::NotForRole { role: PeerRole::Either } | F::ExtendedKeyUsageMissing => {
            "make a certificate with the extended key usages clientAuth and serverAuth"
        }
        F::NotAnAuthority | F::MayNotIssue | F::MayNotIssueFor { .. } | F::TooManyAuthoritiesBelow { .. } => {
            "have the certificate issued by an authority that may do so"
        }
        F::RevocationUnknown { crl, .. } => return revocation_lists::remedy(crl),
        F::Revoked { .. } => "do not use it any more; ask for a new certificate",
        F::NotThatOfTheChannel => "correct the client: it presents two different certificates",
    }
    .to_owned()
}

pub fn sentence(reason: &str, remedy: &str) -> String {
    format!("{}. {}.", capital(reason), capital(remedy))
}

pub fn issuer_at_fault(issuer: &str, reason: &str) -> String {
    format!("its issuer {issuer} is at fault: {reason}")
}

/// What a status means, and what helps. The second part is the end of a sentence.
pub const fn status(status: S) -> (&'static str, &'static str) {
    match status {
        S::CertificateInvalid => ("The certificate is damaged or its signature is wrong", "ask for a new one"),
        S::ChainIncomplete => (
            "The certificate of an authority that issued it is missing",
            "add it to the issuers or to the trusted ones",
        ),
        S::SecurityChecksFailed => ("The certificate was refused", "the peer does not say why"),
        S::PolicyCheckFailed => (
            "Its key or its signature is too weak, or of another kind than the security policy wants",
            "make a new one",
        ),
        S::Untrusted => ("Nobody trusts it here yet", "add it, or the authority that issued it, to the trusted ones"),
        S::TimeInvalid => ("It is expired or not yet valid", "check the clocks, or renew it"),
        S::IssuerTimeInvalid => {
            ("An authority that issued it is expired or not yet valid", "check the clocks, or renew the authority")
        }
        S::HostNameInvalid => ("It is for another host than the one connected to", "use that name, or make a new one"),
        S::UriInvalid => ("Its application URI is not the one the application gives", "make one for this application"),
        S::UseNotAllowed => ("It may not be used for an OPC UA application", "ask for one with the right usages"),
        S::IssuerUseNotAllowed => ("A certificate in its chain may not issue certificates", "it is no authority"),
        S::RevocationUnknown => {
            ("There is no valid revocation list of the authority that issued it", "add an up-to-date one")
        }
        S::IssuerRevocationUnknown => {
            ("There is no valid revocation list for an authority in its chain", "add an up-to-date one")
        }
        S::Revoked => ("The authority has revoked it", "it must not be used any more"),
        S::IssuerRevoked => ("An authority in its chain has been revoked", "nothing it issued may be used any more"),
    }
}

pub fn joined(reason: &str, remedy: &str) -> String {
    format!("{reason}; {remedy}.")
}

const fn who(role: PeerRole) -> &'static str {
    match role {
        PeerRole::Client => "clients",
        PeerRole::Server => "servers",
        PeerRole::Either => "clients or servers",
    }
}
