use serde_json::json;

use super::batch::{Presentation, STATE, Shown};
use super::select::Select;
use super::{Ending, Settled};
use crate::jobs::{GetInfo, StartServer, StopServer};
use crate::model::{Problem, ServerCertificate};

const INFO: Presentation = Presentation {
    header: &["TYPE", "SERIAL", "FIRMWARE", "STATUS", "CERTIFICATE", "EXPIRY", "ACTIVATED", "ENDPOINT"],
    show: |_, info| {
        let (kind, expiry) = match &info.certificate {
            Some(ServerCertificate { kind, summary }) => {
                (format!("{kind:?}"), summary.not_after.format("%Y-%m-%d").to_string())
            }
            None => ("-".to_owned(), "-".to_owned()),
        };
        Shown {
            json: json!(info),
            cells: vec![
                info.series.to_string(),
                info.serial.to_string(),
                info.firmware.to_string(),
                match info.error {
                    Some(code) => format!("{} ({})", info.status.as_str(), code.as_str()),
                    None => info.status.as_str().to_owned(),
                },
                kind,
                expiry,
                if info.activated { "Yes" } else { "No" }.to_owned(),
                info.endpoint.clone(),
            ],
        }
    },
};

pub fn info(settled: &Settled, select: &Select) -> Result<Ending, Problem> {
    let configuration = settled.configuration()?;
    settled.batch(&configuration, &select.resolve(&configuration)?, GetInfo, &INFO)
}

pub fn start(settled: &Settled, select: &Select) -> Result<Ending, Problem> {
    let configuration = settled.configuration()?;
    settled.batch(&configuration, &select.resolve(&configuration)?, StartServer, &STATE)
}

pub fn stop(settled: &Settled, select: &Select) -> Result<Ending, Problem> {
    let configuration = settled.configuration()?;
    settled.batch(&configuration, &select.resolve(&configuration)?, StopServer, &STATE)
}
