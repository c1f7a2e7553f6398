//! Where connection passwords are kept, in Chinese.

use crate::workspace::{PasswordPlace, StoreStatus, VaultState};

pub fn vault_state(store: &StoreStatus) -> String {
    let keyring = if store.keyring_fails && store.place == PasswordPlace::Keyring {
        "本机没有密钥环，或密钥环已锁定。"
    } else {
        ""
    };
    let vault = match store.vault {
        VaultState::None => "该工作区还没有密码库。".to_owned(),
        VaultState::Closed | VaultState::Declined => "密码库已关闭。".to_owned(),
        VaultState::Open { passwords } => format!("密码库已打开，保存了 {passwords} 个密码。"),
    };
    format!("{keyring}{vault}")
}
