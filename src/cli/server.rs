use serde_json::json;

use super::batch::{Presentation, STATE, Shown};
use super::cell::Cell;
use super::select::Select;
use super::{CommandContext, Ending};
use crate::jobs::{Done, GetInfo, StartServer, StopServer};
use crate::model::{Problem, ServerCertificate};
use crate::texts::TextKey;

const INFO: Presentation<Done> = Presentation {
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
                (Cell::from(*kind), summary.not_after.format("%Y-%m-%d").to_string())
            }
            None => (Cell::from("-".to_owned()), "-".to_owned()),
        };
        Shown {
            json: json!(info),
            cells: vec![
                info.series.to_string().into(),
                info.serial.to_string().into(),
                info.firmware.to_string().into(),
                match info.error {
                    Some(code) => Cell::from(info.status).followed_by(format!(" ({})", code.as_str())),
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

pub fn info(cli: &CommandContext, select: &Select) -> Result<Ending, Problem> {
    let configuration = cli.configuration()?;
    cli.batch(&configuration, &select.resolve(&configuration)?, GetInfo, &INFO)
}

pub fn start(cli: &CommandContext, select: &Select) -> Result<Ending, Problem> {
    let configuration = cli.configuration()?;
    cli.batch(&configuration, &select.resolve(&configuration)?, StartServer, &STATE)
}

pub fn stop(cli: &CommandContext, select: &Select) -> Result<Ending, Problem> {
    let configuration = cli.configuration()?;
    cli.batch(&configuration, &select.resolve(&configuration)?, StopServer, &STATE)
}
