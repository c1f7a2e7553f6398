use chrono::NaiveDateTime;
use clap::Args;
use serde_json::{Value as Json, json};

use super::super::table::table;
use super::super::{CommandContext, CommandOutcome, runtime};
use super::print_failure;
use super::target::TargetArgs;
use crate::fins::client::{ClientError, FinsClient, Nodes};
use crate::fins::codec::cpu::{ControllerData, CpuStatus, PlcErrorKind};
use crate::model::{Language, Problem};
use crate::texts::TextKey;

#[derive(Debug, Args)]
pub struct StatusArgs {
    #[command(flatten)]
    target: TargetArgs,
}

/// What a PLC says of itself. Clock and controller data are missing in some models.
struct PlcReport {
    nodes: Option<Nodes>,
    status: CpuStatus,
    data: Option<ControllerData>,
    clock: Option<NaiveDateTime>,
}

pub fn run(cli: &CommandContext, args: &StatusArgs) -> Result<CommandOutcome, Problem> {
    let (mut client, plc) = args.target.client()?;
    match runtime()?.block_on(report(&mut client)) {
        Ok(report) => {
            cli.output.cli("plc", &plc, &Ok((report.as_json(), report.as_text(cli.output.language()))));
            Ok(CommandOutcome::AllDone)
        }
        Err(error) => {
            print_failure(cli, &plc, error.clone().into(), Some(&error), None);
            Ok(CommandOutcome::SomeFailed)
        }
    }
}

async fn report(client: &mut FinsClient) -> Result<PlcReport, ClientError> {
    let status = client.status().await?;
    let data = offered(client.controller_data().await)?;
    let clock = offered(client.clock().await)?;
    Ok(PlcReport { nodes: client.nodes(), status, data, clock })
}

/// `None` where the PLC refuses the command.
fn offered<T>(result: Result<T, ClientError>) -> Result<Option<T>, ClientError> {
    match result {
        Ok(value) => Ok(Some(value)),
        Err(ClientError::EndCode { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}

impl PlcReport {
    fn as_json(&self) -> Json {
        let Self { nodes, status, data, clock } = self;
        let names = |kinds: &mut dyn Iterator<Item = PlcErrorKind>| -> Vec<String> {
            kinds.map(|kind| kind.text(Language::En).to_owned()).collect()
        };
        json!({
            "model": data.as_ref().map(|data| &data.model),
            "version": data.as_ref().map(|data| &data.version),
            "mode": status.mode.to_string(),
            "running": status.is_running,
            "standby": status.is_on_standby,
            "fatal_errors": names(&mut status.fatal()),
            "non_fatal_errors": names(&mut status.non_fatal()),
            "error_code": format!("{:04X}", status.error_code),
            "error_message": status.error_message,
            "clock": clock.map(|clock| clock.to_string()),
            "client_node": nodes.map(|nodes| nodes.client),
            "server_node": nodes.map(|nodes| nodes.server),
        })
    }

    fn as_text(&self, language: Language) -> String {
        let Self { nodes, status, data, clock } = self;
        let listed = |kinds: &mut dyn Iterator<Item = PlcErrorKind>| {
            let kinds: Vec<&str> = kinds.map(|kind| kind.text(language)).collect();
            if kinds.is_empty() { TextKey::FinsNone.text(language).to_owned() } else { kinds.join(", ") }
        };
        let program = if status.is_running { TextKey::FinsProgramRuns } else { TextKey::FinsProgramStands };
        let data = |part: fn(&ControllerData) -> &String| data.as_ref().map(|data| part(data).clone());
        let rows = [
            (TextKey::FinsModel, data(|data| &data.model)),
            (TextKey::FinsVersion, data(|data| &data.version)),
            (TextKey::FinsMode, Some(status.mode.to_string())),
            (TextKey::FinsProgram, Some(program.text(language).to_owned())),
            (TextKey::FinsFatalErrors, Some(listed(&mut status.fatal()))),
            (TextKey::FinsNonFatalErrors, Some(listed(&mut status.non_fatal()))),
            (TextKey::FinsErrorMessage, Some(status.error_message.clone()).filter(|message| !message.is_empty())),
            (TextKey::FinsClock, clock.map(|clock| clock.to_string())),
            (TextKey::FinsNodes, nodes.map(|nodes| format!("{}, {}", nodes.client, nodes.server))),
        ];
        let rows: Vec<Vec<String>> =
            rows.into_iter().filter_map(|(label, value)| Some(vec![label.text(language).to_owned(), value?])).collect();
        table(&["", ""], &rows).trim_start_matches('\n').to_owned()
    }
}
