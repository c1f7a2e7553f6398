use serde_json::json;

use super::batch::{Presentation, PrintedResult, STATE};
use super::controller_selection::ControllerSelection;
use super::table_cell::TableCell;
use super::{CommandContext, CommandOutcome};
use crate::jobs::{GetInfo, NoOutput, StartServer, StopServer};
use crate::model::{Problem, ServerCertificate};
use crate::texts::TextKey;

const INFO: Presentation<NoOutput> = Presentation {
    header: &[
        TextKey::HeadingType,
        TextKey::HeadingSerial,
        TextKey::HeadingFirmware,
        TextKey::HeadingStatus,
        TextKey::HeadingCertificate,
        TextKey::HeadingExpiry,
        TextKey::HeadingActivated,
        TextKey::HeadingEndpoint,
    ],
    show: |_, info| {
        let (kind, expiry) = match &info.certificate {
            Some(ServerCertificate { kind, summary }) => {
                (TableCell::from(*kind), summary.not_after.format("%Y-%m-%d").to_string())
            }
            None => (TableCell::from("-".to_owned()), "-".to_owned()),
        };
        PrintedResult {
            json: json!(info),
            cells: vec![
                info.series.to_string().into(),
                info.serial.to_string().into(),
                info.firmware.to_string().into(),
                match info.error {
                    Some(code) => TableCell::from(info.status).followed_by(format!(" ({})", code.as_str())),
                    None => info.status.into(),
                },
                kind,
                expiry.into(),
                info.activated.into(),
                info.endpoint.clone().into(),
            ],
        }
    },
};

pub fn info(cli: &CommandContext, select: &ControllerSelection) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    cli.batch(&configuration, &select.resolve(&configuration, cli.output.language())?, GetInfo, &INFO)
}

pub fn start(cli: &CommandContext, select: &ControllerSelection) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    cli.batch(&configuration, &select.resolve(&configuration, cli.output.language())?, StartServer, &STATE)
}

pub fn stop(cli: &CommandContext, select: &ControllerSelection) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    cli.batch(&configuration, &select.resolve(&configuration, cli.output.language())?, StopServer, &STATE)
}
