//! Servers that are none, or mean harm.

use std::time::{Duration, Instant};

use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpListener;

use super::*;
use crate::workspace::Workspace;

const WAIT_LIMIT: ConnectTimeouts =
    ConnectTimeouts { connect: Duration::from_secs(1), attempt: Duration::from_secs(2) };

/// Accepts, reads something, then answers; a client that is left waiting finds the connection open.
async fn server(answers: impl Fn(usize) -> Option<Vec<u8>> + Send + 'static) -> ServerLocation {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let target = ServerLocation { host: "127.0.0.1".into(), port: listener.local_addr().unwrap().port() };
    tokio::spawn(async move {
        while let Ok((mut stream, _)) = listener.accept().await {
            for round in 0.. {
                let mut request = [0; 8192];
                if stream.read(&mut request).await.unwrap_or(0) == 0 {
                    break;
                }
                let Some(answer) = answers(round) else { break };
                if stream.write_all(&answer).await.is_err() {
                    break;
                }
            }
        }
    });
    target
}

fn frame(kind: &[u8; 4], body: &[u8]) -> Vec<u8> {
    [kind, &(body.len() as u32 + 8).to_le_bytes()[..], body].concat()
}

/// An acknowledgement as an honest server sends it.
fn acknowledge() -> Vec<u8> {
    let body: Vec<u8> = [0u32, 65_535, 65_535, 0, 0].iter().flat_map(|number| number.to_le_bytes()).collect();
    frame(b"ACKF", &body)
}

async fn ask(target: &ServerLocation) -> ConnectFailure {
    let folder = tempfile::tempdir().unwrap();
    let identity = Workspace::new(folder.path()).own_identity().load_or_make(chrono::Utc::now()).unwrap();
    let client = OpcUaClient::new(&identity, WAIT_LIMIT).unwrap();
    let asked = Instant::now();
    let failure = client.endpoints(target).await.expect_err("not an OPC UA server");
    assert!(asked.elapsed() < Duration::from_secs(20), "took {:?}", asked.elapsed());
    failure
}

#[tokio::test(flavor = "multi_thread")]
async fn nobody_listens_and_no_such_host() {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let target = ServerLocation { host: "127.0.0.1".into(), port: listener.local_addr().unwrap().port() };
    drop(listener);
    let failure = ask(&target).await;
    assert!(
        matches!(failure, ConnectFailure { stage: ConnectStage::Connect, cause: ConnectFailureCause::NotReachable(_) }),
        "{failure:?}"
    );
    assert!(!is_reachable(&target, WAIT_LIMIT.connect).await);
    let failure = ask(&ServerLocation { host: "robot.invalid".into(), port: 4840 }).await;
    assert_eq!(failure.stage, ConnectStage::Connect);
}

#[tokio::test(flavor = "multi_thread")]
async fn what_answers_is_something_else() {
    for answer in [b"HTTP/1.1 400 Bad Request\r\n\r\n".to_vec(), vec![0; 5000], frame(b"ACKF", &[0xff; 20])] {
        let target = server(move |_| Some(answer.clone())).await;
        let failure = ask(&target).await;
        assert!(
            matches!(
                failure.cause,
                ConnectFailureCause::NotOpcUa(_) | ConnectFailureCause::Closed | ConnectFailureCause::Status { .. }
            ),
            "{failure:?}"
        );
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn what_answers_hangs_or_hangs_up() {
    let target = server(|_| Some(Vec::new())).await;
    assert_eq!(ask(&target).await.cause, ConnectFailureCause::TimedOut);
    let target = server(|_| None).await;
    assert_eq!(ask(&target).await.cause, ConnectFailureCause::Closed);
    let target = server(|round| Some(if round == 0 { acknowledge() } else { Vec::new() })).await;
    assert_eq!(ask(&target).await.cause, ConnectFailureCause::TimedOut);
}

#[tokio::test(flavor = "multi_thread")]
async fn what_answers_sends_without_end() {
    let target = server(|_| Some(frame(b"ACKF", &[0; 60_000]).repeat(100))).await;
    let failure = ask(&target).await;
    assert!(!matches!(failure.cause, ConnectFailureCause::Internal(_)), "{failure:?}");
    let target =
        server(|round| Some(if round == 0 { acknowledge() } else { frame(b"MSGC", &[0; 60_000]).repeat(100) })).await;
    assert!(matches!(
        ask(&target).await.cause,
        ConnectFailureCause::NotOpcUa(_) | ConnectFailureCause::Status { .. } | ConnectFailureCause::Closed
    ));
    let target = server(|_| Some([&b"ACKF"[..], &0xffff_ffff_u32.to_le_bytes()].concat())).await;
    let ConnectFailureCause::NotOpcUa(why) = ask(&target).await.cause else { panic!("taken for a server") };
    assert!(why.contains("4294967295"), "{why}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_server_that_is_too_busy_says_so_in_its_own_words() {
    let reason = b"come back later";
    let busy = [&0x807d_0000_u32.to_le_bytes()[..], &(reason.len() as u32).to_le_bytes(), reason].concat();
    for round in [0, 1] {
        let busy = busy.clone();
        let target = server(move |at| Some(if at == round { frame(b"ERRF", &busy) } else { acknowledge() })).await;
        let failure = ask(&target).await;
        assert_eq!(failure.cause.to_string(), "BadTcpServerTooBusy: come back later", "{failure:?}");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_damaged_channel_answer_is_a_clear_failure() {
    // OPN frames with no policy, with one that does not exist, with lengths beyond the end.
    let policy = b"http://opcfoundation.org/UA/SecurityPolicy#Nonsense";
    let named = [&(policy.len() as u32).to_le_bytes()[..], policy, &[0xff; 8], &[7; 64]].concat();
    for body in [vec![], vec![0xff; 12], vec![0x7f; 200], [&[1, 0, 0, 0][..], &named].concat()] {
        let target = server(move |round| Some(if round == 0 { acknowledge() } else { frame(b"OPNF", &body) })).await;
        let failure = ask(&target).await;
        assert_eq!(failure.stage, ConnectStage::Channel, "{failure:?}");
    }
}
