//! Sentences about where connection passwords are kept.

use crate::model::Language;
use crate::workspace::{PasswordPlace, StoreStatus, VaultState};

/// What the keyring and the vault are like.
pub fn vault_state(language: Language, store: &StoreStatus) -> String {
    let keyring = match (language, store.keyring_fails && store.place == PasswordPlace::Keyring) {
        (_, false) => "",
        (Language::En, true) => "This computer has no keyring, or it is locked. ",
        (Language::Zh, true) => "本机没有密钥环，或密钥环已锁定。",
    };
    let vault = match (language, store.vault) {
        (Language::En, VaultState::None) => "The workspace has no vault yet.".to_owned(),
        (Language::Zh, VaultState::None) => "该工作区还没有密码库。".to_owned(),
        (Language::En, VaultState::Closed | VaultState::Declined) => "The vault is closed.".to_owned(),
        (Language::Zh, VaultState::Closed | VaultState::Declined) => "密码库已关闭。".to_owned(),
        (Language::En, VaultState::Open { passwords: 1 }) => "The vault is open and holds 1 password.".to_owned(),
        (Language::En, VaultState::Open { passwords }) => format!("The vault is open and holds {passwords} passwords."),
        (Language::Zh, VaultState::Open { passwords }) => format!("密码库已打开，保存了 {passwords} 个密码。"),
    };
    format!("{keyring}{vault}")
}
