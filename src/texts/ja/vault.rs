//! Where connection passwords are kept, in Japanese.

use crate::workspace::{PasswordPlace, StoreStatus, VaultState};

pub fn vault_state(store: &StoreStatus) -> String {
    let keyring = if store.keyring_fails && store.place == PasswordPlace::Keyring {
        "このPCにキーリングがないか、ロックされています。"
    } else {
        ""
    };
    let vault = match store.vault {
        VaultState::None => "このワークスペースにパスワード保管庫はありません。".to_owned(),
        VaultState::Closed | VaultState::Declined => "パスワード保管庫は閉じています。".to_owned(),
        VaultState::Open { passwords } => {
            format!("パスワード保管庫は開いており、{passwords}件のパスワードが保存されています。")
        }
    };
    format!("{keyring}{vault}")
}
