//! Remote commands to one controller: over remote Ethernet, a serial port or a serial device server.

mod connection;
mod run;
mod serve;
mod show;
mod values;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Subcommand, ValueEnum};

use self::connection::ConnectionArgs;
use self::run::{WatchArgs, identity, login_check, once, read};
use self::values::{IoArea, IoUnit, get_io, get_variable, set_io, set_variable};
use super::{CommandContext, CommandOutcome};
use crate::model::{ErrorCode, Problem, SpelType};
use crate::remote::{AlarmNumber, EncodeError, FunctionNumber, Request, RobotNumber, SpelCommand, text};

#[derive(Debug, Subcommand)]
pub enum RemoteCommand {
    /// Show the state of a controller: which of the eleven states are on, and the number of its error or warning
    Status {
        #[command(flatten)]
        watch: WatchArgs,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
    /// Show name, serial number, model, firmware, network settings, robots and worn parts, as far as the firmware tells
    /// them; over tcp:// only
    Info(ConnectionArgs),
    /// Log in, and say whether that works
    LoginCheck(ConnectionArgs),
    /// Run a function of the program
    Start {
        /// 0 is main, 1 is main1, up to 63
        #[arg(value_name = "FUNCTION", default_value_t = 0, value_parser = clap::value_parser!(u8).range(0..=63))]
        function: u8,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
    /// Stop all tasks and commands
    Stop(ConnectionArgs),
    /// Pause all tasks
    Pause(ConnectionArgs),
    /// Continue paused tasks
    Continue(ConnectionArgs),
    /// Reset emergency stop and error; outputs go off
    Reset(ConnectionArgs),
    /// Switch motors on or off
    Motors {
        #[arg(value_enum)]
        state: Switch,
        /// Only those of this robot; 0 are all robots
        #[arg(long, value_name = "NUMBER", default_value_t = 0, value_parser = clap::value_parser!(u8).range(0..=16))]
        robot: u8,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
    /// Move a robot to its home position
    Home {
        /// Number of the robot
        #[arg(value_name = "ROBOT", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=16))]
        robot: u8,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
    /// Show or select the robot that executed commands are for
    Robot {
        /// Select this robot; without a number the selected one is shown
        #[arg(value_name = "ROBOT", value_parser = clap::value_parser!(u8).range(1..=16))]
        robot: Option<u8>,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
    /// Read I/O, or set outputs
    #[command(subcommand)]
    Io(IoCommand),
    /// Read or set memory I/O
    #[command(subcommand)]
    Mem(IoCommand),
    /// Read or set variables that are declared Global Preserve
    #[command(subcommand)]
    Var(VariableCommand),
    /// Execute a command of SPEL+ and show its result
    Exec {
        /// The command with its parameters, at most 256 bytes
        #[arg(value_name = "COMMAND")]
        text: String,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
    /// Abort the command that is being executed
    Abort(ConnectionArgs),
    /// Show the alarms of parts that wear, or reset one
    Alarms {
        /// Reset this alarm
        #[arg(long, value_name = "NUMBER")]
        reset: Option<u8>,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
    /// Send any command, written in the text form, such as '$GetIO,1'; over a serial line it is sent as a frame
    Raw {
        /// The command, with or without $
        #[arg(value_name = "TEXT")]
        text: String,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
    /// Answer remote commands over a simulated cell alone until Ctrl-C; one line of JSON when it is ready
    Serve(serve::ServeArgs),
}

#[derive(Debug, Subcommand)]
pub enum IoCommand {
    /// Read a bit, byte or word
    Get {
        /// Number of the bit, or of the byte or word
        number: u16,
        #[command(flatten)]
        unit: UnitArgs,
        #[command(flatten)]
        watch: WatchArgs,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
    /// Set a bit, byte or word
    Set {
        /// Number of the bit, or of the byte or word
        number: u16,
        /// on or off for a bit; a number, or hexadecimal such as 0x0F, for a byte or word
        value: String,
        #[command(flatten)]
        unit: UnitArgs,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
}

#[derive(Debug, Args)]
pub struct UnitArgs {
    /// What the number counts: bits, bytes (8 bits) or words (16 bits)
    #[arg(long = "as", value_name = "UNIT", value_enum, default_value_t = IoUnit::Bit)]
    unit: IoUnit,
}

#[derive(Debug, Subcommand)]
pub enum VariableCommand {
    /// Read a variable, or elements of an array
    Get {
        /// Name; of an array with its first element, such as 'g_positions(0)' or 'g_table(3,0)'
        name: String,
        /// The declared type
        #[arg(long = "type", value_name = "TYPE", ignore_case = true, value_parser = types())]
        kind: SpelType,
        /// How many elements of an array, 1–100
        #[arg(long, value_name = "COUNT")]
        count: Option<u16>,
        #[command(flatten)]
        watch: WatchArgs,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
    /// Set a variable that is no array
    Set {
        /// Name
        name: String,
        /// The new value; of a String as it is, without quotes
        #[arg(allow_hyphen_values = true)]
        value: String,
        /// The declared type
        #[arg(long = "type", value_name = "TYPE", ignore_case = true, value_parser = types())]
        kind: SpelType,
        #[command(flatten)]
        connection: ConnectionArgs,
    },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    On,
    Off,
}

fn types() -> impl TypedValueParser<Value = SpelType> {
    PossibleValuesParser::new(SpelType::ALL.map(SpelType::keyword))
        .try_map(|keyword| SpelType::from_keyword(&keyword).ok_or_else(|| keyword.clone()))
}

pub fn run(cli: &CommandContext, command: RemoteCommand) -> Result<CommandOutcome, Problem> {
    let invalid = || Problem::new(ErrorCode::RemoteRequestInvalid);
    let robot = |number| RobotNumber::new(number).ok_or_else(invalid);
    match command {
        RemoteCommand::Status { watch, connection } => read(cli, &connection, &watch, &Request::GetStatus),
        RemoteCommand::Info(connection) => identity(cli, &connection),
        RemoteCommand::LoginCheck(connection) => login_check(cli, &connection),
        RemoteCommand::Start { function, connection } => {
            let function = FunctionNumber::new(function).ok_or_else(invalid)?;
            once(cli, &connection, &Request::Start { function })
        }
        RemoteCommand::Stop(connection) => once(cli, &connection, &Request::Stop),
        RemoteCommand::Pause(connection) => once(cli, &connection, &Request::Pause),
        RemoteCommand::Continue(connection) => once(cli, &connection, &Request::Continue),
        RemoteCommand::Reset(connection) => once(cli, &connection, &Request::Reset),
        RemoteCommand::Motors { state, robot: number, connection } => {
            let robot = robot(number)?;
            let request = match state {
                Switch::On => Request::SetMotorsOn { robot },
                Switch::Off => Request::SetMotorsOff { robot },
            };
            once(cli, &connection, &request)
        }
        RemoteCommand::Home { robot: number, connection } => {
            once(cli, &connection, &Request::Home { robot: robot(number)? })
        }
        RemoteCommand::Robot { robot: None, connection } => once(cli, &connection, &Request::GetCurRobot),
        RemoteCommand::Robot { robot: Some(number), connection } => {
            once(cli, &connection, &Request::SetCurRobot { robot: robot(number)? })
        }
        RemoteCommand::Io(command) => io(cli, IoArea::Io, command),
        RemoteCommand::Mem(command) => io(cli, IoArea::Memory, command),
        RemoteCommand::Var(command) => variable(cli, command),
        RemoteCommand::Exec { text, connection } => {
            let bad = |error| Problem::with_detail(ErrorCode::RemoteRequestInvalid, error);
            once(cli, &connection, &Request::Execute { spel: SpelCommand::new(text).map_err(bad)? })
        }
        RemoteCommand::Abort(connection) => once(cli, &connection, &Request::Abort),
        RemoteCommand::Alarms { reset: None, connection } => once(cli, &connection, &Request::GetAlm),
        RemoteCommand::Alarms { reset: Some(number), connection } => {
            let alarm = AlarmNumber::new(number).ok_or_else(invalid)?;
            once(cli, &connection, &Request::ResetAlm { alarm })
        }
        RemoteCommand::Raw { text, connection } => once(cli, &connection, &raw(&text)?),
        RemoteCommand::Serve(args) => serve::run(&args),
    }
}

fn io(cli: &CommandContext, area: IoArea, command: IoCommand) -> Result<CommandOutcome, Problem> {
    match command {
        IoCommand::Get { number, unit, watch, connection } => {
            read(cli, &connection, &watch, &get_io(cli, area, unit.unit, number)?)
        }
        IoCommand::Set { number, value, unit, connection } => {
            once(cli, &connection, &set_io(cli, area, unit.unit, number, &value)?)
        }
    }
}

fn variable(cli: &CommandContext, command: VariableCommand) -> Result<CommandOutcome, Problem> {
    match command {
        VariableCommand::Get { name, kind, count, watch, connection } => {
            read(cli, &connection, &watch, &get_variable(cli, &name, kind, count)?)
        }
        VariableCommand::Set { name, value, kind, connection } => {
            once(cli, &connection, &set_variable(cli, &name, kind, &value)?)
        }
    }
}

/// A command in the text form, as a controller reads it.
fn raw(text: &str) -> Result<Request, Problem> {
    if text.contains(char::is_control) {
        return Err(Problem::with_detail(ErrorCode::RemoteRequestInvalid, EncodeError::ControlCharacter));
    }
    let mut decoder = text::RequestDecoder::default();
    let start = if text.starts_with('$') { "" } else { "$" };
    decoder.add(format!("{start}{text}\n").as_bytes());
    let request = decoder.next_line().map(|line| line.request);
    match request {
        Some(Ok(request)) => Ok(request),
        Some(Err(error)) => Err(Problem::with_detail(ErrorCode::RemoteRequestInvalid, error)),
        None => Err(ErrorCode::RemoteRequestInvalid.into()),
    }
}
