use std::fmt;

use chrono::{DateTime, Utc};
use rcgen::{
    CertificateParams, DistinguishedName, DnType, ExtendedKeyUsagePurpose, IsCa, KeyPair, KeyUsagePurpose,
    PKCS_ECDSA_P256_SHA256, date_time_ymd,
};
use zeroize::Zeroizing;

use super::self_signed::{CLOCK_SKEW, date, random_serial_number};
use super::{Fingerprint, PkiError};

/// What a controller's management interface shows of itself over TLS, and the key that proves it.
///
/// `Debug` shows the fingerprint only; the key is wiped when it is dropped.
#[derive(Clone, PartialEq, Eq)]
pub struct TlsIdentity {
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
    let key = KeyPair::generate_for(&PKCS_ECDSA_P256_SHA256).map_err(|_| PkiError::KeyGeneration)?;
    let key = Zeroizing::new(key);
    let mut params = CertificateParams::default();
    params.distinguished_name = DistinguishedName::new();
    params.distinguished_name.push(DnType::CommonName, common_name);
    params.key_usages = vec![KeyUsagePurpose::DigitalSignature];
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth];
    params.is_ca = IsCa::ExplicitNoCa;
    params.serial_number = Some(random_serial_number()?.into());
    params.not_before = date(now - CLOCK_SKEW)?;
    params.not_after = date_time_ymd(9999, 12, 31);
    let certificate = params.self_signed(&*key).map_err(|_| PkiError::Signing)?;
    Ok(TlsIdentity {
        certificate_der: certificate.der().to_vec(),
        private_key_pkcs8: Zeroizing::new(key.serialize_der()),
    })
}
