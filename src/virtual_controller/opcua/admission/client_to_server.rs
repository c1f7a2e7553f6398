use std::sync::Arc;

use opcua::crypto::SecurityPolicy;
use opcua::types::{
    ActivateSessionRequest, CreateSessionRequest, ExtensionObject, ObjectId, StatusCode, UAString,
    UserNameIdentityToken,
};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::tcp::{OwnedReadHalf, OwnedWriteHalf};
use tokio::task::spawn_blocking;
use tokio::time::{Instant, timeout, timeout_at};

use super::channel::{LastRequest, PendingCreateSession};
use super::channel_keys::{ChannelKeys, MessageStart, Sender, decode, token_of};
use super::chunk_buffer::ChunkBuffer;
use super::connections::{ClaimedIdentity, GateConnection, StopReason};
use super::fault::Fault;
use super::frame::{MessageHeader, MessageKind, channel_of, longest_response};
use super::gate::Gate;
use super::logins;

/// From one client to the server: whole chunks only, and none that was not looked at.
pub(super) struct ClientToServer<'a> {
    gate: &'a Arc<Gate>,
    connection: &'a Arc<GateConnection>,
    chunk_buffer: ChunkBuffer,
    identity: Option<Arc<ClaimedIdentity>>,
    /// A message has begun whose last chunk was not seen yet.
    in_message: bool,
    /// The client has closed its channel.
    is_closed: bool,
    /// The server has received whole chunks, and not yet that the client has left.
    can_leave: bool,
}

/// Reads the message a client begins with. It may have sent more, which is in the bytes too.
pub(super) async fn read_hello(from: &mut OwnedReadHalf, deadline: Instant) -> Result<Option<Vec<u8>>, Fault> {
    let mut bytes = Vec::with_capacity(4096);
    loop {
        if let Some(header) = MessageHeader::parse(&bytes, 0)? {
            if header.kind != MessageKind::Hello {
                return Err(Fault::new(StatusCode::BadTcpMessageTypeInvalid, "a Hello has to come first"));
            }
            if bytes.len() >= header.size {
                return Ok(Some(bytes));
            }
        }
        let read = timeout_at(deadline, from.read_buf(&mut bytes)).await.map_err(|_| too_late())?;
        if !matches!(read, Ok(1..)) {
            return Ok(None);
        }
    }
}

impl<'a> ClientToServer<'a> {
    /// `bytes` begin with a Hello that was looked at.
    pub(super) fn new(gate: &'a Arc<Gate>, connection: &'a Arc<GateConnection>, bytes: Vec<u8>) -> Self {
        Self {
            gate,
            connection,
            chunk_buffer: ChunkBuffer::new(bytes),
            identity: None,
            in_message: false,
            is_closed: false,
            can_leave: true,
        }
    }

    /// Ends well when one of the two has closed the connection.
    pub(super) async fn run(
        &mut self,
        from: &mut OwnedReadHalf,
        to: &mut OwnedWriteHalf,
        deadline: Instant,
    ) -> Result<(), StopReason> {
        if let Some(hello) = self.next()? {
            let longest = self.chunk_buffer.chunk(hello).and_then(longest_response);
            self.connection.state.lock().longest_response = longest;
            self.chunk_buffer.pass(hello);
        }
        loop {
            self.look().await?;
            if !self.chunk_buffer.good().is_empty() {
                self.can_leave = false;
                if to.write_all(self.chunk_buffer.good()).await.is_err() {
                    return Ok(());
                }
                self.can_leave = true;
                self.chunk_buffer.sent();
            }
            if self.is_closed {
                self.leave(to).await;
                return Ok(());
            }
            let read = from.read_buf(self.chunk_buffer.room());
            let read = match self.identity {
                Some(_) => read.await,
                None => timeout_at(deadline, read).await.map_err(|_| self.gate.refuse(self.connection, too_late()))?,
            };
            if !matches!(read, Ok(1..)) {
                self.leave(to).await;
                return Ok(());
            }
            self.connection.activity.used();
        }
    }

    /// The client sends nothing more: closes the sessions that cannot be used any more, then the connection. Whether
    /// the server has something to do for it. Does nothing the second time.
    pub(super) async fn leave(&mut self, to: &mut OwnedWriteHalf) -> bool {
        if !std::mem::replace(&mut self.can_leave, false) {
            return false;
        }
        let _ = timeout(ANSWER_TIMEOUT, self.connection.all_answered()).await;
        let messages = self.gate.closing_message(self.connection);
        let _ = timeout(ANSWER_TIMEOUT, to.write_all(&messages)).await;
        let _ = to.shutdown().await;
        !messages.is_empty()
    }

    /// Lets pass what is in order.
    async fn look(&mut self) -> Result<(), StopReason> {
        while !self.is_closed
            && let Some(header) = self.next()?
        {
            let looked_at = match (header.kind, self.identity.is_some()) {
                (MessageKind::Open, _) => self.open(header).await?,
                (MessageKind::Message, true) => {
                    self.message(header).map_err(|fault| self.gate.refuse(self.connection, fault))?
                }
                (MessageKind::Close, true) => {
                    self.is_closed = true;
                    true
                }
                _ => {
                    let fault = Fault::new(StatusCode::BadTcpMessageTypeInvalid, "a message out of turn");
                    return Err(self.gate.refuse(self.connection, fault));
                }
            };
            if !looked_at {
                return Ok(());
            }
        }
        Ok(())
    }

    fn next(&mut self) -> Result<Option<MessageHeader>, StopReason> {
        self.chunk_buffer.next(self.gate.limits().chunk).map_err(|fault| self.gate.refuse(self.connection, fault))
    }

    /// False while the chunk is not whole.
    async fn open(&mut self, header: MessageHeader) -> Result<bool, StopReason> {
        let Some(chunk) = self.chunk_buffer.chunk(header) else { return Ok(false) };
        let identity = self.gate.admit(self.connection, chunk).await?;
        let secured = self.connection.state.lock().secured.clone();
        match secured {
            Some(client) => {
                let (own, chunk) = (self.gate.own().clone(), chunk.to_vec());
                let sealed = spawn_blocking(move || client.request(&own, &chunk)).await;
                let sealed = sealed.unwrap_or_else(|_| Err(Fault::internal()));
                let (sequence, sealed) =
                    sealed.map_err(|fault| self.gate.unproven(self.connection, &identity, fault))?;
                self.connection.channel.lock().renewed(sequence);
                self.chunk_buffer.replace(header, sealed);
            }
            None => {
                let sequence =
                    super::frame::OpenChannelHeader::parse(chunk).ok().and_then(|open| sequence_at(chunk, open.body));
                let mut channel = self.connection.channel.lock();
                if self.identity.is_none() {
                    channel.opened(ChannelKeys::none());
                }
                channel.renewed(sequence.unwrap_or_default());
                drop(channel);
                self.chunk_buffer.pass(header);
            }
        }
        self.identity = Some(identity);
        Ok(true)
    }

    /// A chunk of a message. False while it is not whole.
    fn message(&mut self, header: MessageHeader) -> Result<bool, Fault> {
        let Some(chunk) = self.chunk_buffer.chunk(header) else { return Ok(false) };
        let (channel, token) = (channel_of(chunk).unwrap_or_default(), token_of(chunk).unwrap_or_default());
        let keys = self.connection.channel.lock().keys(token);
        let keys = keys.ok_or_else(|| {
            Fault::new(StatusCode::BadSecureChannelTokenUnknown, "a message under a token that is not in use")
        })?;
        let beginning = keys
            .begin(Sender::Client, chunk)
            .ok_or_else(|| Fault::new(StatusCode::BadSecurityChecksFailed, "a message that is too short"))?;
        self.connection.channel.lock().sent(LastRequest { channel, token, sequence: beginning.sequence });
        let is_first = !self.in_message;
        self.in_message = header.last == b'C';
        let edited = if is_first { self.request(header, chunk, &keys, beginning)? } else { None };
        match edited {
            Some(edited) => self.chunk_buffer.replace(header, edited),
            None => self.chunk_buffer.pass(header),
        }
        Ok(true)
    }

    /// What takes the place of the first chunk of a request, if something has to.
    fn request(&self, header: MessageHeader, chunk: &[u8], keys: &ChannelKeys, beginning: MessageStart) -> Edited {
        use ObjectId::{
            ActivateSessionRequest_Encoding_DefaultBinary as ACTIVATE,
            CreateSessionRequest_Encoding_DefaultBinary as CREATE,
        };
        let service = match beginning.service {
            Some(service @ (CREATE | ACTIVATE)) => service,
            Some(_) => return Ok(None),
            None => return Err(Fault::new(StatusCode::BadServiceUnsupported, "not a service")),
        };
        if header.last != b'F' {
            return Err(Fault::new(StatusCode::BadTcpMessageTooLarge, "a session asked for in more than one chunk"));
        }
        // One that is not sealed as it should be is for the server to complain of.
        let Some(body) = keys.open(Sender::Client, chunk) else { return Ok(None) };
        let undecodable = || Fault::new(StatusCode::BadDecodingError, "the request cannot be read");
        if service == CREATE {
            let mut request = decode(&body, service).ok_or_else(undecodable)?;
            let is_edited = self.create_session(&mut request, beginning.request)?;
            Ok(if is_edited { keys.replace(Sender::Client, chunk, &body, service, &request) } else { None })
        } else {
            let mut request = decode(&body, service).ok_or_else(undecodable)?;
            let is_edited = self.activate_session(&mut request)?;
            Ok(if is_edited { keys.replace(Sender::Client, chunk, &body, service, &request) } else { None })
        }
    }

    /// Whether the request was changed. One that is refused is left without its endpoint, so that the server refuses it
    /// and the client gets a proper answer.
    fn create_session(&self, request: &mut CreateSessionRequest, number: u32) -> Result<bool, Fault> {
        let mut is_edited = false;
        if let Some(leaf) = self.identity.as_ref().and_then(|identity| identity.leaf())
            && request.client_certificate.as_ref().len() > leaf.der().len()
            && request.client_certificate.as_ref().starts_with(leaf.der())
        {
            // The server reads one certificate only; its signature is over that alone (OPC 10000-4 §5.7.2.2).
            request.client_certificate = leaf.der().into();
            is_edited = true;
        }
        let is_plain = self.identity.as_ref().is_none_or(|identity| identity.policy == SecurityPolicy::None);
        let refusal = if is_plain && !self.gate.offers_none() {
            Err((StatusCode::BadSecurityPolicyRejected, "a session without security, which is not offered"))
        } else {
            self.gate.enter_session(self.connection).ok_or((StatusCode::BadTooManySessions, "too many sessions"))
        };
        let asked = match refusal {
            Ok(session) => PendingCreateSession::Session(session),
            Err((status, reason)) => {
                self.gate.spoilt(self.connection, reason);
                request.endpoint_url = UAString::null();
                is_edited = true;
                PendingCreateSession::Refused(status)
            }
        };
        if self.connection.channel.lock().ask(number, asked) {
            Ok(is_edited)
        } else {
            Err(Fault::new(StatusCode::BadTooManyOperations, "too many sessions asked for at once"))
        }
    }

    /// Whether the request was changed: a user's name goes on with the connection it came by, for those who check
    /// passwords. A password in clear, which the server would check although it asked for an encrypted one, does not.
    fn activate_session(&self, request: &mut ActivateSessionRequest) -> Result<bool, Fault> {
        let Some(token) = request.user_identity_token.inner_as::<UserNameIdentityToken>() else { return Ok(false) };
        let is_secured = self.identity.as_ref().is_some_and(|identity| identity.policy != SecurityPolicy::None);
        let mark = self.connection.login_mark().map_err(|_| Fault::internal())?;
        let token = logins::passed_on(token, is_secured, &mark).unwrap_or_else(|| {
            self.gate.spoilt(self.connection, "a login whose password was not encrypted");
            // A token that was not offered.
            UserNameIdentityToken::default()
        });
        request.user_identity_token = ExtensionObject::from_message(token);
        Ok(true)
    }
}

type Edited = Result<Option<Vec<u8>>, Fault>;

/// The sequence number that begins here.
pub(super) fn sequence_at(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|bytes| u32::from_le_bytes(*bytes))
}

fn too_late() -> Fault {
    Fault::new(StatusCode::BadTimeout, "no secure channel in time")
}

/// What the server gets to answer requests whose client has left.
const ANSWER_TIMEOUT: std::time::Duration = std::time::Duration::from_secs(1);
