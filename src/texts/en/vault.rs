//! Where connection passwords are kept, in English.

use crate::workspace::{PasswordPlace, StoreStatus, VaultState};

pub fn vault_state(store: &StoreStatus) -> String {
    let keyring = if store.keyring_fails && store.place == PasswordPlace::Keyring {
        "This computer has no keyring, or it is locked. "
    } else {
        ""
    };
    let vault = match store.vault {
        VaultState::None => "The workspace has no vault yet.".to_owned(),
        VaultState::Closed | VaultState::Declined => "The vault is closed.".to_owned(),
        VaultState::Open { passwords: 1 } => "The vault is open and holds 1 password.".to_owned(),
        VaultState::Open { passwords } => format!("The vault is open and holds {passwords} passwords."),
    };
    format!("{keyring}{vault}")
}
