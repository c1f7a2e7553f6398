//! What goes wrong in virtual controllers that run in another process.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use super::CommandOutcome;
use crate::model::{ErrorCode, Problem, SerialNumber};
use crate::virtual_controller::{OutsideSwitches, Switchboard};
use crate::workspace::write_atomic;

#[derive(Debug, Args)]
pub struct SwitchArgs {
    /// The folder that "virtual --data" was given; that of the window's virtual controllers is "virtual" in the workspace
    #[arg(long, value_name = "DIR")]
    data: PathBuf,
    /// A program runs: changes, start and stop are refused
    #[arg(long, value_name = "on|off", value_parser = super::basic_settings::on_off)]
    task_running: Option<bool>,
    /// A teach pendant is connected: changes, start and stop are refused
    #[arg(long, value_name = "on|off", value_parser = super::basic_settings::on_off)]
    teach_pendant: Option<bool>,
    /// The OPC UA server fails with error 580 when it is started
    #[arg(long, value_name = "on|off", value_parser = super::basic_settings::on_off)]
    server_error: Option<bool>,
    #[command(flatten)]
    chosen: Chosen,
}

/// Which of the controllers in a folder.
#[derive(Debug, Args)]
pub struct Chosen {
    /// Every controller in the folder
    #[arg(long, conflicts_with = "serials")]
    all: bool,
    /// Serial numbers
    #[arg(required_unless_present = "all", value_name = "SERIAL")]
    serials: Vec<String>,
}

/// Writes the switches, and one line of JSON about each controller.
pub fn run(args: &SwitchArgs) -> Result<CommandOutcome, Problem> {
    let unreadable =
        |e: std::io::Error| Problem::with_detail(ErrorCode::FileUnreadable, format!("{}: {e}", args.data.display()));
    let chosen = args.chosen.serials(&args.data)?;
    let mut board = Switchboard::load(&args.data).map_err(unreadable)?;
    for serial in &chosen {
        let OutsideSwitches { task_running, teach_pendant, server_error } = board.0.entry(serial.clone()).or_default();
        for (switch, wanted) in
            [(task_running, args.task_running), (teach_pendant, args.teach_pendant), (server_error, args.server_error)]
        {
            *switch = wanted.unwrap_or(*switch);
        }
    }
    let json = serde_json::to_vec_pretty(&board).map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?;
    write_atomic(&Switchboard::path(&args.data), &json)?;
    for serial in &chosen {
        let switches = board.0.get(serial).copied().unwrap_or_default();
        let mut line = json!(switches);
        line["serial"] = json!(serial);
        super::output::line(&line.to_string());
    }
    Ok(CommandOutcome::AllDone)
}

impl Chosen {
    /// Their serial numbers. Errors: a controller that is not in the folder, or a folder that cannot be read.
    pub fn serials(&self, data: &Path) -> Result<Vec<SerialNumber>, Problem> {
        if self.all {
            return controllers(data).map_err(|error| {
                Problem::with_detail(ErrorCode::FileUnreadable, format!("{}: {error}", data.display()))
            });
        }
        let unknown = |serial: &str| Problem::with_detail(ErrorCode::UnknownController, data.join(serial).display());
        let known = |text: &String| match text.parse::<SerialNumber>() {
            Ok(serial) if data.join(serial.folder_name()).is_dir() => Ok(serial),
            _ => Err(unknown(text)),
        };
        self.serials.iter().map(known).collect()
    }
}

/// Each controller has a folder named by its serial number.
fn controllers(data: &Path) -> std::io::Result<Vec<SerialNumber>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(data)? {
        let entry = entry?;
        if entry.file_type()?.is_dir() {
            found.extend(entry.file_name().to_str().and_then(|name| name.parse().ok()));
        }
    }
    found.sort();
    Ok(found)
}
