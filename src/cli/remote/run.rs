//! Sends requests and prints their answers.

use std::time::Duration;

use clap::Args;
use serde_json::Value;

use super::connection::{ConnectionArgs, Session};
use super::show;
use crate::cli::output::say;
use crate::cli::{CommandContext, CommandOutcome, runtime};
use crate::model::Problem;
use crate::platform::stop_signal::StopSignals;
use crate::remote::Request;
use crate::remote::client::{ControllerIdentity, RemoteError};
use crate::texts;

/// Whether a value is read once or followed.
#[derive(Debug, Clone, Args)]
pub struct WatchArgs {
    /// Read again every so many seconds, and print what changed, until Ctrl-C; 1 without a number. A connection that is
    /// lost is made again
    #[arg(long, value_name = "SECONDS", num_args = 0..=1, require_equals = true, default_missing_value = "1", value_parser = seconds)]
    watch: Option<f64>,
}

fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse::<f64>().ok().filter(|seconds| (0.05..=3600.0).contains(seconds));
    seconds.ok_or_else(|| "0.05–3600".to_owned())
}

/// Sends a request after it was confirmed, and prints the answer.
pub fn once(cli: &CommandContext, connection: &ConnectionArgs, request: &Request) -> Result<CommandOutcome, Problem> {
    let mut session = connection.session(cli)?;
    connection.confirm(cli, request)?;
    let runtime = runtime()?;
    let answer = runtime.block_on(async {
        session.connect().await?;
        session.client.request(request).await
    });
    runtime.shutdown_background();
    Ok(print(cli, connection, answer.map(|reply| show::reply(request, &reply, cli.output.language()))))
}

/// Logs in, and nothing else.
pub fn login_check(cli: &CommandContext, connection: &ConnectionArgs) -> Result<CommandOutcome, Problem> {
    let mut session = connection.session(cli)?;
    let runtime = runtime()?;
    let connected = runtime.block_on(session.connect());
    let shown = connected.map(|()| {
        let target = session.client.target().to_string();
        (serde_json::json!({ "target": target }), texts::remote_logged_in(cli.output.language(), &target))
    });
    runtime.shutdown_background();
    Ok(print(cli, connection, shown))
}

/// Prints what the controller says about itself.
pub fn identity(cli: &CommandContext, connection: &ConnectionArgs) -> Result<CommandOutcome, Problem> {
    let mut session = connection.session(cli)?;
    let runtime = runtime()?;
    let identity = runtime.block_on(async {
        session.connect().await?;
        ControllerIdentity::read(&mut session.client).await
    });
    runtime.shutdown_background();
    Ok(print(cli, connection, identity.map(|identity| show::identity(&identity, cli.output.language()))))
}

/// Reads once, or again and again.
pub fn read(
    cli: &CommandContext,
    connection: &ConnectionArgs,
    watch: &WatchArgs,
    request: &Request,
) -> Result<CommandOutcome, Problem> {
    let Some(interval) = watch.watch.map(Duration::from_secs_f64) else { return once(cli, connection, request) };
    let session = connection.session(cli)?;
    let runtime = runtime()?;
    let outcome = runtime.block_on(async {
        let mut stop = StopSignals::listen();
        tokio::select! {
            outcome = follow(cli, connection, session, request, interval) => outcome,
            () = stop.received() => CommandOutcome::AllDone,
        }
    });
    runtime.shutdown_background();
    Ok(outcome)
}

/// Prints each value that differs from the one before. Returns after an error that another try does not change.
async fn follow(
    cli: &CommandContext,
    connection: &ConnectionArgs,
    mut session: Session,
    request: &Request,
    interval: Duration,
) -> CommandOutcome {
    let mut last = None;
    let mut ticks = tokio::time::interval(interval);
    ticks.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
    loop {
        ticks.tick().await;
        let answer = match session.connect().await {
            Ok(()) => session.client.request(request).await,
            Err(error) => Err(error),
        };
        match answer {
            Ok(reply) => {
                if last.as_ref() != Some(&reply) {
                    print(cli, connection, Ok(show::reply(request, &reply, cli.output.language())));
                    last = Some(reply);
                }
            }
            Err(error) => {
                let problem = Problem::from(error.clone());
                if problem.code.is_lasting() {
                    return print(cli, connection, Err(error));
                }
                last = None;
                let language = cli.output.language();
                if cli.output.is_json() {
                    cli.output.failed(connection.name(), &problem);
                }
                say(&texts::remote_watch_goes_on(language, &problem.in_one_line(language)));
            }
        }
    }
}

fn print(
    cli: &CommandContext,
    connection: &ConnectionArgs,
    result: Result<(Value, String), RemoteError>,
) -> CommandOutcome {
    let unmet = match &result {
        Err(RemoteError::NotReady { unmet, .. }) => unmet.clone(),
        _ => Vec::new(),
    };
    let result = result.map_err(Problem::from);
    cli.output.cli("controller", connection.name(), &result);
    if !cli.output.is_json() {
        for condition in unmet {
            say(&format!("  - {condition}: {}", condition.unmet_text().text(cli.output.language())));
        }
    }
    if result.is_ok() { CommandOutcome::AllDone } else { CommandOutcome::SomeFailed }
}
