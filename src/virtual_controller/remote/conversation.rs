use tokio::time::Instant;
use zeroize::Zeroizing;

use super::request_handler::{Outcome, RequestHandler};
use super::wire::{Incoming, Origin, Wire};
use crate::remote::{Answer, Command, Password, RefusalCode, Reply, Request};

/// One client and its session: what it has sent, whether it has logged in, and until when it has to speak. It does no I/O
/// and reads no clock.
#[derive(Debug)]
pub(super) struct Conversation {
    handler: RequestHandler,
    wire: Wire,
    /// The controller is reached at an address of the internet.
    is_global: bool,
    access: Access,
    /// When the present access ends; `None` for never.
    until: Option<Instant>,
    last_byte: Instant,
    /// Bytes since the last whole request.
    unread: usize,
    wrong_passwords: u32,
    executing: Option<Executing>,
    is_over: bool,
}

/// What the client may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Access {
    /// Nothing before it opens the remote function.
    Closed,
    /// To log in.
    Opened,
    /// Everything that the role allows.
    LoggedIn,
}

/// An Execute that has no answer yet.
#[derive(Debug)]
struct Executing {
    number: u64,
    origin: Origin,
    request: Request,
    ask_at: Instant,
}

/// An answer that is to be sent.
#[derive(Debug)]
pub(super) struct Outgoing {
    origin: Origin,
    request: Option<Request>,
    answer: Answer,
}

impl Outgoing {
    /// Whether something was changed that outlives a power-off, so that it has to be kept before the answer is sent.
    pub fn has_to_be_kept(&self) -> bool {
        let command = self.request.as_ref().map(Request::command);
        let keeps = matches!(command, Some(Command::SetVariable | Command::ResetAlm | Command::Execute));
        keeps && matches!(self.answer, Answer::Good(_))
    }

    /// What was changed could not be kept.
    pub fn could_not_be_kept(&mut self) {
        self.answer = Answer::Refused(RefusalCode::SystemError);
    }
}

/// Bytes without a whole request, after which a client is not listened to any more. The longest request has 1024.
const MAX_UNREAD: usize = 64 * 1024;

/// Wrong passwords after which a client is not listened to any more.
const MAX_WRONG_PASSWORDS: u32 = 10;

impl Conversation {
    pub fn new(handler: RequestHandler, wire: Wire, is_global: bool, now: Instant) -> Self {
        let access = if wire.has_to_be_opened() { Access::Closed } else { Access::Opened };
        let mut conversation = Self {
            handler,
            wire,
            is_global,
            access,
            until: None,
            last_byte: now,
            unread: 0,
            wrong_passwords: 0,
            executing: None,
            is_over: false,
        };
        conversation.give(access, now);
        conversation
    }

    /// Bytes came.
    pub fn receive(&mut self, bytes: &[u8], now: Instant) -> Vec<Outgoing> {
        self.last_byte = now;
        self.unread = match self.wire.last_end(bytes) {
            Some(end) => bytes.len() - end - 1,
            None => self.unread + bytes.len(),
        };
        self.wire.add(bytes);
        let mut outgoing = self.take_in(false, now);
        // What came may have ended it.
        outgoing.extend(self.ask_execution(now));
        if self.unread > MAX_UNREAD {
            outgoing.extend(self.end(RefusalCode::BadFormat));
        }
        outgoing
    }

    /// The moment of [`Conversation::wakes_at`] has come.
    pub fn wake(&mut self, now: Instant) -> Vec<Outgoing> {
        let mut outgoing = Vec::new();
        if self.wire.silence().is_some_and(|silence| self.last_byte + silence <= now) {
            outgoing.extend(self.take_in(true, now));
        }
        outgoing.extend(self.ask_execution(now));
        if self.until.is_some_and(|until| until <= now) && self.executing.is_none() {
            outgoing.extend(self.time_out());
        }
        outgoing
    }

    /// When something is to be done although nothing comes; `None` for never.
    pub fn wakes_at(&self) -> Option<Instant> {
        let silence = self.wire.silence().map(|silence| self.last_byte + silence);
        let execution = self.executing.as_ref().map(|executing| executing.ask_at);
        // A client that waits for the end of an Execute is not late.
        let until = self.until.filter(|_| self.executing.is_none());
        [silence, execution, until].into_iter().flatten().min()
    }

    /// The client is gone. What Execute still runs for it ends.
    pub fn hang_up(&mut self) {
        if let Some(executing) = self.executing.take() {
            self.handler.abandon(executing.number);
        }
    }

    /// Whether the connection is to be closed, after what is to be sent.
    pub const fn is_over(&self) -> bool {
        self.is_over
    }

    /// The bytes of an answer, to be sent in one write.
    pub fn encode(&self, outgoing: &Outgoing) -> Zeroizing<Vec<u8>> {
        self.wire.encode(&outgoing.origin, outgoing.request.as_ref(), &outgoing.answer)
    }

    fn take_in(&mut self, silent: bool, now: Instant) -> Vec<Outgoing> {
        let mut outgoing = Vec::new();
        while !self.is_over
            && let Some(incoming) = self.wire.next(silent)
        {
            if self.wire.has_to_be_opened() {
                self.unread = 0;
            }
            match incoming {
                Incoming::Open => self.open(now),
                Incoming::Request { origin, request } => outgoing.extend(self.answer(origin, request, now)),
            }
        }
        outgoing
    }

    /// Opens the remote function. A client that has logged in begins anew.
    fn open(&mut self, now: Instant) {
        match self.access {
            // The login window has begun with the connection.
            Access::Closed => self.access = Access::Opened,
            Access::Opened => {}
            Access::LoggedIn => {
                self.hang_up();
                self.give(Access::Opened, now);
            }
        }
    }

    fn answer(&mut self, origin: Origin, request: Result<Request, RefusalCode>, now: Instant) -> Option<Outgoing> {
        self.renew(now);
        let request = match request {
            Ok(request) => request,
            Err(code) => return Some(Outgoing { origin, request: None, answer: Answer::Refused(code) }),
        };
        let answer = match &request {
            Request::Login { password } if self.access != Access::Closed => match self.log_in(password) {
                Ok(()) => {
                    self.give(Access::LoggedIn, now);
                    Answer::Good(Reply::Done)
                }
                Err(code) => Answer::Refused(code),
            },
            _ if self.access != Access::LoggedIn => Answer::Refused(RefusalCode::UnknownCommand),
            Request::Logout if self.executing.is_some() => Answer::Refused(RefusalCode::ExecuteRunning),
            Request::Logout if self.handler.may_log_out() => {
                self.give(Access::Opened, now);
                Answer::Good(Reply::Done)
            }
            Request::Logout => Answer::Refused(RefusalCode::NotReady),
            _ => match self.handler.act(&request) {
                Outcome::Answer(answer) => answer,
                Outcome::Executing(number) => {
                    let ask_at = now + self.handler.ask_again(number);
                    self.executing = Some(Executing { number, origin, request, ask_at });
                    return None;
                }
            },
        };
        Some(Outgoing { origin, request: Some(request), answer })
    }

    fn log_in(&mut self, password: &Password) -> Result<(), RefusalCode> {
        if self.is_global && self.handler.options().password.expose().is_empty() {
            return Err(RefusalCode::PasswordRequired);
        }
        if self.handler.is_password(password) {
            self.wrong_passwords = 0;
            return Ok(());
        }
        self.wrong_passwords += 1;
        self.is_over = self.wrong_passwords >= MAX_WRONG_PASSWORDS;
        Err(RefusalCode::WrongPassword)
    }

    /// The answer of an Execute that has ended.
    fn ask_execution(&mut self, now: Instant) -> Option<Outgoing> {
        let executing = self.executing.take()?;
        let Some(answer) = self.handler.execution(executing.number) else {
            let ask_at = now + self.handler.ask_again(executing.number);
            self.executing = Some(Executing { ask_at, ..executing });
            return None;
        };
        self.renew(now);
        Some(Outgoing { origin: executing.origin, request: Some(executing.request), answer })
    }

    fn give(&mut self, access: Access, now: Instant) {
        self.access = access;
        let options = self.handler.options();
        let allowed = match access {
            Access::Closed | Access::Opened => Some(options.login_window),
            Access::LoggedIn => Some(options.time_out).filter(|time_out| !time_out.is_zero()),
        };
        self.until = allowed.map(|allowed| now + allowed);
    }

    /// A command of a client that has logged in begins its time-out anew; no command makes the login window longer.
    fn renew(&mut self, now: Instant) {
        if self.access == Access::LoggedIn {
            self.give(Access::LoggedIn, now);
        }
    }

    /// The time is over: a request that was begun is refused, and the session ends.
    fn time_out(&mut self) -> Option<Outgoing> {
        let begun = self.unread > 0;
        self.end(RefusalCode::TimedOut).filter(|_| begun)
    }

    /// Nothing more is read from this client.
    fn end(&mut self, code: RefusalCode) -> Option<Outgoing> {
        self.is_over = true;
        self.unread = 0;
        let origin = self.wire.anonymous();
        Some(Outgoing { origin, request: None, answer: Answer::Refused(code) })
    }
}
