//! Every change a controller accepts, as a function on a copy of its state.
//!
//! Each function checks all rules and limits itself (what a configurator checks beforehand is a courtesy) and may be
//! slow: keys are made and passwords hashed here, so they run on a blocking thread.

use chrono::{DateTime, Utc};

use super::activation_keys::demo_keys;
use super::change_error::{ActivationError, CertificateChangeError, SettingsChangeError, UserChangeError};
use super::opcua::hash_password;
use super::secret_bytes::SecretBytes;
use super::state::{ControllerState, KeyPair, OperatingContext, User};
use crate::model::activation::ActivationKeys;
use crate::model::{
    Base64Bytes, CertificateType, FirmwareGeneration, MAX_USERS, SelfSignedRequest, ServerSettings, UserName,
    UserPassword,
};
use crate::pki::{Certificate, PkiError, PrivateKey, check_usable, pkcs12_read, self_signed};

/// Manual 2.6.1. `log_password` is looked at only when the server log goes from off to on.
pub fn set_settings(
    state: &mut ControllerState,
    context: &OperatingContext,
    settings: ServerSettings,
    log_password: Option<&str>,
) -> Result<(), SettingsChangeError> {
    settings.check()?;
    state.check_port(settings.port.get(), context)?;
    let log_goes_on = settings.server_log && !state.settings.server_log;
    if log_goes_on && log_password != Some(ServerSettings::LOG_PASSWORD) {
        return Err(SettingsChangeError::LogPassword);
    }
    state.settings = settings;
    Ok(())
}

/// Manual 2.6.2.2.
pub fn add_user(state: &mut ControllerState, name: UserName, password: &str) -> Result<(), UserChangeError> {
    let password = UserPassword::new(password)?;
    if state.users.iter().any(|user| user.name == name) {
        return Err(UserChangeError::Exists(name));
    }
    if state.users.len() >= MAX_USERS {
        return Err(UserChangeError::TooMany);
    }
    let password_hash = hash_password(password.expose())?;
    state.users.push(User { name, password_hash });
    Ok(())
}

/// Manual 2.6.2.3: all of them, or none if one does not exist.
pub fn remove_users(state: &mut ControllerState, names: &[UserName]) -> Result<(), UserChangeError> {
    for name in names {
        if !state.users.iter().any(|user| user.name == *name) {
            return Err(UserChangeError::NotFound(name.clone()));
        }
    }
    state.users.retain(|user| !names.contains(&user.name));
    Ok(())
}

/// Manual 2.7.1.2 on current firmware: key and certificate are made here, and the key stays here.
/// Gives the certificate's DER.
pub fn make_self_signed(
    state: &mut ControllerState,
    context: &OperatingContext,
    request: &SelfSignedRequest,
) -> Result<Vec<u8>, CertificateChangeError> {
    if state.generation() == FirmwareGeneration::Legacy {
        return Err(CertificateChangeError::FirmwareTooOld);
    }
    install_self_signed(state, context, request, context.now)
}

/// Makes a self-signed certificate dated `made`, installs and selects it, on any firmware.
pub fn install_self_signed(
    state: &mut ControllerState,
    context: &OperatingContext,
    request: &SelfSignedRequest,
    made: DateTime<Utc>,
) -> Result<Vec<u8>, CertificateChangeError> {
    request.check(&state.settings.security_policies)?;
    let key = PrivateKey::generate(request.key_length)?;
    let certificate = self_signed(request, &state.server_names(context), &key, made)?;
    install(state, CertificateType::SelfSigned, &certificate, &key)
}

/// Manual 2.7.1 on legacy firmware: key and certificate come from the PC. Gives the certificate's DER.
pub fn import_certificate(
    state: &mut ControllerState,
    context: &OperatingContext,
    kind: CertificateType,
    pkcs12: &[u8],
    password: &str,
) -> Result<Vec<u8>, CertificateChangeError> {
    if state.generation() == FirmwareGeneration::Current {
        return Err(CertificateChangeError::FirmwareTooNew);
    }
    if kind == CertificateType::CaSigned {
        return Err(CertificateChangeError::KeyOfCsr);
    }
    let (key, chain) = pkcs12_read(pkcs12, password)?;
    let certificate = chain.iter().find(|c| key.matches(c)).ok_or(PkiError::NotAPair)?;
    check_usable(certificate, &state.settings.security_policies, context.now)?;
    if kind == CertificateType::SelfSigned && !certificate.is_self_signed() {
        return Err(CertificateChangeError::NotSelfSigned);
    }
    install(state, kind, certificate, &key)
}

/// Manual 2.6.3.
pub fn activate(state: &mut ControllerState, keys: ActivationKeys) -> Result<(), ActivationError> {
    if state.generation() == FirmwareGeneration::Current {
        return Err(ActivationError::FirmwareTooNew);
    }
    if keys != demo_keys(&state.identity.serial) {
        return Err(ActivationError::WrongKeys(state.identity.serial.clone()));
    }
    state.activated = true;
    state.activation_keys = Some(keys);
    Ok(())
}

pub(super) fn install(
    state: &mut ControllerState,
    kind: CertificateType,
    certificate: &Certificate,
    key: &PrivateKey,
) -> Result<Vec<u8>, CertificateChangeError> {
    let der = certificate.der().to_vec();
    let private_key = SecretBytes(key.to_pkcs8_der()?);
    state.certificates.insert(kind, KeyPair { certificate: Base64Bytes(der.clone()), private_key });
    state.selected = kind;
    Ok(der)
}
