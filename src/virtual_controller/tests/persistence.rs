use std::fs;

use serde_json::{Value, json};

use super::test_controller::{CURRENT, TestController, bounded, clients, initial, switch_on, with_certificate};
use crate::model::Changed;
use crate::protocol::{self, Request as _};
use crate::virtual_controller::{StoreError, SwitchOnError};

const FILE: &str = "controller.state";

#[tokio::test]
async fn a_controller_comes_back_as_it_was() {
    bounded(async {
        let test_controller = TestController::new(with_certificate(initial(CURRENT))).await;
        let client = test_controller.client().await;
        let user = json!({ "revision": 1, "name": "operator1", "password": "Passw0rd" });
        client.post::<Changed>(protocol::GetUsers::PATH, &user).await.unwrap();
        let step = json!({ "add": { "list": "trusted", "certificates": clients("c", 3) } });
        client.post::<Value>(protocol::EditTrust::PATH, &json!({ "revision": 2, "steps": [step] })).await.unwrap();
        let (state, fingerprint) = (test_controller.state(), test_controller.controller.fingerprint());
        test_controller.controller.shutdown().await;

        // What a process killed while writing leaves behind.
        fs::write(test_controller.folder.path().join("controller.state.new"), b"opcua-virtual-contr").unwrap();
        let again = switch_on(test_controller.folder.path(), initial(CURRENT)).await.unwrap();
        assert_eq!(again.state(), state);
        assert_eq!(again.fingerprint(), fingerprint);
        assert_eq!(again.info().revision.number(), 3);
    })
    .await;
}

#[tokio::test]
async fn a_damaged_file_is_refused_and_kept() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        test_controller.controller.shutdown().await;
        let path = test_controller.folder.path().join(FILE);
        let whole = fs::read(&path).unwrap();
        let mut flipped = whole.clone();
        *flipped.last_mut().unwrap() ^= 1;
        let beyond: &[u8] = &whole[..whole.len() / 2];
        for damaged in [b"".as_slice(), b"nonsense\n{}", beyond, &flipped] {
            fs::write(&path, damaged).unwrap();
            match switch_on(test_controller.folder.path(), initial(CURRENT)).await {
                Err(SwitchOnError::Store(StoreError::Damaged { kept, .. })) => {
                    assert_eq!(fs::read(kept).unwrap(), damaged);
                }
                other => panic!("{other:?}"),
            }
            assert!(!path.exists());
        }
        fs::write(&path, "opcua-virtual-controller 2 later").unwrap();
        fs::write(&path, "opcua-virtual-controller 2 later\n").unwrap();
        let newer = switch_on(test_controller.folder.path(), initial(CURRENT)).await;
        assert!(matches!(newer, Err(SwitchOnError::Store(StoreError::TooNew { .. }))));
        assert!(path.exists(), "a newer program's file is left alone");
        fs::write(&path, &whole).unwrap();
        switch_on(test_controller.folder.path(), initial(CURRENT)).await.unwrap();
    })
    .await;
}

#[cfg(unix)]
#[tokio::test]
async fn folder_and_file_belong_to_the_account_alone() {
    use std::os::unix::fs::PermissionsExt as _;
    bounded(async {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("R7A0000001");
        switch_on(&inner, initial(CURRENT)).await.unwrap().shutdown().await;
        let mode = |path: &std::path::Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
        assert_eq!(mode(&inner), 0o700);
        assert_eq!(mode(&inner.join(FILE)), 0o600);
        let text = fs::read_to_string(inner.join(FILE)).unwrap();
        assert!(!text.contains("connect me"));
    })
    .await;
}
