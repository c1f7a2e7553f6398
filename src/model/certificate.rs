use std::collections::BTreeSet;
use std::net::Ipv4Addr;

use chrono::{DateTime, Duration, Utc};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{Country, SecurityPolicy, SerialNumber};

/// How a server certificate came to be (manual 2.4.4.4). The numbers are those of the file names in appendix B-1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CertificateType {
    /// Made and signed by the controller or by this program (manual 2.7.1.2).
    SelfSigned,
    /// Legacy firmware only.
    UserSpecified,
    /// Issued by a CA for a signing request of the controller (manual 2.7.1.5).
    CaSigned,
}

impl CertificateType {
    /// All types, in the order of their numbers.
    pub const ALL: [Self; 3] = [Self::SelfSigned, Self::UserSpecified, Self::CaSigned];

    /// As the protocol and `--json` write it.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::SelfSigned => "self-signed",
            Self::UserSpecified => "user-specified",
            Self::CaSigned => "ca-signed",
        }
    }

    /// 1, 2 or 3: the prefix of this type's files (appendix B-1).
    pub const fn number(self) -> u8 {
        match self {
            Self::SelfSigned => 1,
            Self::UserSpecified => 2,
            Self::CaSigned => 3,
        }
    }
}

/// Length of an RSA key in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "u16", into = "u16")]
pub enum KeyLength {
    /// Only the deprecated policies take it.
    Rsa1024,
    /// 2048 bits; allowed by every security policy.
    Rsa2048,
    /// 4096 bits; not allowed by `Basic128Rsa15` and `Basic256`.
    Rsa4096,
}

impl KeyLength {
    /// All lengths, the shortest first.
    pub const ALL: [Self; 3] = [Self::Rsa1024, Self::Rsa2048, Self::Rsa4096];

    /// Length of the modulus in bits.
    pub const fn bits(self) -> u16 {
        match self {
            Self::Rsa1024 => 1024,
            Self::Rsa2048 => 2048,
            Self::Rsa4096 => 4096,
        }
    }
}

impl TryFrom<u16> for KeyLength {
    type Error = SubjectError;
    fn try_from(bits: u16) -> Result<Self, SubjectError> {
        Self::ALL.into_iter().find(|k| k.bits() == bits).ok_or(SubjectError::KeyLength(bits))
    }
}

impl From<KeyLength> for u16 {
    fn from(length: KeyLength) -> Self {
        length.bits()
    }
}

/// The key lengths every given policy allows (manual 2.7.1.2). 2048 is always among them.
pub fn offered_key_lengths(policies: &BTreeSet<SecurityPolicy>) -> Vec<KeyLength> {
    let allowed = |policy: SecurityPolicy| -> &[KeyLength] {
        match policy {
            SecurityPolicy::None => &[KeyLength::Rsa2048],
            SecurityPolicy::Basic128Rsa15 | SecurityPolicy::Basic256 => &[KeyLength::Rsa1024, KeyLength::Rsa2048],
            SecurityPolicy::Basic256Sha256
            | SecurityPolicy::Aes128Sha256RsaOaep
            | SecurityPolicy::Aes256Sha256RsaPss => &[KeyLength::Rsa2048, KeyLength::Rsa4096],
        }
    };
    if policies.is_empty() {
        return vec![KeyLength::Rsa2048];
    }
    KeyLength::ALL.into_iter().filter(|length| policies.iter().all(|p| allowed(*p).contains(length))).collect()
}

/// How long a self-signed certificate is valid: 1–10 years (manual 2.7.1.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "u8", into = "u8")]
pub struct Validity(u8);

impl Validity {
    /// Shortest validity, in years.
    pub const MIN_YEARS: u8 = 1;
    /// Longest validity, in years.
    pub const MAX_YEARS: u8 = 10;

    /// The validity in years, 1–10.
    pub const fn years(self) -> u8 {
        self.0
    }

    /// Years of 365.25 days.
    pub fn duration(self) -> Duration {
        Duration::hours(i64::from(self.0) * 8766)
    }
}

impl TryFrom<u8> for Validity {
    type Error = SubjectError;
    fn try_from(years: u8) -> Result<Self, SubjectError> {
        if (Self::MIN_YEARS..=Self::MAX_YEARS).contains(&years) {
            Ok(Self(years))
        } else {
            Err(SubjectError::Years(years))
        }
    }
}

impl From<Validity> for u8 {
    fn from(validity: Validity) -> Self {
        validity.0
    }
}

/// Who a certificate is for. Every field is half-width printable text (manual 2.7.1.2).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Subject {
    /// At most 64 characters (X.520 `ub-common-name`). Also the server's ApplicationName.
    pub common_name: String,
    /// An ISO 3166-1 alpha-2 code.
    pub country: String,
    /// State or province (ST); may be empty.
    pub state: String,
    /// City (L); may be empty.
    pub locality: String,
    /// Organisation (O); may be empty.
    pub organisation: String,
}

/// Which field of a certificate request is wrong, and how.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SubjectError {
    /// A required field is empty; holds its name.
    #[error("{0} is empty")]
    Empty(&'static str),
    /// A field is too long: its name, its length and the greatest length, in characters.
    #[error("{0} has {1} characters; at most {2} are allowed")]
    TooLong(&'static str, usize, usize),
    /// A field holds other characters than half-width printable ones; holds its name.
    #[error("{0} contains a character that is not half-width printable")]
    Characters(&'static str),
    /// The country is no ISO 3166-1 alpha-2 code; holds the text.
    #[error("\"{0}\" is not an ISO 3166-1 alpha-2 country code")]
    Country(String),
    /// The key length is none of [`KeyLength::ALL`]; holds the bits.
    #[error("{0} is not a key length; choose 1024, 2048 or 4096")]
    KeyLength(u16),
    /// A ticked security policy does not allow this key length; holds the bits.
    #[error("the ticked security policies do not allow {0}-bit keys")]
    KeyLengthNotAllowed(u16),
    /// The validity is out of range; holds the years.
    #[error("{0} years is not a validity; choose 1 to 10")]
    Years(u8),
}

impl Subject {
    /// The rules of manual 2.7.1.2, with the lengths of X.520's upper bounds.
    pub fn check(&self) -> Result<(), SubjectError> {
        let fields: [(&'static str, &str, usize, bool); 4] = [
            ("common name", &self.common_name, 64, true),
            ("state", &self.state, 128, false),
            ("locality", &self.locality, 128, false),
            ("organisation", &self.organisation, 64, false),
        ];
        for (field, text, max, required) in fields {
            if text.is_empty() && required {
                return Err(SubjectError::Empty(field));
            }
            if !text.bytes().all(|b| b.is_ascii_graphic() || b == b' ') {
                return Err(SubjectError::Characters(field));
            }
            if text.len() > max {
                return Err(SubjectError::TooLong(field, text.len(), max));
            }
        }
        if !self.country.is_empty() && Country::from_code(&self.country).is_none() {
            return Err(SubjectError::Country(self.country.clone()));
        }
        Ok(())
    }
}

/// What a self-signed certificate is to be made of.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SelfSignedRequest {
    /// Who the certificate is for.
    pub subject: Subject,
    /// Length of the new key.
    pub key_length: KeyLength,
    /// How long the certificate is valid.
    pub validity: Validity,
}

impl SelfSignedRequest {
    /// Checks the fields, and the key length against the ticked security policies. Returns the first field that is
    /// wrong.
    pub fn check(&self, policies: &BTreeSet<SecurityPolicy>) -> Result<(), SubjectError> {
        check_request(&self.subject, self.key_length, policies)
    }
}

/// What a certificate signing request is to be made of (manual 2.7.1.5): as a self-signed certificate, but how long the
/// certificate will be valid is for the CA to say.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CsrRequest {
    /// Who the certificate is for.
    pub subject: Subject,
    /// Length of the new key.
    pub key_length: KeyLength,
}

impl CsrRequest {
    /// As [`SelfSignedRequest::check`].
    pub fn check(&self, policies: &BTreeSet<SecurityPolicy>) -> Result<(), SubjectError> {
        check_request(&self.subject, self.key_length, policies)
    }
}

fn check_request(
    subject: &Subject,
    key_length: KeyLength,
    policies: &BTreeSet<SecurityPolicy>,
) -> Result<(), SubjectError> {
    subject.check()?;
    if !offered_key_lengths(policies).contains(&key_length) {
        return Err(SubjectError::KeyLengthNotAllowed(key_length.bits()));
    }
    Ok(())
}

/// How a certificate or a signing request is written to a file (manual 2.7.1.3, 2.7.1.5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FileFormat {
    /// Binary (ITU-T X.690), `.der` or `.csr`.
    #[default]
    Der,
    /// Base64 between `-----BEGIN …` and `-----END …` (RFC 7468).
    Pem,
}

impl FileFormat {
    /// Both, the default first.
    pub const ALL: [Self; 2] = [Self::Der, Self::Pem];

    /// The file name extension, without its dot.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Der => "der",
            Self::Pem => "pem",
        }
    }
}

/// `EpsonRC.<serial>.<IP with each part padded to three digits>` (manual 2.7.1.2): the default common name, and the
/// ApplicationName of the controller's OPC UA server.
pub fn default_common_name(serial: &SerialNumber, ip: Ipv4Addr) -> String {
    let [a, b, c, d] = ip.octets();
    format!("EpsonRC.{serial}.{a:03}.{b:03}.{c:03}.{d:03}")
}

/// What a list shows of one certificate without holding it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CertificateSummary {
    /// Common name of the subject, or the whole subject where it has none.
    pub issued_to: String,
    /// Common name of the issuer, or the whole name where it has none.
    pub issued_by: String,
    /// Upper-case hexadecimal.
    pub serial_number: String,
    /// First moment of the validity.
    pub not_before: DateTime<Utc>,
    /// Last moment of the validity.
    pub not_after: DateTime<Utc>,
    /// SHA-1 of the DER, upper-case hexadecimal: the one OPC UA tools show.
    pub thumbprint: String,
    /// Length of the public key in bits.
    pub key_bits: u16,
    /// The first URI of the subject alternative name.
    pub application_uri: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn subject() -> Subject {
        Subject {
            common_name: "EpsonRC.SN0000123.192.168.010.001".into(),
            country: "JP".into(),
            state: "Nagano".into(),
            locality: "Suwa".into(),
            organisation: "Example".into(),
        }
    }

    #[test]
    fn the_default_common_name_pads_the_address() {
        let serial = "SN0000123".parse().expect("serial");
        assert_eq!(default_common_name(&serial, Ipv4Addr::new(192, 168, 10, 1)), "EpsonRC.SN0000123.192.168.010.001");
    }

    #[test]
    fn key_lengths_are_those_every_policy_allows() {
        use SecurityPolicy as P;
        let offered = |p: &[P]| -> Vec<u16> {
            offered_key_lengths(&p.iter().copied().collect()).into_iter().map(KeyLength::bits).collect()
        };
        assert_eq!(offered(&[P::None]), [2048]);
        assert_eq!(offered(&[P::Basic256]), [1024, 2048]);
        assert_eq!(offered(&[P::Basic256Sha256, P::Aes256Sha256RsaPss]), [2048, 4096]);
        assert_eq!(offered(&P::ALL), [2048]);
        assert_eq!(offered(&[]), [2048]);
    }

    #[test]
    fn a_subject_is_half_width_printable() {
        assert_eq!(subject().check(), Ok(()));
        let wide = Subject { state: "长野".into(), ..subject() };
        assert_eq!(wide.check(), Err(SubjectError::Characters("state")));
        let nobody = Subject { common_name: String::new(), ..subject() };
        assert_eq!(nobody.check(), Err(SubjectError::Empty("common name")));
        let nowhere = Subject { country: "XX".into(), ..subject() };
        assert_eq!(nowhere.check(), Err(SubjectError::Country("XX".into())));
        let long = Subject { common_name: "a".repeat(65), ..subject() };
        assert_eq!(long.check(), Err(SubjectError::TooLong("common name", 65, 64)));
    }

    #[test]
    fn validity_is_1_to_10_years() {
        assert!(Validity::try_from(0).is_err());
        assert!(Validity::try_from(11).is_err());
        assert_eq!(Validity::try_from(10).map(Validity::years), Ok(10));
    }
}
