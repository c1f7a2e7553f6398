use reqwest::{Method, StatusCode};
use serde_json::{Value, json};

use super::test_controller::{
    ApiClient, CURRENT, LEGACY, PASSWORD, RequestFailure, TestController, bounded, code, initial,
};
use crate::model::{ControllerInfo, ErrorCode};
use crate::protocol::{self, LOGIN_ATTEMPTS, MAX_REQUEST_BYTES, Request as _};

#[tokio::test]
async fn a_session_begins_with_the_password_and_ends_with_logout() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let mut client = ApiClient::new(&test_controller.controller);
        let hello = client.hello().await;
        assert_eq!((hello.product.as_str(), hello.versions.as_slice()), (protocol::PRODUCT, [1].as_slice()));
        assert_eq!(code(client.get::<Value>(protocol::GetInfo::PATH).await), ErrorCode::SessionExpired);
        client.login(PASSWORD).await.unwrap();
        let info: ControllerInfo = client.get(protocol::GetInfo::PATH).await.unwrap();
        assert_eq!(info.name, "测试 1");
        assert_eq!(info.application_name, "EpsonRC.R7A0000001.127.000.000.001");
        assert_eq!(info.endpoint, test_controller.controller.endpoint());
        assert!(info.used_ports.contains(&test_controller.controller.management_address().port()));
        assert!(info.activated);
        client.post::<()>(protocol::Logout::PATH, &()).await.unwrap();
        assert_eq!(code(client.get::<Value>(protocol::GetInfo::PATH).await), ErrorCode::SessionExpired);
    })
    .await;
}

#[tokio::test]
async fn wrong_passwords_are_slow_and_lock_out_even_the_right_one() {
    bounded(async {
        let test_controller = TestController::new(initial(LEGACY)).await;
        let mut client = ApiClient::new(&test_controller.controller);
        for _ in 0..LOGIN_ATTEMPTS {
            let asked = std::time::Instant::now();
            assert_eq!(code(client.login("wrong").await), ErrorCode::WrongPassword);
            assert!(asked.elapsed() >= std::time::Duration::from_millis(300));
        }
        assert_eq!(code(client.login(PASSWORD).await), ErrorCode::LockedOut);
    })
    .await;
}

#[tokio::test]
async fn guesses_at_the_same_time_do_not_slip_by_the_count() {
    bounded(async {
        let test_controller = TestController::new(initial(LEGACY)).await;
        let guesses: Vec<_> = (0..12)
            .map(|_| {
                let mut client = ApiClient::new(&test_controller.controller);
                tokio::spawn(async move { code(client.login("wrong").await) })
            })
            .collect();
        let mut wrong = 0;
        for guess in guesses {
            wrong += u32::from(guess.await.unwrap() == ErrorCode::WrongPassword);
        }
        assert_eq!(wrong, LOGIN_ATTEMPTS);
    })
    .await;
}

#[tokio::test]
async fn every_failure_is_a_failure_body() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let client = test_controller.client().await;
        for (method, path, status) in [
            (Method::GET, "/", StatusCode::NOT_FOUND),
            (Method::GET, "/v2/info", StatusCode::NOT_FOUND),
            (Method::GET, "/v1/clients/others", StatusCode::NOT_FOUND),
            (Method::POST, "/v1/clients/trusted", StatusCode::METHOD_NOT_ALLOWED),
            (Method::DELETE, protocol::GetUsers::PATH, StatusCode::METHOD_NOT_ALLOWED),
        ] {
            match client.send::<Value>(method, path, Vec::new()).await {
                Err(RequestFailure::Failure(got, _)) => assert_eq!(got, status, "{path}"),
                other => panic!("{path}: {other:?}"),
            }
        }
        for (path, body, expected) in [
            (protocol::GetUsers::PATH, "", ErrorCode::BadCredential),
            (protocol::GetUsers::PATH, "[1]", ErrorCode::BadCredential),
            (protocol::MakeSelfSigned::PATH, "{", ErrorCode::BadCertificateRequest),
            (protocol::RemoveUsers::PATH, r#"{"revision":1,"names":[],"x":1}"#, ErrorCode::BadCredential),
            (
                protocol::EditTrust::PATH,
                r#"{"revision":1,"steps":[{"add":{"list":"trusted","certificates":[["a","!"]]}}]}"#,
                ErrorCode::BadCertificate,
            ),
            (protocol::EditTrust::PATH, r#"{"revision":1,"steps":[]}"#, ErrorCode::Refused),
            (
                protocol::EditTrust::PATH,
                r#"{"revision":1,"steps":[{"remove":{"list":"rejected","thumbprints":["AB"]}}]}"#,
                ErrorCode::NotInList,
            ),
        ] {
            let result = client.send::<Value>(Method::POST, path, body.into()).await;
            assert_eq!(code(result), expected, "{path}");
        }
    })
    .await;
}

#[tokio::test]
async fn a_misplaced_secret_is_not_quoted() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let client = test_controller.client().await;
        let body = json!({ "revision": "TopSecret99", "name": "operator1", "password": "TopSecret99" });
        match client.post::<Value>(protocol::GetUsers::PATH, &body).await {
            Err(RequestFailure::Failure(_, failure)) => assert!(!format!("{failure:?}").contains("TopSecret99")),
            other => panic!("{other:?}"),
        }
    })
    .await;
}

#[tokio::test]
async fn a_body_over_its_bound_is_refused_and_the_answer_arrives() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let client = test_controller.client().await;
        let body = vec![b' '; MAX_REQUEST_BYTES + 1];
        let result = client.send::<Value>(Method::POST, protocol::GetUsers::PATH, body).await;
        assert_eq!(code(result), ErrorCode::RequestTooLarge);
        let mut body = br#"{"revision":0,"names":[]}"#.to_vec();
        body.resize(MAX_REQUEST_BYTES, b' ');
        let result = client.send::<Value>(Method::POST, protocol::RemoveUsers::PATH, body).await;
        assert_eq!(code(result), ErrorCode::ChangedMeanwhile);
    })
    .await;
}

#[tokio::test]
async fn silent_connections_do_not_keep_others_out_for_long() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let address = test_controller.controller.management_address();
        let mut silent = Vec::new();
        for _ in 0..80 {
            silent.push(tokio::net::TcpStream::connect(address).await.unwrap());
        }
        let asked = std::time::Instant::now();
        ApiClient::new(&test_controller.controller).hello().await;
        assert!(asked.elapsed() < std::time::Duration::from_secs(15));
        test_controller.controller.shutdown().await;
    })
    .await;
}

#[tokio::test]
async fn latency_and_a_wrong_clock_show() {
    bounded(async {
        let test_controller = TestController::new(initial(CURRENT)).await;
        let client = test_controller.client().await;
        test_controller.controller.faults().update(|switches| {
            switches.latency = std::time::Duration::from_millis(200);
            switches.clock_offset = chrono::TimeDelta::days(-365);
        });
        let asked = std::time::Instant::now();
        let info: ControllerInfo = client.get(protocol::GetInfo::PATH).await.unwrap();
        assert!(asked.elapsed() >= std::time::Duration::from_millis(200));
        assert!((chrono::Utc::now() - info.clock).num_days() >= 364);
    })
    .await;
}
