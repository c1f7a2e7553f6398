use crate::pki::name::quoted;
use crate::pki::{AlternativeName, Certificate, CertificateFlaw};

/// How many names of a certificate a message lists.
const MOST_NAMES: usize = 20;

/// Whether the certificate names one of the hosts; one of them is enough (OPC 10000-4 §6.1.3, step 7).
pub(in crate::pki) fn host_flaw(certificate: &Certificate, hosts: &[impl AsRef<str>]) -> Option<CertificateFlaw> {
    if hosts.iter().any(|host| certificate.names_host(host.as_ref())) {
        return None;
    }
    let is_host = |name: &&AlternativeName| matches!(name, AlternativeName::Dns(_) | AlternativeName::Ip(_));
    let names = certificate.alternative_names().iter().filter(is_host).take(MOST_NAMES);
    let names = names.map(|name| match name {
        AlternativeName::Dns(host) => quoted(host),
        other => other.to_string().trim_start_matches("IP:").to_owned(),
    });
    let hosts = hosts.iter().map(|host| quoted(host.as_ref()));
    Some(CertificateFlaw::HostName { hosts: hosts.collect(), names: names.collect() })
}

/// Whether the first URI of the certificate is the announced ApplicationUri (OPC 10000-4 §6.1.3, step 8). `announced`:
/// `None` if the application was not asked; then it is enough that there is a URI of ASCII characters.
pub(in crate::pki) fn application_uri_flaw(
    certificate: &Certificate,
    announced: Option<&str>,
) -> Option<CertificateFlaw> {
    let Some(found) = certificate.facts().extensions.application_uri() else {
        return Some(CertificateFlaw::UriMissing { announced: announced.map(quoted) });
    };
    let announced = announced.unwrap_or(found);
    if let Some(uri) = [found, announced].into_iter().find(|uri| !uri.is_ascii()) {
        return Some(CertificateFlaw::UriNotAscii { uri: quoted(uri) });
    }
    (found != announced)
        .then(|| CertificateFlaw::UriDiffers { certificate: quoted(found), announced: quoted(announced) })
}

/// The first DNS name or mailbox that is not ASCII. RFC 5280 §4.2.1.6 makes them IA5String; some applications read UTF-8.
pub(in crate::pki) fn name_not_ascii(certificate: &Certificate) -> Option<CertificateFlaw> {
    let is_text = |name: &&AlternativeName| matches!(name, AlternativeName::Dns(_) | AlternativeName::Email(_));
    let mut names = certificate.alternative_names().iter().filter(is_text).map(ToString::to_string);
    let name = names.find(|name| !name.is_ascii())?;
    Some(CertificateFlaw::NameNotAscii { name: quoted(&name) })
}
