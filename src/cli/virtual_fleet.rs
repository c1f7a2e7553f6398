use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use secrecy::SecretString;

use super::remote_answers::RemoteAnswers;
use super::secret_file::read_secret;
use super::{CommandOutcome, runtime, virtual_cell, virtual_switch};
use crate::model::activation::{ActivationKeys, FIRST_LINE};
use crate::model::{ErrorCode, Problem, SerialNumber};
use crate::platform::stop_signal::StopSignals;
use crate::virtual_controller::cell::{CellOptions, ClockRate, RobotModel};
use crate::virtual_controller::{AdmissionOptions, Fleet, FleetConfig, FleetFirmware, demo_keys};

#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
pub struct VirtualArgs {
    #[command(subcommand)]
    command: Option<VirtualCommand>,
    #[command(flatten)]
    fleet: FleetArgs,
}

#[derive(Debug, Subcommand)]
enum VirtualCommand {
    /// Print an activation file with the keys that virtual controllers with these serial numbers accept
    Keys {
        #[arg(required = true, value_name = "SERIAL")]
        serials: Vec<String>,
    },
    /// Switch what goes wrong in virtual controllers that run in another process with --data: a running task, a connected
    /// teach pendant, a failing OPC UA server. In force within a second, until it is switched off; without a switch, shows
    /// them
    Switch(virtual_switch::SwitchArgs),
    /// Act on the simulated cell of virtual controllers that run in another process with --data, as the plant around them
    /// does: start and stop the program, press the emergency stop, open the safety door, raise errors, record. Shows the
    /// state afterwards, and without --do only the state
    Cell(virtual_cell::CellArgs),
}

#[derive(Debug, Args)]
struct FleetArgs {
    /// How many controllers
    #[arg(long, value_name = "N", default_value_t = 1)]
    count: usize,
    /// Address to listen on; anything but a loopback address lets the whole network in
    #[arg(long, value_name = "ADDR", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    bind: IpAddr,
    /// First port of the management protocol, each next controller takes the next one; 0 picks free ones
    #[arg(long, value_name = "P", default_value_t = 0)]
    management_port: u16,
    /// First port of the OPC UA servers, each next controller takes the next one; 0 picks free ones
    #[arg(long, value_name = "P", default_value_t = 0)]
    opcua_port: u16,
    #[arg(long, value_enum, default_value_t = FirmwareArg::Mixed)]
    firmware: FirmwareArg,
    /// Legacy controllers come without keys, to be activated by those that "virtual keys" prints
    #[arg(long)]
    not_activated: bool,
    /// File with the connection password of all of them, "-" for standard input; empty without it
    #[arg(long, value_name = "FILE")]
    password_file: Option<PathBuf>,
    /// Folder for what the controllers keep; a temporary one without it
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// Tell OPC UA clients that are refused what is wrong with their certificate
    #[arg(long)]
    detailed_status: bool,
    /// Admit OPC UA clients whose CA has given no valid revocation list
    #[arg(long)]
    allow_unknown_revocation: bool,
    /// Robots on each controller, joined by commas: C4-A601S (six axes), GX4-A251S (SCARA)
    #[arg(long, value_name = "MODEL", value_delimiter = ',', default_value = "C4-A601S")]
    robots: Vec<RobotModel>,
    /// OPC UA clients may write inputs, and see words beside bytes and bits
    #[arg(long)]
    virtual_io: bool,
    /// Simulated seconds in one second, 0.001 to 10000
    #[arg(long, value_name = "RATE", default_value_t = ClockRate::default())]
    clock_rate: ClockRate,
    /// The same seed makes the same controllers
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    remote: RemoteAnswers,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FirmwareArg {
    /// Below 8.0.0
    Legacy,
    /// 8.0.0 and later
    Current,
    /// Some of each
    Mixed,
}

impl From<FirmwareArg> for FleetFirmware {
    fn from(firmware: FirmwareArg) -> Self {
        match firmware {
            FirmwareArg::Legacy => Self::Legacy,
            FirmwareArg::Current => Self::Current,
            FirmwareArg::Mixed => Self::Mixed,
        }
    }
}

pub fn run(args: &VirtualArgs) -> Result<CommandOutcome, Problem> {
    match &args.command {
        Some(VirtualCommand::Keys { serials }) => keys(serials),
        Some(VirtualCommand::Switch(args)) => virtual_switch::run(args),
        Some(VirtualCommand::Cell(args)) => virtual_cell::run(args),
        None => fleet(&args.fleet),
    }
}

fn keys(serials: &[String]) -> Result<CommandOutcome, Problem> {
    let bad = |error| Problem::with_detail(ErrorCode::BadName, error);
    let serials = serials.iter().map(|s| s.parse()).collect::<Result<Vec<SerialNumber>, _>>().map_err(bad)?;
    super::output::line(FIRST_LINE);
    for serial in serials {
        let ActivationKeys { licence, activation } = demo_keys(&serial);
        super::output::line(&format!("{serial},{licence},{activation}"));
    }
    Ok(CommandOutcome::AllDone)
}

fn fleet(args: &FleetArgs) -> Result<CommandOutcome, Problem> {
    let password = args.password_file.as_ref().map(|f| read_secret(f)).transpose()?;
    // Removed when this function ends.
    let temporary = match args.data {
        Some(_) => None,
        None => Some(tempfile::tempdir().map_err(|e| Problem::with_detail(ErrorCode::WorkspaceReadOnly, e))?),
    };
    let data = match (&args.data, &temporary) {
        (Some(data), _) => data.clone(),
        (None, Some(folder)) => folder.path().to_owned(),
        (None, None) => PathBuf::new(),
    };
    let config = FleetConfig {
        count: args.count,
        bind: args.bind,
        management_port: args.management_port,
        opcua_port: args.opcua_port,
        firmware: args.firmware.into(),
        activated: !args.not_activated,
        password: password.unwrap_or_else(|| SecretString::from("")),
        data,
        admission: AdmissionOptions {
            detailed_status: args.detailed_status,
            allow_unknown_revocation: args.allow_unknown_revocation,
        },
        cell: CellOptions {
            robots: args.robots.clone(),
            seed: args.seed,
            rate: args.clock_rate,
            virtual_io: args.virtual_io,
        },
        remote: args.remote.options()?,
        seed: args.seed,
    };
    runtime()?.block_on(async {
        // Before the lines that say the controllers are ready: from then on a caller may ask the program to end.
        let mut stop = StopSignals::listen();
        let fleet = Fleet::start(config).await.map_err(Problem::from)?;
        for controller in fleet.controllers() {
            let line = serde_json::to_string(&controller.ready_line())
                .map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?;
            super::output::line(&line);
        }
        stop.received().await;
        fleet.shutdown().await;
        Ok(CommandOutcome::AllDone)
    })
}
