//! A certification authority that signs what it is told to.

use opcua_configurator::pki::Csr;
use rcgen::{
    CertificateParams, CertificateSigningRequestParams, DnType, ExtendedKeyUsagePurpose, IsCa, Issuer, KeyPair,
    KeyUsagePurpose,
};
use time::{Duration, OffsetDateTime};

pub struct Ca(Issuer<'static, KeyPair>, Vec<u8>);

impl Ca {
    pub fn new() -> Self {
        let mut params = CertificateParams::default();
        params.distinguished_name.push(DnType::CommonName, "Plant CA");
        params.is_ca = IsCa::Ca(rcgen::BasicConstraints::Unconstrained);
        let key = KeyPair::generate().unwrap();
        let certificate = params.self_signed(&key).unwrap().der().to_vec();
        Self(Issuer::new(params, key), certificate)
    }

    /// Its own certificate, in DER.
    pub fn certificate(&self) -> &[u8] {
        &self.1
    }

    /// What a careful CA makes of a request: valid from an hour ago for a year, and otherwise as asked.
    pub fn sign(&self, csr: &Csr) -> Vec<u8> {
        self.sign_changed(csr, |_| {})
    }

    /// What a careless one makes of it.
    pub fn sign_changed(&self, csr: &Csr, change: impl FnOnce(&mut CertificateParams)) -> Vec<u8> {
        let mut request = CertificateSigningRequestParams::from_der(&csr.der().into()).unwrap();
        let params = &mut request.params;
        params.key_usages = vec![
            KeyUsagePurpose::DigitalSignature,
            KeyUsagePurpose::ContentCommitment,
            KeyUsagePurpose::KeyEncipherment,
            KeyUsagePurpose::DataEncipherment,
        ];
        params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth, ExtendedKeyUsagePurpose::ClientAuth];
        params.not_before = OffsetDateTime::now_utc() - Duration::hours(1);
        params.not_after = OffsetDateTime::now_utc() + Duration::days(365);
        change(params);
        request.signed_by(&self.0).unwrap().der().to_vec()
    }
}
