use std::sync::Arc;

use opcua::crypto::SecurityPolicy;
use opcua::types::{ObjectId, StatusCode};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::tcp::{OwnedReadHalf, OwnedWriteHalf};
use tokio::task::spawn_blocking;
use tokio::time::{Instant, timeout_at};

use super::connections::{Connection, Identity, Stop};
use super::fault::Fault;
use super::frame::{Header, Kind};
use super::gate::Gate;
use super::passage::Passage;
use super::plain;
use super::rewrap::ChainedClient;

/// From one client to the server: no byte reaches it before the header of its chunk was looked at.
pub(super) struct Upward<'a> {
    gate: &'a Arc<Gate>,
    connection: &'a Arc<Connection>,
    passage: Passage,
    identity: Option<Arc<Identity>>,
    chained: Option<Arc<ChainedClient>>,
    /// A message has begun whose last chunk was not seen yet.
    in_message: bool,
}

/// Reads the message a client begins with. It may have sent more, which is in the bytes too.
pub(super) async fn read_hello(from: &mut OwnedReadHalf, deadline: Instant) -> Result<Option<Vec<u8>>, Fault> {
    let mut bytes = Vec::with_capacity(4096);
    loop {
        if let Some(header) = Header::parse(&bytes, 0)? {
            if header.kind != Kind::Hello {
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

impl<'a> Upward<'a> {
    /// `bytes` begin with a Hello that was looked at.
    pub(super) fn new(gate: &'a Arc<Gate>, connection: &'a Arc<Connection>, bytes: Vec<u8>) -> Self {
        Self { gate, connection, passage: Passage::new(bytes), identity: None, chained: None, in_message: false }
    }

    /// Ends well when one of the two has closed the connection.
    pub(super) async fn run(
        mut self,
        from: &mut OwnedReadHalf,
        mut to: OwnedWriteHalf,
        deadline: Instant,
    ) -> Result<(), Stop> {
        if let Some(hello) = self.next()? {
            self.passage.pass(hello);
        }
        loop {
            self.look().await?;
            if !self.passage.good().is_empty() {
                if to.write_all(self.passage.good()).await.is_err() {
                    return Ok(());
                }
                self.passage.sent();
            }
            let read = from.read_buf(self.passage.room());
            let read = match self.identity {
                Some(_) => read.await,
                None => timeout_at(deadline, read).await.map_err(|_| self.gate.refuse(self.connection, too_late()))?,
            };
            if !matches!(read, Ok(1..)) {
                let _ = to.shutdown().await;
                return Ok(());
            }
            self.connection.activity.used();
        }
    }

    /// Lets pass what is in order.
    async fn look(&mut self) -> Result<(), Stop> {
        while let Some(header) = self.next()? {
            let looked_at = match (header.kind, self.identity.as_ref().map(|identity| identity.policy)) {
                (Kind::Open, _) => self.open(header).await?,
                (Kind::Message, Some(SecurityPolicy::None)) => {
                    self.plain(header).map_err(|fault| self.gate.refuse(self.connection, fault))?
                }
                (Kind::Message, Some(_)) if self.chained.is_some() && !self.connection.activity.has_session() => {
                    self.before_session(header)
                }
                (Kind::Message | Kind::Close, Some(_)) => {
                    self.passage.pass(header);
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

    fn next(&mut self) -> Result<Option<Header>, Stop> {
        self.passage.next(self.gate.limits().chunk).map_err(|fault| self.gate.refuse(self.connection, fault))
    }

    /// False while the chunk is not whole.
    async fn open(&mut self, header: Header) -> Result<bool, Stop> {
        let Some(chunk) = self.passage.chunk(header) else { return Ok(false) };
        let identity = self.gate.admit(self.connection, chunk).await?;
        self.chained = self.connection.state.lock().chained.clone();
        match self.chained.clone() {
            Some(client) => {
                let (own, chunk) = (self.gate.own().clone(), chunk.to_vec());
                let sealed = spawn_blocking(move || client.request(&own, &chunk)).await;
                let sealed = sealed.unwrap_or_else(|_| Err(Fault::internal()));
                let sealed = sealed.map_err(|fault| self.gate.unproven(self.connection, &identity, fault))?;
                self.passage.replace(header, sealed);
            }
            None => self.passage.pass(header),
        }
        self.identity = Some(identity);
        Ok(true)
    }

    /// A message of a client that sent its issuers along, and may do so again. False while the chunk is not whole.
    fn before_session(&mut self, header: Header) -> bool {
        let Some(chunk) = self.passage.chunk(header) else { return false };
        match self.chained.as_ref().and_then(|client| client.session_request(chunk)) {
            Some(edited) => self.passage.replace(header, edited),
            None => self.passage.pass(header),
        }
        true
    }

    /// A message without security. False while too little of it is here.
    fn plain(&mut self, header: Header) -> Result<bool, Fault> {
        if !self.in_message {
            let bytes = self.passage.rest();
            if bytes.len() < plain::SERVICE_AT_MOST.min(header.size) {
                return Ok(false);
            }
            let objection = match plain::service(header, bytes)? {
                ObjectId::ActivateSessionRequest_Encoding_DefaultBinary => Some(plain::CLEAR_PASSWORD),
                ObjectId::CreateSessionRequest_Encoding_DefaultBinary if !self.gate.offers_none() => {
                    Some(plain::NO_ENDPOINT)
                }
                _ => None,
            };
            if let Some(objection) = objection {
                let Some(chunk) = self.passage.chunk(header) else { return Ok(false) };
                if let Some(spoilt) = (objection.spoil)(header, chunk)? {
                    self.gate.spoilt(self.connection, objection.reason);
                    self.passage.replace(header, spoilt);
                    return Ok(true);
                }
            }
        }
        self.in_message = header.last == b'C';
        self.passage.pass(header);
        Ok(true)
    }
}

fn too_late() -> Fault {
    Fault::new(StatusCode::BadTimeout, "no secure channel in time")
}
