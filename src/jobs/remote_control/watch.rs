use std::convert::Infallible;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use tokio::sync::mpsc::{UnboundedReceiver, unbounded_channel};
use tokio::time::{Instant, interval_at, sleep, sleep_until};
use tokio_util::sync::CancellationToken;

use super::request::{RemoteConnection, RemoteControlEvent, RemoteControlRequest};
use super::tap::ExchangeTap;
use crate::model::{Cause, Problem};
use crate::remote::client::{ControllerIdentity, Interjections, RemoteClient, RemoteError, RemoteTimeouts};
use crate::remote::{Answer, Command, ErrorNumber, RefusalCode, Reply, Request, SpelCommand};

/// From the beginning of one cycle to that of the next; longer if the line is slow.
const POLL_PERIOD: Duration = Duration::from_millis(500);

/// Watches one controller over one connection until it is cancelled: reports its state and the values that are asked for,
/// and does commands, one after the other.
///
/// A lost connection is opened again, after pauses from 0.5 to 30 s. An error that would be the same at the next try, such
/// as a wrong password, ends the watch with [`RemoteControlEvent::Ended`]. When it is cancelled, a command that acts and
/// was sent is waited for, at most as long as [`RemoteTimeouts`] says; everything else is dropped.
pub async fn control_remotely(
    connection: RemoteConnection,
    requests: UnboundedReceiver<RemoteControlRequest>,
    cancel: CancellationToken,
    on_event: impl Fn(RemoteControlEvent) + Send + Sync,
) {
    let mut watch = Watch::new(connection, requests, cancel, &on_event);
    loop {
        let stopped = match watch.connect().await {
            Ok(()) => match watch.serve().await {
                Ok(never) => match never {},
                Err(stopped) => stopped,
            },
            Err(Stopped::Lost(error)) => {
                let problem = Problem::from(error);
                watch.tell_exchanges();
                if problem.code.is_lasting() {
                    return on_event(RemoteControlEvent::Ended(problem));
                }
                on_event(RemoteControlEvent::Lost(problem));
                continue;
            }
            Err(stopped) => stopped,
        };
        watch.tell_exchanges();
        match stopped {
            Stopped::Cancelled => return,
            Stopped::Lost(error) => on_event(RemoteControlEvent::Lost(error.into())),
        }
    }
}

/// Why a watch goes no further.
enum Stopped {
    Cancelled,
    Lost(RemoteError),
}

struct Watch<'a, F> {
    connection: RemoteConnection,
    client: RemoteClient,
    tap: ExchangeTap,
    requests: UnboundedReceiver<RemoteControlRequest>,
    cancel: CancellationToken,
    /// Sent in each cycle.
    shown: Vec<Request>,
    /// The next cycle begins at once.
    is_due: bool,
    /// The error whose text was asked for last, and the text.
    message: (u16, Option<String>),
    on_event: &'a F,
}

impl<'a, F: Fn(RemoteControlEvent) + Send + Sync> Watch<'a, F> {
    fn new(
        connection: RemoteConnection,
        requests: UnboundedReceiver<RemoteControlRequest>,
        cancel: CancellationToken,
        on_event: &'a F,
    ) -> Self {
        let tap = ExchangeTap::default();
        let client = client(&connection, &tap);
        Self {
            connection,
            client,
            tap,
            requests,
            cancel,
            shown: Vec::new(),
            is_due: false,
            message: (0, None),
            on_event,
        }
    }

    fn tell(&self, event: RemoteControlEvent) {
        (self.on_event)(event);
    }

    fn tell_exchanges(&self) {
        tell_exchanges(&self.tap, self.on_event);
    }

    /// Connects; after a failure it waits first. Commands that are asked for meanwhile are refused: nobody expects a robot
    /// to move when the network is back.
    async fn connect(&mut self) -> Result<(), Stopped> {
        {
            let connecting = self.client.connect();
            tokio::pin!(connecting);
            loop {
                tokio::select! {
                    biased;
                    () = self.cancel.cancelled() => return Err(Stopped::Cancelled),
                    // Before the connection is there: what was asked for until then is refused.
                    Some(request) = self.requests.recv() => match request {
                        RemoteControlRequest::Show(reads) => self.shown = reads,
                        RemoteControlRequest::Do(request) => (self.on_event)(refused_without_connection(request)),
                    },
                    connected = &mut connecting => break connected.map_err(Stopped::Lost)?,
                }
            }
        }
        self.tell(RemoteControlEvent::Connected);
        Ok(())
    }

    /// Polls and does commands until the connection ends.
    async fn serve(&mut self) -> Result<Infallible, Stopped> {
        self.message = (0, None);
        let mut knows_identity = false;
        loop {
            let next = Instant::now() + POLL_PERIOD;
            self.is_due = false;
            self.read_status().await?;
            if !knows_identity {
                knows_identity = true;
                self.read_identity().await?;
            }
            self.read_values().await?;
            self.tell_exchanges();
            while !self.is_due {
                tokio::select! {
                    biased;
                    () = self.cancel.cancelled() => return Err(Stopped::Cancelled),
                    Some(request) = self.requests.recv() => self.take(request).await?,
                    () = sleep_until(next) => break,
                }
            }
        }
    }

    async fn read_status(&mut self) -> Result<(), Stopped> {
        let status = match self.read(&Request::GetStatus).await? {
            Ok(Reply::Status(status)) => status,
            // A serial line stays open when the controller ends the session.
            Err(error @ RemoteError::Refused { code: RefusalCode::UnknownCommand, .. }) => {
                self.client = client(&self.connection, &self.tap);
                self.pause().await?;
                return Err(Stopped::Lost(error));
            }
            Ok(_) | Err(_) => return Ok(()),
        };
        if status.code != self.message.0 {
            self.message = (status.code, self.read_message(status.code).await?);
        }
        self.tell(RemoteControlEvent::Status { status, message: self.message.1.clone() });
        Ok(())
    }

    /// The text of an error or warning; `None` where the firmware does not know it.
    async fn read_message(&mut self, code: u16) -> Result<Option<String>, Stopped> {
        let Some(code) = ErrorNumber::new(code).filter(|code| code.get() > 0) else { return Ok(None) };
        let language = self.connection.language;
        Ok(match self.read(&Request::GetErrMsg { code, language }).await? {
            Ok(Reply::Text(text)) => Some(text.trim().to_owned()).filter(|text| !text.is_empty()),
            _ => None,
        })
    }

    async fn read_identity(&mut self) -> Result<(), Stopped> {
        let reading = ControllerIdentity::read(&mut self.client);
        let identity = tokio::select! {
            biased;
            () = self.cancel.cancelled() => return Err(Stopped::Cancelled),
            identity = reading => identity,
        };
        if let Ok(identity) = self.still_connected(identity)? {
            self.tell(RemoteControlEvent::Identity(Box::new(identity)));
        }
        Ok(())
    }

    /// Commands do not wait until all values are read.
    async fn read_values(&mut self) -> Result<(), Stopped> {
        let mut values = Vec::new();
        for request in self.shown.clone() {
            let value = self.read(&request).await?;
            values.push((request, value));
            while let Ok(request) = self.requests.try_recv() {
                self.take(request).await?;
            }
            if self.is_due {
                // What was asked for is older than the command that was done, or not wanted any more.
                return Ok(());
            }
        }
        if !values.is_empty() {
            self.tell(RemoteControlEvent::Values(values));
        }
        Ok(())
    }

    /// Sends a command that only reads.
    async fn read(&mut self, request: &Request) -> Result<Result<Reply, RemoteError>, Stopped> {
        let answer = tokio::select! {
            biased;
            () = self.cancel.cancelled() => return Err(Stopped::Cancelled),
            answer = self.client.request(request) => answer,
        };
        self.still_connected(answer)
    }

    fn still_connected<T>(&self, result: Result<T, RemoteError>) -> Result<Result<T, RemoteError>, Stopped> {
        match result {
            Err(error) if !self.client.is_connected() => Err(Stopped::Lost(error)),
            other => Ok(other),
        }
    }

    async fn take(&mut self, request: RemoteControlRequest) -> Result<(), Stopped> {
        self.is_due = true;
        match request {
            RemoteControlRequest::Show(reads) => self.shown = reads,
            RemoteControlRequest::Do(request) => self.act(request).await?,
        }
        Ok(())
    }

    /// Does a command, to its end also if the watch is cancelled meanwhile.
    async fn act(&mut self, request: Request) -> Result<(), Stopped> {
        self.tell_exchanges();
        self.tap.set_asked(true);
        let result = match &request {
            Request::Execute { spel } => self.execute(spel.clone()).await,
            request => self.client.request(request).await,
        };
        self.tap.set_asked(false);
        self.tell_exchanges();
        self.tell(RemoteControlEvent::Done { request, result: result.clone() });
        match self.still_connected(result) {
            Err(Stopped::Lost(RemoteError::OutcomeUnknown { cause, .. })) => Err(Stopped::Lost(*cause)),
            Err(stopped) => Err(stopped),
            Ok(_) => Ok(()),
        }
    }

    /// Executes a command of SPEL+. Until it has ended, the state is read on, and commands are done that the controller
    /// accepts meanwhile: Abort, and setting I/O.
    async fn execute(&mut self, spel: SpelCommand) -> Result<Reply, RemoteError> {
        let (sender, mut interjected) = unbounded_channel();
        let (on_event, tap, shown) = (self.on_event, self.tap.clone(), &mut self.shown);
        let (code, text) = self.message.clone();
        let is_reading = AtomicBool::new(false);
        let mut answered = |request: Request, answer: Answer| match (request, answer) {
            (Request::GetStatus, answer) => {
                is_reading.store(false, Ordering::Relaxed);
                if let Answer::Good(Reply::Status(status)) = answer {
                    let message = text.clone().filter(|_| status.code == code);
                    on_event(RemoteControlEvent::Status { status, message });
                }
            }
            (request, answer) => {
                let result = interjected_result(request.command(), answer);
                on_event(RemoteControlEvent::Done { request, result });
            }
        };
        let interjections = Interjections { requests: &mut interjected, answered: &mut answered };
        let executing = self.client.execute(spel, interjections);
        tokio::pin!(executing);
        let mut ticks = interval_at(Instant::now() + POLL_PERIOD, POLL_PERIOD);
        loop {
            let interject = tokio::select! {
                biased;
                result = &mut executing => return result,
                Some(request) = self.requests.recv() => match request {
                    RemoteControlRequest::Show(reads) => {
                        *shown = reads;
                        continue;
                    }
                    RemoteControlRequest::Do(request) => request,
                },
                _ = ticks.tick() => {
                    tell_exchanges(&tap, on_event);
                    if is_reading.swap(true, Ordering::Relaxed) {
                        continue;
                    }
                    Request::GetStatus
                }
            };
            let command = interject.command();
            if command.is_accepted_during_execute() {
                // Fails only when the answer has come, which the next turn returns.
                let _ended = sender.send(interject);
            } else {
                let result = Err(RemoteError::Refused { command, code: RefusalCode::ExecuteRunning });
                on_event(RemoteControlEvent::Done { request: interject, result });
            }
        }
    }

    async fn pause(&mut self) -> Result<(), Stopped> {
        tokio::select! {
            () = self.cancel.cancelled() => Err(Stopped::Cancelled),
            () = sleep(POLL_PERIOD) => Ok(()),
        }
    }
}

fn tell_exchanges(tap: &ExchangeTap, on_event: &impl Fn(RemoteControlEvent)) {
    let exchanges = tap.take();
    if !exchanges.is_empty() {
        on_event(RemoteControlEvent::Exchanged(exchanges));
    }
}

/// Why a command was refused during an Execute is not asked: its state is not what the conditions are about.
fn interjected_result(command: Command, answer: Answer) -> Result<Reply, RemoteError> {
    match answer {
        Answer::Good(reply) => Ok(reply),
        Answer::Refused(RefusalCode::NotReady) => {
            Err(RemoteError::NotReady { command, unmet: Vec::new(), status: None })
        }
        Answer::Refused(code) => Err(RemoteError::Refused { command, code }),
    }
}

fn client(connection: &RemoteConnection, tap: &ExchangeTap) -> RemoteClient {
    let RemoteConnection { target, password, .. } = connection.clone();
    RemoteClient::new(target, password, RemoteTimeouts::default()).observed_by(tap.observer())
}

fn refused_without_connection(request: Request) -> RemoteControlEvent {
    let command: Command = request.command();
    let cause = Cause::finding("there was no connection");
    RemoteControlEvent::Done { request, result: Err(RemoteError::ConnectionLost { command, cause }) }
}
