use std::fmt;

use chrono::{DateTime, Utc};
use rcgen::{
    CertificateParams, DistinguishedName, DnType, ExtendedKeyUsagePurpose, IsCa, KeyPair, KeyUsagePurpose,
    PKCS_ECDSA_P256_SHA256,
};
use zeroize::Zeroizing;

use super::self_signed::{CLOCK_SKEW, date, random_serial_number};
use super::{Fingerprint, PkiError};
use crate::model::with_cause;

/// What a controller's management interface shows of itself over TLS, and the key that proves it.
///
/// `Debug` shows the fingerprint only; the key is wiped when it is dropped.
#[derive(Clone, PartialEq, Eq)]
pub struct TlsIdentity {
    /// Self-signed.
    pub certificate_der: Vec<u8>,
    /// ECDSA P-256, unencrypted.
    pub private_key_pkcs8: Zeroizing<Vec<u8>>,
}

impl TlsIdentity {
    /// What a configurator pins.
    pub fn fingerprint(&self) -> Fingerprint {
        Fingerprint::of(&self.certificate_der)
    }
}

impl fmt::Debug for TlsIdentity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "TlsIdentity({})", self.fingerprint())
    }
}

/// Makes a new management identity: ECDSA P-256, self-signed. Fast.
///
/// It is pinned, so neither its name nor its dates are looked at; it does not expire (RFC 5280 §4.1.2.5).
pub fn tls_identity(common_name: &str, now: DateTime<Utc>) -> Result<TlsIdentity, PkiError> {
    let key = KeyPair::generate_for(&PKCS_ECDSA_P256_SHA256).map_err(with_cause(PkiError::KeyGeneration))?;
    let key = Zeroizing::new(key);
    let mut params = CertificateParams::default();
    params.distinguished_name = DistinguishedName::new();
    params.distinguished_name.push(DnType::CommonName, common_name);
    params.key_usages = vec![KeyUsagePurpose::DigitalSignature];
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth];
    params.is_ca = IsCa::ExplicitNoCa;
    params.serial_number = Some(random_serial_number()?.into());
    params.not_before = date(now.checked_sub_signed(CLOCK_SKEW))?;
    params.not_after = date(DateTime::from_timestamp(NEVER, 0))?;
    let certificate = params.self_signed(&*key).map_err(with_cause(PkiError::Signing))?;
    Ok(TlsIdentity {
        certificate_der: certificate.der().to_vec(),
        private_key_pkcs8: Zeroizing::new(key.serialize_der()),
    })
}

/// 9999-12-31T23:59:59Z, which X.509 defines as "does not expire".
const NEVER: i64 = 253_402_300_799;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pki::{Certificate, samples::now};

    #[test]
    fn an_identity_does_not_expire() {
        let identity = tls_identity("SN0000123", now()).unwrap();
        let certificate = Certificate::from_der(&identity.certificate_der).unwrap();
        assert_eq!(certificate.common_name().as_deref(), Some("SN0000123"));
        assert!(certificate.is_self_signed());
        assert!(certificate.not_before() < now());
        assert_eq!(certificate.not_after().to_rfc3339(), "9999-12-31T23:59:59+00:00");
    }

    #[test]
    fn every_identity_has_its_own_key_and_fingerprint() {
        let (one, other) = (tls_identity("same", now()).unwrap(), tls_identity("same", now()).unwrap());
        assert_ne!(one.private_key_pkcs8, other.private_key_pkcs8);
        assert_ne!(one.fingerprint(), other.fingerprint());
        assert_eq!(one.fingerprint(), Fingerprint::of(&one.certificate_der));
    }

    #[test]
    fn key_and_certificate_serve_tls() {
        let identity = tls_identity("SN0000123", now()).unwrap();
        let key = rustls::pki_types::PrivatePkcs8KeyDer::from(identity.private_key_pkcs8.to_vec());
        let provider = std::sync::Arc::new(rustls::crypto::aws_lc_rs::default_provider());
        rustls::ServerConfig::builder_with_provider(provider)
            .with_safe_default_protocol_versions()
            .unwrap()
            .with_no_client_auth()
            .with_single_cert(vec![identity.certificate_der.into()], key.into())
            .unwrap();
    }

    #[test]
    fn debug_shows_the_fingerprint_only() {
        let identity = tls_identity("SN0000123", now()).unwrap();
        assert_eq!(format!("{identity:?}"), format!("TlsIdentity({})", identity.fingerprint()));
    }
}
