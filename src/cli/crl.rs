use std::path::Path;

use clap::Subcommand;
use serde_json::json;

use super::batch::{Presentation, PrintedResult};
use super::client_certificates::{CHANGE, hexadecimal, listing};
use super::controller_selection::{ControllerSelection, ItemsThenControllers};
use super::table_cell::TableCell;
use super::trust_files::{read_trust_files, show_plan};
use super::{CommandContext, CommandOutcome};
use crate::jobs::{AddTrust, Destination, ListTrust, RemoveCrls, TrustSnapshot};
use crate::model::{Language, ListedCrl, Problem};
use crate::pki::CrlHealth;
use crate::texts::{TextKey, cli as texts, crl_flaws};

#[derive(Debug, Subcommand)]
pub enum CrlCommand {
    /// List CRLs, by whose certificates clients are refused that their authority revoked
    List(ControllerSelection),
    /// Add CRLs; one takes the place of an older one of the same issuer: FILE… CONTROLLER…
    Add(ItemsThenControllers),
    /// Remove CRLs by the ids that list shows: ID… CONTROLLER…
    Remove(ItemsThenControllers),
}

const CRLS: Presentation<TrustSnapshot> = Presentation {
    header: &[TextKey::HeadingCrls],
    show: |held, _| {
        let with_health = || held.crls.iter().zip(&held.health.crls);
        let json: Vec<_> = with_health()
            .map(|(crl, health)| {
                json!({ "file_name": crl.file_name, "crl": crl.summary, "added": crl.added, "health": health })
            })
            .collect();
        let json = json!({ "revision": held.revision, "crls": json, "without_crl": held.health.without_crl });
        PrintedResult {
            json,
            cells: vec![TableCell::said(|language| {
                listing(with_health().map(|(crl, health)| line(crl, health, language)))
            })],
        }
    },
};

fn line(crl: &ListedCrl, health: &CrlHealth, language: Language) -> String {
    let summary = &crl.summary;
    let until = summary.next_update.map(|next| next.format("%Y-%m-%d").to_string());
    texts::crl_line(language, &summary.id, &summary.issuer, summary.entries, until, &crl_flaws(health))
}

pub fn run(cli: &CommandContext, command: CrlCommand) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    match command {
        CrlCommand::List(select) => {
            cli.batch(&configuration, &select.resolve(&configuration, cli.output.language())?, ListTrust, &CRLS)
        }
        CrlCommand::Add(arguments) => {
            let (files, chosen) = arguments.resolve(&configuration, cli.output.language())?;
            let destination = Destination::Crls;
            let files = read_trust_files(files.iter().map(Path::new), destination, cli.output.language())?;
            show_plan(cli, &files, destination, &chosen)?;
            let operation = AddTrust { files: files.into(), destination, based_on: None };
            cli.batch(&configuration, &chosen, operation, &CHANGE)
        }
        CrlCommand::Remove(arguments) => {
            let (ids, chosen) = arguments.resolve(&configuration, cli.output.language())?;
            let operation = RemoveCrls { ids: hexadecimal(&ids, cli.output.language())?, based_on: None };
            cli.batch(&configuration, &chosen, operation, &CHANGE)
        }
    }
}
