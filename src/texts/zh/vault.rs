//! Where connection passwords are kept, in Chinese.

use crate::workspace::{PasswordPlace, StoreStatus, VaultState};

fixed_texts! {
    PasswordsLabel: "连接密码";
    PasswordsKeyring: "本机密钥环";
    PasswordsVault: "工作区密码库";
    PasswordsNotKept: "密码未保存";
    PasswordsNotKeptTip: "已输入的密码仅在本窗口关闭前有效。单击以处理。";
    VaultOpen: "打开密码库…";
    VaultClose: "关闭密码库";
    VaultChange: "更改口令…";
    VaultCreateTitle: "创建密码库";
    VaultCreateText: "密码库将连接密码以口令加密保存在工作区中。每次启动程序时输入一次口令。没有口令则无法打开密码库。";
    VaultCreateNow: "创建";
    VaultOpenTitle: "打开密码库";
    VaultOpenText: "连接密码保存在该工作区的密码库中。如不打开，将逐一询问密码。";
    VaultOpenNow: "打开";
    VaultChangeTitle: "更改密码库口令";
    VaultChangeText: "此前复制的密码库文件仍可用旧口令打开。";
    VaultChangeNow: "更改";
    VaultNewPassphrase: "新口令";
    VaultPassphraseNeeded: "请输入密码库口令";
    VaultCreated: "已创建密码库，连接密码将保存在其中";
    VaultOpened: "密码库已打开";
    VaultPassphraseChanged: "密码库口令已更改";
}

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
