use secrecy::ExposeSecret as _;

use super::*;
use crate::model::{ErrorCode, Problem};

const PASSPHRASE: &str = "correct horse";

fn files(folder: &tempfile::TempDir) -> VaultFiles {
    VaultFiles::new(&folder.path().join("空 间"))
}

fn id(name: &str) -> Fingerprint {
    Fingerprint::of(name.as_bytes())
}

fn code<T>(result: Result<T, VaultError>) -> ErrorCode {
    Problem::from(result.map(drop).unwrap_err()).code
}

fn known(vault: &mut Vault, name: &str) -> Option<String> {
    vault.get(id(name)).unwrap().map(|password| password.expose_secret().to_owned())
}

#[test]
fn passwords_are_kept_under_the_passphrase_only() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(&folder);
    assert_eq!(code(files.open(&PASSPHRASE.into())), ErrorCode::VaultMissing);
    assert_eq!(code(files.create(&"short".into())), ErrorCode::BadPassphrase);
    let mut vault = files.create(&PASSPHRASE.into()).unwrap();
    vault.set(&[id("weld"), id("paint")], &"plant-password".into()).unwrap();
    vault.set(&[id("open")], &"".into()).unwrap();
    assert_eq!(code(files.create(&PASSPHRASE.into())), ErrorCode::VaultExists);
    let bytes = std::fs::read(files.path()).unwrap();
    for secret in ["plant-password", PASSPHRASE, &id("weld").to_string()] {
        assert!(!String::from_utf8_lossy(&bytes).contains(secret));
    }
    assert!(!format!("{vault:?}").contains("plant"));
    let mut again = files.open(&PASSPHRASE.into()).unwrap();
    assert_eq!(known(&mut again, "paint").as_deref(), Some("plant-password"));
    assert_eq!(known(&mut again, "open").as_deref(), Some(""), "a controller without a password is known as such");
    assert_eq!(known(&mut again, "other"), None);
    assert_eq!((again.forget(&[id("weld"), id("other")]).unwrap(), again.len()), (1, 2));
    assert_eq!(code(files.open(&"correct house".into())), ErrorCode::VaultPassphrase);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode() & 0o777;
        assert_eq!((mode(&files.path()), mode(files.path().parent().unwrap())), (0o600, 0o700));
    }
}

#[test]
fn what_cannot_be_read_says_why_and_is_left_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(&folder);
    let mut vault = files.create(&PASSPHRASE.into()).unwrap();
    vault.set(&[id("weld")], &"plant-password".into()).unwrap();
    let whole = std::fs::read_to_string(files.path()).unwrap();
    let sealed = whole.find("\"sealed\": \"").unwrap() + 20;
    let flipped = if whole.as_bytes()[sealed] == b'A' { "B" } else { "A" };
    let damaged = format!("{}{flipped}{}", &whole[..sealed], &whole[sealed + 1..]);
    for (bytes, expected) in [
        (damaged, ErrorCode::VaultDamaged),
        (whole[..whole.len() / 2].to_owned(), ErrorCode::VaultDamaged),
        (String::new(), ErrorCode::VaultDamaged),
        (whole.replace("opcua-configurator-vault", "else"), ErrorCode::VaultDamaged),
        (" ".repeat(file::MAX_VAULT_BYTES as usize + 1), ErrorCode::VaultDamaged),
        (whole.replace("\"version\": 1", "\"version\": 2"), ErrorCode::VaultVersion),
        (r#"{"format":"opcua-configurator-vault","version":2,"recipients":[]}"#.to_owned(), ErrorCode::VaultVersion),
    ] {
        std::fs::write(files.path(), &bytes).unwrap();
        assert_eq!(code(files.open(&PASSPHRASE.into())), expected);
        assert_eq!(code(vault.set(&[id("paint")], &"x".into())), expected);
        assert_eq!(code(vault.change_passphrase(&"another passphrase".into())), expected);
        assert_eq!(code(files.create(&PASSPHRASE.into())), ErrorCode::VaultExists);
        assert_eq!(std::fs::read_to_string(files.path()).unwrap(), bytes);
        assert_eq!(known(&mut vault, "weld").as_deref(), Some("plant-password"), "what is open stays usable");
    }
    std::fs::remove_file(files.path()).unwrap();
    assert_eq!(code(vault.set(&[id("paint")], &"x".into())), ErrorCode::VaultMissing);
    assert!(!files.exists(), "it is not made again behind the back of its owner");
    std::fs::create_dir(files.path()).unwrap();
    assert_eq!(code(files.open(&PASSPHRASE.into())), ErrorCode::FileUnreadable);
}

/// The checksum is no secret, so damage that was made on purpose has the right one.
#[test]
fn what_was_changed_on_purpose_does_not_open() {
    let key = SealingKey::new(&PASSPHRASE.into(), SealCost::PC).unwrap();
    let made = file::write(b"passwords", &key).unwrap();
    let sealed = file::parse(&made).unwrap();
    assert_eq!(file::open(&sealed, &key).unwrap().as_slice(), b"passwords");
    for position in 0..sealed.bytes.len() {
        let mut changed = sealed.clone();
        changed.bytes[position] ^= 1;
        assert_eq!(file::open(&changed, &key).unwrap_err(), SealError::NotOpened);
    }
    assert_eq!(key.open(&sealed, b"opcua-configurator-vault 2").unwrap_err(), SealError::NotOpened);
}

#[test]
fn processes_side_by_side_lose_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(&folder);
    files.create(&PASSPHRASE.into()).unwrap();
    std::thread::scope(|scope| {
        for process in 0..3 {
            let files = files.clone();
            scope.spawn(move || {
                let mut vault = files.open(&PASSPHRASE.into()).unwrap();
                for number in 0..10 {
                    vault.set(&[id(&format!("{process}-{number}"))], &"x".into()).unwrap();
                }
            });
        }
    });
    assert_eq!(files.open(&PASSPHRASE.into()).unwrap().len(), 30);
}

#[test]
fn what_another_process_did_is_seen() {
    let folder = tempfile::tempdir().unwrap();
    let files = files(&folder);
    let mut window = files.create(&PASSPHRASE.into()).unwrap();
    let mut command = files.open(&PASSPHRASE.into()).unwrap();
    command.set(&[id("weld")], &"plant-password".into()).unwrap();
    assert_eq!(known(&mut window, "weld").as_deref(), Some("plant-password"));

    command.change_passphrase(&"another passphrase".into()).unwrap();
    assert_eq!(code(window.set(&[id("paint")], &"x".into())), ErrorCode::VaultLocked);
    assert_eq!(code(window.get(id("paint"))), ErrorCode::VaultLocked);
    assert_eq!(code(files.open(&PASSPHRASE.into())), ErrorCode::VaultPassphrase);
    let mut window = files.open(&"another passphrase".into()).unwrap();
    assert_eq!(known(&mut window, "weld").as_deref(), Some("plant-password"));
}
