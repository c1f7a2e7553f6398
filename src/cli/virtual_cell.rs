//! Commands to the cells of virtual controllers that run in another process: safety, modes, inputs, recordings.

use std::path::PathBuf;

use clap::Args;

use super::CommandOutcome;
use super::virtual_switch::Chosen;
use crate::model::{ErrorCode, Problem, SerialNumber};
use crate::virtual_controller::cell::CellCommand;
use crate::virtual_controller::{PlantAnswer, PlantError, ask_plant};

#[derive(Debug, Args)]
pub struct CellArgs {
    /// The folder that "virtual --data" was given; that of the window's virtual controllers is "virtual" in the workspace
    #[arg(long, value_name = "DIR")]
    data: PathBuf,
    /// What to do, in this order: start N, stop, pause, continue, reset, motors-on ROBOT, motors-off ROBOT, home ROBOT, power
    /// ROBOT high|low, speed PERCENT, step-mode on|off, step, emergency-stop on|off, door open|closed, mode auto|teach|test,
    /// error NUMBER, warning NUMBER, bit PORT OFFSET on|off, byte PORT OFFSET VALUE, record-start ROBOT SECONDS INTERVAL,
    /// record-end MONITOR, record-break MONITOR, motion-log on|off|break, wear-out ALARM, reset-alarm ALARM, abort; robot 0
    /// stands for all robots
    #[arg(long = "do", value_name = "COMMAND", value_parser = checked)]
    commands: Vec<String>,
    #[command(flatten)]
    chosen: Chosen,
}

/// A command as it was typed, if it is one.
fn checked(text: &str) -> Result<String, String> {
    text.parse::<CellCommand>().map(|_| text.to_owned()).map_err(|error| error.to_string())
}

/// Gives the commands to each cell, and prints one line of JSON about it. A refused command ends the commands to its cell.
pub fn run(args: &CellArgs) -> Result<CommandOutcome, Problem> {
    let mut outcome = CommandOutcome::AllDone;
    for serial in args.chosen.serials(&args.data)? {
        let answer = args.act(&serial).map_err(problem)?;
        if answer.refused.is_some() {
            outcome = CommandOutcome::SomeFailed;
        }
        let mut line = answer.state;
        line["serial"] = serial.as_str().into();
        line["refused"] = answer.refused.into();
        super::output::line(&line.to_string());
    }
    Ok(outcome)
}

impl CellArgs {
    fn act(&self, serial: &SerialNumber) -> Result<PlantAnswer, PlantError> {
        for command in &self.commands {
            let answer = ask_plant(&self.data, serial, Some(command))?;
            if answer.refused.is_some() {
                return Ok(answer);
            }
        }
        ask_plant(&self.data, serial, None)
    }
}

fn problem(error: PlantError) -> Problem {
    let code = match &error {
        PlantError::NotRunning { .. } => ErrorCode::FileUnreadable,
        PlantError::Connection(_) => ErrorCode::Unreachable,
        PlantError::Refused(_) => ErrorCode::UnknownController,
    };
    Problem::with_detail(code, error)
}
