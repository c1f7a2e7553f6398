use std::time::Duration;

use chrono::Local;
use clap::Args;
use serde_json::json;
use tokio::time::MissedTickBehavior;

use super::super::output::{line, say};
use super::super::{CommandContext, CommandOutcome, runtime};
use super::read::{ReadArgs, print_read_failure};
use super::{as_json, as_text};
use crate::fins::bridge::robot::{ReadError, read_values};
use crate::fins::client::ClientError;
use crate::fins::data_type::Value;
use crate::model::{ErrorCode, Problem, clock};
use crate::platform::stop_signal::StopSignals;
use crate::texts;

#[derive(Debug, Args)]
pub struct WatchArgs {
    #[command(flatten)]
    read: ReadArgs,

    /// From one reading to the next
    #[arg(long, value_name = "MILLISECONDS", default_value_t = 500, value_parser = clap::value_parser!(u64).range(10..=3_600_000))]
    interval: u64,
}

/// What was printed last.
enum Shown {
    Nothing,
    Values(Vec<Value>),
    Failure(ErrorCode),
}

/// Prints values when they change, and an error when it begins. The client connects again by itself.
pub fn run(cli: &CommandContext, args: &WatchArgs) -> Result<CommandOutcome, Problem> {
    let (range, form) = args.read.range()?;
    let (mut client, plc) = args.read.target().client()?;
    let output = cli.output;
    runtime()?.block_on(async {
        let mut stop = StopSignals::listen();
        if !output.is_json() {
            say(&texts::plc_watched(output.language(), &format!("{plc} {range}")));
        }
        let mut ticks = tokio::time::interval(Duration::from_millis(args.interval));
        ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut shown = Shown::Nothing;
        loop {
            let read = async {
                ticks.tick().await;
                read_values(&mut client, range, form.data_type, form.order).await
            };
            let result = tokio::select! {
                result = read => result,
                () = stop.received() => return Ok(CommandOutcome::AllDone),
            };
            match result {
                Ok(values) => {
                    if !matches!(&shown, Shown::Values(old) if *old == values) {
                        let now = clock::now().with_timezone(&Local);
                        if output.is_json() {
                            let mut result = as_json(range, &values);
                            result["at"] = json!(now.to_rfc3339());
                            line(&json!({ "plc": plc, "ok": true, "result": result }).to_string());
                        } else {
                            line(&format!(
                                "{}  {}",
                                now.format("%H:%M:%S%.3f"),
                                as_text(range, &values).replace('\n', "  ")
                            ));
                        }
                    }
                    shown = Shown::Values(values);
                }
                Err(error) => {
                    let code = Problem::from(error.clone()).code;
                    let is_new = !matches!(&shown, Shown::Failure(old) if *old == code);
                    // Between two attempts to connect nothing new is known.
                    let is_waiting = matches!(&error, ReadError::Client(ClientError::Waiting { .. }));
                    if is_new && !is_waiting {
                        print_read_failure(cli, &plc, error);
                        shown = Shown::Failure(code);
                    }
                }
            }
        }
    })
}
