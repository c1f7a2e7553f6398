//! A recorder at the motion log's full rate: every block of several virtual controllers, 8 samples a block, SamplingInterval
//! 0. Whether a block is lost, and what it costs of the processor, against asyncua doing the same reads and NumPy taking the
//! blocks apart.
//!
//! `cargo bench --bench recorder -- [CONTROLLERS] [SECONDS]`; 4 and 20 without arguments.
//!
//! The controllers are in one process, the recorder (`record motion` of the program itself) in another, asyncua in a third.
//! All connections sign and encrypt. `OPCUA_INTEROP_PYTHON` names a Python with asyncua and NumPy.

#[allow(dead_code, reason = "tests need more of it")]
#[path = "../common/command_line_test.rs"]
mod command_line_test;
#[allow(dead_code, reason = "other benches need more of it")]
mod opcua_client;
mod plant;
#[allow(dead_code, reason = "tests need more of it")]
#[path = "../common/process.rs"]
mod process;
#[allow(dead_code, reason = "other benches need more of it")]
mod report;
#[allow(dead_code, reason = "other benches need more of it")]
mod usage;

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use command_line_test::CommandLineTest;
use opcua_client::{Failure, TestApplication};
use process::Running;
use report::{Spread, line};
use serde_json::Value;
use usage::{processor_seconds, processor_seconds_of_ended};

const ROUNDS: usize = 3;
/// Rows of a block in a file.
const ROWS_PER_BLOCK: u64 = 8;
/// A sample each 0.5 ms.
const BLOCKS_PER_SECOND: f64 = 250.0;

/// What one round came to.
struct Round {
    /// Blocks of each controller.
    blocks: Vec<u64>,
    missing: u64,
    /// Seconds from the first block to the last, of the controllers' time, together.
    seconds: f64,
    /// Of the processor, for a controller and a second of recording.
    reader: Option<f64>,
    /// Of the processor, for a controller and a second of recording.
    controllers: Option<f64>,
}

fn main() -> Result<(), Failure> {
    let benching = report::is_benching();
    let controllers = report::number(0).unwrap_or(if benching { 4 } else { 2 }).max(1);
    let seconds = report::number(1).unwrap_or(if benching { 20 } else { 1 }).max(1);
    let folder = tempfile::tempdir()?;
    let client = TestApplication::new("client")?;
    client.write(folder.path())?;
    let plant = CommandLineTest::with(controllers, &["--seed", "1", "--firmware", "current"]);
    let settings = ["--policies", "Basic256Sha256", "--tokens", "anonymous"];
    plant::set_up(&plant, &settings, &folder.path().join("own.der"));
    println!("Every block of {controllers} motion logs for {seconds} s, {} cores", report::cores());

    let mut rounds: [Vec<Round>; 3] = Default::default();
    for round in 0..report::rounds_when(benching, ROUNDS) {
        for (format, rounds) in ["csv", "parquet"].into_iter().zip(&mut rounds) {
            let output = folder.path().join(format!("{format}-{round}"));
            rounds.push(record(&plant, format, seconds, &output)?);
            fs::remove_dir_all(output)?;
        }
        match read_with_asyncua(&plant, seconds, folder.path()) {
            Ok(read) => rounds[2].push(read),
            Err(missing) if round == 0 => println!("  asyncua: not compared: {missing}"),
            Err(_) => {}
        }
    }
    let ours = Spread::of(rounds[0].iter().filter_map(|round| round.reader)).median();
    for (what, rounds) in ["recorder, CSV", "recorder, Parquet", "asyncua, NumPy"].into_iter().zip(&rounds) {
        if rounds.is_empty() {
            continue;
        }
        println!("{what}");
        let blocks: Vec<String> = rounds.iter().flat_map(|round| &round.blocks).map(u64::to_string).collect();
        line(
            "blocks",
            format!("{}; missing: {}", blocks.join(" "), rounds.iter().map(|round| round.missing).sum::<u64>()),
        );
        let produced = rounds.iter().map(|round| round.seconds * BLOCKS_PER_SECOND + round.blocks.len() as f64);
        let recorded = rounds.iter().flat_map(|round| &round.blocks).sum::<u64>() as f64;
        line("recorded of produced", format!("{:.4} %", recorded / produced.sum::<f64>() * 100.0));
        let reader = Spread::of(rounds.iter().filter_map(|round| round.reader));
        line(
            "processor, reader",
            format!("{reader} s for a controller's second; {:.1} × CSV's", reader.median() / ours),
        );
        let plant = Spread::of(rounds.iter().filter_map(|round| round.controllers));
        line("processor, controller", format!("{plant} s for its second"));
    }
    Ok(())
}

/// Records from every controller with the command line.
fn record(plant: &CommandLineTest, format: &str, seconds: usize, output: &Path) -> Result<Round, Failure> {
    let mut command = plant.command();
    command.args(["--json", "record", "motion", "--sampling-interval", "0", "--trust-me", "--all", "--yes"]);
    command.args(["--duration", &seconds.to_string(), "--format", format, "--output"]).arg(output);
    let (lines, reader, controllers) = run(plant, &mut command, seconds)?;
    let recordings: Vec<Value> = lines.lines().map(serde_json::from_str).collect::<Result<_, _>>()?;
    if recordings.len() != plant.ready.len() || recordings.iter().any(|line| line["ok"] != true) {
        return Err(format!("not every controller was recorded: {lines}").into());
    }
    let recordings: Vec<&Value> = recordings.iter().map(|line| &line["result"]["recording"]).collect();
    let missing = |recording: &Value| match recording["gaps"].as_array() {
        Some(gaps) => gaps.iter().map(|gap| gap["missing"].as_u64().unwrap_or(1)).sum(),
        None => 0,
    };
    Ok(Round {
        blocks: recordings.iter().map(|one| one["rows"].as_u64().unwrap_or_default() / ROWS_PER_BLOCK).collect(),
        missing: recordings.iter().map(|recording| missing(recording)).sum(),
        seconds: recordings.iter().filter_map(|recording| recording["seconds"].as_f64()).sum(),
        reader,
        controllers,
    })
}

/// The same reads by asyncua, with the blocks taken apart by NumPy and then forgotten.
fn read_with_asyncua(plant: &CommandLineTest, seconds: usize, folder: &Path) -> Result<Round, Failure> {
    let python = std::env::var_os("OPCUA_INTEROP_PYTHON").unwrap_or_else(|| "python3".into());
    let mut command = Command::new(python);
    command.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/benches/recorder.py"));
    command.arg(folder).arg(seconds.to_string());
    command.args(plant.ready.iter().filter_map(|ready| ready["opcua"].as_str()));
    let (told, reader, controllers) = run(plant, &mut command, seconds)?;
    let told: Value = serde_json::from_str(told.trim())?;
    let numbers = |key: &str| told[key].as_array().into_iter().flatten().filter_map(Value::as_u64).collect::<Vec<_>>();
    let seconds = told["seconds"].as_array().into_iter().flatten().filter_map(Value::as_f64).sum();
    Ok(Round { blocks: numbers("blocks"), missing: numbers("missing").iter().sum(), seconds, reader, controllers })
}

/// Runs a reader to its end: what it printed, and the processor time of the reader and of the controllers, each for a
/// controller's second.
fn run(
    plant: &CommandLineTest,
    command: &mut Command,
    seconds: usize,
) -> Result<(String, Option<f64>, Option<f64>), Failure> {
    let process = plant.controllers.id();
    let (reader, controllers) = (processor_seconds_of_ended(), processor_seconds(process));
    let ended = Running::start(command)?.finish(Duration::from_secs(seconds as u64 + 120));
    let recorded = (seconds * plant.ready.len()) as f64;
    let spent = |before: Option<f64>, after: Option<f64>| Some((after? - before?) / recorded);
    let reader = spent(reader, processor_seconds_of_ended());
    let controllers = spent(controllers, processor_seconds(process));
    match ended.code {
        Some(0) => Ok((ended.stdout, reader, controllers)),
        code => Err(format!("exit code {code:?}: {}", ended.stderr.lines().last().unwrap_or_default()).into()),
    }
}
