//! Every change a controller accepts, as a function on a copy of its state.
//!
//! Each function checks all rules and limits itself (what a configurator checks beforehand is a courtesy) and may be
//! slow: keys are made and passwords hashed here, so they run on a blocking thread.

use chrono::{DateTime, Utc};

use super::activation_keys::demo_keys;
use super::opcua::hash_password;
use super::secret_bytes::SecretBytes;
use super::state::{ControllerState, KeyPair, OperatingContext, User};
use crate::model::activation::ActivationKeys;
use crate::model::{
    Base64Bytes, CertificateType, ErrorCode, FirmwareGeneration, MAX_USERS, Problem, SelfSignedRequest, ServerSettings,
    UserName, UserPassword,
};
use crate::pki::{Certificate, PkiError, PrivateKey, check_usable, pkcs12_read, self_signed};

/// Manual 2.6.1. `log_password` is looked at only when the server log goes from off to on.
pub fn set_settings(
    state: &mut ControllerState,
    context: &OperatingContext,
    settings: ServerSettings,
    log_password: Option<&str>,
) -> Result<(), Problem> {
    settings.check().map_err(|error| Problem::with_detail(ErrorCode::BadSettings, error))?;
    state.check_port(settings.port.get(), context)?;
    let log_goes_on = settings.server_log && !state.settings.server_log;
    if log_goes_on && log_password != Some(ServerSettings::LOG_PASSWORD) {
        return Err(ErrorCode::LogPassword.into());
    }
    state.settings = settings;
    Ok(())
}

/// Manual 2.6.2.2.
pub fn add_user(state: &mut ControllerState, name: UserName, password: &str) -> Result<(), Problem> {
    let password =
        UserPassword::new(password).map_err(|error| Problem::with_detail(ErrorCode::BadCredential, error))?;
    if state.users.iter().any(|user| user.name == name) {
        return Err(Problem::with_detail(ErrorCode::UserExists, name));
    }
    if state.users.len() >= MAX_USERS {
        return Err(ErrorCode::TooManyUsers.into());
    }
    let password_hash =
        hash_password(password.expose()).map_err(|error| Problem::with_detail(ErrorCode::Internal, error))?;
    state.users.push(User { name, password_hash });
    Ok(())
}

/// Manual 2.6.2.3: all of them, or none if one does not exist.
pub fn remove_users(state: &mut ControllerState, names: &[UserName]) -> Result<(), Problem> {
    for name in names {
        if !state.users.iter().any(|user| user.name == *name) {
            return Err(Problem::with_detail(ErrorCode::UserNotFound, name));
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
) -> Result<Vec<u8>, Problem> {
    if state.generation() == FirmwareGeneration::Legacy {
        return Err(ErrorCode::FirmwareTooOld.into());
    }
    install_self_signed(state, context, request, context.now)
}

/// Makes a self-signed certificate dated `made`, installs and selects it, whatever the firmware.
pub fn install_self_signed(
    state: &mut ControllerState,
    context: &OperatingContext,
    request: &SelfSignedRequest,
    made: DateTime<Utc>,
) -> Result<Vec<u8>, Problem> {
    request
        .check(&state.settings.security_policies)
        .map_err(|error| Problem::with_detail(ErrorCode::BadCertificateRequest, error))?;
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
) -> Result<Vec<u8>, Problem> {
    if state.generation() == FirmwareGeneration::Current {
        return Err(ErrorCode::FirmwareTooNew.into());
    }
    if kind == CertificateType::CaSigned {
        return Err(Problem::with_detail(ErrorCode::Refused, "a CA-signed certificate is for the key of a CSR"));
    }
    let (key, chain) = pkcs12_read(pkcs12, password)?;
    let certificate = chain.iter().find(|c| key.matches(c)).ok_or(PkiError::NotAPair)?;
    check_usable(certificate, &state.settings.security_policies, context.now)?;
    if kind == CertificateType::SelfSigned && !certificate.is_self_signed() {
        return Err(Problem::with_detail(ErrorCode::BadCertificate, "the certificate is not self-signed"));
    }
    install(state, kind, certificate, &key)
}

/// Manual 2.6.3.
pub fn activate(state: &mut ControllerState, keys: ActivationKeys) -> Result<(), Problem> {
    if state.generation() == FirmwareGeneration::Current {
        return Err(ErrorCode::FirmwareTooNew.into());
    }
    if keys != demo_keys(&state.identity.serial) {
        return Err(Problem::with_detail(ErrorCode::WrongKeys, &state.identity.serial));
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
) -> Result<Vec<u8>, Problem> {
    let der = certificate.der().to_vec();
    let private_key = SecretBytes(key.to_pkcs8_der()?);
    state.certificates.insert(kind, KeyPair { certificate: Base64Bytes(der.clone()), private_key });
    state.selected = kind;
    Ok(der)
}
