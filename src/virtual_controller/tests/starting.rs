use serde_json::json;

use super::test_controller::{CURRENT, LEGACY, TestController, bounded, code, initial, with_certificate};
use crate::model::{Changed, ErrorCode, RevisionToken, ServerStatus, StartupMode};
use crate::protocol::{self, Request as _};
use crate::virtual_controller::NewController;

async fn refuses_to_start(new: NewController, expected: ErrorCode) -> TestController {
    let test_controller = TestController::new(new).await;
    let client = test_controller.client().await;
    assert_eq!(test_controller.status(), (ServerStatus::Stop, None));
    assert_eq!(code(client.post::<Changed>(protocol::StartServer::PATH, &()).await), expected);
    assert_eq!(test_controller.status(), (ServerStatus::Error, Some(expected)));
    let stopped: Changed = client.post(protocol::StopServer::PATH, &()).await.unwrap();
    assert_eq!(stopped, Changed { revision: RevisionToken::new(1), status: ServerStatus::Stop });
    assert_eq!(test_controller.status(), (ServerStatus::Stop, None));
    test_controller
}

#[tokio::test]
async fn each_reason_not_to_start_has_its_code() {
    bounded(async {
        let mut without_licence = initial(LEGACY);
        without_licence.activated = false;
        refuses_to_start(without_licence, ErrorCode::NotActivated).await;
        refuses_to_start(initial(LEGACY), ErrorCode::NoCertificate).await;
        let mut conflict = with_certificate(initial(CURRENT));
        conflict.used_ports.push(conflict.settings.port.get());
        refuses_to_start(conflict, ErrorCode::PortConflict).await;
        let occupied = with_certificate(initial(CURRENT));
        let blocker = std::net::TcpListener::bind(("127.0.0.1", occupied.settings.port.get())).unwrap();
        refuses_to_start(occupied, ErrorCode::PortConflict).await;
        drop(blocker);
    })
    .await;
}

#[tokio::test]
async fn a_number_goes_when_its_cause_is_mended() {
    bounded(async {
        let mut bare = initial(LEGACY);
        bare.activated = false;
        let test_controller = TestController::new(bare).await;
        let client = test_controller.client().await;
        assert_eq!(code(client.post::<Changed>(protocol::StartServer::PATH, &()).await), ErrorCode::NotActivated);
        let crate::model::activation::ActivationKeys { licence, activation } =
            crate::virtual_controller::demo_keys(&test_controller.controller.serial());
        let keys = json!({ "revision": 1, "licence": licence, "activation": activation });
        let changed: Changed = client.post(protocol::Activate::PATH, &keys).await.unwrap();
        assert_eq!(changed.status, ServerStatus::Error);
        assert_eq!(test_controller.status(), (ServerStatus::Error, Some(ErrorCode::NoCertificate)), "the next reason");

        let test_controller = TestController::new(initial(CURRENT)).await;
        let client = test_controller.client().await;
        assert_eq!(code(client.post::<Changed>(protocol::StartServer::PATH, &()).await), ErrorCode::NoCertificate);
        let make = json!({ "revision": 1, "request": super::test_controller::request("robot", 2048) });
        let made: protocol::CertificateInstalled = client.post(protocol::MakeSelfSigned::PATH, &make).await.unwrap();
        assert_eq!(made.changed.status, ServerStatus::Stop);
        assert_eq!(test_controller.status(), (ServerStatus::Stop, None));

        let blocker = std::net::TcpListener::bind(("127.0.0.1", test_controller.state().settings.port.get())).unwrap();
        assert_eq!(code(client.post::<Changed>(protocol::StartServer::PATH, &()).await), ErrorCode::PortConflict);
        assert_eq!(test_controller.status(), (ServerStatus::Error, Some(ErrorCode::PortConflict)));
        drop(blocker);
        assert_eq!(test_controller.status(), (ServerStatus::Stop, None));
        let started: Changed = client.post(protocol::StartServer::PATH, &()).await.unwrap();
        assert_eq!(started.status, ServerStatus::Run);
    })
    .await;
}

#[tokio::test]
async fn an_error_lasts_until_a_start_succeeds() {
    bounded(async {
        let test_controller = TestController::new(with_certificate(initial(CURRENT))).await;
        let client = test_controller.client().await;
        test_controller.controller.faults().update(|switches| switches.server_error = true);
        assert_eq!(code(client.post::<Changed>(protocol::StartServer::PATH, &()).await), ErrorCode::ServerError);
        let body = json!({ "revision": 1, "name": "operator1", "password": "Passw0rd" });
        let changed: Changed = client.post(protocol::GetUsers::PATH, &body).await.unwrap();
        assert_eq!(changed, Changed { revision: RevisionToken::new(2), status: ServerStatus::Error });
        test_controller.controller.faults().update(|switches| switches.server_error = false);
        for _ in 0..2 {
            let started: Changed = client.post(protocol::StartServer::PATH, &()).await.unwrap();
            assert_eq!(started, Changed { revision: RevisionToken::new(2), status: ServerStatus::Run });
        }
        assert!(test_controller.answers());
        let stopped: Changed = client.post(protocol::StopServer::PATH, &()).await.unwrap();
        assert_eq!(stopped.status, ServerStatus::Stop);
        assert!(!test_controller.answers());
    })
    .await;
}

#[tokio::test]
async fn startup_auto_starts_with_the_controller_or_says_why_not() {
    bounded(async {
        let mut good = with_certificate(initial(CURRENT));
        good.settings.startup = StartupMode::Auto;
        let test_controller = TestController::new(good).await;
        assert_eq!(test_controller.status(), (ServerStatus::Run, None));
        assert!(test_controller.answers());
        let mut bare = initial(CURRENT);
        bare.settings.startup = StartupMode::Auto;
        let test_controller = TestController::new(bare).await;
        assert_eq!(test_controller.status(), (ServerStatus::Error, Some(ErrorCode::NoCertificate)));
        test_controller.client().await.hello().await;
    })
    .await;
}

/// Manual 4.2.2: a change of the variables takes effect when the server is started again.
#[tokio::test]
async fn the_variables_of_the_project_are_taken_at_each_start_and_mistakes_are_named_in_the_log() {
    bounded(async {
        let mut new = with_certificate(initial(CURRENT));
        new.settings.server_log = true;
        let test_controller = TestController::new(new).await;
        let client = test_controller.client().await;
        let file = test_controller.folder.path().join("project").join("Variables.inc");
        let names = || {
            let variables = test_controller.controller.cell().description().variables.clone();
            variables.iter().map(|variable| variable.name.clone()).collect::<Vec<_>>()
        };
        assert!(
            names().contains(&"OPCUA_ItemCode".to_owned()),
            "the example of the manual is there from the beginning"
        );
        std::fs::write(&file, "Global Preserve Long OPCUA_Own\nGlobal Preserve Long OPCUA_List(5)\n").unwrap();
        let _started: Changed = client.post(protocol::StartServer::PATH, &()).await.unwrap();
        assert_eq!(names(), ["OPCUA_Own"]);
        let log = client.get::<crate::model::LogChunk>(protocol::GetLog::PATH).await.unwrap().text;
        assert!(log.contains("WARN variables: line 2: OPCUA_List is an array"), "{log}");

        std::fs::write(&file, "Global Preserve Long OPCUA_Other\n").unwrap();
        assert_eq!(names(), ["OPCUA_Own"], "while the server runs");
        let _stopped: Changed = client.post(protocol::StopServer::PATH, &()).await.unwrap();
        std::fs::remove_file(&file).unwrap();
        std::fs::create_dir(&file).unwrap();
        let _started: Changed = client.post(protocol::StartServer::PATH, &()).await.unwrap();
        assert_eq!(names(), ["OPCUA_Own"], "a file that cannot be read changes nothing");
        let log = client.get::<crate::model::LogChunk>(protocol::GetLog::PATH).await.unwrap().text;
        assert!(log.contains("WARN variables cannot be read: "), "{log}");
    })
    .await;
}
