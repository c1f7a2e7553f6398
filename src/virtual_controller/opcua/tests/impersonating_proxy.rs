use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use opcua::crypto::{PrivateKey, SecurityPolicy as WirePolicy, X509};
use parking_lot::Mutex;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinHandle;

use super::super::OpcUaServer;
use super::super::admission::wire::{ChannelKeys, ChunkBuffer, ChunkEnvelope, MessageKind, OpenChannelHeader, unseal};
use super::SERVER;
use super::test_application::TestApplication;

/// Stands between a client and the server, and opens the client's secure channels as another application, or with more
/// certificates than its own. Everything else passes untouched. Works because the test has the keys of both.
pub(super) struct ImpersonatingProxy {
    pub url: String,
    /// How many CreateSession requests had the issuers put in.
    pub sessions: Arc<AtomicUsize>,
    task: JoinHandle<()>,
}

struct Keys {
    server: (PrivateKey, X509),
    /// Whom the client is.
    client: (PrivateKey, X509),
    /// Whom it shows.
    shown: (PrivateKey, X509),
    shown_bytes: Vec<u8>,
    sessions: Arc<AtomicUsize>,
    asked: Mutex<Vec<u8>>,
    channel: Mutex<Option<ChannelKeys>>,
}

impl ImpersonatingProxy {
    /// `shown` opens the channels of `client`; `issuers` (DER) follow its certificate, in CreateSession too.
    pub async fn start(
        server: &OpcUaServer,
        client: &TestApplication,
        shown: &TestApplication,
        issuers: &[&[u8]],
    ) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let url = format!("opc.tcp://{}", listener.local_addr().unwrap());
        let keys = Arc::new(Keys {
            server: SERVER.wire(),
            client: client.wire(),
            shown: shown.wire(),
            shown_bytes: [&[&shown.der[..]], issuers].concat().concat(),
            sessions: Arc::default(),
            asked: Mutex::default(),
            channel: Mutex::default(),
        });
        let sessions = keys.sessions.clone();
        let has_issuers = !issuers.is_empty();
        let port = server.port();
        let task = tokio::spawn(async move {
            while let Ok((client, _)) = listener.accept().await {
                let server = TcpStream::connect(("127.0.0.1", port)).await.unwrap();
                let ((from_client, to_client), (from_server, to_server)) = (client.into_split(), server.into_split());
                let (up, down) = (keys.clone(), keys.clone());
                tokio::spawn(pass(from_client, to_server, move |kind, chunk| match kind {
                    MessageKind::Open => Some(up.request(chunk)),
                    MessageKind::Message if has_issuers => up.session_request(chunk),
                    _ => None,
                }));
                tokio::spawn(pass(from_server, to_client, move |kind, chunk| match kind {
                    MessageKind::Open => Some(down.answer(chunk)),
                    _ => None,
                }));
            }
        });
        Self { url, sessions, task }
    }
}

impl Drop for ImpersonatingProxy {
    fn drop(&mut self) {
        self.task.abort();
    }
}

impl Keys {
    fn request(&self, chunk: &[u8]) -> Vec<u8> {
        let (server_key, server) = &self.server;
        let client = self.client.1.public_key().unwrap();
        let (sealed, body) = reseal(chunk, server_key, &client, &self.shown_bytes, &self.shown.0, server);
        *self.asked.lock() = body;
        sealed
    }

    fn answer(&self, chunk: &[u8]) -> Vec<u8> {
        let server = self.server.1.public_key().unwrap();
        let (sealed, body) = reseal(chunk, &self.shown.0, &server, &SERVER.der, &self.server.0, &self.client.1);
        let policy = WirePolicy::from_uri(OpenChannelHeader::parse(chunk).unwrap().policy_uri);
        *self.channel.lock() = ChannelKeys::new(policy, &self.asked.lock(), &body);
        sealed
    }

    fn session_request(&self, chunk: &[u8]) -> Option<Vec<u8>> {
        let channel = self.channel.lock();
        channel.as_ref()?.edit_session_request(chunk, |request| {
            assert_eq!(request.client_certificate.as_ref(), self.client.1.to_der().unwrap());
            self.sessions.fetch_add(1, Ordering::Relaxed);
            request.client_certificate = self.shown_bytes.as_slice().into();
        })
    }
}

fn reseal(
    chunk: &[u8],
    key: &PrivateKey,
    sender: &opcua::crypto::PublicKey,
    sender_bytes: &[u8],
    sender_key: &PrivateKey,
    receiver: &X509,
) -> (Vec<u8>, Vec<u8>) {
    let open = OpenChannelHeader::parse(chunk).unwrap();
    let policy = WirePolicy::from_uri(open.policy_uri);
    let body = unseal(policy, chunk, key, sender).unwrap();
    let thumbprint = receiver.thumbprint();
    let envelope = ChunkEnvelope {
        policy,
        channel: open.channel,
        sender: sender_bytes,
        sender_key,
        receiver_thumbprint: thumbprint.value(),
        receiver: &receiver.public_key().unwrap(),
    };
    (envelope.seal(&body).unwrap(), body)
}

async fn pass(
    mut from: tokio::net::tcp::OwnedReadHalf,
    mut to: tokio::net::tcp::OwnedWriteHalf,
    edit: impl Fn(MessageKind, &[u8]) -> Option<Vec<u8>>,
) {
    let mut chunk_buffer = ChunkBuffer::default();
    while matches!(from.read_buf(chunk_buffer.room()).await, Ok(1..)) {
        while let Some(header) = chunk_buffer.next(65_535).unwrap() {
            let Some(chunk) = chunk_buffer.chunk(header) else { break };
            match edit(header.kind, chunk) {
                Some(edited) => chunk_buffer.replace(header, edited),
                None => chunk_buffer.pass(header),
            }
        }
        if to.write_all(chunk_buffer.good()).await.is_err() {
            return;
        }
        chunk_buffer.sent();
    }
}
