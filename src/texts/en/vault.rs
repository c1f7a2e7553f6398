//! Where connection passwords are kept, in English.

use crate::workspace::{PasswordPlace, StoreStatus, VaultState};

english_texts! { vault:
    PasswordsLabel: "Connection passwords";
    PasswordsKeyring: "Keyring of this computer";
    PasswordsVault: "Vault in the workspace";
    PasswordsNotKept: "Passwords are not kept";
    PasswordsNotKeptTip: "A password that was entered is known until this window is closed. Click to do something about it.";
    VaultOpen: "Open vault…";
    VaultClose: "Close vault";
    VaultChange: "Change passphrase…";
    VaultCreateTitle: "Create a vault for passwords";
    VaultCreateText: "The vault keeps connection passwords in the workspace, sealed under a passphrase. It is asked for once each time the program starts. Nobody can open the vault without it.";
    VaultCreateNow: "Create";
    VaultOpenTitle: "Open the vault for passwords";
    VaultOpenText: "The connection passwords are in the vault of this workspace. If it is not opened, they are asked for instead.";
    VaultOpenNow: "Open";
    VaultChangeTitle: "Change the passphrase of the vault";
    VaultChangeText: "Copies of the vault that were made before still open with the old passphrase.";
    VaultChangeNow: "Change";
    VaultNewPassphrase: "New passphrase";
    VaultPassphraseNeeded: "Enter the passphrase of the vault";
    VaultCreated: "The vault was created: connection passwords are kept in it";
    VaultOpened: "The vault is open";
    VaultPassphraseChanged: "The passphrase of the vault was changed";
}

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
