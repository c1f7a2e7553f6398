use std::sync::Arc;
use std::time::Duration;

use opcua::types::{BinaryDecodable as _, NodeId, ObjectId, ResponseHeader, ServiceFault};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::tcp::{OwnedReadHalf, OwnedWriteHalf};
use tokio::sync::watch;
use tokio::task::spawn_blocking;
use tokio::time::{Instant, sleep_until, timeout};

use super::channel::PendingCreateSession;
use super::channel_keys::{BEGINNING, ChannelKeys, SEQUENCE_HEADER, Sender, contexts, decode, token_of};
use super::chunk_buffer::ChunkBuffer;
use super::connections::{GateConnection, StopReason, stop_asked};
use super::fault::Fault;
use super::frame::{MessageHeader, MessageKind, channel_of};
use super::gate::Gate;

/// From the server to one client. Says to the client why its connection ends, between two chunks.
pub(super) struct ServerToClient<'a> {
    gate: &'a Gate,
    connection: &'a Arc<GateConnection>,
    chunk_buffer: ChunkBuffer,
}

impl<'a> ServerToClient<'a> {
    pub(super) fn new(gate: &'a Gate, connection: &'a Arc<GateConnection>) -> Self {
        Self { gate, connection, chunk_buffer: ChunkBuffer::default() }
    }

    /// Ends when the server has hung up, when the client takes nothing any more, or as `stopped` says. Whether the
    /// client should be given time to read its last words.
    pub(super) async fn run(
        &mut self,
        from: &mut OwnedReadHalf,
        to: &mut OwnedWriteHalf,
        mut stopped: watch::Receiver<Option<StopReason>>,
    ) -> bool {
        let (mut stop, mut boundary_by): (Option<StopReason>, Option<Instant>) = (None, None);
        loop {
            if let Some(stop) = &stop
                && self.chunk_buffer.is_between_chunks()
            {
                return say(to, stop).await;
            }
            tokio::select! {
                biased;
                asked = stop_asked(&mut stopped), if stop.is_none() => {
                    stop = Some(asked);
                    boundary_by = Some(Instant::now() + REST_OF_A_CHUNK);
                    continue;
                }
                read = from.read_buf(self.chunk_buffer.room()) => if !matches!(read, Ok(1..)) {
                    return to.shutdown().await.is_ok();
                },
                () = sleep_until(boundary_by.unwrap_or_else(Instant::now)), if boundary_by.is_some() => return false,
            }
            if let Err(fault) = self.look().await {
                self.connection.stop(StopReason::Told(fault));
            }
            if !self.chunk_buffer.good().is_empty() {
                let written = timeout(self.gate.limits().stall, to.write_all(self.chunk_buffer.good()));
                // A client that reads nothing must not put off its end.
                let overdue = async {
                    if stop.is_none() {
                        stop_asked(&mut stopped).await;
                    }
                    sleep_until(boundary_by.unwrap_or_else(|| Instant::now() + REST_OF_A_CHUNK)).await;
                };
                tokio::select! {
                    written = written => if !matches!(written, Ok(Ok(()))) {
                        return false;
                    },
                    () = overdue => return false,
                }
                self.chunk_buffer.sent();
            }
        }
    }

    /// Reads what the server still says to a client that has left, until it hangs up.
    pub(super) async fn read_until_end(&mut self, from: &mut OwnedReadHalf) {
        loop {
            self.chunk_buffer.sent();
            if self.look().await.is_err() || !matches!(from.read_buf(self.chunk_buffer.room()).await, Ok(1..)) {
                return;
            }
        }
    }

    async fn look(&mut self) -> Result<(), Fault> {
        while let Some(header) = self.chunk_buffer.next(self.gate.limits().chunk)? {
            match header.kind {
                MessageKind::Open => {
                    if !self.opened(header).await? {
                        return Ok(());
                    }
                }
                MessageKind::Message if self.connection.channel.lock().awaits_answers() => {
                    if !self.answered(header) {
                        return Ok(());
                    }
                }
                MessageKind::Error => {
                    self.gate.server_refused(self.connection);
                    self.chunk_buffer.pass(header);
                }
                _ => self.chunk_buffer.pass(header),
            }
        }
        Ok(())
    }

    /// The server has answered an OpenSecureChannel. False while the answer is not whole.
    async fn opened(&mut self, header: MessageHeader) -> Result<bool, Fault> {
        let Some(chunk) = self.chunk_buffer.chunk(header) else { return Ok(false) };
        if let Some(channel) = channel_of(chunk) {
            self.gate.opened(self.connection, channel);
        }
        let secured = self.connection.state.lock().secured.clone();
        match secured {
            Some(client) => {
                let (own, chunk) = (self.gate.own().clone(), chunk.to_vec());
                let sealed = spawn_blocking(move || client.answer(&own, &chunk)).await;
                let (keys, sealed) = sealed.unwrap_or_else(|_| Err(Fault::internal()))?;
                if let Some(keys) = keys {
                    self.connection.channel.lock().opened(keys);
                }
                self.chunk_buffer.replace(header, sealed);
            }
            None => self.chunk_buffer.pass(header),
        }
        Ok(true)
    }

    /// A message, perhaps the answer to a request for a session. False while too little of it is here.
    fn answered(&mut self, header: MessageHeader) -> bool {
        let bytes = self.chunk_buffer.rest();
        if bytes.len() < BEGINNING.min(header.size) {
            return false;
        }
        let keys = token_of(bytes).and_then(|token| self.connection.channel.lock().keys(token));
        let Some(keys) = keys else {
            self.chunk_buffer.pass(header);
            return true;
        };
        let request = keys.begin(Sender::Server, bytes).map(|beginning| beginning.request).unwrap_or_default();
        if !self.connection.channel.lock().is_asked(request) {
            self.chunk_buffer.pass(header);
            return true;
        }
        let Some(chunk) = self.chunk_buffer.chunk(header) else { return false };
        let asked = self.connection.channel.lock().answered(request);
        let edited = asked.and_then(|asked| self.session_answer(&keys, chunk, asked));
        match edited {
            Some(edited) => self.chunk_buffer.replace(header, edited),
            None => self.chunk_buffer.pass(header),
        }
        self.connection.notify_answered();
        true
    }

    /// What takes the place of the first chunk of the answer, if something has to.
    fn session_answer(&self, keys: &ChannelKeys, chunk: &[u8], asked: PendingCreateSession) -> Option<Vec<u8>> {
        let body = keys.open(Sender::Server, chunk);
        match asked {
            PendingCreateSession::Session(number) => {
                match body.as_deref().and_then(created_token) {
                    Some(token) => self.gate.sessions().created(number, token),
                    None => self.gate.sessions().refused(number),
                }
                None
            }
            PendingCreateSession::Refused(status) => {
                let body = body?;
                let service = ObjectId::ServiceFault_Encoding_DefaultBinary;
                let mut fault: ServiceFault = decode(&body, service)?;
                fault.response_header.service_result = status;
                keys.replace(Sender::Server, chunk, &body, service, &fault)
            }
        }
    }
}

/// The authentication token in the first chunk of a CreateSession answer (OPC 10000-4 §5.7.2.2); the rest of the answer
/// may be in other chunks.
fn created_token(body: &[u8]) -> Option<NodeId> {
    let contexts = contexts();
    let context = contexts.context();
    let mut rest = body.get(SEQUENCE_HEADER..)?;
    let service = NodeId::decode(&mut rest, &context).ok()?.as_object_id().ok()?;
    if service != ObjectId::CreateSessionResponse_Encoding_DefaultBinary {
        return None;
    }
    ResponseHeader::decode(&mut rest, &context).ok()?;
    let _session_id = NodeId::decode(&mut rest, &context).ok()?;
    NodeId::decode(&mut rest, &context).ok()
}

/// Last words. Whether the client should be given time to read them.
pub(super) async fn say(to: &mut OwnedWriteHalf, stop: &StopReason) -> bool {
    match stop {
        StopReason::Told(fault) => {
            timeout(LAST_WORDS, to.write_all(&fault.to_message())).await.is_ok_and(|written| written.is_ok())
                && to.shutdown().await.is_ok()
        }
        StopReason::AtOnce(fault) => {
            let _ = to.try_write(&fault.to_message());
            false
        }
    }
}

/// What a client that has to go may still read of the chunk it is being sent.
const REST_OF_A_CHUNK: Duration = Duration::from_millis(300);
const LAST_WORDS: Duration = Duration::from_secs(1);
