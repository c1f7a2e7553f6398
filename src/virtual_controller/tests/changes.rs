use std::collections::BTreeSet;

use chrono::{TimeDelta, Utc};
use serde_json::{Value, json};

use super::test_controller::{
    CURRENT, KEY, LEGACY, TestController, bounded, certificate, clients, code, initial, request, with_certificate,
};
use crate::model::{
    CertificateType, Changed, ClientList, ErrorCode, ListLimits, ListedCertificate, RevisionToken, Revisioned,
    SecurityPolicy, ServerPort, ServerSettings, ServerStatus, UserName,
};
use crate::pki::{Certificate, pkcs12_write};
use crate::protocol::{self, CertificateInstalled, Request as _};
use crate::virtual_controller::NewController;

fn set(revision: u64, settings: &ServerSettings) -> Value {
    json!({ "revision": revision, "settings": settings })
}

#[tokio::test]
async fn settings_follow_the_rules() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let client = test_controller.client().await;
        let before: Revisioned<ServerSettings> = client.get(protocol::GetSettings::PATH).await.unwrap();
        let settings = before.value;
        let put = async |body: Value| client.put::<Changed>(protocol::GetSettings::PATH, &body).await;

        let none = ServerSettings { security_policies: BTreeSet::new(), ..settings.clone() };
        assert_eq!(code(put(set(1, &none)).await), ErrorCode::BadSettings);
        let nobody = ServerSettings { user_tokens: BTreeSet::new(), ..settings.clone() };
        assert_eq!(code(put(set(1, &nobody)).await), ErrorCode::BadSettings);
        let mut system = set(1, &settings);
        system["settings"]["port"] = json!(80);
        assert_eq!(code(put(system).await), ErrorCode::BadSettings);
        for taken in [5000, test_controller.controller.management_address().port()] {
            let taken = ServerSettings { port: ServerPort::try_from(taken).unwrap(), ..settings.clone() };
            assert_eq!(code(put(set(1, &taken)).await), ErrorCode::PortConflict);
        }
        let log = ServerSettings { server_log: true, ..settings.clone() };
        assert_eq!(code(put(set(1, &log)).await), ErrorCode::LogPassword);
        let mut wrong = set(1, &log);
        wrong["log_password"] = json!("199533");
        assert_eq!(code(put(wrong).await), ErrorCode::LogPassword);
        assert_eq!(test_controller.revision(), 1, "nothing was changed so far");

        let mut right = set(1, &log);
        right["log_password"] = json!("199532");
        right["delete_log"] = json!(true);
        assert_eq!(put(right).await.unwrap(), Changed { revision: RevisionToken::new(2), status: ServerStatus::Stop });
        put(set(2, &log)).await.expect("it is on already, so no password is asked");
        assert_eq!(test_controller.state().settings, log);
    })
    .await;
}

#[tokio::test]
async fn a_change_based_on_an_old_revision_is_refused() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let client = test_controller.client().await;
        let settings = test_controller.state().settings.clone();
        client.put::<Changed>(protocol::GetSettings::PATH, &set(1, &settings)).await.unwrap();
        let before = test_controller.state();
        for stale in [0, 1, 3, u64::MAX] {
            let result = client.put::<Changed>(protocol::GetSettings::PATH, &set(stale, &settings)).await;
            assert_eq!(code(result), ErrorCode::ChangedMeanwhile);
        }
        assert_eq!(test_controller.state(), before);
    })
    .await;
}

#[tokio::test]
async fn users_are_ten_at_most_and_each_name_once() {
    bounded(async {
        let test_controller = TestController::new(initial(LEGACY)).await;
        let client = test_controller.client().await;
        let add = async |revision: u64, name: &str, password: &str| {
            let body = json!({ "revision": revision, "name": name, "password": password });
            client.post::<Changed>(protocol::GetUsers::PATH, &body).await
        };
        let remove = async |revision: u64, names: Value| {
            client.post::<Changed>(protocol::RemoveUsers::PATH, &json!({ "revision": revision, "names": names })).await
        };
        assert_eq!(code(add(1, "short", "Passw0rd").await), ErrorCode::BadCredential);
        assert_eq!(code(add(1, "operator1", "short").await), ErrorCode::BadCredential);
        assert_eq!(code(add(1, "operator1", "with symbols!").await), ErrorCode::BadCredential);
        for i in 0..10 {
            add(1 + i, &format!("operator{i}"), "Passw0rd").await.unwrap();
        }
        assert_eq!(code(add(11, "operator0", "Passw0rd").await), ErrorCode::UserExists);
        assert_eq!(code(add(11, "operator10", "Passw0rd").await), ErrorCode::TooManyUsers);
        assert_eq!(code(remove(11, json!(["operator1", "nobody99"])).await), ErrorCode::UserNotFound);
        remove(11, json!(["operator1", "operator2"])).await.unwrap();
        let users: Revisioned<Vec<UserName>> = client.get(protocol::GetUsers::PATH).await.unwrap();
        assert_eq!((users.revision.number(), users.value.len()), (12, 8));
        assert!(test_controller.state().users.iter().all(|user| user.password_hash.starts_with("$argon2id$")));
    })
    .await;
}

#[tokio::test]
async fn current_firmware_makes_its_own_key_and_takes_none() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let client = test_controller.client().await;
        let make = async |request: Value| {
            client
                .post::<CertificateInstalled>(
                    protocol::MakeSelfSigned::PATH,
                    &json!({ "revision": 1, "request": request }),
                )
                .await
        };
        let wanted = serde_json::to_value(request("EpsonRC.R7A0000001", 2048)).unwrap();
        let mut wide = wanted.clone();
        wide["subject"]["state"] = json!("长野");
        assert_eq!(code(make(wide).await), ErrorCode::BadCertificateRequest);
        let mut short = wanted.clone();
        short["key_length"] = json!(1024);
        assert_eq!(code(make(short).await), ErrorCode::BadCertificateRequest);
        let mut long = wanted.clone();
        long["validity"] = json!(11);
        assert_eq!(code(make(long).await), ErrorCode::BadCertificateRequest);

        let installed = make(wanted).await.unwrap();
        assert_eq!(installed.changed.revision.number(), 2);
        let made = Certificate::from_der(&installed.certificate.0).unwrap();
        let info = test_controller.controller.info();
        let in_use = info.certificate.unwrap();
        assert_eq!((in_use.kind, in_use.summary), (CertificateType::SelfSigned, made.summary()));
        assert_eq!(made.application_uri(), Some(format!("urn:{}", info.application_name)));

        let pkcs12 = pkcs12_write("x", &KEY, &[&certificate("a", Utc::now())], "transfer").unwrap();
        let body = json!({ "revision": 2, "kind": "user-specified", "password": "transfer",
            "pkcs12": crate::model::Base64Bytes(pkcs12) });
        let result = client.post::<CertificateInstalled>(protocol::ImportCertificate::PATH, &body).await;
        assert_eq!(code(result), ErrorCode::FirmwareTooNew);
    })
    .await;
}

#[tokio::test]
async fn legacy_firmware_takes_a_key_and_makes_none() {
    bounded(async {
        let test_controller = TestController::new(initial(LEGACY)).await;
        let client = test_controller.client().await;
        let body = json!({ "revision": 1, "request": request("a", 2048) });
        let result = client.post::<CertificateInstalled>(protocol::MakeSelfSigned::PATH, &body).await;
        assert_eq!(code(result), ErrorCode::FirmwareTooOld);

        let import = async |kind: &str, certificate: &Certificate, password: &str| {
            let pkcs12 = pkcs12_write("x", &KEY, &[certificate], "transfer").unwrap();
            let body = json!({ "revision": 1, "kind": kind, "password": password,
                "pkcs12": crate::model::Base64Bytes(pkcs12) });
            client.post::<CertificateInstalled>(protocol::ImportCertificate::PATH, &body).await
        };
        let good = certificate("robot", Utc::now());
        assert_eq!(code(import("self-signed", &good, "wrong").await), ErrorCode::WrongKeyPassword);
        let expired = certificate("robot", Utc::now() - TimeDelta::days(400));
        assert_eq!(code(import("self-signed", &expired, "transfer").await), ErrorCode::CertificateExpired);
        assert_eq!(code(import("ca-signed", &good, "transfer").await), ErrorCode::Refused);
        assert_eq!(test_controller.revision(), 1);

        let installed = import("user-specified", &good, "transfer").await.unwrap();
        assert_eq!(installed.certificate.0, good.der());
        assert_eq!(test_controller.state().selected, CertificateType::UserSpecified);
        let started: Changed = client.post(protocol::StartServer::PATH, &()).await.unwrap();
        assert_eq!(started, Changed { revision: RevisionToken::new(2), status: ServerStatus::Run });
        assert!(test_controller.answers());
    })
    .await;
}

#[tokio::test]
async fn client_lists_have_limits_and_no_doubles() {
    bounded(async {
        for firmware in [LEGACY, CURRENT] {
            let test_controller = TestController::new(initial(firmware)).await;
            let client = test_controller.client().await;
            let limit = ListLimits::of(firmware.generation()).trusted;
            let add = async |list: ClientList, revision: u64, certificates: &[_]| {
                let step = json!({ "add": { "list": list, "certificates": certificates } });
                client.post::<Value>(protocol::EditTrust::PATH, &json!({ "revision": revision, "steps": [step] })).await
            };
            let many = clients("client", limit + 1);
            assert_eq!(code(add(ClientList::Trusted, 1, &many).await), ErrorCode::ListFull);
            assert_eq!(code(add(ClientList::Trusted, 1, &[]).await), ErrorCode::BadCertificate);
            let twice = [many[0].clone(), many[0].clone()];
            assert_eq!(code(add(ClientList::Trusted, 1, &twice).await), ErrorCode::DuplicateCertificate);
            let path = [("../x.der".to_owned(), many[0].1.clone())];
            assert_eq!(code(add(ClientList::Trusted, 1, &path).await), ErrorCode::BadName);
            let junk = [many[0].clone(), ("junk.der".to_owned(), crate::model::Base64Bytes(vec![0x30, 0]))];
            assert_eq!(code(add(ClientList::Trusted, 1, &junk).await), ErrorCode::BadCertificate);
            assert_eq!(test_controller.revision(), 1);

            add(ClientList::Trusted, 1, &many[..limit]).await.unwrap();
            assert_eq!(code(add(ClientList::Trusted, 2, &many[limit..]).await), ErrorCode::ListFull);
            let listed: Revisioned<Vec<ListedCertificate>> = client.get(protocol::GetTrusted::PATH).await.unwrap();
            assert_eq!((listed.revision.number(), listed.value.len()), (2, limit));
            assert_eq!(listed.value[0].file_name, "client0.der");
            assert_eq!(listed.value[0].certificate, many[0].1);

            let issuers = add(ClientList::Issuers, 2, &many[..1]).await;
            if firmware == LEGACY {
                assert_eq!(code(issuers), ErrorCode::FirmwareTooOld);
                let read = client.get::<Value>(protocol::GetIssuers::PATH).await;
                assert_eq!(code(read), ErrorCode::FirmwareTooOld);
            } else {
                issuers.unwrap();
                assert_eq!(test_controller.state().issuers.len(), 1);
            }
        }
    })
    .await;
}

#[tokio::test]
async fn a_running_task_or_a_pendant_forbids_changes_but_no_questions() {
    bounded(async {
        let test_controller = TestController::new(with_certificate(initial(CURRENT))).await;
        let client = test_controller.client().await;
        let faults = test_controller.controller.faults();
        let settings = test_controller.state().settings.clone();
        let expect = async |expected: ErrorCode| {
            assert_eq!(code(client.put::<Changed>(protocol::GetSettings::PATH, &set(1, &settings)).await), expected);
            assert_eq!(code(client.post::<Changed>(protocol::StartServer::PATH, &()).await), expected);
            assert_eq!(code(client.post::<Changed>(protocol::StopServer::PATH, &()).await), expected);
            client.get::<Value>(protocol::GetInfo::PATH).await.expect("questions are answered");
        };
        faults.update(|switches| switches.refuse = true);
        expect(ErrorCode::Refused).await;
        faults.update(|switches| switches.teach_pendant_connected = true);
        expect(ErrorCode::TeachPendantConnected).await;
        faults.update(|switches| switches.task_running = true);
        expect(ErrorCode::TaskRunning).await;
        faults.update(|switches| *switches = Default::default());
        client.put::<Changed>(protocol::GetSettings::PATH, &set(1, &settings)).await.unwrap();
    })
    .await;
}

#[tokio::test]
async fn a_running_server_refuses_what_it_could_not_run_with() {
    bounded(async {
        let mut new: NewController = with_certificate(initial(CURRENT));
        new.settings.startup = crate::model::StartupMode::Auto;
        let test_controller = TestController::new(new).await;
        let client = test_controller.client().await;
        assert_eq!(test_controller.status(), (ServerStatus::Run, None));
        let blocker = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
        let port = ServerPort::try_from(blocker.local_addr().unwrap().port()).unwrap();
        let before = test_controller.state();
        let taken = ServerSettings { port, ..before.settings.clone() };
        assert_eq!(
            code(client.put::<Changed>(protocol::GetSettings::PATH, &set(1, &taken)).await),
            ErrorCode::PortConflict
        );
        assert_eq!(test_controller.state(), before);
        assert_eq!(test_controller.status(), (ServerStatus::Run, None));
        assert!(test_controller.answers());

        let weak = ServerSettings { security_policies: [SecurityPolicy::None].into(), ..before.settings.clone() };
        let changed: Changed = client.put(protocol::GetSettings::PATH, &set(1, &weak)).await.unwrap();
        assert_eq!(changed, Changed { revision: RevisionToken::new(2), status: ServerStatus::Run });
        assert!(test_controller.answers());
        test_controller.controller.shutdown().await;
        assert!(!test_controller.answers());
    })
    .await;
}
