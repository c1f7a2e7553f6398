use chrono::{DateTime, Utc};
use x509_cert::der::oid::ObjectIdentifier;
use x509_cert::ext::Extension;
use x509_cert::ext::pkix::{BasicConstraints, ExtendedKeyUsage, KeyUsage, KeyUsages};

use super::CertificateAuthority;
use super::authority::UnsignedCertificate;
use super::encode;
use super::requested::RequestedContents;
use crate::model::{CertificateProfile, Validity};
use crate::pki::{Certificate, Csr, PkiError, ServerNames};

/// What the CA is to make of a signing request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IssueRequest {
    /// Whether the certificate is for a server or a client.
    pub profile: CertificateProfile,
    /// Cut to the CA's own.
    pub validity: Validity,
    /// Instead of the names the request asks for; for tools whose requests name none.
    pub names: Option<ServerNames>,
    /// Sign keys of 1024 to 2047 bits, which only the deprecated security policies take. Otherwise that is
    /// [`PkiError::ShortKey`].
    pub allow_short_keys: bool,
}

impl CertificateAuthority {
    /// Signs the certificate of an OPC UA application (OPC 10000-6 §6.2.2).
    ///
    /// The subject is taken over byte by byte, the application URI, host names and addresses after a check; nothing
    /// else is taken from the request. Refuses a request without a common name, one that does not name exactly one
    /// URI, that of a server that names no host, names of other kinds, and keys that are too short.
    pub fn issue(&self, csr: &Csr, request: &IssueRequest, now: DateTime<Utc>) -> Result<Certificate, PkiError> {
        let bits = csr.key_bits();
        let shortest = if request.allow_short_keys { 1024 } else { 2048 };
        if bits < shortest {
            return Err(PkiError::ShortKey(bits));
        }
        let requested = RequestedContents::read(csr, request.names.as_ref())?;
        if requested.subject == self.name {
            return Err(PkiError::CsrRefused("asks for the name of the CA"));
        }
        if request.profile == CertificateProfile::Server && !requested.names_a_host() {
            return Err(PkiError::NoHostName);
        }
        let mut extensions = extensions(request.profile)?;
        extensions.push(encode::extension(&requested.names)?);
        self.certify(UnsignedCertificate {
            subject: requested.subject,
            public_key: requested.public_key,
            dates: self.dates(request.validity.duration(), now)?,
            extensions,
        })
    }
}

fn extensions(profile: CertificateProfile) -> Result<Vec<Extension>, PkiError> {
    let uses = KeyUsages::DigitalSignature
        | KeyUsages::NonRepudiation
        | KeyUsages::KeyEncipherment
        | KeyUsages::DataEncipherment;
    let extended = match profile {
        CertificateProfile::Server => vec![SERVER_AUTH, CLIENT_AUTH],
        CertificateProfile::Client => vec![CLIENT_AUTH],
    };
    Ok(vec![
        encode::extension(&BasicConstraints { ca: false, path_len_constraint: None })?,
        encode::extension(&KeyUsage(uses))?,
        encode::extension(&ExtendedKeyUsage(extended))?,
    ])
}

const SERVER_AUTH: ObjectIdentifier = ObjectIdentifier::new_unwrap("1.3.6.1.5.5.7.3.1");
const CLIENT_AUTH: ObjectIdentifier = ObjectIdentifier::new_unwrap("1.3.6.1.5.5.7.3.2");
