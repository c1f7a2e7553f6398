use super::{CertificateFlaw, date, usages};
use crate::pki::Role;

impl CertificateFlaw {
    pub(super) fn english(&self) -> String {
        match self {
            Self::Unreadable { why } => why.clone(),
            Self::UnknownCriticalExtension { extension } => {
                format!("its extension {extension} is critical and not supported")
            }
            Self::RareCriticalExtension { extension } => {
                format!("its extension {extension} is critical; clients that do not support it refuse the certificate")
            }
            Self::DamagedExtension { extension } => format!("its extension {extension} is damaged"),
            Self::NameNotAscii { name } => {
                format!("the name {name} in it has characters that are not ASCII (RFC 5280 §4.2.1.6)")
            }
            Self::EndsBeforeItBegins => "its validity ends before it begins".to_owned(),
            Self::ChainTooLong { most } => format!("its chain has more than {most} certificates"),
            Self::TooManyIssuers => "too many authorities have the name of its issuer to try them all".to_owned(),
            Self::IssuerMissing { issuer } => format!("the certificate of its issuer, {issuer}, is missing"),
            Self::IssuerKeyIdentifier { issuer, wanted } => format!(
                "its issuer {issuer} is there and signed it, but has another key identifier than the one it names, \
                 {wanted} (RFC 5280 §4.2.1.1)"
            ),
            Self::IssuerKey { issuer } => {
                format!("an authority called {issuer} is there, but with another key than the one that signed it")
            }
            Self::SignatureWrong { issuer } => format!("its signature is not that of its issuer, {issuer}"),
            Self::SelfSignatureWrong => "it is not signed with its own key, although it names itself as its issuer".to_owned(),
            Self::SignatureUnverifiable { why } => format!("its signature cannot be checked: {why}"),
            Self::NameNotPermitted { name, authority } => format!(
                "the name constraints of its authority {authority} do not allow the name {name} (RFC 5280 §4.2.1.10)"
            ),
            Self::NameConstraintUnsupported { name, authority } => format!(
                "whether the name constraints of its authority {authority} allow the name {name} cannot be checked (RFC 5280 \
                 §4.2.1.10)"
            ),
            Self::TooManyNames { authority } => {
                format!("it has too many names to compare them with the name constraints of {authority}")
            }
            Self::PolicyMissing => {
                "an authority above it asks for a certificate policy, and none holds for the whole chain (RFC 5280 §6.1.5)"
                    .to_owned()
            }
            Self::PolicyMappingOfAny => "it maps the policy anyPolicy, which RFC 5280 §4.2.1.5 forbids".to_owned(),
            Self::KeyNotRsa => "its key is not an RSA key, which the security policies need".to_owned(),
            Self::KeyExponent => "its RSA key has an impossible exponent".to_owned(),
            Self::KeyTooShort { bits, least: least @ 2048.. } if *bits >= 1024 => format!(
                "its RSA key has {bits} bits; at least {least} are needed with all but the deprecated security policies"
            ),
            Self::KeyTooShort { bits, least } => format!("its RSA key has {bits} bits; at least {least} are needed"),
            Self::KeyTooLong { bits, most } => format!("its RSA key has {bits} bits; at most {most} are allowed"),
            Self::KeyLengthNotTicked { bits } => format!("the ticked security policies do not allow {bits}-bit keys"),
            Self::WeakHash { algorithm } => format!("it is signed with {algorithm}, which is too weak"),
            Self::Untrusted => "neither it nor any of its issuers is in the trust list".to_owned(),
            Self::NotYetValid { from, now } => format!("it is valid from {} on; the clock says {}", date(from), date(now)),
            Self::Expired { until, now } => format!("it was valid until {}; the clock says {}", date(until), date(now)),
            Self::ExpiresSoon { until } => format!("it is valid only until {}", date(until)),
            Self::HostName { hosts, names } if names.is_empty() => {
                format!("it is for no host; the application is reached as {}", hosts.join(", "))
            }
            Self::HostName { hosts, names } => {
                format!("it is not for {}, but for {}", hosts.join(", "), names.join(", "))
            }
            Self::UriMissing { announced: None } => "it has no application URI".to_owned(),
            Self::UriMissing { announced: Some(announced) } => {
                format!("it has no application URI; the application says {announced}")
            }
            Self::UriDiffers { certificate, announced } => {
                format!("its application URI is {certificate}; the application says {announced}")
            }
            Self::UriNotAscii { uri } => {
                format!("the application URI {uri} has characters that are not ASCII (RFC 5280 §4.2.1.6)")
            }
            Self::CertificateOfAuthority => "it is the certificate of an authority (CA), not of an application".to_owned(),
            Self::ClaimsToBeAuthority => "it says that it is a CA, although it is that of an application".to_owned(),
            Self::KeyUsageMissing => "it does not say what its key may be used for".to_owned(),
            Self::KeyUsageLacks { missing } => format!("its key may not be used for {}", usages(missing).join(", ")),
            Self::NotForRole { role } => format!("its extended key usage is not for {}", who(*role)),
            Self::ExtendedKeyUsageMissing => "it has no extended key usage".to_owned(),
            Self::NotAnAuthority => "it issued a certificate, but is not a CA".to_owned(),
            Self::MayNotIssue => "it issued a certificate, but its key may not sign certificates".to_owned(),
            Self::MayNotIssueFor { role } => format!("it may not issue certificates for {}", who(*role)),
            Self::TooManyAuthoritiesBelow { most, found } => {
                format!("at most {most} authorities may stand below it, but {found} do")
            }
            Self::RevocationUnknown { authority, crl } => crl.english(authority),
            Self::Revoked { on, because } => format!("it was revoked on {} ({})", date(on), because.as_str()),
            Self::NotThatOfTheChannel => {
                "the session was opened with another certificate than the secure channel".to_owned()
            }
        }
    }

    pub(super) fn english_remedy(&self) -> String {
        match self {
            Self::Unreadable { .. } => "send the certificate again in DER, or ask for a new one",
            Self::UnknownCriticalExtension { .. } => {
                "ask the authority for a certificate without this extension, or with the extension not critical"
            }
            Self::RareCriticalExtension { .. } => {
                "try the clients that connect, or ask the authority for a certificate without this extension"
            }
            Self::DamagedExtension { .. } | Self::EndsBeforeItBegins | Self::KeyExponent => "ask for a new certificate",
            Self::NameNotAscii { .. } => {
                "make a certificate with ASCII names only; the other characters of a host name are written as xn--…"
            }
            Self::UriNotAscii { .. } => {
                "give the application a URI of ASCII characters, and make a certificate with that URI"
            }
            Self::ChainTooLong { .. } => "have the certificate issued by an authority closer to the root",
            Self::TooManyIssuers => "remove authorities of this name that are not needed any more",
            Self::IssuerMissing { .. } => "add the authority to the issuers or to the trusted ones",
            Self::IssuerKeyIdentifier { wanted, .. } => {
                return format!(
                    "add the authority's certificate with the key identifier {wanted}, or have this certificate issued \
                     again by the present authority"
                );
            }
            Self::IssuerKey { .. } => "add the authority's certificate with the key that signed it",
            Self::SignatureWrong { .. } | Self::SelfSignatureWrong => {
                "do not trust it; it is damaged or forged, ask for a new certificate"
            }
            Self::SignatureUnverifiable { .. } | Self::WeakHash { .. } => {
                "ask for a certificate that is signed with SHA-256 and an RSA key of at least 2048 bits"
            }
            Self::NameNotPermitted { .. } | Self::NameConstraintUnsupported { .. } => {
                "ask for a certificate with names that this authority may certify, or from another authority"
            }
            Self::TooManyNames { .. } => "ask for a certificate with fewer names",
            Self::PolicyMissing => "ask for a certificate with a policy that the authority allows",
            Self::PolicyMappingOfAny => "ask for a new certificate of this authority without that mapping",
            Self::KeyNotRsa => "make a certificate with an RSA key of 2048 to 4096 bits",
            Self::KeyTooShort { .. } | Self::KeyTooLong { .. } => "make a certificate with a key of another length",
            Self::KeyLengthNotTicked { .. } => {
                "make a certificate with a key of another length, or tick a security policy that uses this length"
            }
            Self::Untrusted => "add it, or the authority that issued it, to the trusted ones",
            Self::NotYetValid { .. } => "check the clocks, or wait until it is valid",
            Self::Expired { .. } | Self::ExpiresSoon { .. } => "renew it, or check the clocks",
            Self::HostName { .. } => "connect by a name in the certificate, or make a certificate with this one",
            Self::UriMissing { .. } => "make a certificate with the application's URI in its subject alternative name",
            Self::UriDiffers { .. } => "make a certificate for this URI, or set this URI in the application",
            Self::CertificateOfAuthority => "use the certificate of the application itself",
            Self::ClaimsToBeAuthority => "make a certificate that is not for a CA (CA:FALSE)",
            Self::KeyUsageMissing | Self::KeyUsageLacks { .. } => {
                "make a certificate with the key usages digitalSignature, nonRepudiation, keyEncipherment and \
                 dataEncipherment"
            }
            Self::NotForRole { role: Role::Client } => "make a certificate with the extended key usage clientAuth",
            Self::NotForRole { role: Role::Server } => "make a certificate with the extended key usage serverAuth",
            Self::NotForRole { role: Role::Either } | Self::ExtendedKeyUsageMissing => {
                "make a certificate with the extended key usages clientAuth and serverAuth"
            }
            Self::NotAnAuthority
            | Self::MayNotIssue
            | Self::MayNotIssueFor { .. }
            | Self::TooManyAuthoritiesBelow { .. } => "have the certificate issued by an authority that may do so",
            Self::RevocationUnknown { crl, .. } => return crl.english_remedy(),
            Self::Revoked { .. } => "do not use it any more; ask for a new certificate",
            Self::NotThatOfTheChannel => "mend the client; it shows two certificates",
        }
        .to_owned()
    }
}

const fn who(role: Role) -> &'static str {
    match role {
        Role::Client => "clients",
        Role::Server => "servers",
        Role::Either => "clients or servers",
    }
}
