use std::net::IpAddr;

use chrono::{DateTime, Duration, Utc};
use rcgen::{
    CertificateParams, DistinguishedName, DnType, DnValue, ExtendedKeyUsagePurpose, IsCa, KeyIdMethod, KeyUsagePurpose,
    SanType,
};
use time::OffsetDateTime;

use super::{Certificate, PkiError, PrivateKey};
use crate::model::{SelfSignedRequest, Subject, SubjectError, with_cause, with_told_cause};

/// Under which names a server is known. At least one address or DNS name is needed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ServerNames {
    /// The ApplicationUri of the server's application description; clients compare the two.
    pub application_uri: String,
    /// IPv4 or IPv6.
    pub ips: Vec<IpAddr>,
    /// Host names, with or without a domain.
    pub dns: Vec<String>,
}

impl ServerNames {
    /// Whether they can be written into a certificate; not whether there are enough.
    pub(super) fn check(&self) -> Result<(), PkiError> {
        if !is_uri(&self.application_uri) {
            return Err(PkiError::ApplicationUri(self.application_uri.clone()));
        }
        match self.dns.iter().find(|dns| !is_dns_name(dns)) {
            Some(bad) => Err(PkiError::DnsName(bad.clone())),
            None => Ok(()),
        }
    }
}

/// Makes the certificate of an OPC UA server, signed with its own key (OPC 10000-6 §6.2.2).
///
/// It is an X.509 v3 certificate that is no CA, for server and client authentication, with every key usage OPC UA asks
/// for, signed with SHA-256 at every length of the key. Empty fields of the subject are left out. It is valid from
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
    params.not_before = date(now.checked_sub_signed(CLOCK_SKEW))?;
    params.not_after = date(now.checked_add_signed(request.validity.duration()))?;
    let certificate = params.self_signed(key).map_err(with_cause(PkiError::Signing))?;
    Certificate::from_der(certificate.der())
}

/// How far the clock of a client may be behind.
pub(super) const CLOCK_SKEW: Duration = Duration::days(1);

/// 126 random bits: positive, and always 16 bytes long.
pub(super) fn random_serial_number() -> Result<Vec<u8>, PkiError> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(with_told_cause(PkiError::Random))?;
    bytes[0] = bytes[0] & 0x3f | 0x40;
    Ok(bytes.to_vec())
}

/// Refuses `None`, and what X.509 cannot write: years before 0 or after 9999.
pub(super) fn date(when: Option<DateTime<Utc>>) -> Result<OffsetDateTime, PkiError> {
    let seconds = when.ok_or_else(PkiError::beyond_calendar)?.timestamp();
    let date = OffsetDateTime::from_unix_timestamp(seconds).map_err(with_cause(PkiError::Dates))?;
    if date.year() < 0 { Err(PkiError::beyond_calendar()) } else { Ok(date) }
}

pub(super) fn distinguished_name(subject: &Subject) -> Result<DistinguishedName, PkiError> {
    subject.check()?;
    let mut name = DistinguishedName::new();
    if !subject.country.is_empty() {
        // rcgen says only that the characters are wrong.
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
pub(super) fn alternative_names(names: &ServerNames) -> Result<Vec<SanType>, PkiError> {
    if names.ips.is_empty() && names.dns.is_empty() {
        return Err(PkiError::NoHostName);
    }
    names.check()?;
    // rcgen says of both only that the characters are wrong.
    let uri = names.application_uri.as_str().try_into();
    let mut all = vec![SanType::URI(uri.map_err(|_| PkiError::ApplicationUri(names.application_uri.clone()))?)];
    for dns in &names.dns {
        all.push(SanType::DnsName(dns.as_str().try_into().map_err(|_| PkiError::DnsName(dns.clone()))?));
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

#[cfg(test)]
mod tests {
    use super::*;
    use aws_lc_rs::signature::{RSA_PKCS1_1024_8192_SHA256_FOR_LEGACY_USE_ONLY, UnparsedPublicKey};
    use x509_parser::asn1_rs::Tag;
    use x509_parser::prelude::{FromDer, GeneralName, ParsedExtension, X509Certificate, X509Version};

    use crate::model::KeyLength;
    use crate::pki::samples::{self, names, now, request};

    fn made_with(names: &ServerNames) -> Result<Certificate, PkiError> {
        self_signed(&request(KeyLength::Rsa2048), names, samples::key(), now())
    }

    #[test]
    fn it_is_what_opc_ua_asks_for_at_every_key_length() {
        for key in [samples::legacy_key(), samples::key()] {
            let certificate = samples::certificate_for(key);
            assert_eq!(certificate.key_bits(), key.bits());
            assert!(certificate.is_self_signed());
            let (_, parsed) = X509Certificate::from_der(certificate.der()).unwrap();
            assert_eq!(parsed.version(), X509Version::V3);
            assert_eq!(
                parsed.subject().to_string(),
                "C=JP, ST=Nagano, L=Suwa, O=Example & Sons, CN=EpsonRC.SN0000123.192.168.010.001"
            );
            let country = parsed.subject().iter_country().next().unwrap();
            assert_eq!(country.attr_value().tag(), Tag::PrintableString);

            let usage = parsed.key_usage().unwrap().unwrap();
            assert!(usage.critical);
            assert_eq!(usage.value.flags, 0b10_1111, "the first four, and keyCertSign");
            let extended = parsed.extended_key_usage().unwrap().unwrap().value;
            assert!(extended.server_auth && extended.client_auth && !extended.any);
            let constraints = parsed.basic_constraints().unwrap().expect("said explicitly");
            assert!(!constraints.value.ca);

            let alternative = parsed.subject_alternative_name().unwrap().unwrap().value;
            assert_eq!(
                alternative.general_names,
                [
                    GeneralName::URI("urn:EpsonRC:SN0000123"),
                    GeneralName::DNSName("robot-7.plant.example"),
                    GeneralName::IPAddress(&[192, 168, 10, 1]),
                    GeneralName::IPAddress(&[0xfe, 0x80, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]),
                ]
            );
            let (mut subject_key, mut authority_key) = (None, None);
            for extension in parsed.extensions() {
                match extension.parsed_extension() {
                    ParsedExtension::SubjectKeyIdentifier(id) => subject_key = Some(id.clone()),
                    ParsedExtension::AuthorityKeyIdentifier(id) => authority_key = id.key_identifier.clone(),
                    _ => {}
                }
            }
            assert!(subject_key.is_some());
            assert_eq!(subject_key, authority_key);
        }
    }

    #[test]
    fn it_is_signed_with_sha_256_at_every_key_length() {
        for key in [samples::legacy_key(), samples::key()] {
            let certificate = samples::certificate_for(key);
            let (_, parsed) = X509Certificate::from_der(certificate.der()).unwrap();
            let public_key = &parsed.public_key().subject_public_key.data[..];
            UnparsedPublicKey::new(&RSA_PKCS1_1024_8192_SHA256_FOR_LEGACY_USE_ONLY, public_key)
                .verify(parsed.tbs_certificate.as_ref(), &parsed.signature_value.data)
                .unwrap();
        }
    }

    #[test]
    fn it_is_valid_from_a_day_ago_for_the_years_asked_for() {
        let certificate = samples::certificate();
        assert_eq!(certificate.not_before(), now() - Duration::days(1));
        assert_eq!(certificate.not_after(), now() + request(KeyLength::Rsa2048).validity.duration());
    }

    #[test]
    fn a_clock_beyond_all_dates_is_an_error_and_no_crash() {
        for now in [DateTime::<Utc>::MIN_UTC, DateTime::<Utc>::MAX_UTC, now() - Duration::days(365 * 2040)] {
            let made = self_signed(&request(KeyLength::Rsa2048), &names(), samples::key(), now);
            assert_eq!(made, Err(PkiError::Dates(crate::model::Cause::any())));
        }
    }

    #[test]
    fn serial_numbers_are_positive_and_never_the_same() {
        let serial = || made_with(&names()).unwrap().summary().serial_number;
        let (one, other) = (serial(), serial());
        assert_ne!(one, other);
        for serial in [one, other] {
            assert_eq!(serial.len(), 32);
            assert!(('4'..='7').contains(&serial.chars().next().unwrap()));
        }
    }

    #[test]
    fn empty_fields_are_left_out() {
        let mut request = request(KeyLength::Rsa2048);
        request.subject.country.clear();
        request.subject.state.clear();
        request.subject.locality.clear();
        request.subject.organisation.clear();
        let certificate = self_signed(&request, &names(), samples::key(), now()).unwrap();
        let (_, parsed) = X509Certificate::from_der(certificate.der()).unwrap();
        assert_eq!(parsed.subject().to_string(), "CN=EpsonRC.SN0000123.192.168.010.001");
    }

    #[test]
    fn a_wish_that_cannot_be_granted_is_refused_with_its_reason() {
        let mut nameless = request(KeyLength::Rsa2048);
        nameless.subject.common_name.clear();
        assert_eq!(
            self_signed(&nameless, &names(), samples::key(), now()),
            Err(PkiError::Subject(SubjectError::Empty("common name")))
        );
        assert_eq!(
            self_signed(&request(KeyLength::Rsa4096), &names(), samples::key(), now()),
            Err(PkiError::OtherKeyLength { asked: 4096, got: 2048 })
        );
        assert_eq!(made_with(&ServerNames { ips: vec![], dns: vec![], ..names() }), Err(PkiError::NoHostName));
        for uri in ["", "EpsonRC", "urn:", ":x", "urn:a b", "urn:机器人", "1rn:x"] {
            let bad = ServerNames { application_uri: uri.into(), ..names() };
            assert_eq!(made_with(&bad), Err(PkiError::ApplicationUri(uri.into())));
        }
        for dns in ["", "robot..example", "robot 7", "机器人", "*.example", &"a".repeat(64)] {
            let bad = ServerNames { dns: vec![dns.into()], ..names() };
            assert_eq!(made_with(&bad), Err(PkiError::DnsName(dns.into())));
        }
    }
}
