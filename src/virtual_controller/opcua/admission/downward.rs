use std::sync::Arc;
use std::time::Duration;

use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::tcp::{OwnedReadHalf, OwnedWriteHalf};
use tokio::sync::watch;
use tokio::task::spawn_blocking;
use tokio::time::{Instant, sleep_until, timeout};

use super::connections::{Connection, Stop, stop_asked};
use super::fault::Fault;
use super::frame::{Header, Kind, channel_of};
use super::gate::Gate;
use super::passage::Passage;

/// From the server to one client. Says to the client why its connection ends, between two chunks.
pub(super) struct Downward<'a> {
    gate: &'a Gate,
    connection: &'a Arc<Connection>,
    passage: Passage,
}

impl<'a> Downward<'a> {
    pub(super) fn new(gate: &'a Gate, connection: &'a Arc<Connection>) -> Self {
        Self { gate, connection, passage: Passage::default() }
    }

    /// Ends when the server has hung up, when the client takes nothing any more, or as `stopped` says. Whether the
    /// client should be given time to read its last words.
    pub(super) async fn run(
        mut self,
        mut from: OwnedReadHalf,
        to: &mut OwnedWriteHalf,
        mut stopped: watch::Receiver<Option<Stop>>,
    ) -> bool {
        let (mut stop, mut boundary_by): (Option<Stop>, Option<Instant>) = (None, None);
        loop {
            if let Some(stop) = &stop
                && self.passage.is_between_chunks()
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
                read = from.read_buf(self.passage.room()) => if !matches!(read, Ok(1..)) {
                    return to.shutdown().await.is_ok();
                },
                () = sleep_until(boundary_by.unwrap_or_else(Instant::now)), if boundary_by.is_some() => return false,
            }
            if let Err(fault) = self.look().await {
                self.connection.stop(Stop::Told(fault));
            }
            if !self.passage.good().is_empty() {
                let written = timeout(self.gate.limits().stall, to.write_all(self.passage.good()));
                // Whoever reads nothing must not put off its end.
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
                self.passage.sent();
            }
        }
    }

    async fn look(&mut self) -> Result<(), Fault> {
        while let Some(header) = self.passage.next(self.gate.limits().chunk)? {
            match header.kind {
                Kind::Open => {
                    if !self.opened(header).await? {
                        return Ok(());
                    }
                }
                Kind::Error => {
                    self.gate.server_refused(self.connection);
                    self.passage.pass(header);
                }
                _ => self.passage.pass(header),
            }
        }
        Ok(())
    }

    /// The server has answered an OpenSecureChannel. False while the answer is not whole.
    async fn opened(&mut self, header: Header) -> Result<bool, Fault> {
        let Some(chunk) = self.passage.chunk(header) else { return Ok(false) };
        if let Some(channel) = channel_of(chunk) {
            self.gate.opened(self.connection, channel);
        }
        let chained = self.connection.state.lock().chained.clone();
        match chained {
            Some(client) => {
                let (own, chunk) = (self.gate.own().clone(), chunk.to_vec());
                let sealed = spawn_blocking(move || client.answer(&own, &chunk)).await;
                self.passage.replace(header, sealed.unwrap_or_else(|_| Err(Fault::internal()))?);
            }
            None => self.passage.pass(header),
        }
        Ok(true)
    }
}

/// Last words. Whether the client should be given time to read them.
pub(super) async fn say(to: &mut OwnedWriteHalf, stop: &Stop) -> bool {
    match stop {
        Stop::Told(fault) => {
            timeout(LAST_WORDS, to.write_all(&fault.to_message())).await.is_ok_and(|written| written.is_ok())
                && to.shutdown().await.is_ok()
        }
        Stop::AtOnce(fault) => {
            let _ = to.try_write(&fault.to_message());
            false
        }
    }
}

/// What a client that has to go may still read of the chunk it is being sent.
const REST_OF_A_CHUNK: Duration = Duration::from_millis(300);
const LAST_WORDS: Duration = Duration::from_secs(1);
