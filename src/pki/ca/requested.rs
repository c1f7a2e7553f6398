use std::net::IpAddr;

use x509_cert::der::Decode as _;
use x509_cert::der::asn1::{Ia5String, OctetString};
use x509_cert::ext::pkix::SubjectAltName;
use x509_cert::ext::pkix::name::GeneralName;
use x509_cert::name::Name;
use x509_cert::spki::SubjectPublicKeyInfoOwned;
use x509_parser::certification_request::X509CertificationRequest;
use x509_parser::prelude::{FromDer as _, ParsedExtension};

use super::encode;
use crate::model::with_cause;
use crate::pki::csr::requested_extensions;
use crate::pki::{Csr, PkiError, ServerNames};

/// What of a signing request goes into the certificate.
pub(super) struct RequestedContents {
    /// Order, repetitions and string types as they were asked for: a tool compares them with its own.
    pub subject: Name,
    pub public_key: SubjectPublicKeyInfoOwned,
    pub names: SubjectAltName,
}

impl RequestedContents {
    /// `instead` replaces the names of the request.
    pub fn read(csr: &Csr, instead: Option<&ServerNames>) -> Result<Self, PkiError> {
        let (_, parsed) = X509CertificationRequest::from_der(csr.der()).map_err(with_cause(PkiError::NotACsr))?;
        let info = &parsed.certification_request_info;
        let subject = Name::from_der(info.subject.as_raw()).map_err(damaged("name"))?;
        let named = |part: &x509_cert::attr::AttributeTypeAndValue| {
            part.oid == encode::COMMON_NAME && !part.value.value().is_empty()
        };
        if !subject.0.iter().flat_map(|part| part.0.iter()).any(named) {
            return Err(PkiError::CsrRefused("has no common name"));
        }
        let public_key =
            SubjectPublicKeyInfoOwned::from_der(info.subject_pki.raw).map_err(with_cause(PkiError::NotACsr))?;
        let names = match instead {
            Some(names) => names.clone(),
            None => names_of(&parsed)?,
        };
        names.check()?;
        Ok(Self { subject, public_key, names: SubjectAltName(written(&names)?) })
    }

    pub fn names_a_host(&self) -> bool {
        self.names.0.iter().any(|name| matches!(name, GeneralName::DnsName(_) | GeneralName::IpAddress(_)))
    }
}

/// A part of the request cannot be read.
fn damaged<E: std::error::Error + Send + Sync + 'static>(part: &'static str) -> impl FnOnce(E) -> PkiError {
    with_cause(move |cause| PkiError::CsrDamaged { part, cause })
}

fn names_of(parsed: &X509CertificationRequest<'_>) -> Result<ServerNames, PkiError> {
    use x509_parser::prelude::GeneralName;
    let (mut uris, mut ips, mut dns) = (Vec::new(), Vec::new(), Vec::new());
    for extension in &requested_extensions(parsed)? {
        let san = match extension.parsed_extension() {
            ParsedExtension::SubjectAlternativeName(san) => san,
            ParsedExtension::ParseError { error } => return Err(damaged("extension")(error.clone())),
            _ => continue,
        };
        for name in &san.general_names {
            match name {
                GeneralName::URI(uri) => uris.push((*uri).to_owned()),
                GeneralName::DNSName(name) => dns.push((*name).to_owned()),
                GeneralName::IPAddress(bytes) => ips.push(ip(bytes)?),
                _ => return Err(PkiError::CsrRefused("asks for a name that is no URI, host name or IP address")),
            }
        }
    }
    match <[String; 1]>::try_from(uris) {
        Ok([application_uri]) => Ok(ServerNames { application_uri, ips, dns }),
        Err(none) if none.is_empty() => Err(PkiError::CsrRefused("names no application URI")),
        Err(_) => Err(PkiError::CsrRefused("names several URIs; exactly one, the application URI, is expected")),
    }
}

fn ip(bytes: &[u8]) -> Result<IpAddr, PkiError> {
    if let Ok(v4) = <[u8; 4]>::try_from(bytes) {
        Ok(v4.into())
    } else if let Ok(v6) = <[u8; 16]>::try_from(bytes) {
        Ok(v6.into())
    } else {
        Err(PkiError::CsrRefused("has an IP address of a wrong length"))
    }
}

/// The URI comes first: some peers look only there.
fn written(names: &ServerNames) -> Result<Vec<GeneralName>, PkiError> {
    let text = |text: &str| Ia5String::new(text).map_err(encode::signing);
    let mut all = vec![GeneralName::UniformResourceIdentifier(text(&names.application_uri)?)];
    for dns in &names.dns {
        all.push(GeneralName::DnsName(text(dns)?));
    }
    for ip in &names.ips {
        let bytes = match ip {
            IpAddr::V4(ip) => ip.octets().to_vec(),
            IpAddr::V6(ip) => ip.octets().to_vec(),
        };
        all.push(GeneralName::IpAddress(OctetString::new(bytes).map_err(encode::signing)?));
    }
    Ok(all)
}
