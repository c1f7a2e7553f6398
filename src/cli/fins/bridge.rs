use std::path::PathBuf;

use clap::Args;
use serde_json::{Value as Json, json};

use super::super::output::{json_path, line, say};
use super::super::secret_file::read_secret;
use super::super::table::table;
use super::super::{CommandContext, CommandOutcome, runtime};
use super::value_as_json;
use crate::fins::bridge::map::Row;
use crate::fins::bridge::robot::{Direction, RobotError};
use crate::fins::bridge::status::{BridgeStatus, RowError, RowStatus};
use crate::jobs::open_fins_bridge;
use crate::model::{ErrorCode, Language, Problem, with_sources};
use crate::platform::stop_signal::StopSignals;
use crate::texts::{self, TextKey};

#[derive(Debug, Args)]
pub struct BridgeArgs {
    /// The map: a TOML file such as fixtures/fins-bridge.toml
    #[arg(value_name = "MAP.toml")]
    map: PathBuf,

    /// End after so many cycles
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u64).range(1..))]
    cycles: Option<u64>,
}

/// Runs the bridge, says when a row begins or ceases to be copied, and shows the counters at the end.
pub fn run(cli: &CommandContext, args: &BridgeArgs) -> Result<CommandOutcome, Problem> {
    let bridge = open_fins_bridge(&args.map, read_secret)?;
    let rows = bridge.rows().to_vec();
    let output = cli.output;
    let status = runtime()?.block_on(async {
        let mut stop = StopSignals::listen();
        let running = bridge.start();
        let mut status = running.status();
        if !output.is_json() {
            say(&texts::bridge_started(output.language(), rows.len()));
        }
        let mut shown = vec![Shown::Nothing; rows.len()];
        loop {
            let changed = tokio::select! {
                changed = status.changed() => changed.is_ok(),
                () = stop.received() => false,
            };
            let now = status.borrow_and_update().clone();
            show_changes(cli, &rows, &now, &mut shown);
            if !changed || args.cycles.is_some_and(|cycles| now.cycles >= cycles) {
                break;
            }
        }
        running.stop().await.map_err(|error| Problem::with_detail(ErrorCode::Internal, error))?;
        let last = status.borrow().clone();
        Ok::<_, Problem>(last)
    })?;
    if output.is_json() {
        let ok = status.rows.iter().all(|row| row.error.is_none());
        line(&json!({ "map": json_path(&args.map), "ok": ok, "result": as_json(&rows, &status) }).to_string());
    } else {
        output.text(&as_text(&rows, &status, output.language()));
    }
    let is_good = status.rows.iter().all(|row| row.error.is_none() && row.copied > 0);
    Ok(if is_good { CommandOutcome::AllDone } else { CommandOutcome::SomeFailed })
}

/// What was said of a row last. An error is said once, until another one follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shown {
    Nothing,
    Copied,
    Failed(ErrorCode),
}

fn show_changes(cli: &CommandContext, rows: &[Row], status: &BridgeStatus, shown: &mut [Shown]) {
    for ((row, status), shown) in rows.iter().zip(&status.rows).zip(shown) {
        let now = match &status.error {
            Some(error) => Shown::Failed(problem(error).code),
            None if status.copied > 0 => Shown::Copied,
            None => Shown::Nothing,
        };
        if now == *shown {
            continue;
        }
        *shown = now;
        if cli.output.is_json() {
            line(
                &json!({ "row": row.name, "ok": status.error.is_none(), "result": row_as_json(row, status) })
                    .to_string(),
            );
        } else {
            say(&match &status.error {
                Some(error) => format!("{}: {}", row.name, problem(error).in_one_line(cli.output.language())),
                None => texts::bridge_row_copied(cli.output.language(), &row.name),
            });
        }
    }
}

/// The error as that of a single request.
fn problem(error: &RowError) -> Problem {
    let detailed = |code| Problem::with_detail(code, with_sources(error));
    match error {
        RowError::Plc(error) => error.clone().into(),
        RowError::PlcWrite(error) => error.clone().into(),
        RowError::Value(error) => error.clone().into(),
        RowError::Robot(RobotError::NotReached(_)) => detailed(ErrorCode::Unreachable),
        RowError::Robot(RobotError::Refused(_)) => detailed(ErrorCode::Refused),
        RowError::Robot(RobotError::Unknown(_)) => detailed(ErrorCode::RemoteOutcomeUnknown),
        RowError::ConnectedAnew => detailed(ErrorCode::ConnectionLost),
    }
}

fn row_as_json(row: &Row, status: &RowStatus) -> Json {
    json!({
        "name": row.name,
        "plc": row.plc.to_string(),
        "robot": row.item.text,
        "direction": match row.direction {
            Direction::ToRobot => "to-robot",
            Direction::ToPlc => "to-plc",
        },
        "type": row.item.data_type.to_string(),
        "values": status.values.iter().map(value_as_json).collect::<Vec<Json>>(),
        "copied": status.copied,
        "failed": status.failed,
        "unknown": status.unknown,
        "error": status.error.as_ref().map(|error| with_sources(error)),
    })
}

fn as_json(rows: &[Row], status: &BridgeStatus) -> Json {
    json!({
        "cycles": status.cycles,
        "complete_cycles": status.complete_cycles,
        "longest_cycle_ms": status.longest_cycle.as_millis() as u64,
        "plc_connections": status.plc.connections,
        "robot_connections": status.robot.connections,
        "rows": rows.iter().zip(&status.rows).map(|(row, status)| row_as_json(row, status)).collect::<Vec<Json>>(),
    })
}

fn as_text(rows: &[Row], status: &BridgeStatus, language: Language) -> String {
    let headings = [
        TextKey::HeadingRow,
        TextKey::HeadingPlc,
        TextKey::HeadingDirection,
        TextKey::HeadingRobot,
        TextKey::HeadingValues,
        TextKey::HeadingCopied,
        TextKey::HeadingFailed,
        TextKey::HeadingUnknown,
        TextKey::HeadingError,
    ];
    let line = |(row, status): (&Row, &RowStatus)| {
        let arrow = match row.direction {
            Direction::ToRobot => "→",
            Direction::ToPlc => "←",
        };
        vec![
            row.name.clone(),
            row.plc.to_string(),
            arrow.to_owned(),
            row.item.text.clone(),
            status.values.iter().map(ToString::to_string).collect::<Vec<String>>().join(" "),
            status.copied.to_string(),
            status.failed.to_string(),
            status.unknown.to_string(),
            status.error.as_ref().map(|error| problem(error).in_one_line(language)).unwrap_or_default(),
        ]
    };
    let lines: Vec<Vec<String>> = rows.iter().zip(&status.rows).map(line).collect();
    let headings = headings.map(|heading| heading.text(language));
    let ended = texts::bridge_ended(language, status.cycles, status.complete_cycles, status.longest_cycle.as_millis());
    format!("{}\n{ended}", table(&headings, &lines).trim_end())
}
