//! Recording the data of controllers, and what is done with recordings.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Subcommand, ValueEnum};
use serde_json::{Value, json};
use tokio_util::sync::CancellationToken;

use super::controller_selection::ControllerSelection;
use super::output::{json_path, say};
use super::table::table;
use super::user_login::UserLoginArgs;
use super::{CommandContext, CommandOutcome, runtime};
use crate::jobs::{self, FindServer, FoundServer, RecordEnd, RecordEvent, RecordRequest};
use crate::model::{ErrorCode, Language, Problem};
use crate::platform::stop_signal::StopSignals;
use crate::recorder::{self, Format, RecordSettings, Recorded, SettingsError, Sidecar, StopLimits};
use crate::texts;
use crate::workspace::ControllerEntry;

#[derive(Debug, Subcommand)]
pub enum RecordCommand {
    /// Record what the force sensor measures, from RecordStart to its end; waits for RecordStart
    Force(ForceArgs),
    /// Record the motion log: encoders, currents, I/O, force sensor, tool centre point
    Motion(MotionArgs),
    /// Show what a recording holds and what is missing in it
    Show {
        /// File of a recording: CSV, Parquet, or packets
        file: PathBuf,
    },
    /// Make a CSV or Parquet file from a recording
    Convert {
        /// File of a recording: CSV, Parquet, or packets
        recording: PathBuf,
        /// File to make; its extension is .csv or .parquet
        file: PathBuf,
    },
}

#[derive(Debug, Args)]
pub struct ForceArgs {
    /// Values: 0 all; 1 positions, speeds, joints; 2 forces and positions; 3 positions
    #[arg(long, value_name = "NUMBER", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=3))]
    data_type: u16,

    /// Channel: 2 is that of a second RecordStart at the same time
    #[arg(long, value_name = "NUMBER", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=2))]
    monitor: u8,

    /// Records that one read brings at most; 0 leaves it to the controller
    #[arg(long, value_name = "COUNT", default_value_t = 0)]
    data_num: u16,

    /// End after so many recordings of the force sensor; 0: go on
    #[arg(long, value_name = "COUNT", default_value_t = 1)]
    recordings: u32,

    #[command(flatten)]
    common: CommonArgs,
}

#[derive(Debug, Args)]
pub struct MotionArgs {
    /// The sampling period is the shortest one times 2 to the power of this number
    #[arg(long, value_name = "NUMBER", default_value_t = 0, value_parser = clap::value_parser!(u8).range(0..=4))]
    sampling_interval: u8,

    /// Blocks that one read brings at most; 0 leaves it to the controller
    #[arg(long, value_name = "COUNT", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=200))]
    data_num: u16,

    #[command(flatten)]
    common: CommonArgs,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FileFormat {
    Csv,
    Parquet,
}

#[derive(Debug, Args)]
pub struct CommonArgs {
    /// End after so many seconds
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(u64).range(1..=31_536_000))]
    duration: Option<u64>,

    /// End when packets of so many megabytes have come
    #[arg(long, value_name = "MEGABYTES", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    max_size: Option<u64>,

    /// Format of the file
    #[arg(long, value_enum, default_value_t = FileFormat::Csv)]
    format: FileFormat,

    /// Folder for the files [default: recordings in the workspace]
    #[arg(long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Keep the packets as they came in a file of their own
    #[arg(long)]
    keep_packets: bool,

    #[command(flatten)]
    login: UserLoginArgs,

    /// First put the certificate of this configurator into the trusted list of each controller, where it stays
    #[arg(long)]
    trust_me: bool,

    #[command(flatten)]
    select: ControllerSelection,
}

pub fn run(cli: &CommandContext, command: RecordCommand) -> Result<CommandOutcome, Problem> {
    let bad = |error: SettingsError| Problem::with_detail(ErrorCode::BadSettings, error);
    match command {
        RecordCommand::Force(ForceArgs { data_type, monitor, data_num, recordings, common }) => {
            let settings = RecordSettings::force(data_type, monitor, data_num).map_err(bad)?;
            record(cli, &common, settings, (recordings > 0).then_some(recordings))
        }
        RecordCommand::Motion(MotionArgs { sampling_interval, data_num, common }) => {
            let settings = RecordSettings::motion(sampling_interval, data_num).map_err(bad)?;
            record(cli, &common, settings, None)
        }
        RecordCommand::Show { file } => {
            let sidecar = recorder::summarise(&file)?;
            cli.output.finished(&json!(sidecar), &summary(&sidecar, cli.output.language()));
            Ok(CommandOutcome::AllDone)
        }
        RecordCommand::Convert { recording, file } => {
            let sidecar = recorder::convert(&recording, &file)?;
            let text = ended(&file, &sidecar, cli.output.language());
            cli.output.finished(&json!({ "file": json_path(&file), "recording": sidecar }), &text);
            Ok(CommandOutcome::AllDone)
        }
    }
}

/// Finds the servers, then records from all of them side by side until each has ended.
fn record(
    cli: &CommandContext,
    args: &CommonArgs,
    settings: RecordSettings,
    footers: Option<u32>,
) -> Result<CommandOutcome, Problem> {
    let language = cli.output.language();
    let configuration = cli.configuration()?;
    let chosen = args.select.resolve(&configuration, language)?;
    let login = args.login.credential()?;
    let folder = args.output.clone().unwrap_or_else(|| cli.workspace.root().join("recordings"));
    for recovered in recorder::recover(&folder) {
        match recovered {
            Ok(Recorded { file, sidecar, .. }) => say(&texts::recording_recovered(language, &file, sidecar.rows)),
            Err(error) => cli.output.explain(None, &error.into()),
        }
    }
    let find = FindServer { identity: cli.workspace.own_identity(), trust_first: args.trust_me };
    let found = cli.found_servers(&configuration, &chosen, find)?;
    let format = match args.format {
        FileFormat::Csv => Format::Csv,
        FileFormat::Parquet => Format::Parquet,
    };
    let limits = StopLimits {
        duration: args.duration.map(Duration::from_secs),
        bytes: args.max_size.map(|megabytes| megabytes * 1_000_000),
        footers,
    };
    let requests = found.into_iter().map(|(entry, found)| {
        let request = RecordRequest {
            name: entry.name.to_string(),
            found,
            login: login.clone(),
            settings,
            format,
            keep_packets: args.keep_packets,
            folder: folder.clone(),
            limits,
            values: None,
        };
        (entry, request)
    });
    let all_found = requests.len() == chosen.len();
    let all_recorded = record_all(cli, requests.collect())?;
    Ok(if all_found && all_recorded { CommandOutcome::AllDone } else { CommandOutcome::SomeFailed })
}

/// Whether all succeeded.
fn record_all(cli: &CommandContext, requests: Vec<(ControllerEntry, RecordRequest)>) -> Result<bool, Problem> {
    let output = cli.output;
    let language = output.language();
    let runtime = runtime()?;
    let all_good = runtime.block_on(async {
        let stop = CancellationToken::new();
        let on_stop = {
            let (signals, stop) = (StopSignals::listen(), stop.clone());
            tokio::spawn(signals.end_at_second(move || stop.cancel()))
        };
        let mut tasks = tokio::task::JoinSet::new();
        for (entry, request) in requests {
            let stop = stop.clone();
            tasks.spawn(async move {
                let name = entry.name.to_string();
                let on_event = |event| {
                    if let RecordEvent::Started(file) = event
                        && !output.is_json()
                    {
                        say(&texts::recording_started(language, &name, &file));
                    }
                };
                let end = jobs::record(request, stop, on_event).await;
                (entry, end)
            });
        }
        let mut all_good = true;
        while let Some(ended) = tasks.join_next().await {
            all_good &= match ended {
                Ok((entry, end)) => print_end(cli, entry.name.as_str(), end),
                Err(error) => {
                    output.explain(None, &Problem::with_detail(ErrorCode::Internal, error));
                    false
                }
            };
        }
        on_stop.abort();
        all_good
    });
    runtime.shutdown_background();
    Ok(all_good)
}

/// Whether nothing failed.
fn print_end(cli: &CommandContext, name: &str, end: RecordEnd) -> bool {
    let RecordEnd { recorded, problem } = end;
    let result = recorded.as_ref().map(as_json);
    if cli.output.is_json() {
        match (&problem, &result) {
            (None, result) => cli.output.done(name, result.as_ref().unwrap_or(&Value::Null)),
            (Some(problem), None) => cli.output.failed(name, problem),
            (Some(problem), Some(result)) => cli.output.done_with_shortcoming(name, problem, result),
        }
        return problem.is_none();
    }
    if let Some(Recorded { file, sidecar, .. }) = &recorded {
        cli.output.text(&format!("{name}: {}", ended(file, sidecar, cli.output.language())));
    }
    match &problem {
        None => true,
        Some(problem) => print_failure(cli, name, problem),
    }
}

fn print_failure(cli: &CommandContext, name: &str, problem: &Problem) -> bool {
    if cli.output.is_json() {
        cli.output.failed(name, problem);
    } else {
        cli.output.explain(Some(name), problem);
    }
    false
}

impl CommandContext {
    /// The servers that were found; what failed is printed.
    fn found_servers(
        &self,
        configuration: &crate::workspace::Configuration,
        chosen: &[ControllerEntry],
        find: FindServer,
    ) -> Result<Vec<(ControllerEntry, FoundServer)>, Problem> {
        // Successes are printed once they are recorded, not before.
        let reports = self.quiet_reports(configuration, chosen, find)?;
        let mut found = Vec::new();
        for (entry, report) in chosen.iter().zip(reports) {
            match report.result {
                Ok(server) => found.push((entry.clone(), server)),
                Err(problem) => {
                    print_failure(self, entry.name.as_str(), &problem);
                }
            }
        }
        Ok(found)
    }
}

fn as_json(recorded: &Recorded) -> Value {
    json!({
        "file": json_path(&recorded.file),
        "sidecar": json_path(&recorded.sidecar_file),
        "packets": recorded.packets.as_ref().map(|path| json_path(path)),
        "recording": recorded.sidecar,
    })
}

fn ended(file: &std::path::Path, sidecar: &Sidecar, language: Language) -> String {
    texts::recording_ended(language, file, sidecar.rows, sidecar.missing(), sidecar.gaps.len())
}

/// A recording for a terminal: its facts, then each gap.
fn summary(sidecar: &Sidecar, language: Language) -> String {
    let time = |time: chrono::DateTime<chrono::Utc>| time.format("%Y-%m-%d %H:%M:%S UTC").to_string();
    let facts = texts::recording_facts(language, sidecar, time);
    let rows: Vec<Vec<String>> =
        facts.into_iter().map(|(label, value)| vec![label.text(language).to_owned(), value]).collect();
    let mut text = table(&["", ""], &rows).trim_start_matches('\n').to_owned();
    for gap in sidecar.gaps.iter().take(MAX_GAPS_SHOWN) {
        let missing = gap.missing.map_or_else(|| "?".to_owned(), |missing| missing.to_string());
        let cause = gap.cause.text_key().text(language);
        text.push_str(&format!("  {}  {}  {missing}  {cause}\n", gap.at_row, time(gap.noticed_at)));
    }
    if sidecar.gaps.len() > MAX_GAPS_SHOWN {
        text.push_str("  …\n");
    }
    text
}

const MAX_GAPS_SHOWN: usize = 50;
