use std::sync::Arc;

use opcua::crypto::{PrivateKey, SecurityPolicy as WirePolicy, X509};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinHandle;

use super::super::OpcUaServer;
use super::super::admission::wire::{Envelope, Kind, Open, Passage, unseal};
use super::SERVER;
use super::identity::Identity;

/// Stands between a client and the server, and opens the client's secure channels as somebody else, or with more
/// certificates than its own. Everything else passes untouched. Works because the test has everybody's keys.
pub(super) struct Disguise {
    pub url: String,
    task: JoinHandle<()>,
}

struct Keys {
    server: (PrivateKey, X509),
    /// Whom the client is.
    client: (PrivateKey, X509),
    /// Whom it shows.
    shown: (PrivateKey, X509),
    shown_bytes: Vec<u8>,
}

impl Disguise {
    /// `shown` opens the channels of `client`; `issuers` (DER) follow its certificate.
    pub async fn start(server: &OpcUaServer, client: &Identity, shown: &Identity, issuers: &[&[u8]]) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let url = format!("opc.tcp://{}", listener.local_addr().unwrap());
        let keys = Arc::new(Keys {
            server: SERVER.wire(),
            client: client.wire(),
            shown: shown.wire(),
            shown_bytes: [&[&shown.der[..]], issuers].concat().concat(),
        });
        let port = server.port();
        let task = tokio::spawn(async move {
            while let Ok((client, _)) = listener.accept().await {
                let server = TcpStream::connect(("127.0.0.1", port)).await.unwrap();
                let ((from_client, to_client), (from_server, to_server)) = (client.into_split(), server.into_split());
                let (up, down) = (keys.clone(), keys.clone());
                tokio::spawn(pass(from_client, to_server, move |chunk| up.request(chunk)));
                tokio::spawn(pass(from_server, to_client, move |chunk| down.answer(chunk)));
            }
        });
        Self { url, task }
    }
}

impl Drop for Disguise {
    fn drop(&mut self) {
        self.task.abort();
    }
}

impl Keys {
    fn request(&self, chunk: &[u8]) -> Vec<u8> {
        let (server_key, server) = &self.server;
        let client = self.client.1.public_key().unwrap();
        reseal(chunk, server_key, &client, &self.shown_bytes, &self.shown.0, server)
    }

    fn answer(&self, chunk: &[u8]) -> Vec<u8> {
        let server = self.server.1.public_key().unwrap();
        reseal(chunk, &self.shown.0, &server, &SERVER.der, &self.server.0, &self.client.1)
    }
}

fn reseal(
    chunk: &[u8],
    key: &PrivateKey,
    sender: &opcua::crypto::PublicKey,
    sender_bytes: &[u8],
    sender_key: &PrivateKey,
    receiver: &X509,
) -> Vec<u8> {
    let open = Open::parse(chunk).unwrap();
    let policy = WirePolicy::from_uri(open.policy_uri);
    let body = unseal(policy, chunk, key, sender).unwrap();
    let thumbprint = receiver.thumbprint();
    let envelope = Envelope {
        policy,
        channel: open.channel,
        sender: sender_bytes,
        sender_key,
        receiver_thumbprint: thumbprint.value(),
        receiver: &receiver.public_key().unwrap(),
    };
    envelope.seal(&body).unwrap()
}

async fn pass(
    mut from: tokio::net::tcp::OwnedReadHalf,
    mut to: tokio::net::tcp::OwnedWriteHalf,
    reseal: impl Fn(&[u8]) -> Vec<u8>,
) {
    let mut passage = Passage::default();
    while matches!(from.read_buf(passage.room()).await, Ok(1..)) {
        while let Some(header) = passage.next(65_535).unwrap() {
            match (header.kind, passage.chunk(header)) {
                (Kind::Open, None) => break,
                (Kind::Open, Some(chunk)) => {
                    let resealed = reseal(chunk);
                    passage.replace(header, resealed);
                }
                _ => passage.pass(header),
            }
        }
        if to.write_all(passage.good()).await.is_err() {
            return;
        }
        passage.sent();
    }
}
