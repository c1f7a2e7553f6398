//! The changes that are about server certificates beyond making or importing one with its key (manual 2.7.1.5, 2.7.2).
//! The rules of `changes` hold here too.

use super::change_error::CertificateChangeError;
use super::changes::install;
use super::secret_bytes::SecretBytes;
use super::state::{ControllerState, KeyPair, OperatingContext, PendingCsr};
use crate::model::{Base64Bytes, CertificateType, CsrRequest, FirmwareGeneration};
use crate::pki::{Certificate, Csr, PkiError, PrivateKey, check_usable, make_csr as csr_for, pkcs12_read_key};

/// Manual 2.7.1.5 on current firmware: the key is made here and stays here, beside the one of the certificate in use.
/// Gives the CSR's DER.
pub fn make_csr(
    state: &mut ControllerState,
    context: &OperatingContext,
    request: &CsrRequest,
) -> Result<Vec<u8>, CertificateChangeError> {
    if state.generation() == FirmwareGeneration::Legacy {
        return Err(CertificateChangeError::FirmwareTooOld);
    }
    request.check(&state.settings.security_policies)?;
    let key = PrivateKey::generate(request.key_length)?;
    let csr = csr_for(request, &state.server_names(context), &key)?;
    keep(state, &csr, &key)
}

/// Manual 2.7.1.5 on legacy firmware: key and CSR come from the PC, and the CA-signed certificate held so far is gone
/// unless it is for the same key. A certificate that comes with them is installed and selected. Gives the CSR's DER.
pub fn import_csr(
    state: &mut ControllerState,
    context: &OperatingContext,
    csr: &[u8],
    pkcs12: &[u8],
    password: &str,
    certificate: Option<&[u8]>,
) -> Result<Vec<u8>, CertificateChangeError> {
    if state.generation() == FirmwareGeneration::Current {
        return Err(CertificateChangeError::FirmwareTooNew);
    }
    let csr = Csr::from_der(csr)?;
    let key = pkcs12_read_key(pkcs12, password)?;
    if !csr.is_of(&key) {
        return Err(PkiError::NotAPair.into());
    }
    if !state.key_length_fits(key.bits()) {
        return Err(PkiError::KeyLengthNotAllowed(key.bits()).into());
    }
    let is_of_key = |held: &KeyPair| held.parse().is_ok_and(|certificate| csr.matches(&certificate));
    if !state.certificates.get(&CertificateType::CaSigned).is_some_and(is_of_key) {
        state.certificates.remove(&CertificateType::CaSigned);
    }
    let made = keep(state, &csr, &key)?;
    if let Some(certificate) = certificate {
        import_ca_signed(state, context, certificate)?;
    }
    Ok(made)
}

/// Manual 2.7.1.5: installs and selects what the CA issued for the CSR held here. Gives the certificate's DER.
pub fn import_ca_signed(
    state: &mut ControllerState,
    context: &OperatingContext,
    certificate: &[u8],
) -> Result<Vec<u8>, CertificateChangeError> {
    let pending = state.csr.as_ref().ok_or(CertificateChangeError::NoCsr)?;
    let certificate = Certificate::from_der(certificate)?;
    if !Csr::from_der(&pending.csr.0)?.matches(&certificate) {
        return Err(CertificateChangeError::CsrMismatch);
    }
    check_usable(&certificate, &state.settings.security_policies, context.now)?;
    let key = PrivateKey::from_pkcs8_der(&pending.private_key.0)?;
    install(state, CertificateType::CaSigned, &certificate, &key)
}

/// Manual 2.7.2: only a type that is held can be selected.
pub fn select_certificate(state: &mut ControllerState, kind: CertificateType) -> Result<(), CertificateChangeError> {
    if kind == CertificateType::UserSpecified && state.generation() == FirmwareGeneration::Current {
        return Err(CertificateChangeError::FirmwareTooNew);
    }
    if !state.certificates.contains_key(&kind) {
        return Err(CertificateChangeError::NotStored(kind));
    }
    state.selected = kind;
    Ok(())
}

fn keep(state: &mut ControllerState, csr: &Csr, key: &PrivateKey) -> Result<Vec<u8>, CertificateChangeError> {
    let der = csr.der().to_vec();
    state.csr = Some(PendingCsr { csr: Base64Bytes(der.clone()), private_key: SecretBytes(key.to_pkcs8_der()?) });
    Ok(der)
}
