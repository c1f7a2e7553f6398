//! `remote serve`: the server of the remote commands alone, over a simulated cell, without the management protocol and the
//! OPC UA server of a whole virtual controller.

use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use crate::cli::remote_answers::RemoteAnswers;
use crate::cli::{CommandOutcome, output, runtime};
use crate::model::{ControllerSeries, ErrorCode, FirmwareVersion, NameError, Problem, clock, with_sources};
use crate::platform::stop_signal::StopSignals;
use crate::remote::text::DEFAULT_PORT;
use crate::virtual_controller::cell::{
    BackupMemory, Cell, CellClock, CellConfig, CellHandle, CellOptions, ClockRate, MAX_DECLARATION_BYTES, RobotModel,
    SpelDeclaration, SpelDeclarations,
};
use crate::virtual_controller::remote::{RemoteOptions, RemoteServer, RemoteServerError};
use crate::virtual_controller::usual_variables;

#[derive(Debug, Args)]
pub struct ServeArgs {
    /// Address to listen on; anything but a loopback address lets the whole network in
    #[arg(long, value_name = "ADDR", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    bind: IpAddr,
    #[command(flatten)]
    answers: RemoteAnswers,
    /// Robots of the cell, joined by commas: C4-A601S (six axes), GX4-A251S (SCARA)
    #[arg(long, value_name = "MODEL", value_delimiter = ',', default_value = "C4-A601S")]
    robots: Vec<RobotModel>,
    /// File with the declarations of variables, "Global Preserve Integer g_Status" or "g_List(10)" a line; without it there
    /// are the variables of a new virtual controller
    #[arg(long, value_name = "FILE")]
    variables: Option<PathBuf>,
    /// Simulated seconds in one second, 0.001 to 10000
    #[arg(long, value_name = "RATE", default_value_t = ClockRate::default())]
    clock_rate: ClockRate,
    /// The same seed makes the same cell
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
}

/// Answers until the program is asked to end. Prints one line of JSON when it is ready. Nothing is kept.
pub fn run(args: &ServeArgs) -> Result<CommandOutcome, Problem> {
    let options = with_port(args.answers.options()?);
    let cell = cell(args)?;
    runtime()?.block_on(async {
        let mut stop = StopSignals::listen();
        let server = RemoteServer::start(args.bind, options, cell).await.map_err(|error| problem(&error))?;
        let line = json!({
            "remote": server.text_address(),
            "remote_frames": server.frames_address(),
            "remote_serial": server.serial_path(),
        });
        output::line(&line.to_string());
        stop.received().await;
        server.stop().await;
        Ok(CommandOutcome::AllDone)
    })
}

/// Without any choice, the text form at its usual port.
fn with_port(options: RemoteOptions) -> RemoteOptions {
    let is_chosen = options.text_port.is_some() || options.frames_port.is_some() || options.serial.is_some();
    let text_port = if is_chosen { options.text_port } else { Some(DEFAULT_PORT) };
    RemoteOptions { text_port, ..options }
}

fn cell(args: &ServeArgs) -> Result<CellHandle, Problem> {
    let name = |error: NameError| Problem::with_detail(ErrorCode::BadName, error);
    let config = CellConfig {
        name: "Virtual cell".parse().map_err(name)?,
        serial: "SN0000001".parse().map_err(name)?,
        series: ControllerSeries::Rc800,
        firmware: FirmwareVersion::new(8, 1, 0),
        started: clock::now(),
        variables: variables(args)?,
        backup: BackupMemory::default(),
        options: CellOptions {
            robots: args.robots.clone(),
            seed: args.seed,
            rate: args.clock_rate,
            ..CellOptions::default()
        },
    };
    Ok(CellHandle::new(Cell::new(config), CellClock::running(args.clock_rate)))
}

fn variables(args: &ServeArgs) -> Result<Vec<SpelDeclaration>, Problem> {
    use std::io::Read as _;
    let Some(path) = &args.variables else { return Ok(usual_variables()) };
    let unreadable =
        |error: std::io::Error| Problem::with_detail(ErrorCode::FileUnreadable, format!("{}: {error}", path.display()));
    let mut content = Vec::new();
    let file = std::fs::File::open(path).map_err(unreadable)?;
    // One byte more than is looked at says that there is more.
    file.take(MAX_DECLARATION_BYTES as u64 + 1).read_to_end(&mut content).map_err(unreadable)?;
    let found = SpelDeclarations::parse(&content);
    match found.findings.first() {
        Some(finding) if found.variables.is_empty() => {
            Err(Problem::with_detail(ErrorCode::FileFormat, format!("{}: {finding}", path.display())))
        }
        _ => Ok(found.variables),
    }
}

fn problem(error: &RemoteServerError) -> Problem {
    Problem::with_detail(ErrorCode::CannotListen, with_sources(error))
}
