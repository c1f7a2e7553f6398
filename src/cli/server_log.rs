use clap::Subcommand;
use serde_json::json;

use super::batch::{Presentation, PrintedResult, STATE};
use super::controller_selection::ControllerSelection;
use super::output::say;
use super::{CommandContext, CommandOutcome};
use crate::jobs::{BasicSettingsChange, LogPart, ReadLog, SetBasicSettings};
use crate::model::{LogChunk, Problem, untrusted_text};
use crate::texts::{TextKey, cli as texts};

#[derive(Debug, Subcommand)]
pub enum LogCommand {
    /// Show what the OPC UA server has logged; "settings set --server-log on" makes it log
    Show {
        /// The last 256 KiB only
        #[arg(long)]
        end: bool,
        #[command(flatten)]
        select: ControllerSelection,
    },
    /// Delete the server log; the OPC UA server is stopped, and started again if it was running
    Delete(ControllerSelection),
}

const LOG: Presentation<LogChunk> = Presentation {
    header: &[TextKey::HeadingLog],
    show: |log, _| PrintedResult {
        json: json!({ "size": log.size, "from": log.from, "next": log.next, "text": log.text }),
        cells: vec![log.size.to_string().into()],
    },
};

pub fn run(cli: &CommandContext, command: LogCommand) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    match command {
        LogCommand::Show { end, select } => {
            let part = if end { LogPart::End } else { LogPart::From(0) };
            let chosen = select.resolve(&configuration, cli.output.language())?;
            let reports = cli.reports(&configuration, &chosen, ReadLog { part }, &LOG)?;
            if !cli.output.is_json() {
                for (entry, report) in chosen.iter().zip(&reports) {
                    match &report.result {
                        Ok(log) if chosen.len() > 1 => {
                            let text = untrusted_text::lines(&log.text);
                            cli.output.text(&format!("==> {} <==\n{text}", entry.name));
                        }
                        Ok(log) if log.text.is_empty() => {}
                        Ok(log) => cli.output.text(&untrusted_text::lines(&log.text)),
                        Err(problem) => cli.output.explain(Some(entry.name.as_str()), problem),
                    }
                    if let Ok(log) = &report.result
                        && log.next < log.size
                    {
                        let read = log.next - log.from;
                        say(&texts::log_read(cli.output.language(), entry.name.as_str(), read, log.size));
                    }
                }
            }
            Ok(CommandOutcome::of(&reports))
        }
        LogCommand::Delete(select) => {
            let change = BasicSettingsChange { delete_log: true, ..BasicSettingsChange::default() };
            let operation = SetBasicSettings { change, ..SetBasicSettings::default() };
            cli.batch(&configuration, &select.resolve(&configuration, cli.output.language())?, operation, &STATE)
        }
    }
}
