use clap::Subcommand;
use serde_json::json;

use super::output::json_path;
use super::{Ending, Settled};
use crate::model::Problem;
use crate::texts::cli as texts;

#[derive(Debug, Subcommand)]
pub enum BackupCommand {
    /// Keep copies of certificates made here, and of keys made on this computer
    On,
    /// Keep no copies
    Off,
    /// Say whether copies are kept, and where
    Show,
}

pub fn run(settled: &Settled, command: BackupCommand) -> Result<Ending, Problem> {
    let backup = match command {
        BackupCommand::Show => settled.configuration()?.options.backup,
        BackupCommand::On | BackupCommand::Off => {
            let lock = settled.lock()?;
            let mut configuration = settled.configuration()?;
            configuration.options.backup = matches!(command, BackupCommand::On);
            settled.workspace.save(&configuration, &lock)?;
            configuration.options.backup
        }
    };
    let root = settled.workspace.root();
    if settled.output.is_json() {
        settled.output.text(&json!({ "backup": backup, "folder": json_path(root) }).to_string());
    } else {
        settled.output.text(&texts::backup(settled.output.language(), backup, root.display()));
    }
    Ok(Ending::AllDone)
}
