//! Peers that want no service.

use std::net::SocketAddr;
use std::time::Instant;

use opcua::core::comms::tcp_types::ErrorMessage;
use opcua::types::{DecodingOptions, SimpleBinaryDecodable as _, StatusCode};
use sha1::{Digest as _, Sha1};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;

use super::super::admission::wire::tests::open;
use super::*;

const NONE: &str = "http://opcfoundation.org/UA/SecurityPolicy#None";
const BASIC128RSA15: &str = "http://opcfoundation.org/UA/SecurityPolicy#Basic128Rsa15";
const BASIC256SHA256: &str = "http://opcfoundation.org/UA/SecurityPolicy#Basic256Sha256";

pub(super) fn hello() -> Vec<u8> {
    let url = b"opc.tcp://127.0.0.1";
    let mut hello = b"HELF".to_vec();
    hello.extend((32 + url.len() as u32).to_le_bytes());
    for number in [0, 65_535, 65_535, 0, 0, url.len() as u32] {
        hello.extend(number.to_le_bytes());
    }
    hello.extend(url);
    hello
}

/// The first OpenSecureChannel request of a connection, without security.
pub(super) fn open_plain(channel: u32) -> Vec<u8> {
    open_again(channel, 1, 0)
}

/// Any OpenSecureChannel request without security; `kind` 0 asks for a channel, 1 for its renewal.
fn open_again(channel: u32, sequence: u32, kind: u32) -> Vec<u8> {
    let mut body = Vec::new();
    // Sequence number, request id, type 446.
    body.extend([sequence.to_le_bytes(), sequence.to_le_bytes()].concat());
    body.extend([1, 0, 0xbe, 0x01]);
    // Request header: token, time, handle, diagnostics, audit entry, timeout, additional header.
    body.extend([0, 0]);
    body.extend([0; 8]);
    body.extend([1_u32.to_le_bytes(), 0_u32.to_le_bytes(), u32::MAX.to_le_bytes(), 5000_u32.to_le_bytes()].concat());
    body.extend([0, 0, 0]);
    // Version, kind, mode None, no nonce, lifetime.
    for number in [0, kind, 1, u32::MAX, 60_000_u32] {
        body.extend(number.to_le_bytes());
    }
    open(channel, NONE, b"", b"", &body)
}

/// An OpenSecureChannel request with this certificate, sealed with nothing.
fn open_as(certificates: &[u8]) -> Vec<u8> {
    open(0, BASIC256SHA256, certificates, &Sha1::digest(&SERVER.der), &[7; 512])
}

fn message(kind: &[u8; 4], size: u32, bytes: usize) -> Vec<u8> {
    [&kind[..], &size.to_le_bytes(), &vec![0; bytes]].concat()
}

async fn dial(address: SocketAddr) -> TcpStream {
    TcpStream::connect(address).await.unwrap()
}

/// Sends this and reads until the server hangs up: with what error, if it says one.
async fn last_word(address: SocketAddr, bytes: &[u8]) -> Option<StatusCode> {
    let mut peer = dial(address).await;
    // The server may have hung up in the middle.
    let _ = peer.write_all(bytes).await;
    error_of(peer).await
}

async fn error_of(mut peer: TcpStream) -> Option<StatusCode> {
    let mut answer = Vec::new();
    let _ = timeout(WAIT_LIMIT, peer.read_to_end(&mut answer)).await.expect("the connection is still open");
    let at = answer.windows(4).rposition(|bytes| bytes == b"ERRF")?;
    Some(ErrorMessage::decode(&mut &answer[at..], &DecodingOptions::default()).unwrap().error)
}

/// A server that trusts [`CLIENT`], and what it tells.
async fn target(folder: &TempDir) -> (OpcUaServer, SocketAddr, EventLines) {
    let told = EventLines::default();
    let server = start(OpcUaConfig { trust: trusting(&[&CLIENT]), events: told.events(), ..config(folder) }).await;
    let address = SocketAddr::from((Ipv4Addr::LOCALHOST, server.port()));
    (server, address, told)
}

async fn serves_proper_clients(server: &OpcUaServer) {
    for client in [Client::encrypted(server).await.unwrap(), Client::anonymous(server).await.unwrap()] {
        assert!(client.is_served().await);
        client.close().await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn garbage_and_lies_are_answered_with_an_error_and_hurt_nobody() {
    use StatusCode as S;
    let folder = tempfile::tempdir().unwrap();
    let (server, address, _) = target(&folder).await;
    let proper = Client::encrypted(&server).await.unwrap();
    let after_hello = |bytes: Vec<u8>| [hello(), bytes].concat();
    let after_open = |bytes: Vec<u8>| [hello(), open_plain(0), bytes].concat();
    let long = CLIENT.der.repeat(9);
    for (what, bytes, expected) in [
        ("noise", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03".to_vec(), S::BadTcpMessageTypeInvalid),
        ("HTTP", b"GET / HTTP/1.1\r\nHost: robot\r\n\r\n".to_vec(), S::BadTcpMessageTypeInvalid),
        ("Hello of 4 GiB", message(b"HELF", u32::MAX, 24), S::BadTcpMessageTooLarge),
        ("Hello of nothing", message(b"HELF", 0, 24), S::BadTcpMessageTypeInvalid),
        ("no Hello", open_plain(0), S::BadTcpMessageTypeInvalid),
        ("two Hellos", after_hello(hello()), S::BadTcpMessageTypeInvalid),
        ("message before channel", after_hello(message(b"MSGF", 64, 56)), S::BadTcpMessageTypeInvalid),
        ("channel of 1 GiB", after_hello(message(b"OPNF", 1 << 30, 100)), S::BadTcpMessageTooLarge),
        ("channel in pieces", after_hello(message(b"OPNC", 100, 92)), S::BadTcpMessageTypeInvalid),
        ("unknown policy", after_hello(open(0, "policy", b"", b"", b"")), S::BadSecurityPolicyRejected),
        ("channel 7 at once", after_hello(open_plain(7)), S::BadTcpSecureChannelUnknown),
        ("another server", after_hello(open(0, BASIC256SHA256, &CLIENT.der, &[0; 20], b"")), S::BadCertificateInvalid),
        ("no certificate", after_hello(open_as(b"")), S::BadSecurityChecksFailed),
        ("noise for a certificate", after_hello(open_as(&[7; 900])), S::BadSecurityChecksFailed),
        ("a certificate that lies", after_hello(open_as(b"\x30\x82\xff\xff1234")), S::BadSecurityChecksFailed),
        ("nine certificates", after_hello(open_as(&long)), S::BadSecurityChecksFailed),
        ("a stranger", after_hello(open_as(&SERVER.der)), S::BadSecurityChecksFailed),
        ("message of 1 MiB", after_open(message(b"MSGF", 1 << 20, 2000)), S::BadTcpMessageTooLarge),
        ("message of 12 bytes", after_open(message(b"MSGF", 12, 4)), S::BadTcpMessageTypeInvalid),
        ("no service", after_open(message(b"MSGF", 64, 56)), S::BadServiceUnsupported),
    ] {
        assert_eq!(last_word(address, &bytes).await, Some(expected), "{what}");
        assert!(proper.is_served().await, "{what}");
    }
    serves_proper_clients(&server).await;
    proper.close().await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stolen_certificate_is_worth_nothing_without_its_key() {
    let folder = tempfile::tempdir().unwrap();
    let (server, address, told) = target(&folder).await;
    // Alone, and with an issuer.
    for stolen in [CLIENT.der.clone(), [&CLIENT.der[..], &SERVER.der].concat()] {
        let before = told.lines().matches("no proof").count();
        assert!(last_word(address, &[hello(), open_as(&stolen)].concat()).await.is_some());
        timeout(WAIT_LIMIT, async {
            while told.lines().matches("no proof").count() == before {
                tokio::time::sleep(Duration::from_millis(10)).await;
            }
        })
        .await
        .unwrap_or_else(|_| panic!("nobody was told: {}", told.lines()));
    }
    assert!(!told.lines().contains("activated"), "{}", told.lines());
    serves_proper_clients(&server).await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn showing_a_certificate_where_it_is_refused_does_not_lock_its_owner_out() {
    let folder = tempfile::tempdir().unwrap();
    let authority = super::test_application::TestCa::new("Plant CA");
    let owner = authority.issue("owner", rcgen::RsaKeySize::_4096);
    let trust = TrustLists::new(vec![authority.certificate.clone()], vec![], vec![authority.crl(1, &[])]);
    let server = start(OpcUaConfig { trust, ..config(&folder) }).await;
    let held = || std::fs::read_dir(folder.path().join("pki/trusted")).unwrap().count();
    let client = ClientOptions::new(&server).identity(&owner).connect().await.unwrap();
    assert_eq!(held(), 1);
    // Its key is too long for this policy.
    let shown = open(0, BASIC128RSA15, &owner.der, &Sha1::digest(&SERVER.der), &[7; 512]);
    let last = last_word((Ipv4Addr::LOCALHOST, server.port()).into(), &[hello(), shown].concat()).await;
    assert_eq!(last, Some(opcua::types::StatusCode::BadSecurityChecksFailed));
    assert_eq!(held(), 1);
    assert!(client.is_served().await);
    client.close().await;
    server.stop().await;
}

/// Opens a channel without security. The connection, and the channel's number.
async fn opened(address: SocketAddr) -> (TcpStream, u32) {
    let mut peer = dial(address).await;
    peer.write_all(&[hello(), open_plain(0)].concat()).await.unwrap();
    let mut acknowledge = [0; 28];
    timeout(WAIT_LIMIT, peer.read_exact(&mut acknowledge)).await.unwrap().unwrap();
    let channel = channel_answered(&mut peer).await;
    (peer, channel)
}

/// Reads the answer to an OpenSecureChannel request.
pub(super) async fn channel_answered(peer: &mut TcpStream) -> u32 {
    let mut head = [0; 12];
    timeout(WAIT_LIMIT, peer.read_exact(&mut head)).await.unwrap().unwrap();
    assert_eq!(&head[..4], b"OPNF");
    let size = u32::from_le_bytes(head[4..8].try_into().unwrap()) as usize;
    let mut rest = vec![0; size - head.len()];
    timeout(WAIT_LIMIT, peer.read_exact(&mut rest)).await.unwrap().unwrap();
    u32::from_le_bytes(head[8..].try_into().unwrap())
}

#[tokio::test(flavor = "multi_thread")]
async fn a_channel_is_renewed_by_nobody_but_its_owner() {
    let folder = tempfile::tempdir().unwrap();
    let (server, address, _) = target(&folder).await;
    let thumbprint = Sha1::digest(&SERVER.der).to_vec();
    for (what, renewal, expected) in [
        ("in its own name", None, None),
        ("with a certificate", Some((BASIC256SHA256, &CLIENT.der[..], 0)), Some(StatusCode::BadSecurityChecksFailed)),
        ("with another number", Some((NONE, &b""[..], 1)), Some(StatusCode::BadTcpSecureChannelUnknown)),
    ] {
        let (mut peer, channel) = opened(address).await;
        let renewal = match renewal {
            None => open_again(channel, 2, 1),
            Some((policy, certificate, plus)) => open(channel + plus, policy, certificate, &thumbprint, &[7; 512]),
        };
        peer.write_all(&renewal).await.unwrap();
        if expected.is_none() {
            assert_eq!(channel_answered(&mut peer).await, channel, "{what}");
            peer.shutdown().await.unwrap();
        }
        assert_eq!(error_of(peer).await, expected, "{what}");
    }
    serves_proper_clients(&server).await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn half_closed_connections_do_not_stay() {
    let folder = tempfile::tempdir().unwrap();
    let (server, address, _) = target(&folder).await;
    for bytes in [vec![], hello()[..9].to_vec(), hello(), [hello(), open_plain(0)].concat()] {
        let mut peer = dial(address).await;
        peer.write_all(&bytes).await.unwrap();
        peer.shutdown().await.unwrap();
        let start = Instant::now();
        error_of(peer).await;
        assert!(start.elapsed() < Duration::from_secs(20), "{} bytes: {:?}", bytes.len(), start.elapsed());
    }
    serves_proper_clients(&server).await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn thousands_of_connections_keep_no_proper_client_out() {
    let folder = tempfile::tempdir().unwrap();
    let (server, address, told) = target(&folder).await;
    let proper = Client::encrypted(&server).await.unwrap();
    let mut held = Vec::new();
    for number in 0..2000 {
        let mut peer = dial(address).await;
        // Some say nothing, some begin, some open a channel and leave it at that.
        let bytes = match number % 3 {
            0 => vec![],
            1 => hello(),
            _ => [hello(), open_plain(0)].concat(),
        };
        let _ = peer.write_all(&bytes).await;
        // As many as this process may have open besides those of other tests.
        if held.len() < 400 {
            held.push(peer);
        }
        if number % 500 == 499 {
            serves_proper_clients(&server).await;
            assert!(proper.is_served().await);
        }
    }
    serves_proper_clients(&server).await;
    assert!(proper.is_served().await, "who has a session keeps it");
    assert!(told.lines().lines().count() < 400, "the log is not flooded: {}", told.lines().lines().count());
    drop(held);
    proper.close().await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn whoever_is_refused_too_often_is_kept_quiet_and_its_neighbour_is_served() {
    let folder = tempfile::tempdir().unwrap();
    let told = EventLines::default();
    let recorded = Arc::new(RecordedRejections::default());
    let refusals: Arc<dyn RejectionRecorder> = recorded.clone();
    let trust = trusting(&[&CLIENT]);
    let server = start(OpcUaConfig { trust, events: told.events(), refusals: Some(refusals), ..config(&folder) }).await;
    let address = SocketAddr::from((Ipv4Addr::LOCALHOST, server.port()));
    let stranger = [hello(), open_as(&SERVER.der)].concat();
    for _ in 0..100 {
        last_word(address, &stranger).await;
    }
    // The same address.
    serves_proper_clients(&server).await;
    assert_eq!(recorded.0.lock().len(), 30);
    assert_eq!(told.lines().matches(" refused: ").count(), 30, "{}", told.lines());
    assert_eq!(told.lines().matches("refusals of 127.0.0.1 are too many").count(), 1);
    server.stop().await;
}
