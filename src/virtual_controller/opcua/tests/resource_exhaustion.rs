//! Peers that take what others need: sessions, and the right to guess a password.

use std::collections::BTreeSet;
use std::net::SocketAddr;
use std::time::Instant;

use opcua::client::IdentityToken;
use opcua::types::{CreateSessionRequest, ObjectId, StatusCode};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpSocket, TcpStream};

use super::super::admission::wire::{ChannelKeys, Sender};
use super::hostile::{channel_answered, hello, open_plain};
use super::*;

/// A client from another address that opens a channel without security and a session on it, which it leaves at that.
async fn create_session(server: &OpcUaServer, from: [u8; 4]) -> TcpStream {
    let socket = TcpSocket::new_v4().unwrap();
    socket.bind((from, 0).into()).unwrap();
    let mut peer = socket.connect(SocketAddr::from((Ipv4Addr::LOCALHOST, server.port()))).await.unwrap();
    peer.write_all(&[hello(), open_plain(0)].concat()).await.unwrap();
    let mut acknowledge = [0; 28];
    timeout(WAIT_LIMIT, peer.read_exact(&mut acknowledge)).await.unwrap().unwrap();
    let channel = channel_answered(&mut peer).await;
    let head = [&b"MSGF\0\0\0\0"[..], &channel.to_le_bytes(), &1_u32.to_le_bytes()].concat();
    let sequence = [2_u32.to_le_bytes(), 2_u32.to_le_bytes()].concat();
    let request = CreateSessionRequest {
        endpoint_url: server.endpoint().into(),
        requested_session_timeout: 120_000.0,
        ..Default::default()
    };
    let service = ObjectId::CreateSessionRequest_Encoding_DefaultBinary;
    let message = ChannelKeys::none().message(Sender::Client, &head, &sequence, service, &request).unwrap();
    peer.write_all(&message).await.unwrap();
    let mut answer = [0; 32];
    timeout(WAIT_LIMIT, peer.read_exact(&mut answer)).await.unwrap().unwrap();
    // OPC 10000-6: CreateSessionResponse is 464.
    assert_eq!((&answer[..4], &answer[24..28]), (&b"MSGF"[..], &[1, 0, 0xd0, 1][..]), "{answer:?}");
    peer
}

/// Ten clients, one after another; the longest time one took to have a session.
async fn serves_ten(server: &OpcUaServer) -> Duration {
    let mut longest = Duration::ZERO;
    for number in 0..10 {
        let asked = Instant::now();
        let client = if number % 2 == 0 { Client::encrypted(server).await } else { Client::anonymous(server).await };
        let client = client.unwrap();
        longest = longest.max(asked.elapsed());
        assert!(client.is_served().await);
        client.close().await;
    }
    longest
}

/// It was so: with 20 of them, no other client got a session for 121 s.
#[tokio::test(flavor = "multi_thread")]
async fn sessions_that_are_not_activated_keep_nobody_out() {
    let folder = tempfile::tempdir().unwrap();
    let server = start(OpcUaConfig { trust: trusting(&[&CLIENT]), ..config(&folder) }).await;
    let working = Client::encrypted(&server).await.unwrap();
    // More than the crate's server would take, if they were not closed.
    for _ in 0..250 {
        drop(create_session(&server, [127, 0, 0, 77]).await);
    }
    println!("after 250 that hung up: 10 of 10, the longest took {:?}", serves_ten(&server).await);
    let mut held = Vec::new();
    for number in 0..60 {
        held.push(create_session(&server, [127, 0, 0, 70 + number % 3]).await);
    }
    println!("while 60 hold on: 10 of 10, the longest took {:?}", serves_ten(&server).await);
    assert!(working.is_served().await);
    drop(held);
    working.close().await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_trusted_client_that_never_activates_keeps_nobody_out() {
    let folder = tempfile::tempdir().unwrap();
    let other = TestApplication::new("other");
    let trust = trusting(&[&CLIENT, &other]);
    let server = start(OpcUaConfig { trust, ..config(&folder) }).await;
    for number in 0..12 {
        let user = IdentityToken::new_user_name(format!("nobody{number}"), "guess");
        let refused = ClientOptions { user, ..ClientOptions::new(&server) }.connect().await.err();
        assert_eq!(refused, Some(StatusCode::BadUserAccessDenied));
    }
    let client = ClientOptions::new(&server).identity(&other).connect().await.unwrap();
    assert!(client.is_served().await);
    client.close().await;
    Client::encrypted(&server).await.unwrap().close().await;
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn one_client_cannot_have_all_sessions() {
    let folder = tempfile::tempdir().unwrap();
    let server = start(OpcUaConfig { trust: trusting(&[&CLIENT]), ..config(&folder) }).await;
    let mut held = Vec::new();
    for _ in 0..10 {
        held.push(Client::encrypted(&server).await.unwrap());
    }
    assert_eq!(Client::encrypted(&server).await.err(), Some(StatusCode::BadTooManySessions));
    let other = Client::anonymous(&server).await.unwrap();
    assert!(other.is_served().await);
    held.pop().unwrap().close().await;
    Client::encrypted(&server).await.unwrap().close().await;
    server.stop().await;
}

/// It was so: five wrong passwords a minute, and 0 of 37 logins of the right user in 130 s.
#[tokio::test(flavor = "multi_thread")]
async fn a_stranger_who_guesses_passwords_does_not_lock_the_user_out() {
    let folder = tempfile::tempdir().unwrap();
    let users = vec![OpcUaUser { name: "operator1".to_owned(), password_hash: hash_password("Passw0rd").unwrap() }];
    let user_tokens = BTreeSet::from([UserTokenPolicy::UserName]);
    let told = EventLines::default();
    let trust = trusting(&[&CLIENT]);
    let server = start(OpcUaConfig { users, user_tokens, trust, events: told.events(), ..config(&folder) }).await;
    for _ in 0..6 {
        assert_eq!(Client::log_in(&server, "operator1", "guess").await, Err(StatusCode::BadUserAccessDenied));
    }
    let guessing = async {
        loop {
            let _ = Client::log_in(&server, "operator1", "guess").await;
        }
    };
    let working = async {
        let mut longest = Duration::ZERO;
        for _ in 0..8 {
            let asked = Instant::now();
            let user = IdentityToken::new_user_name("operator1", "Passw0rd");
            let client = ClientOptions { user, ..ClientOptions::new(&server) }.connect().await.unwrap();
            longest = longest.max(asked.elapsed());
            client.close().await;
        }
        longest
    };
    let longest = tokio::select! {
        () = guessing => unreachable!(),
        longest = working => longest,
    };
    println!("8 of 8 logins, the longest took {longest:?}");
    assert!(longest < Duration::from_secs(5), "{longest:?}");
    told.wait_for("session of operator1 refused: wrong password, from 127.0.0.1:").await;
    server.stop().await;
}
