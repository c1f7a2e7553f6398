//! Where connection passwords are kept, in Japanese.

use crate::workspace::{PasswordPlace, StoreStatus, VaultState};

fixed_texts! {
    PasswordsLabel: "接続パスワードの保存先";
    PasswordsKeyring: "このPCのキーリング";
    PasswordsVault: "ワークスペースの保管庫";
    PasswordsNotKept: "パスワードは保存されません";
    PasswordsNotKeptTip: "入力したパスワードは、このウィンドウを閉じるまで保持されます。クリックすると保存方法を設定できます。";
    VaultOpen: "保管庫を開く…";
    VaultClose: "保管庫を閉じる";
    VaultChange: "パスフレーズの変更…";
    VaultCreateTitle: "パスワード保管庫の作成";
    VaultCreateText: "パスワード保管庫は、接続パスワードをパスフレーズで暗号化してワークスペースに保存します。パスフレーズは、本ツールを起動するたびに1回入力します。パスフレーズがないと、保管庫は開けません。";
    VaultCreateNow: "作成";
    VaultOpenTitle: "パスワード保管庫を開く";
    VaultOpenText: "接続パスワードは、このワークスペースのパスワード保管庫に保存されています。保管庫を開かない場合は、接続パスワードを都度入力します。";
    VaultOpenNow: "開く";
    VaultChangeTitle: "パスワード保管庫のパスフレーズの変更";
    VaultChangeText: "以前にコピーした保管庫ファイルは、変更後も古いパスフレーズで開けます。";
    VaultChangeNow: "変更";
    VaultNewPassphrase: "新しいパスフレーズ";
    VaultPassphraseNeeded: "パスワード保管庫のパスフレーズを入力してください";
    VaultCreated: "パスワード保管庫を作成しました。接続パスワードは保管庫に保存されます。";
    VaultOpened: "パスワード保管庫を開きました";
    VaultPassphraseChanged: "パスワード保管庫のパスフレーズを変更しました";
}

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
