//! The gate in front of a server that is not one, with little patience.

use std::net::{Ipv4Addr, SocketAddr};
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use opcua::core::comms::tcp_types::ErrorMessage;
use opcua::types::{DecodingOptions, SimpleBinaryDecodable as _, StatusCode};
use tempfile::TempDir;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinHandle;
use tokio::time::{Instant, sleep, timeout};

use super::super::ServerEvents;
use super::super::certificate_store::PkiFolder;
use super::super::tests::test_application::TestApplication;
use super::client_verifier::ClientVerifier;
use super::fault::Fault;
use super::gate::{Gate, GateSettings};
use super::inner_server::InnerServer;
use super::limits::AdmissionLimits;
use super::report::AdmissionReporter;
use super::rewrap::ServerKeyPair;
use super::{client_verifier, frame};
use crate::model::SecurityPolicy;
use crate::pki::{TrustLists, TrustPolicy};

static SERVER: LazyLock<TestApplication> = LazyLock::new(|| TestApplication::new("server"));
const WAIT_LIMIT: Duration = Duration::from_secs(90);

struct GateFixture {
    address: SocketAddr,
    server: TcpListener,
    gate: JoinHandle<()>,
    _folder: TempDir,
}

impl GateFixture {
    async fn new(limits: AdmissionLimits) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let clients = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await.unwrap();
        let server = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await.unwrap();
        let address = clients.local_addr().unwrap();
        let gate = Gate::new(
            GateSettings { limits, ..GateSettings::new(SecurityPolicy::ALL.into(), false) },
            InnerServer::standing_in(server.local_addr().unwrap()),
            ServerKeyPair::new(&SERVER.der, &SERVER.key.serialize_pem()).unwrap(),
            ClientVerifier::new(
                TrustLists::default(),
                TrustPolicy::default(),
                client_verifier::CertificateClock::default(),
            ),
            PkiFolder::create(folder.path().join("pki")).unwrap(),
            AdmissionReporter::new(ServerEvents::default(), None),
        );
        let gate = tokio::spawn(Arc::new(gate).run(clients));
        Self { address, server, gate, _folder: folder }
    }

    async fn dial(&self) -> TcpStream {
        TcpStream::connect(self.address).await.unwrap()
    }

    /// A client that has a channel, and what the server holds of it.
    async fn open(&self) -> (TcpStream, TcpStream) {
        let mut client = self.dial().await;
        let request = [hello(), opening()].concat();
        client.write_all(&request).await.unwrap();
        let mut server = self.server.accept().await.unwrap().0;
        let mut seen = vec![0; request.len()];
        server.read_exact(&mut seen).await.unwrap();
        assert_eq!(seen, request);
        let answer = frame::tests::open(9, NONE, b"", b"", b"answer");
        server.write_all(&answer).await.unwrap();
        let mut seen = vec![0; answer.len()];
        client.read_exact(&mut seen).await.unwrap();
        assert_eq!(seen, answer);
        (client, server)
    }
}

impl Drop for GateFixture {
    fn drop(&mut self) {
        self.gate.abort();
    }
}

const NONE: &str = "http://opcfoundation.org/UA/SecurityPolicy#None";

fn hello() -> Vec<u8> {
    let mut hello = b"HELF".to_vec();
    hello.extend(32_u32.to_le_bytes());
    hello.resize(32, 0);
    hello
}

fn opening() -> Vec<u8> {
    frame::tests::open(0, NONE, b"", b"", b"request")
}

fn short_limits() -> AdmissionLimits {
    let short = Duration::from_millis(300);
    AdmissionLimits { open: short, session: short, stall: short, linger: short, ..AdmissionLimits::default() }
}

/// What the client is told at the end, and when.
async fn end_of(mut client: TcpStream) -> (Vec<u8>, Duration) {
    let start = Instant::now();
    let mut rest = Vec::new();
    let _ = timeout(WAIT_LIMIT, client.read_to_end(&mut rest)).await.expect("the connection is still open");
    (rest, start.elapsed())
}

fn error(message: &[u8]) -> StatusCode {
    ErrorMessage::decode(&mut &message[..], &DecodingOptions::default()).unwrap().error
}

#[tokio::test]
async fn bytes_pass_both_ways_and_a_last_word_arrives() {
    let stand = GateFixture::new(AdmissionLimits::default()).await;
    let (mut client, mut server) = stand.open().await;
    let goodbye = Fault::new(StatusCode::BadServerHalted, "bye").to_message();
    server.write_all(&goodbye).await.unwrap();
    // It hangs up while the client still talks.
    client.write_all(b"CLO").await.unwrap();
    drop(server);
    assert_eq!(end_of(client).await.0, goodbye);
}

#[tokio::test]
async fn nothing_reaches_the_server_before_a_hello() {
    let stand = GateFixture::new(short_limits()).await;
    let mut client = stand.dial().await;
    client.write_all(&hello()[..31]).await.unwrap();
    assert_eq!(error(&end_of(client).await.0), StatusCode::BadTimeout);
    assert!(timeout(Duration::from_millis(50), stand.server.accept()).await.is_err());
}

#[tokio::test]
async fn who_is_silent_or_slow_is_told_that_it_takes_too_long() {
    let stand = GateFixture::new(short_limits()).await;
    for begin in [vec![], hello(), [&hello()[..], &opening()[..20]].concat()] {
        let mut client = stand.dial().await;
        client.write_all(&begin).await.unwrap();
        let (told, after) = end_of(client).await;
        assert_eq!(error(&told), StatusCode::BadTimeout, "after {} bytes", begin.len());
        assert!(after >= Duration::from_millis(250) && after < Duration::from_secs(3), "{after:?}");
    }
    let mut client = stand.dial().await;
    let sent = timeout(WAIT_LIMIT, async {
        for byte in [hello(), opening()].concat() {
            if client.write_all(&[byte]).await.is_err() {
                return;
            }
            sleep(Duration::from_millis(30)).await;
        }
        panic!("it was let in, byte by byte");
    });
    sent.await.unwrap();
}

#[tokio::test]
async fn a_channel_nobody_opens_a_session_on_is_closed() {
    let stand = GateFixture::new(short_limits()).await;
    let (client, _server) = stand.open().await;
    let (told, after) = end_of(client).await;
    assert_eq!(error(&told), StatusCode::BadTimeout);
    assert!(after < Duration::from_secs(3), "{after:?}");
}

#[tokio::test]
async fn a_client_that_does_not_read_is_dropped_and_cannot_hold_the_server() {
    let slow = AdmissionLimits { session: WAIT_LIMIT, ..short_limits() };
    for (limits, stopped) in [(slow, false), (AdmissionLimits::default(), true)] {
        let stand = GateFixture::new(limits).await;
        let (_client, mut server) = stand.open().await;
        let mut chunk = b"MSGF".to_vec();
        chunk.extend(60_000_u32.to_le_bytes());
        chunk.resize(60_000, 0);
        let writing = tokio::spawn(async move { while server.write_all(&chunk).await.is_ok() {} });
        if stopped {
            sleep(Duration::from_millis(300)).await;
            assert!(!writing.is_finished());
            stand.gate.abort();
        }
        timeout(WAIT_LIMIT, writing).await.unwrap().unwrap();
    }
}

#[tokio::test]
async fn a_client_that_does_not_read_cannot_put_off_its_end() {
    let stand =
        GateFixture::new(AdmissionLimits { session: Duration::from_secs(1), stall: WAIT_LIMIT, ..short_limits() })
            .await;
    let (_client, mut server) = stand.open().await;
    let mut chunk = b"MSGF".to_vec();
    chunk.extend(60_000_u32.to_le_bytes());
    chunk.resize(60_000, 0);
    let start = Instant::now();
    while server.write_all(&chunk).await.is_ok() {}
    assert!(start.elapsed() < WAIT_LIMIT / 2, "{:?}", start.elapsed());
}

#[tokio::test]
async fn a_server_that_says_too_much_at_once_is_not_believed() {
    let stand = GateFixture::new(AdmissionLimits::default()).await;
    let (client, mut server) = stand.open().await;
    let mut lie = b"MSGF".to_vec();
    lie.extend(u32::MAX.to_le_bytes());
    server.write_all(&lie).await.unwrap();
    assert_eq!(error(&end_of(client).await.0), StatusCode::BadTcpMessageTooLarge);
}

#[tokio::test]
async fn a_server_that_is_gone_is_said_to_have_stopped() {
    let mut stand = GateFixture::new(AdmissionLimits::default()).await;
    stand.server = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await.unwrap();
    let mut client = stand.dial().await;
    client.write_all(&hello()).await.unwrap();
    assert_eq!(error(&end_of(client).await.0), StatusCode::BadServerHalted);
}
