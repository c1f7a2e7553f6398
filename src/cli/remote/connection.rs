//! Where remote commands go, and the client that sends them.

use std::io::{IsTerminal as _, Write as _};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use clap::Args;
use secrecy::ExposeSecret as _;

use crate::cli::CommandContext;
use crate::cli::output::say;
use crate::cli::passwords::ask_secret;
use crate::cli::secret_file::read_secret;
use crate::model::{ErrorCode, Problem};
use crate::remote::client::{
    Direction, Observer, RemoteClient, RemoteError, RemoteTarget, RemoteTimeouts, TargetError,
};
use crate::remote::{Command, Password, RefusalCode, Request};
use crate::texts::TextKey;

/// The connection of a remote command.
#[derive(Debug, Clone, Args)]
pub struct ConnectionArgs {
    /// Where the controller is: tcp://HOST[:PORT] (remote Ethernet, port 5000 by default; ?terminator=crlf, cr or lf),
    /// raw-tcp://HOST:PORT (a serial device server), serial:DEVICE[?baud=9600&parity=none&stop=1&handshake=none], or the
    /// name of a controller in the list (remote Ethernet at its address)
    #[arg(long, value_name = "TARGET")]
    to: String,

    /// File with the password for remote commands, "-" for standard input [default: no password; on a terminal it is asked
    /// for if the controller wants one]
    #[arg(long, value_name = "FILE", env = "OPCUA_CONFIGURATOR_REMOTE_PASSWORD_FILE", hide_env_values = true)]
    remote_password_file: Option<PathBuf>,

    /// Longest wait for an answer, in seconds; for exec and home, which answer when the robot has arrived, at least 120
    #[arg(long, value_name = "SECONDS", default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=3600))]
    timeout: u64,

    /// Show everything that goes over the line on standard error, as text and in hexadecimal
    #[arg(long)]
    trace: bool,
}

/// A client with what is needed to ask for a password.
pub struct Session {
    pub client: RemoteClient,
    make: Box<dyn Fn(Password) -> RemoteClient>,
    /// On a terminal, and no file was given.
    question: Option<&'static str>,
}

impl ConnectionArgs {
    /// As it was given, for messages.
    pub fn name(&self) -> &str {
        &self.to
    }

    /// A client that has not connected yet. Reads the list of controllers and the password.
    ///
    /// Errors: [`ErrorCode::BadRemoteTarget`], [`ErrorCode::RemoteWrongPassword`] for a password that no controller can
    /// have, and those of files that cannot be read.
    pub fn session(&self, cli: &CommandContext) -> Result<Session, Problem> {
        let target = self.target(cli)?;
        let password = match &self.remote_password_file {
            None => Password::default(),
            Some(file) => password(read_secret(file)?.expose_secret())?,
        };
        let asks = self.remote_password_file.is_none() && std::io::stdin().is_terminal();
        let question = asks.then(|| TextKey::RemoteAskPassword.text(cli.output.language()));
        let timeouts = self.timeouts();
        let trace = self.trace;
        let make = move |password| {
            let client = RemoteClient::new(target.clone(), password, timeouts);
            if trace { client.observed_by(tracer()) } else { client }
        };
        Ok(Session { client: make(password), make: Box::new(make), question })
    }

    fn target(&self, cli: &CommandContext) -> Result<RemoteTarget, Problem> {
        match self.to.parse::<RemoteTarget>() {
            Err(TargetError::Scheme(name)) => match cli.configuration()?.find(&name) {
                Some(entry) => Ok(RemoteTarget::ethernet(entry.address.host())?),
                None => Err(TargetError::Scheme(name).into()),
            },
            other => Ok(other?),
        }
    }

    fn timeouts(&self) -> RemoteTimeouts {
        let default = RemoteTimeouts::default();
        let answer = Duration::from_secs(self.timeout);
        RemoteTimeouts { connect: default.connect.min(answer), answer, motion: default.motion.max(answer) }
    }

    /// Asks before something is sent that acts. `more`: what is known about it besides.
    ///
    /// Errors: [`ErrorCode::NotConfirmed`] without a terminal and without `--yes`, [`ErrorCode::Cancelled`].
    pub fn confirm(&self, cli: &CommandContext, request: &Request) -> Result<(), Problem> {
        let Some(consequence) = request.command().consequence() else { return Ok(()) };
        if cli.yes {
            return Ok(());
        }
        if !std::io::stdin().is_terminal() {
            return Err(ErrorCode::NotConfirmed.into());
        }
        let language = cli.output.language();
        say(&crate::texts::cli::changes(language, &[self.name()]));
        say(&format!("  - {}", consequence.text(language)));
        eprint!("{} ", TextKey::CliGoOn.text(language));
        let mut answer = String::new();
        let read = std::io::stderr().flush().and_then(|()| std::io::stdin().read_line(&mut answer));
        match (read, answer.trim()) {
            (Ok(_), "y" | "Y" | "yes") => Ok(()),
            _ => Err(ErrorCode::Cancelled.into()),
        }
    }
}

impl Session {
    /// Connects and logs in. Asks for the password on a terminal if the controller wants one.
    ///
    /// Errors: those of [`RemoteClient::connect`]; a password that was typed and is none counts as wrong.
    pub async fn connect(&mut self) -> Result<(), RemoteError> {
        let error = match self.client.connect().await {
            Err(error) if wants_password(&error) => error,
            other => return other,
        };
        let Some(question) = self.question.take() else { return Err(error) };
        let Ok(Some(typed)) = ask_secret(question) else { return Err(error) };
        let Some(password) = Password::new(typed.expose_secret()) else { return Err(error) };
        self.client = (self.make)(password);
        self.client.connect().await
    }
}

const fn wants_password(error: &RemoteError) -> bool {
    matches!(
        error,
        RemoteError::Refused {
            command: Command::Login,
            code: RefusalCode::WrongPassword | RefusalCode::PasswordRequired
        }
    )
}

fn password(text: &str) -> Result<Password, Problem> {
    Password::new(text).ok_or(Problem::new(ErrorCode::RemoteWrongPassword))
}

/// Prints everything that goes over the line on standard error.
fn tracer() -> Observer {
    Arc::new(|observed| {
        let arrow = match observed.direction {
            Direction::Sent => ">",
            Direction::Received => "<",
        };
        say(&format!("{arrow} {}\n  {}", observed.text(), observed.hex()));
    })
}
