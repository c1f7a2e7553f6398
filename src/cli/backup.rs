use clap::Subcommand;
use serde_json::json;

use super::output::json_path;
use super::{CommandContext, CommandOutcome};
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

pub fn run(cli: &CommandContext, command: BackupCommand) -> Result<CommandOutcome, Problem> {
    let backup = match command {
        BackupCommand::Show => cli.configuration()?.options.backup,
        BackupCommand::On | BackupCommand::Off => {
            let lock = cli.lock()?;
            let mut configuration = cli.configuration()?;
            configuration.options.backup = matches!(command, BackupCommand::On);
            cli.workspace.save(&configuration, &lock)?;
            configuration.options.backup
        }
    };
    let root = cli.workspace.root();
    if cli.output.is_json() {
        cli.output.text(&json!({ "backup": backup, "folder": json_path(root) }).to_string());
    } else {
        cli.output.text(&texts::backup(cli.output.language(), backup, root.display()));
    }
    Ok(CommandOutcome::AllDone)
}
