//! What an engineer is told when the address of a controller leads somewhere else.

use std::time::Duration;

use opcua_configurator::model::{Address, ErrorCode};
use opcua_configurator::pki::{Fingerprint, TlsIdentity};
use opcua_configurator::session::{Connector as _, ManagementConnector, ManagementTimeouts};
use secrecy::SecretString;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;

use crate::common::https::{listener, tls};

fn connector() -> ManagementConnector {
    ManagementConnector {
        timeouts: ManagementTimeouts {
            connect: Duration::from_secs(2),
            read: Duration::from_millis(400),
            change: Duration::from_secs(1),
        },
    }
}

async fn probe(address: &Address) -> ErrorCode {
    let connector = connector();
    tokio::time::timeout(Duration::from_secs(10), connector.probe(address))
        .await
        .expect("bounded")
        .expect_err("not a controller")
        .code
}

/// An HTTPS server that answers every request with the same bytes.
async fn always(answer: Vec<u8>) -> (Address, TlsIdentity) {
    in_turn(vec![answer]).await
}

/// An HTTPS server that answers one connection with the first bytes, the next with the second, and so on; the last
/// are for all that follow.
async fn in_turn(answers: Vec<Vec<u8>>) -> (Address, TlsIdentity) {
    let (acceptor, identity) = tls("not a controller");
    let (listener, address) = listener().await;
    tokio::spawn(async move {
        let last = answers.last().cloned().unwrap_or_default();
        let mut answers = answers.into_iter();
        while let Ok((stream, _)) = listener.accept().await {
            let (acceptor, answer) = (acceptor.clone(), answers.next().unwrap_or_else(|| last.clone()));
            tokio::spawn(async move {
                let mut stream = acceptor.accept(stream).await?;
                let mut request = [0; 4096];
                if stream.read(&mut request).await? == 0 {
                    return Ok(());
                }
                stream.write_all(&answer).await?;
                stream.shutdown().await
            });
        }
    });
    (address, identity)
}

fn http(body: &str) -> Vec<u8> {
    http_with("200 OK", body)
}

fn http_with(status: &str, body: &str) -> Vec<u8> {
    let length = body.len();
    format!("HTTP/1.1 {status}\r\nconnection: close\r\ncontent-length: {length}\r\n\r\n{body}").into()
}

#[tokio::test]
async fn nobody_listens() {
    let (listener, address) = listener().await;
    drop(listener);
    assert_eq!(probe(&address).await, ErrorCode::Unreachable);
}

#[tokio::test]
async fn a_name_that_does_not_exist() {
    assert_eq!(probe(&"robot.invalid".parse().unwrap()).await, ErrorCode::Unreachable);
}

#[tokio::test]
async fn a_host_that_accepts_and_says_nothing() {
    let (listener, address) = listener().await;
    let held: tokio::task::JoinHandle<Vec<TcpStream>> = tokio::spawn(async move {
        let mut held = Vec::new();
        while let Ok((stream, _)) = listener.accept().await {
            held.push(stream);
        }
        held
    });
    assert_eq!(probe(&address).await, ErrorCode::Timeout);
    held.abort();
}

#[tokio::test]
async fn a_host_that_answers_garbage_instead_of_tls() {
    let (listener, address) = listener().await;
    tokio::spawn(async move {
        while let Ok((mut stream, _)) = listener.accept().await {
            let _gone = stream.write_all(b"220 printer ready\r\n").await;
        }
    });
    assert_eq!(probe(&address).await, ErrorCode::NotAController);
}

#[tokio::test]
async fn an_opc_ua_server_port_instead_of_the_management_port() {
    let (listener, address) = listener().await;
    tokio::spawn(async move {
        while let Ok((mut stream, _)) = listener.accept().await {
            let mut hello = [0; 64];
            let _read = stream.read(&mut hello).await;
            // OPC 10000-6 §7.1.2.5: Error, BadTcpMessageTypeInvalid, no reason.
            let _sent = stream.write_all(b"ERRF\x10\0\0\0\0\0\x7e\x80\xff\xff\xff\xff").await;
        }
    });
    assert_eq!(probe(&address).await, ErrorCode::NotAController);
}

#[tokio::test]
async fn a_host_that_hangs_up_during_the_handshake_may_be_a_busy_controller() {
    let (listener, address) = listener().await;
    tokio::spawn(async move {
        while let Ok((stream, _)) = listener.accept().await {
            drop(stream);
        }
    });
    assert_eq!(probe(&address).await, ErrorCode::HandshakeLost);
}

#[tokio::test]
async fn a_handshake_that_is_lost_twice_is_tried_a_third_time() {
    let (acceptor, _) = tls("a busy controller");
    let (listener, address) = listener().await;
    tokio::spawn(async move {
        for _ in 0..2 {
            drop(listener.accept().await);
        }
        let (stream, _) = listener.accept().await?;
        let mut stream = acceptor.accept(stream).await?;
        let mut request = [0; 4096];
        let _read = stream.read(&mut request).await?;
        stream.write_all(&http("{}")).await?;
        stream.shutdown().await
    });
    assert_eq!(probe(&address).await, ErrorCode::NotAController, "an answer, although not a controller's");
}

#[tokio::test]
async fn another_https_server() {
    for body in ["<html>welcome</html>", "{}", r#"{"product":"something-else","versions":[1]}"#, "[[[[[[[["] {
        let (address, _) = always(http(body)).await;
        assert_eq!(probe(&address).await, ErrorCode::NotAController, "{body}");
    }
    let (address, _) = always(b"SSH-2.0-OpenSSH\r\n".to_vec()).await;
    assert_eq!(probe(&address).await, ErrorCode::NotAController);
}

#[tokio::test]
async fn a_web_server_without_the_controllers_page() {
    for body in ["<html>no such page</html>", r#"{"error":"not found"}"#, ""] {
        let (address, _) = always(http_with("404 Not Found", body)).await;
        assert_eq!(probe(&address).await, ErrorCode::NotAController, "{body}");
    }
}

/// A code of a newer controller is still a refusal; one that only the PC can know is not believed.
#[tokio::test]
async fn a_failure_with_a_strange_code() {
    for code in ["out-of-coffee", "cancelled", "timeout"] {
        let failure = format!(r#"{{"code":"{code}","message":"not \u001b[31mtoday"}}"#);
        let (address, identity) = always(http_with("400 Bad Request", &failure)).await;
        let refused = connector().connect(&address, identity.fingerprint(), &"".into()).await;
        let problem = refused.err().expect("refused");
        assert_eq!(problem.code, ErrorCode::Refused);
        assert_eq!(problem.detail, Some(format!("{code}: not \u{fffd}[31mtoday")));
    }
}

/// It would be kept for every controller of the plant, and fill the configuration until that cannot be read again.
#[tokio::test]
async fn information_without_end_is_not_taken() {
    for (length, taken) in [(32, true), (1_000_000, false)] {
        let info = format!(
            r#"{{"name":"{}","serial":"RC80010001","series":"RC800","firmware":"8.0.0","status":"Stop","error":null,
            "activated":true,"certificate":null,"application_name":"a","endpoint":"opc.tcp://127.0.0.1:4840",
            "used_ports":[],"limits":{{"trusted":1,"issuers":1,"crls":0}},"clock":"2026-01-01T00:00:00Z","revision":1}}"#,
            "x".repeat(length)
        );
        let (address, identity) = in_turn(vec![http(r#"{"token":"t","idle_secs":300}"#), http(&info)]).await;
        let session = connector().connect(&address, identity.fingerprint(), &"".into()).await;
        let Ok(mut session) = session else { panic!("not logged in") };
        match session.info().await {
            Ok(info) => assert!(taken && info.name.len() == length),
            Err(problem) => assert!(!taken && problem.code == ErrorCode::NotAController, "{problem}"),
        }
    }
}

#[tokio::test]
async fn a_controller_of_a_future_protocol() {
    let (address, _) = always(http(r#"{"product":"opcua-controller-management","versions":[2,3]}"#)).await;
    assert_eq!(probe(&address).await, ErrorCode::ProtocolVersion);
}

#[tokio::test]
async fn an_answer_without_end_does_not_fill_the_memory() {
    let mut endless = b"HTTP/1.1 200 OK\r\ncontent-type: application/json\r\n\r\n".to_vec();
    endless.resize(16 * 1024 * 1024, b'[');
    let (address, _) = always(endless).await;
    let connector = ManagementConnector::default();
    let problem = connector.probe(&address).await.expect_err("too large");
    assert_eq!(problem.code, ErrorCode::NotAController);
}

/// The password must not be sent: the server would have read it.
#[tokio::test]
async fn a_changed_fingerprint_is_refused_before_the_password_is_sent() {
    let (acceptor, identity) = tls("impostor");
    let (listener, address) = listener().await;
    let heard = tokio::spawn(async move {
        let (stream, _) = listener.accept().await.unwrap();
        let mut heard = Vec::new();
        if let Ok(mut stream) = acceptor.accept(stream).await {
            let _read = stream.read_to_end(&mut heard).await;
        }
        heard
    });
    let expected = Fingerprint::of(b"the one that was confirmed");
    let password = SecretString::from("secret-of-the-plant");
    let refused = connector().connect(&address, expected, &password.into()).await;
    let problem = refused.err().expect("refused");
    assert_eq!(problem.code, ErrorCode::FingerprintChanged);
    let detail = problem.detail.expect("both fingerprints");
    assert!(detail.contains(&expected.grouped()) && detail.contains(&identity.fingerprint().grouped()), "{detail}");
    assert!(heard.await.unwrap().is_empty(), "nothing may be sent to an impostor");
}
