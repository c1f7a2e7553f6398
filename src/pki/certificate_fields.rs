//! What is read from a certificate, once.

use std::fmt;
use std::net::IpAddr;
use std::ops::Range;

use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};
use x509_parser::prelude::{
    ASN1Time, GeneralName as Parsed, ParsedExtension, PolicyMapping, X509Certificate, X509Extension,
};

use super::distribution_point::DistributionPoint;
use super::general_name::{GeneralName, NameConstraints};
use super::name::quoted;
use super::signature::{PublicKey, SignatureAlgorithm};
use super::{CertificateFlaw, Fingerprint, KeyUsage, PkiError, name};
use crate::model::Cause;

/// What a certificate is for (RFC 5280 §4.2.1.12), by the names of that document.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum ExtendedKeyUsage {
    /// Every use (2.5.29.37.0).
    AnyExtendedKeyUsage,
    /// A TLS or OPC UA server.
    ServerAuth,
    /// A TLS or OPC UA client.
    ClientAuth,
    /// Signing of programs.
    CodeSigning,
    /// Protection of e-mail.
    EmailProtection,
    /// Signing of time stamps.
    TimeStamping,
    /// Signing of OCSP answers.
    #[serde(rename = "OCSPSigning")]
    OcspSigning,
    /// Its object identifier.
    Other(String),
}

impl ExtendedKeyUsage {
    /// As RFC 5280 writes it; of others, the object identifier.
    pub fn as_str(&self) -> &str {
        match self {
            Self::AnyExtendedKeyUsage => "anyExtendedKeyUsage",
            Self::ServerAuth => "serverAuth",
            Self::ClientAuth => "clientAuth",
            Self::CodeSigning => "codeSigning",
            Self::EmailProtection => "emailProtection",
            Self::TimeStamping => "timeStamping",
            Self::OcspSigning => "OCSPSigning",
            Self::Other(identifier) => identifier,
        }
    }
}

/// One entry of a subject alternative name, without control characters.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AlternativeName {
    /// A URI, such as the application URI of an OPC UA application.
    Uri(String),
    /// A DNS name.
    Dns(String),
    /// An IP address.
    Ip(IpAddr),
    /// An e-mail address.
    Email(String),
    /// Of a kind OPC UA has no use for.
    Other(String),
}

impl fmt::Display for AlternativeName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Uri(text) => write!(f, "URI:{text}"),
            Self::Dns(text) => write!(f, "DNS:{text}"),
            Self::Ip(address) => write!(f, "IP:{address}"),
            Self::Email(text) => write!(f, "email:{text}"),
            Self::Other(text) => f.write_str(text),
        }
    }
}

/// Whether a certificate is that of a CA, and how many CAs may stand below it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct BasicConstraints {
    /// Whether the certificate is that of a CA.
    pub ca: bool,
    /// Most CA certificates that may follow below it, self-issued ones not counted; `None`: no limit.
    pub path_length: Option<u32>,
}

/// What was read from the DER.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct CertificateFields {
    pub common_name: Option<String>,
    pub issued_to: String,
    pub issued_by: String,
    pub subject: String,
    pub issuer: String,
    /// For comparing names; see [`name::folded`].
    pub subject_folded: Vec<u8>,
    pub issuer_folded: Vec<u8>,
    /// The mailboxes among the attributes of the subject (RFC 5280 §4.1.2.6).
    pub subject_emails: Vec<GeneralName>,
    pub version: u32,
    pub serial_number: String,
    /// Without the bytes that only keep its sign.
    pub serial: Vec<u8>,
    pub not_before: DateTime<Utc>,
    pub not_after: DateTime<Utc>,
    pub public_key: PublicKey,
    pub extensions: Extensions,
    pub distribution_points: Vec<DistributionPoint>,
    pub signature_algorithm: SignatureAlgorithm,
    /// Where in the DER lies what is signed.
    pub signed: Range<usize>,
    pub signature: Vec<u8>,
    pub sha256: [u8; 32],
}

/// What the extensions say, of a certificate or as a signing request asks for them.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Extensions {
    pub alternative_names: Vec<AlternativeName>,
    /// The same, to be compared with name constraints.
    pub names: Vec<GeneralName>,
    pub name_constraints: Option<NameConstraints>,
    pub policies: CertificatePolicies,
    pub basic_constraints: Option<BasicConstraints>,
    pub key_usages: Option<Vec<KeyUsage>>,
    pub extended_key_usages: Option<Vec<ExtendedKeyUsage>>,
    pub subject_key_id: Option<Vec<u8>>,
    pub authority_key_id: Option<Vec<u8>>,
    /// Those that are critical, by their names.
    pub critical: Vec<String>,
    /// Why this certificate must not be used, though it can be shown: an extension that is critical and not
    /// understood, or one that contradicts its own definition.
    pub not_understood: Option<CertificateFlaw>,
}

/// What the extensions say about certificate policies, by object identifier (RFC 5280 §4.2.1.4, .5, .11, .14).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct CertificatePolicies {
    /// `None` without the extension.
    pub asserted: Option<Vec<String>>,
    /// From the issuer's policies to the subject's.
    pub mappings: Vec<(String, String)>,
    /// After how many more certificates a policy is needed.
    pub require_explicit: Option<u32>,
    pub inhibit_mapping: Option<u32>,
    pub inhibit_any: Option<u32>,
}

impl CertificateFields {
    pub fn of(der: &[u8], parsed: &X509Certificate<'_>) -> Result<Self, PkiError> {
        if parsed.signature_algorithm != parsed.tbs_certificate.signature {
            return Err(PkiError::SignatureAlgorithms);
        }
        // The only error is that an extension is repeated.
        parsed.extensions_map().map_err(|_| PkiError::RepeatedExtension)?;
        let damaged = |finding| PkiError::NotACertificate(Cause::finding(finding));
        let beyond = || damaged("a date is out of range");
        let mut extensions = Extensions::default();
        let mut distribution_points = Vec::new();
        for extension in parsed.extensions() {
            extensions.read_extension(extension);
            if extension.oid.to_id_string() == CRL_DISTRIBUTION_POINTS {
                match DistributionPoint::read_all(extension.value, parsed.issuer()) {
                    Some(points) => distribution_points = points,
                    None => extensions.damaged(extension_name(CRL_DISTRIBUTION_POINTS)),
                }
            }
        }
        Ok(Self {
            common_name: name::common_name(parsed.subject()),
            issued_to: name::title(parsed.subject()),
            issued_by: name::title(parsed.issuer()),
            subject: name::full(parsed.subject()),
            issuer: name::full(parsed.issuer()),
            subject_folded: name::folded(parsed.subject()),
            issuer_folded: name::folded(parsed.issuer()),
            subject_emails: name::emails(parsed.subject()).into_iter().map(GeneralName::Email).collect(),
            version: parsed.version().0.saturating_add(1),
            serial_number: serial_number(parsed.raw_serial()),
            serial: significant(parsed.raw_serial()).to_vec(),
            not_before: date(parsed.validity().not_before).ok_or_else(beyond)?,
            not_after: date(parsed.validity().not_after).ok_or_else(beyond)?,
            public_key: PublicKey::of(parsed.public_key())?,
            extensions,
            distribution_points,
            signature_algorithm: SignatureAlgorithm::of(&parsed.signature_algorithm),
            signed: range_within(der, parsed.tbs_certificate.as_ref())
                .ok_or_else(|| damaged("what is signed is not within it"))?,
            signature: parsed.signature_value.data.to_vec(),
            sha256: *Fingerprint::of(der).as_bytes(),
        })
    }
}

impl Extensions {
    /// The first URI among the alternative names.
    pub fn application_uri(&self) -> Option<&str> {
        self.alternative_names.iter().find_map(|name| match name {
            AlternativeName::Uri(uri) => Some(uri.as_str()),
            _ => None,
        })
    }

    fn read_extension(&mut self, extension: &X509Extension<'_>) {
        let extension_name = || extension_name(&extension.oid.to_id_string());
        if extension.critical {
            self.critical.push(extension_name());
        }
        let parsed = extension.parsed_extension();
        match parsed {
            ParsedExtension::ParseError { .. } => self.damaged(extension_name()),
            // The parser passes over distances, and reads only some kinds of names.
            ParsedExtension::NameConstraints(_) => match NameConstraints::parse(extension.value) {
                Some(constraints) => self.name_constraints = Some(constraints),
                None => self.damaged(extension_name()),
            },
            known if self.read(known) => {}
            _ if extension.critical => {
                self.not_understood(CertificateFlaw::UnknownCriticalExtension { extension: extension_name() });
            }
            _ => {}
        }
    }

    fn damaged(&mut self, extension: String) {
        self.not_understood(CertificateFlaw::DamagedExtension { extension });
    }

    /// Whether the extension is understood.
    pub fn read(&mut self, extension: &ParsedExtension<'_>) -> bool {
        match extension {
            ParsedExtension::BasicConstraints(constraints) => {
                self.basic_constraints =
                    Some(BasicConstraints { ca: constraints.ca, path_length: constraints.path_len_constraint });
            }
            ParsedExtension::KeyUsage(usage) => {
                let set = |bit: &usize| usage.flags >> bit & 1 == 1;
                let bits = (0..KeyUsage::ALL.len()).filter(set);
                self.key_usages = Some(bits.map(|bit| KeyUsage::ALL[bit]).collect());
            }
            ParsedExtension::ExtendedKeyUsage(usage) => self.extended_key_usages = Some(purposes(usage)),
            ParsedExtension::SubjectAlternativeName(names) => {
                self.alternative_names = names.general_names.iter().map(alternative_name).collect();
                self.names = names.general_names.iter().filter_map(GeneralName::of).collect();
                for name in &names.general_names {
                    match name {
                        Parsed::Invalid(tag, bytes) if text_form(tag.0).is_some() => {
                            let name = quoted(&not_utf8(tag.0, bytes));
                            self.not_understood(CertificateFlaw::NameNotAscii { name });
                        }
                        Parsed::Invalid(..) => self.damaged(extension_name(ALTERNATIVE_NAME)),
                        _ => {}
                    }
                }
            }
            ParsedExtension::SubjectKeyIdentifier(id) => self.subject_key_id = Some(id.0.to_vec()),
            ParsedExtension::AuthorityKeyIdentifier(authority) => {
                self.authority_key_id = authority.key_identifier.as_ref().map(|id| id.0.to_vec());
            }
            ParsedExtension::CertificatePolicies(policies) => {
                self.policies.asserted = Some(policies.iter().map(|policy| policy.policy_id.to_id_string()).collect());
            }
            // Read with the issuer's name, which some of them are relative to.
            ParsedExtension::CRLDistributionPoints(_) => {}
            ParsedExtension::PolicyMappings(mappings) => {
                let pair = |one: &PolicyMapping<'_>| {
                    (one.issuer_domain_policy.to_id_string(), one.subject_domain_policy.to_id_string())
                };
                self.policies.mappings = mappings.mappings.iter().map(pair).collect();
            }
            ParsedExtension::PolicyConstraints(constraints) => {
                self.policies.require_explicit = constraints.require_explicit_policy;
                self.policies.inhibit_mapping = constraints.inhibit_policy_mapping;
            }
            ParsedExtension::InhibitAnyPolicy(inhibit) => self.policies.inhibit_any = Some(inhibit.skip_certs),
            _ => return false,
        }
        true
    }

    fn not_understood(&mut self, why: CertificateFlaw) {
        self.not_understood.get_or_insert(why);
    }
}

/// As RFC 5280 writes it; of others, the object identifier.
fn extension_name(oid: &str) -> String {
    let known = match oid {
        "2.5.29.14" => "subjectKeyIdentifier",
        "2.5.29.15" => "keyUsage",
        ALTERNATIVE_NAME => "subjectAltName",
        "2.5.29.19" => "basicConstraints",
        "2.5.29.30" => "nameConstraints",
        CRL_DISTRIBUTION_POINTS => "cRLDistributionPoints",
        "2.5.29.32" => "certificatePolicies",
        "2.5.29.33" => "policyMappings",
        "2.5.29.35" => "authorityKeyIdentifier",
        "2.5.29.36" => "policyConstraints",
        "2.5.29.37" => "extKeyUsage",
        "2.5.29.54" => "inhibitAnyPolicy",
        other => other,
    };
    known.to_owned()
}

const ALTERNATIVE_NAME: &str = "2.5.29.17";

/// What a name with that tag is called, if it is text (RFC 5280 §4.2.1.6).
const fn text_form(tag: u32) -> Option<&'static str> {
    match tag {
        1 => Some("email"),
        2 => Some("DNS"),
        6 => Some("URI"),
        _ => None,
    }
}

/// A name in another encoding than UTF-8, as far as it can be read.
fn not_utf8(tag: u32, bytes: &[u8]) -> String {
    format!("{}:{}", text_form(tag).unwrap_or("?"), String::from_utf8_lossy(bytes))
}
const CRL_DISTRIBUTION_POINTS: &str = "2.5.29.31";

fn purposes(usage: &x509_parser::prelude::ExtendedKeyUsage<'_>) -> Vec<ExtendedKeyUsage> {
    let known = [
        (usage.any, ExtendedKeyUsage::AnyExtendedKeyUsage),
        (usage.server_auth, ExtendedKeyUsage::ServerAuth),
        (usage.client_auth, ExtendedKeyUsage::ClientAuth),
        (usage.code_signing, ExtendedKeyUsage::CodeSigning),
        (usage.email_protection, ExtendedKeyUsage::EmailProtection),
        (usage.time_stamping, ExtendedKeyUsage::TimeStamping),
        (usage.ocsp_signing, ExtendedKeyUsage::OcspSigning),
    ];
    let known = known.into_iter().filter_map(|(is_set, purpose)| is_set.then_some(purpose));
    known.chain(usage.other.iter().map(|oid| ExtendedKeyUsage::Other(oid.to_id_string()))).collect()
}

fn alternative_name(general_name: &Parsed<'_>) -> AlternativeName {
    match general_name {
        Parsed::URI(uri) => AlternativeName::Uri(name::printable(uri)),
        Parsed::DNSName(dns) => AlternativeName::Dns(name::printable(dns)),
        Parsed::RFC822Name(mail) => AlternativeName::Email(name::printable(mail)),
        Parsed::IPAddress(bytes) => match (<[u8; 4]>::try_from(*bytes), <[u8; 16]>::try_from(*bytes)) {
            (Ok(v4), _) => AlternativeName::Ip(v4.into()),
            (_, Ok(v6)) => AlternativeName::Ip(v6.into()),
            _ => AlternativeName::Other(format!("IP:{}", hex::encode_upper(bytes))),
        },
        Parsed::DirectoryName(directory) => AlternativeName::Other(format!("dirName:{}", name::full(directory))),
        Parsed::RegisteredID(oid) => AlternativeName::Other(format!("RID:{}", oid.to_id_string())),
        Parsed::OtherName(oid, _) => AlternativeName::Other(format!("otherName:{}", oid.to_id_string())),
        Parsed::X400Address(_) => AlternativeName::Other("X400".to_owned()),
        Parsed::EDIPartyName(_) => AlternativeName::Other("ediPartyName".to_owned()),
        Parsed::Invalid(tag, bytes) if text_form(tag.0).is_some() => {
            AlternativeName::Other(name::printable(&not_utf8(tag.0, bytes)))
        }
        Parsed::Invalid(tag, _) => AlternativeName::Other(format!("damaged [{}]", tag.0)),
    }
}

/// Where `part`, which must lie within `whole`, lies within it.
pub(super) fn range_within(whole: &[u8], part: &[u8]) -> Option<Range<usize>> {
    let start = (part.as_ptr() as usize).checked_sub(whole.as_ptr() as usize)?;
    let range = start..start.checked_add(part.len())?;
    (whole.get(range.clone()) == Some(part)).then_some(range)
}

fn serial_number(raw: &[u8]) -> String {
    match raw {
        // The zero that keeps a DER integer positive is not part of the number.
        [0, number @ ..] if !number.is_empty() => hex::encode_upper(number),
        number => hex::encode_upper(number),
    }
}

/// A number without the bytes before it that only keep its sign, of which a careless writer leaves too many.
pub(super) fn significant(mut number: &[u8]) -> &[u8] {
    while let [0, next, ..] | [0xff, next, ..] = number {
        if (number[0] == 0) != (*next < 0x80) {
            break;
        }
        number = &number[1..];
    }
    number
}

/// `None` for a date that is out of range.
pub(super) fn date(time: ASN1Time) -> Option<DateTime<Utc>> {
    DateTime::from_timestamp(time.timestamp(), 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_compared_without_what_only_keeps_their_sign() {
        assert_eq!(serial_number(&[0, 0x9a, 1]), "9A01");
        assert_eq!(serial_number(&[0]), "00");
        for (raw, expected) in [
            (&[0, 0, 0x9a, 1][..], &[0, 0x9a, 1][..]),
            (&[0, 0x12], &[0x12]),
            (&[0xff, 0xff, 0x80], &[0x80]),
            (&[0xff, 0x12], &[0xff, 0x12]),
            (&[0, 0], &[0]),
            (&[], &[]),
        ] {
            assert_eq!(significant(raw), expected, "{raw:02x?}");
        }
    }
}
