use std::net::IpAddr;

use chrono::{DateTime, Duration, Utc};
use rcgen::{
    CertificateParams, DistinguishedName, DnType, DnValue, ExtendedKeyUsagePurpose, IsCa, KeyIdMethod, KeyUsagePurpose,
    SanType,
};
use time::OffsetDateTime;

use super::{Certificate, PkiError, PrivateKey};
use crate::model::{SelfSignedRequest, Subject, SubjectError};

/// Under which names a server is known. At least one address or DNS name is needed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ServerNames {
    /// The ApplicationUri of the server's application description; clients compare the two.
    pub application_uri: String,
    pub ips: Vec<IpAddr>,
    pub dns: Vec<String>,
}

/// Makes the certificate of an OPC UA server, signed with its own key (OPC 10000-6 §6.2.2).
///
/// It is an X.509 v3 certificate that is no CA, for server and client authentication, with every key usage OPC UA asks
/// for, signed with SHA-256 whatever the length of the key. Empty fields of the subject are left out. It is valid from
/// one day before `now`, because the clocks of controllers and clients run behind or in another time zone, until
/// `now` plus the validity asked for.
pub fn self_signed(
    request: &SelfSignedRequest,
    names: &ServerNames,
    key: &PrivateKey,
    now: DateTime<Utc>,
) -> Result<Certificate, PkiError> {
    let (asked, got) = (request.key_length.bits(), key.bits());
    if asked != got {
        return Err(PkiError::OtherKeyLength { asked, got });
    }
    let mut params = CertificateParams::default();
    params.distinguished_name = distinguished_name(&request.subject)?;
    params.subject_alt_names = alternative_names(names)?;
    params.key_usages = vec![
        KeyUsagePurpose::DigitalSignature,
        KeyUsagePurpose::ContentCommitment, // its older name is nonRepudiation
        KeyUsagePurpose::KeyEncipherment,
        KeyUsagePurpose::DataEncipherment,
        KeyUsagePurpose::KeyCertSign, // asked for in self-signed certificates, although they are no CA
    ];
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth, ExtendedKeyUsagePurpose::ClientAuth];
    params.is_ca = IsCa::ExplicitNoCa;
    params.key_identifier_method = KeyIdMethod::Sha256;
    params.use_authority_key_identifier_extension = true;
    params.serial_number = Some(random_serial_number()?.into());
    params.not_before = date(now - CLOCK_SKEW)?;
    params.not_after = date(now + request.validity.duration())?;
    let certificate = params.self_signed(key).map_err(|_| PkiError::Signing)?;
    Certificate::from_der(certificate.der())
}

/// How far the clock of whoever looks at a certificate may be behind.
pub(super) const CLOCK_SKEW: Duration = Duration::days(1);

/// 126 random bits: positive, and always 16 bytes long.
pub(super) fn random_serial_number() -> Result<Vec<u8>, PkiError> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|_| PkiError::Random)?;
    bytes[0] = bytes[0] & 0x3f | 0x40;
    Ok(bytes.to_vec())
}

pub(super) fn date(when: DateTime<Utc>) -> Result<OffsetDateTime, PkiError> {
    OffsetDateTime::from_unix_timestamp(when.timestamp()).map_err(|_| PkiError::Dates)
}

fn distinguished_name(subject: &Subject) -> Result<DistinguishedName, PkiError> {
    subject.check()?;
    let mut name = DistinguishedName::new();
    if !subject.country.is_empty() {
        let country = subject.country.as_str().try_into();
        let country = country.map_err(|_| SubjectError::Country(subject.country.clone()))?;
        name.push(DnType::CountryName, DnValue::PrintableString(country));
    }
    for (kind, text) in [
        (DnType::StateOrProvinceName, &subject.state),
        (DnType::LocalityName, &subject.locality),
        (DnType::OrganizationName, &subject.organisation),
        (DnType::CommonName, &subject.common_name),
    ] {
        if !text.is_empty() {
            name.push(kind, text.as_str());
        }
    }
    Ok(name)
}

/// The URI comes first: some peers look only there.
fn alternative_names(names: &ServerNames) -> Result<Vec<SanType>, PkiError> {
    if names.ips.is_empty() && names.dns.is_empty() {
        return Err(PkiError::NoHostName);
    }
    let bad_uri = || PkiError::ApplicationUri(names.application_uri.clone());
    if !is_uri(&names.application_uri) {
        return Err(bad_uri());
    }
    let uri = names.application_uri.as_str().try_into().map_err(|_| bad_uri())?;
    let mut all = vec![SanType::URI(uri)];
    for dns in &names.dns {
        let bad_dns = || PkiError::DnsName(dns.clone());
        if !is_dns_name(dns) {
            return Err(bad_dns());
        }
        all.push(SanType::DnsName(dns.as_str().try_into().map_err(|_| bad_dns())?));
    }
    all.extend(names.ips.iter().copied().map(SanType::IpAddress));
    Ok(all)
}

/// A scheme, a colon, something; nothing but printable ASCII without spaces.
fn is_uri(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_graphic())
        && text.split_once(':').is_some_and(|(scheme, rest)| {
            scheme.starts_with(|c: char| c.is_ascii_alphabetic())
                && scheme.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"+-.".contains(&byte))
                && !rest.is_empty()
        })
}

/// Letters, digits, hyphens, and the underscores that Windows allows in computer names.
fn is_dns_name(text: &str) -> bool {
    text.len() <= 253
        && text.split('.').all(|label| {
            (1..=63).contains(&label.len())
                && label.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-' || byte == b'_')
        })
}
