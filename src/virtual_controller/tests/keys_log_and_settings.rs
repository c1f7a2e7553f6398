use chrono::Utc;
use serde_json::{Value, json};

use super::test_controller::{CURRENT, LEGACY, RequestFailure, TestController, bounded, code, initial};
use crate::model::{Changed, ErrorCode, LogChunk, ServerSettings};
use crate::protocol::{self, ExportContent, ExportedUser, Request as _, SettingsExport};
use crate::virtual_controller::demo_keys;

const PASSPHRASE: &str = "correct horse";

fn detail<T: std::fmt::Debug>(result: Result<T, RequestFailure>) -> String {
    match result {
        Err(RequestFailure::Failure(_, failure)) => failure.detail.unwrap_or_default(),
        other => panic!("not a refusal: {other:?}"),
    }
}

#[tokio::test]
async fn only_its_own_keys_activate_a_controller() {
    bounded(async {
        let mut new = initial(LEGACY);
        new.activated = false;
        let test_controller = TestController::new(new).await;
        let client = test_controller.client().await;
        let own = demo_keys(&test_controller.state().identity.serial);
        let body = |revision: u64, licence: &str, activation: &str| {
            json!({ "revision": revision, "licence": licence, "activation": activation })
        };
        let send = async |body: Value| client.post::<Changed>(protocol::Activate::PATH, &body).await;
        let (licence, activation) = (own.licence.to_string(), own.activation.to_string());
        let strange = "aaaa-aaaa-aaaa-aaaa";
        assert_eq!(code(send(body(1, strange, &activation)).await), ErrorCode::WrongKeys);
        assert_eq!(code(send(body(1, &licence, &"A".repeat(24))).await), ErrorCode::WrongKeys);
        let short = send(body(1, &licence, &activation[1..])).await;
        assert!(!detail(short).contains(&activation[1..]), "a mistake does not repeat a key");
        assert_eq!(code(send(body(1, &licence, "")).await), ErrorCode::BadActivationKey);
        assert_eq!(code(send(body(2, &licence, &activation)).await), ErrorCode::ChangedMeanwhile);
        assert!(!test_controller.state().activated);
        assert_eq!(send(body(1, &licence.to_uppercase(), &activation)).await.unwrap().revision.number(), 2);
        assert!(test_controller.state().activated);

        let test_controller = TestController::new(initial(CURRENT)).await;
        let result = test_controller.client().await.post::<Changed>(protocol::Activate::PATH, &body(1, &licence, &activation)).await;
        assert_eq!(code(result), ErrorCode::FirmwareTooNew);
    })
    .await;
}

#[tokio::test]
async fn a_log_is_asked_for_from_a_byte_on_and_in_no_other_way() {
    bounded(async {
        let test_controller = TestController::new(initial(LEGACY)).await;
        let client = test_controller.client().await;
        let ask = async |query: &str| client.get::<LogChunk>(&format!("{}{query}", protocol::GetLog::PATH)).await;
        for query in ["", "?", "?from=0", "?from=18446744073709551615"] {
            assert_eq!(ask(query).await.unwrap(), LogChunk::default(), "{query}");
        }
        for query in ["?from=", "?from=-1", "?from=18446744073709551616", "?to=1", "?from=0&from=1"] {
            assert_eq!(code(ask(query).await), ErrorCode::Refused, "{query}");
        }
    })
    .await;
}

/// Who knows the passphrase can seal anything; the controller checks it as if it came from a stranger.
#[tokio::test]
async fn a_sealed_export_is_checked_like_any_other_change() {
    bounded(async {
        let test_controller = TestController::new(initial(LEGACY)).await;
        let client = test_controller.client().await;
        let before = test_controller.state();
        let identity = before.identity.clone();
        let hash = "$argon2id$v=19$m=19456,t=2,p=1$bm9ib2R5bm9ib2R5bm9ibw$AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA";
        let user = |name: String, hash: &str| ExportedUser { name: name.parse().unwrap(), password_hash: hash.into() };
        let good = ExportContent { settings: before.settings.clone(), users: Vec::new(), activation: None };
        let import = async |content: &ExportContent, passphrase: &str| {
            let of = (identity.serial.clone(), identity.series, identity.firmware);
            let export = SettingsExport::new(of, Utc::now(), content, &PASSPHRASE.into()).unwrap();
            let body = json!({ "revision": 1, "export": export, "passphrase": passphrase });
            client.post::<Changed>(protocol::ImportSettings::PATH, &body).await
        };
        let none = ServerSettings { security_policies: Default::default(), ..good.settings.clone() };
        let taken = ServerSettings { port: before.used_ports[0].try_into().unwrap(), ..good.settings.clone() };
        let with_users = |users: Vec<ExportedUser>| ExportContent { users, ..good.clone() };
        let many = (0..11).map(|i| user(format!("operator{i}"), hash)).collect();
        let twice = vec![user("operator1".into(), hash), user("operator1".into(), hash)];
        let costly = vec![user("operator1".into(), &hash.replace("m=19456", "m=4194304"))];
        let strange = Some(demo_keys(&"R7A9999999".parse().unwrap()));
        for (content, expected) in [
            (ExportContent { settings: none, ..good.clone() }, ErrorCode::BadSettings),
            (ExportContent { settings: taken, ..good.clone() }, ErrorCode::PortConflict),
            (with_users(many), ErrorCode::TooManyUsers),
            (with_users(twice), ErrorCode::UserExists),
            (with_users(costly), ErrorCode::BadCredential),
            (ExportContent { activation: strange, ..good.clone() }, ErrorCode::WrongKeys),
        ] {
            assert_eq!(code(import(&content, PASSPHRASE).await), expected);
        }
        assert_eq!(code(import(&good, "correct house").await), ErrorCode::WrongPassphrase);
        let body = json!({ "revision": 1, "export": { "format": "secret" }, "passphrase": PASSPHRASE });
        let refused = client.post::<Changed>(protocol::ImportSettings::PATH, &body).await;
        assert!(!detail(refused).contains("secret"));
        assert_eq!(test_controller.state(), before);
        assert_eq!(
            import(&with_users(vec![user("operator1".into(), hash)]), PASSPHRASE).await.unwrap().revision.number(),
            2
        );
    })
    .await;
}
