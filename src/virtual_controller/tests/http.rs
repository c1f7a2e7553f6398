//! What a client is told whose request is wrong before it reaches the protocol.

use std::sync::Arc;

use rustls::pki_types::ServerName;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;

use super::test_controller::{ApiClient, LEGACY, TestController, bounded, initial, tls};
use crate::model::ErrorCode;
use crate::protocol::FailureBody;

/// Everything the controller answers on one connection.
async fn answers(test_controller: &TestController, request: &[u8]) -> String {
    let tcp = TcpStream::connect(test_controller.controller.management_address()).await.unwrap();
    let connector = tokio_rustls::TlsConnector::from(Arc::new(tls(&test_controller.controller)));
    let mut stream = connector.connect(ServerName::try_from("robot").unwrap(), tcp).await.unwrap();
    stream.write_all(request).await.unwrap();
    let mut answer = Vec::new();
    // Without a goodbye of TLS the connection ends with an error.
    let _end = stream.read_to_end(&mut answer).await;
    String::from_utf8(answer).unwrap()
}

/// Status and failure of an answer.
fn failure(answer: &str) -> (u16, FailureBody) {
    let status = answer.split(' ').nth(1).and_then(|status| status.parse().ok()).expect(answer);
    let (_, body) = answer.split_once("\r\n\r\n").expect(answer);
    (status, serde_json::from_str(body).expect(answer))
}

#[tokio::test]
async fn every_refused_request_is_told_why() {
    bounded(async {
        let test_controller = TestController::new(initial(LEGACY)).await;
        let long = "a".repeat(3000);
        let headers = "x: y\r\n".repeat(100);
        for (request, status, code) in [
            ("GET /v1/hello HTTP/1.1\r\n\r\n".to_owned(), 400, ErrorCode::Refused),
            ("GET /v1/hello HTTP/1.1\r\nhost: a\r\nhost: b\r\n\r\n".to_owned(), 400, ErrorCode::Refused),
            ("nonsense\r\n\r\n".to_owned(), 400, ErrorCode::Refused),
            (
                "POST /v1/login HTTP/1.1\r\nhost: a\r\ntransfer-encoding: chunked\r\ncontent-length: 3\r\n\r\n{}\n"
                    .to_owned(),
                400,
                ErrorCode::Refused,
            ),
            ("GET /v1/hello HTTP/1.0\r\nhost: a\r\n\r\n".to_owned(), 505, ErrorCode::Refused),
            (format!("GET /{long} HTTP/1.1\r\nhost: a\r\n\r\n"), 414, ErrorCode::RequestTooLarge),
            (format!("GET / HTTP/1.1\r\nhost: a\r\n{headers}\r\n"), 431, ErrorCode::RequestTooLarge),
            (
                "POST /v1/login HTTP/1.1\r\nhost: a\r\ncontent-length: 99999999\r\n\r\n".to_owned(),
                413,
                ErrorCode::RequestTooLarge,
            ),
            ("GET /refused HTTP/1.1\r\nhost: a\r\nconnection: close\r\n\r\n".to_owned(), 404, ErrorCode::Refused),
        ] {
            let (told, failure) = failure(&answers(&test_controller, request.as_bytes()).await);
            assert_eq!((told, failure.code), (status, code), "{request:.60?}");
        }
    })
    .await;
}

#[tokio::test]
async fn a_path_that_is_no_text_is_no_path() {
    bounded(async {
        let test_controller = TestController::new(initial(LEGACY)).await;
        let client = test_controller.client().await;
        for path in ["/v1/clients/%ff", "/v1/crls/%ff%fe", "/v1/clients/a%2fb", "/v1/../v1/info%00"] {
            let refused = client.get::<serde_json::Value>(path).await.expect_err(path);
            assert!(
                matches!(refused, super::test_controller::RequestFailure::Failure(status, _) if status == 404),
                "{path} {refused:?}"
            );
        }
    })
    .await;
}

#[tokio::test]
async fn a_refusal_stands_behind_the_answers_before_it() {
    bounded(async {
        let test_controller = TestController::new(initial(LEGACY)).await;
        let good = "GET /v1/hello HTTP/1.1\r\nhost: a\r\n\r\n";
        let answer =
            answers(&test_controller, [good, good, "GET /v1/hello HTTP/1.1\r\n\r\n", good].concat().as_bytes()).await;
        let statuses: Vec<&str> = answer.matches("HTTP/1.1 200").chain(answer.matches("HTTP/1.1 400")).collect();
        assert_eq!(statuses, ["HTTP/1.1 200", "HTTP/1.1 200", "HTTP/1.1 400"], "{answer}");
        let chunked = "POST /v1/login HTTP/1.1\r\nhost: a\r\ntransfer-encoding: chunked\r\n\r\n2\r\n{}\r\n0\r\n\r\n";
        let answer = answers(&test_controller, [chunked, good].concat().as_bytes()).await;
        assert!(answer.contains("connection: close") && !answer.contains("HTTP/1.1 200"), "{answer}");
        // Others are served meanwhile.
        ApiClient::new(&test_controller.controller).hello().await;
    })
    .await;
}
