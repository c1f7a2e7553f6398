//! PLCs over FINS: reading and writing their memory, a simulated PLC, a bridge to a robot.

mod bridge;
mod elements;
mod read;
mod serve;
mod status;
mod target;
mod watch;
mod write;

use clap::Subcommand;
use serde_json::{Value as Json, json};

use super::output::say;
use super::{CommandContext, CommandOutcome};
use crate::fins::address::{Address, AddressRange, Area, Part};
use crate::fins::client::ClientError;
use crate::fins::data_type::Value;
use crate::model::Problem;
use crate::texts;

#[derive(Debug, Subcommand)]
pub enum FinsCommand {
    /// Read words or bits of a PLC
    Read(read::ReadArgs),
    /// Write words or bits of a PLC
    Write(write::WriteArgs),
    /// Read words or bits of a PLC again and again, and show what changes, until Ctrl-C
    Watch(watch::WatchArgs),
    /// Show model, operating mode, errors and clock of a PLC
    Status(status::StatusArgs),
    /// Run a simulated PLC until Ctrl-C; one line of JSON when it is ready
    Serve(serve::ServeArgs),
    /// Copy words and bits between a PLC and a robot, as a map says, until Ctrl-C
    Bridge(bridge::BridgeArgs),
}

pub fn run(cli: &CommandContext, command: FinsCommand) -> Result<CommandOutcome, Problem> {
    match command {
        FinsCommand::Read(args) => read::run(cli, &args),
        FinsCommand::Write(args) => write::run(cli, &args),
        FinsCommand::Watch(args) => watch::run(cli, &args),
        FinsCommand::Status(args) => status::run(cli, &args),
        FinsCommand::Serve(args) => serve::run(cli, &args),
        FinsCommand::Bridge(args) => bridge::run(cli, &args),
    }
}

/// Prints why a PLC did not do what was asked, with what its end code means. `done` is said before the advice.
fn print_failure(cli: &CommandContext, plc: &str, problem: Problem, error: Option<&ClientError>, done: Option<&str>) {
    let end = error.and_then(ClientError::end_code);
    cli.output.cli("plc", plc, &Err(problem));
    if cli.output.is_json() {
        return;
    }
    for line in done.map(str::to_owned).into_iter().chain(end.map(|end| texts::plc_advice(cli.output.language(), end)))
    {
        say(&format!("    {line}"));
    }
}

/// `{"area","address","values"}`; `bit` with bits, `flag` with completion flags.
fn as_json(range: AddressRange, values: &[Value]) -> Json {
    let start = range.start;
    let mut json = json!({
        "area": area_name(start.area()),
        "address": start.number(),
        "values": values.iter().map(value_as_json).collect::<Vec<Json>>(),
    });
    match start.part() {
        Part::Word => {}
        Part::Bit(bit) => json["bit"] = bit.into(),
        Part::Flag => json["flag"] = true.into(),
    }
    json
}

fn area_name(area: Area) -> String {
    match area {
        Area::DataMemory => "DM".to_owned(),
        area => area.to_string().trim_end_matches('_').to_owned(),
    }
}

fn value_as_json(value: &Value) -> Json {
    match value {
        Value::Bit(state) => json!(state),
        Value::Integer(number) => json!(number),
        // JSON has no infinity and no NaN.
        Value::Float(number) if number.is_finite() => json!(number),
        Value::Float(number) => json!(number.to_string()),
        Value::Text(text) => json!(text),
    }
}

/// The values, each after its address: `D300 123`.
fn as_text(range: AddressRange, values: &[Value]) -> String {
    let elements = usize::from(range.count) / values.len().max(1);
    let line = |(at, value): (usize, &Value)| {
        let address: Address = range.start.plus(at * elements).unwrap_or(range.start);
        format!("{address} {}", crate::model::untrusted_text::one_line(&value.to_string(), MAX_TEXT_CHARS))
    };
    values.iter().enumerate().map(line).collect::<Vec<String>>().join("\n")
}

/// As many as a PLC's text may have in this program's other outputs.
const MAX_TEXT_CHARS: usize = 2_000;
