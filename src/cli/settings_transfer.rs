use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::batch::{Presentation, PrintedResult};
use super::controller_selection::ControllerSelection;
use super::output::json_path;
use super::secret_file::read_secret;
use super::{CommandContext, CommandOutcome};
use crate::jobs::{ExportSettings, ImportSettings, SettingsExported, SettingsImported};
use crate::model::Problem;
use crate::texts::TextKey;
use crate::workspace::check_passphrase;

#[derive(Debug, Args)]
pub struct TransferArgs {
    /// File with the passphrase that protects the exports, at least 8 characters, "-" for standard input; without it
    /// the connection password does, unless it is empty
    #[arg(long, value_name = "FILE")]
    passphrase_file: Option<PathBuf>,
    #[command(flatten)]
    select: ControllerSelection,
}

const EXPORTED: Presentation<SettingsExported> = Presentation {
    header: &[TextKey::HeadingSerial, TextKey::HeadingFile],
    show: |SettingsExported { path }, info| PrintedResult {
        json: json!({ "serial": info.serial, "file": json_path(path) }),
        cells: vec![info.serial.to_string().into(), path.display().to_string().into()],
    },
};

const IMPORTED: Presentation<SettingsImported> = Presentation {
    header: &[TextKey::HeadingStatus, TextKey::HeadingRevision, TextKey::HeadingFile],
    show: |SettingsImported { path }, info| PrintedResult {
        json: json!({ "status": info.status, "revision": info.revision, "file": json_path(path) }),
        cells: vec![info.status.into(), info.revision.to_string().into(), path.display().to_string().into()],
    },
};

pub fn export(cli: &CommandContext, args: &TransferArgs) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    let chosen = args.select.resolve(&configuration, cli.output.language())?;
    let passphrase = args.passphrase_file.as_ref().map(|f| read_secret(f)).transpose()?;
    passphrase.as_ref().map_or(Ok(()), check_passphrase)?;
    let operation = ExportSettings { files: cli.workspace.settings_files(), passphrase };
    cli.batch(&configuration, &chosen, operation, &EXPORTED)
}

pub fn import(cli: &CommandContext, args: &TransferArgs) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    let chosen = args.select.resolve(&configuration, cli.output.language())?;
    let passphrase = args.passphrase_file.as_ref().map(|f| read_secret(f)).transpose()?;
    let operation = ImportSettings { files: cli.workspace.settings_files(), passphrase };
    cli.batch(&configuration, &chosen, operation, &IMPORTED)
}
