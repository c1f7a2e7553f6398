//! The controller's end of exporting and importing settings (manual 2.6.4, 2.6.5). Slow: for a blocking thread.

use argon2::Params;
use argon2::password_hash::PasswordHash;
use secrecy::{ExposeSecret as _, SecretString};

use super::change_error::{SettingsChangeError, TransferError, UserChangeError};
use super::changes;
use super::state::{ControllerState, OperatingContext, User};
use crate::model::{FirmwareGeneration, MAX_USERS};
use crate::protocol::{ExportContent, ExportedUser, SettingsExport};

/// Seals what manual 2.6.1 to 2.6.3 sets.
pub fn export(
    state: &ControllerState,
    context: &OperatingContext,
    passphrase: &SecretString,
) -> Result<SettingsExport, TransferError> {
    legacy(state)?;
    if passphrase.expose_secret().is_empty() {
        return Err(TransferError::NoPassphrase);
    }
    let user = |user: &User| ExportedUser { name: user.name.clone(), password_hash: user.password_hash.clone() };
    let content = ExportContent {
        settings: state.settings.clone(),
        users: state.users.iter().map(user).collect(),
        activation: state.activation_keys.clone(),
    };
    let of = (state.identity.serial.clone(), state.identity.series, state.identity.firmware);
    Ok(SettingsExport::new(of, context.now, &content, passphrase)?)
}

/// Puts back what this controller sealed, after every check a single change would have met. Only the password of the
/// server log is not asked for again: it was switched on deliberately then.
pub fn import(
    state: &mut ControllerState,
    context: &OperatingContext,
    export: &SettingsExport,
    passphrase: &SecretString,
) -> Result<(), TransferError> {
    legacy(state)?;
    export.check_for(&state.identity.serial, state.identity.series, state.identity.firmware)?;
    let ExportContent { settings, users, activation } = export.open(passphrase)?;
    settings.check().map_err(SettingsChangeError::from)?;
    state.check_port(settings.port.get(), context).map_err(SettingsChangeError::from)?;
    if users.len() > MAX_USERS {
        return Err(UserChangeError::TooMany.into());
    }
    state.settings = settings;
    state.users.clear();
    for ExportedUser { name, password_hash } in users {
        if state.users.iter().any(|user| user.name == name) {
            return Err(UserChangeError::Exists(name).into());
        }
        check_hash(&password_hash)?;
        state.users.push(User { name, password_hash });
    }
    match activation {
        Some(keys) => Ok(changes::activate(state, keys)?),
        None => Ok(()),
    }
}

fn legacy(state: &ControllerState) -> Result<(), TransferError> {
    match state.generation() {
        FirmwareGeneration::Legacy => Ok(()),
        FirmwareGeneration::Current => Err(TransferError::FirmwareTooNew),
    }
}

/// A hash from outside must not be one that takes all memory at each login.
fn check_hash(hash: &str) -> Result<(), TransferError> {
    let affordable = |params: &Params| {
        params.m_cost() <= MAX_MEMORY_KIB && params.t_cost() <= MAX_PASSES && params.p_cost() <= MAX_LANES
    };
    let parsed = PasswordHash::new(hash).ok().filter(|hash| hash.algorithm == argon2::ARGON2ID_IDENT);
    match parsed.and_then(|hash| Params::try_from(&hash).ok()) {
        Some(params) if affordable(&params) => Ok(()),
        _ => Err(TransferError::CostlyHash),
    }
}

const MAX_MEMORY_KIB: u32 = 65_536;
const MAX_PASSES: u32 = 8;
const MAX_LANES: u32 = 4;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hash_of_any_cost_is_not_taken() {
        let hash = |cost: &str| {
            format!("$argon2id$v=19${cost}$bm9ib2R5bm9ib2R5bm9ibw$AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA")
        };
        assert_eq!(check_hash(&hash("m=19456,t=2,p=1")), Ok(()));
        for bad in [hash("m=4194304,t=2,p=1"), hash("m=19456,t=4000,p=1"), "Passw0rd".to_owned(), String::new()] {
            assert_eq!(check_hash(&bad), Err(TransferError::CostlyHash), "{bad}");
        }
    }
}
