use std::fmt;
use std::time::Duration;

use super::backoff::Backoff;
use super::error::RemoteError;
use super::exchange::{ExchangeError, Form, Interjections, exchange, execute, send_open, wait_for_silence};
use super::link::{Link, open};
use super::observer::Observer;
use super::target::RemoteTarget;
use crate::model::Cause;
use crate::remote::codec::{Answer, Command, Effect, Password, RefusalCode, Reply, Request, SpelCommand};

/// How long a client waits. No call takes longer than these together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RemoteTimeouts {
    /// For the connection; 5 s by default.
    pub connect: Duration,
    /// For the answer to a command; 10 s by default.
    pub answer: Duration,
    /// For the answer to Execute and Home, which come when the robot has arrived; 120 s by default.
    pub motion: Duration,
}

impl Default for RemoteTimeouts {
    fn default() -> Self {
        Self { connect: Duration::from_secs(5), answer: Duration::from_secs(10), motion: Duration::from_secs(120) }
    }
}

impl RemoteTimeouts {
    const fn of(&self, command: Command) -> Duration {
        match command {
            Command::Execute | Command::Home => self.motion,
            _ => self.answer,
        }
    }
}

/// Speaks to one controller, one command at a time: connects and logs in when that is needed, and again after the
/// connection was lost.
///
/// A reading command whose answer was damaged on a serial line is sent once more. A command that acts is never sent again:
/// if its answer is lost or damaged, the error is [`RemoteError::OutcomeUnknown`].
///
/// It never sends Logout: a controller reports an error if that happens while tasks run. The session ends with the
/// connection, or with the time-out that is set in the controller.
pub struct RemoteClient {
    target: RemoteTarget,
    password: Password,
    timeouts: RemoteTimeouts,
    observer: Option<Observer>,
    /// Logged in, and no answer is outstanding.
    link: Option<Box<dyn Link>>,
    backoff: Backoff,
}

impl fmt::Debug for RemoteClient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let connected = self.link.is_some();
        f.debug_struct("RemoteClient").field("target", &self.target).field("connected", &connected).finish()
    }
}

impl RemoteClient {
    /// Connects with the first command.
    pub fn new(target: RemoteTarget, password: Password, timeouts: RemoteTimeouts) -> Self {
        Self { target, password, timeouts, observer: None, link: None, backoff: Backoff::default() }
    }

    /// Tells `observer` of everything that goes over the line from now on.
    #[must_use]
    pub fn observed_by(mut self, observer: Observer) -> Self {
        self.observer = Some(observer);
        self
    }

    /// Where the commands go.
    pub const fn target(&self) -> &RemoteTarget {
        &self.target
    }

    /// Whether it is connected and logged in, as far as is known without sending anything.
    pub const fn is_connected(&self) -> bool {
        self.link.is_some()
    }

    /// Connects and logs in, unless that is done. After a failure it waits first: half a second, then longer each time, at
    /// most 30 s. Cancel safe: a connection that is being made is dropped.
    ///
    /// Errors: [`RemoteError::Unreachable`], [`RemoteError::ConnectTimeout`], [`RemoteError::SerialPort`], and those of the
    /// login.
    pub async fn connect(&mut self) -> Result<(), RemoteError> {
        if self.link.is_some() {
            return Ok(());
        }
        self.backoff.wait().await;
        // Counts also if this future is dropped.
        self.backoff.failed();
        let mut link = open(&self.target, self.timeouts.connect).await?;
        self.log_in(link.as_mut()).await?;
        self.backoff.succeeded();
        self.link = Some(link);
        Ok(())
    }

    async fn log_in(&mut self, link: &mut dyn Link) -> Result<(), RemoteError> {
        let login = Request::Login { password: self.password.clone() };
        let limit = self.timeouts.answer;
        if self.form() == Form::Frames {
            send_open(link, limit).await.map_err(|error| failure(Command::Login, limit, error))?;
        }
        // A login that is damaged on the line may be repeated: it does nothing else.
        let mut answer = self.exchange(link, &login).await;
        if self.is_damaged(&answer) {
            wait_for_silence(link, limit).await;
            answer = self.exchange(link, &login).await;
        }
        match answer.map_err(|error| failure(Command::Login, limit, error))? {
            Answer::Good(_) => Ok(()),
            Answer::Refused(code) => Err(RemoteError::Refused { command: Command::Login, code }),
        }
    }

    /// Sends a command and gives its answer. Connects first where that is needed.
    ///
    /// Takes at most the back-off, the time to connect and log in, and twice the time for the answer; three times if the
    /// command is refused with code 20, when the state is read to say why. If the future is dropped before it is ready, the
    /// connection is closed, and an acting command may have been done.
    ///
    /// Errors: those of [`RemoteClient::connect`], and every other [`RemoteError`].
    pub async fn request(&mut self, request: &Request) -> Result<Reply, RemoteError> {
        let answer = self.answer(request).await?;
        self.reply(request.command(), answer).await
    }

    /// As [`RemoteClient::request`] for Execute. Until its answer comes, commands can be interjected that the controller
    /// accepts meanwhile. If nothing could be sent because the controller had closed the connection, it is not tried again.
    pub async fn execute(&mut self, spel: SpelCommand, interjections: Interjections<'_>) -> Result<Reply, RemoteError> {
        let (command, request) = (Command::Execute, Request::Execute { spel });
        let limits = (self.timeouts.motion, self.timeouts.answer);
        self.connect().await?;
        let answer = match self.link.take() {
            Some(mut link) => {
                let (form, observer) = (self.form(), self.observer.as_ref());
                let answer = execute(link.as_mut(), form, &request, limits, observer, interjections).await;
                self.settle(link, command, limits.0, answer)?
            }
            None => self.lost(command)?,
        };
        self.reply(command, answer).await
    }

    async fn reply(&mut self, command: Command, answer: Answer) -> Result<Reply, RemoteError> {
        match answer {
            Answer::Good(reply) => Ok(reply),
            Answer::Refused(RefusalCode::NotReady) => Err(self.not_ready(command).await),
            Answer::Refused(code) => Err(RemoteError::Refused { command, code }),
        }
    }

    async fn answer(&mut self, request: &Request) -> Result<Answer, RemoteError> {
        let command = request.command();
        let limit = self.timeouts.of(command);
        self.connect().await?;
        // Taken out while an answer is outstanding: an answer that comes too late must not be taken for the next one.
        let Some(mut link) = self.link.take() else { return self.lost(command) };
        let mut answer = self.exchange(link.as_mut(), request).await;
        if matches!(answer, Err(ExchangeError::Stale)) {
            // Nothing was sent.
            self.connect().await?;
            let Some(again) = self.link.take() else { return self.lost(command) };
            link = again;
            answer = self.exchange(link.as_mut(), request).await;
        }
        if command.effect() == Effect::Reads && self.is_damaged(&answer) {
            wait_for_silence(link.as_mut(), limit).await;
            answer = self.exchange(link.as_mut(), request).await;
        }
        self.settle(link, command, limit, answer)
    }

    /// Keeps the link for the next request, unless an answer to this one may come yet.
    fn settle(
        &mut self,
        link: Box<dyn Link>,
        command: Command,
        limit: Duration,
        answer: Result<Answer, ExchangeError>,
    ) -> Result<Answer, RemoteError> {
        match answer {
            Ok(answer) => {
                self.link = Some(link);
                Ok(answer)
            }
            Err(error @ ExchangeError::NotSent(_)) => {
                self.link = Some(link);
                Err(failure(command, limit, error))
            }
            Err(error @ ExchangeError::Stale) => Err(failure(command, limit, error)),
            Err(error) if command.effect() == Effect::Reads => Err(failure(command, limit, error)),
            Err(error) => {
                let cause = Box::new(failure(command, limit, error));
                Err(RemoteError::OutcomeUnknown { command, cause })
            }
        }
    }

    fn lost(&self, command: Command) -> Result<Answer, RemoteError> {
        Err(RemoteError::ConnectionLost { command, cause: Cause::finding("there is no connection") })
    }

    /// Which condition was not met, by the state right after the refusal.
    async fn not_ready(&mut self, command: Command) -> RemoteError {
        let status = match self.answer(&Request::GetStatus).await {
            Ok(Answer::Good(Reply::Status(status))) => Some(status),
            _ => None,
        };
        let unmet = status.map(|status| command.unmet(status.flags).collect()).unwrap_or_default();
        RemoteError::NotReady { command, unmet, status }
    }

    const fn form(&self) -> Form {
        Form::of(&self.target)
    }

    /// Whether the line damaged the request or its answer. TCP damages nothing: what cannot be read there is meant so.
    fn is_damaged(&self, answer: &Result<Answer, ExchangeError>) -> bool {
        self.form() == Form::Frames
            && matches!(answer, Ok(Answer::Refused(RefusalCode::BadChecksum)) | Err(ExchangeError::Bad(_)))
    }

    async fn exchange(&mut self, link: &mut dyn Link, request: &Request) -> Result<Answer, ExchangeError> {
        let limit = self.timeouts.of(request.command());
        exchange(link, self.form(), request, limit, self.observer.as_ref()).await
    }
}

fn failure(command: Command, after: Duration, error: ExchangeError) -> RemoteError {
    match error {
        ExchangeError::NotSent(error) => RemoteError::NotSent { command, error },
        ExchangeError::Stale => {
            RemoteError::ConnectionLost { command, cause: Cause::finding("the controller closed the connection") }
        }
        ExchangeError::Lost(error) => RemoteError::ConnectionLost { command, cause: Cause::new(error) },
        ExchangeError::Silent => RemoteError::NoAnswer { command, after },
        ExchangeError::Bad(error) => RemoteError::BadAnswer { command, error },
    }
}
