use std::fmt;

use chrono::{DateTime, Utc};
use rcgen::{CertificateParams, ExtendedKeyUsagePurpose, IsCa, KeyIdMethod, KeyUsagePurpose};
use zeroize::Zeroizing;

use super::self_signed::{CLOCK_SKEW, alternative_names, date, distinguished_name, random_serial_number};
use super::{Certificate, PkiError, PrivateKey, ServerNames, pem};
use crate::model::{KeyLength, Subject, Validity, with_cause, with_told_cause};

/// The application instance certificate an OPC UA client of this computer shows to servers, and its key.
///
/// `Debug` shows the certificate only.
pub struct ClientIdentity {
    /// The certificate.
    pub certificate: Certificate,
    /// Its private key.
    pub key: PrivateKey,
}

impl ClientIdentity {
    /// The key as an unencrypted PKCS#8 in PEM.
    pub fn key_pem(&self) -> Result<Zeroizing<String>, PkiError> {
        Ok(Zeroizing::new(pem::private_key(&self.key.to_pkcs8_der()?)))
    }
}

impl fmt::Debug for ClientIdentity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("ClientIdentity").field(&self.certificate).finish()
    }
}

/// Makes a new client identity (OPC 10000-6 §6.2.2): self-signed, for client authentication only, RSA 2048, which is
/// the one length every security policy of the manual takes, valid for five years.
///
/// The common name is `<application>@<host>`, the ApplicationUri `urn:<host>:<application in lower case>:<random>`.
/// Of the host's name only what fits into both is used. Slow: off async threads.
pub fn client_identity(application: &str, host: &str, now: DateTime<Utc>) -> Result<ClientIdentity, PkiError> {
    let host = presentable(host);
    let mut random = [0; 8];
    getrandom::fill(&mut random).map_err(with_told_cause(PkiError::Random))?;
    let slug = application.to_ascii_lowercase().replace(' ', "-");
    let names = ServerNames {
        application_uri: format!("urn:{host}:{slug}:{}", hex::encode(random)),
        ips: Vec::new(),
        dns: vec![host.clone()],
    };
    let subject = Subject {
        common_name: format!("{application}@{host}"),
        country: String::new(),
        state: String::new(),
        locality: String::new(),
        organisation: String::new(),
    };
    let validity = Validity::try_from(VALID_YEARS)?;
    let key = PrivateKey::generate(KeyLength::Rsa2048)?;
    let mut params = CertificateParams::default();
    params.distinguished_name = distinguished_name(&subject)?;
    params.subject_alt_names = alternative_names(&names)?;
    params.key_usages = vec![
        KeyUsagePurpose::DigitalSignature,
        KeyUsagePurpose::ContentCommitment,
        KeyUsagePurpose::KeyEncipherment,
        KeyUsagePurpose::DataEncipherment,
        KeyUsagePurpose::KeyCertSign, // as in a server's self-signed certificate
    ];
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth];
    params.is_ca = IsCa::ExplicitNoCa;
    params.key_identifier_method = KeyIdMethod::Sha256;
    params.use_authority_key_identifier_extension = true;
    params.serial_number = Some(random_serial_number()?.into());
    params.not_before = date(now.checked_sub_signed(CLOCK_SKEW))?;
    params.not_after = date(now.checked_add_signed(validity.duration()))?;
    let certificate = params.self_signed(&key).map_err(with_cause(PkiError::Signing))?;
    Ok(ClientIdentity { certificate: Certificate::from_der(certificate.der())?, key })
}

/// A computer's name as one label of a DNS name.
fn presentable(host: &str) -> String {
    let label = host.split('.').next().unwrap_or_default();
    let kept: String =
        label.chars().filter(|c| c.is_ascii_alphanumeric() || *c == '-' || *c == '_').take(MAX_HOST).collect();
    if kept.is_empty() { "pc".to_owned() } else { kept }
}

const VALID_YEARS: u8 = 5;
/// With the application's name before it, it fits into a common name of 64 characters.
const MAX_HOST: usize = 32;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pki::{read_key_file, samples::now};
    use x509_parser::prelude::{FromDer, X509Certificate};

    #[test]
    fn it_is_what_a_server_wants_to_see_of_a_client() {
        let made = client_identity("OPC UA Configurator", "工位 Desk_7.plant.example", now()).unwrap();
        let certificate = &made.certificate;
        assert_eq!(certificate.common_name().as_deref(), Some("OPC UA Configurator@Desk_7"));
        let uri = certificate.application_uri().unwrap();
        assert!(uri.starts_with("urn:Desk_7:opc-ua-configurator:"), "{uri}");
        assert!(made.key.matches(certificate) && certificate.is_self_signed());
        assert_eq!((certificate.key_bits(), certificate.not_before()), (2048, now() - CLOCK_SKEW));
        let (_, parsed) = X509Certificate::from_der(certificate.der()).unwrap();
        let usage = parsed.extended_key_usage().unwrap().unwrap().value;
        assert!(usage.client_auth && !usage.server_auth);
        assert!(!parsed.basic_constraints().unwrap().unwrap().value.ca);
    }

    #[test]
    fn two_workspaces_of_one_computer_are_two_applications() {
        let of = || client_identity("OPC UA Configurator", "", now()).unwrap().certificate;
        let (one, other) = (of(), of());
        assert_ne!(one.application_uri(), other.application_uri());
        assert_eq!(one.common_name().as_deref(), Some("OPC UA Configurator@pc"));
    }

    #[test]
    fn the_key_is_written_so_that_it_can_be_read_and_shown_nowhere() {
        let made = client_identity("OPC UA Configurator", &"x".repeat(300), now()).unwrap();
        let read = read_key_file(made.key_pem().unwrap().as_bytes(), None).unwrap();
        assert!(read.matches(&made.certificate));
        assert!(format!("{made:?}").starts_with("ClientIdentity(Certificate("));
    }
}
