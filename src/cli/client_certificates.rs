use std::path::Path;

use chrono::{DateTime, Utc};
use clap::{Args, Subcommand, ValueEnum};
use serde_json::{Value, json};

use super::batch::{Presentation, PrintedResult};
use super::controller_selection::{ControllerSelection, ItemsThenControllers};
use super::table_cell::TableCell;
use super::trust_files::{read_trust_files, show_move, show_plan};
use super::{CommandContext, CommandOutcome};
use crate::jobs::{AddTrust, Destination, ListTrust, MoveClients, RemoveClients, TrustChange, TrustSnapshot};
use crate::model::{ClientList, ErrorCode, Language, ListedCertificate, Problem};
use crate::pki::RejectedClient;
use crate::texts::{TextKey, cli as texts, client_list};

#[derive(Debug, Subcommand)]
pub enum ClientsCommand {
    /// List the certificates of clients that may connect, of authorities, and of clients that were refused
    List(ListArgs),
    /// Add certificates of clients that may connect, or of authorities, and CRLs that come with them: FILE… CONTROLLER…
    Add {
        /// Where certificates go; without it, each goes where certificates of its kind belong
        #[arg(long, value_enum)]
        list: Option<AddDestinationArg>,
        #[command(flatten)]
        arguments: ItemsThenControllers,
    },
    /// Remove certificates from every list they are in: THUMBPRINT… CONTROLLER…
    Remove(ItemsThenControllers),
    /// Let in clients that were refused: THUMBPRINT… CONTROLLER…
    Trust(ItemsThenControllers),
}

#[derive(Debug, Args)]
pub struct ListArgs {
    /// Only this list
    #[arg(long, value_enum)]
    list: Option<ClientListArg>,
    #[command(flatten)]
    select: ControllerSelection,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ClientListArg {
    Trusted,
    Rejected,
    /// Current firmware only
    Issuers,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum AddDestinationArg {
    Trusted,
    /// Current firmware only
    Issuers,
}

const ALL_LISTS: Presentation<TrustSnapshot> = Presentation {
    header: &[TextKey::HeadingCertificates],
    show: |held, _| shown(held, &[ClientList::Trusted, ClientList::Issuers, ClientList::Rejected]),
};
const TRUSTED: Presentation<TrustSnapshot> =
    Presentation { header: &[TextKey::HeadingTrusted], show: |held, _| shown(held, &[ClientList::Trusted]) };
const ISSUERS: Presentation<TrustSnapshot> =
    Presentation { header: &[TextKey::HeadingIssuers], show: |held, _| shown(held, &[ClientList::Issuers]) };
const REJECTED: Presentation<TrustSnapshot> =
    Presentation { header: &[TextKey::HeadingRejected], show: |held, _| shown(held, &[ClientList::Rejected]) };

/// What a list holds in one cell.
pub fn listing(lines: impl Iterator<Item = String>) -> String {
    let lines: Vec<String> = lines.collect();
    if lines.is_empty() { "-".to_owned() } else { lines.join("; ") }
}

fn shown(held: &TrustSnapshot, lists: &[ClientList]) -> PrintedResult {
    let mut json = json!({ "revision": held.revision });
    for list in lists {
        json[list.as_str()] = match list {
            ClientList::Trusted => held.trusted.iter().map(entry).collect(),
            ClientList::Issuers => held.issuers.iter().map(entry).collect(),
            ClientList::Rejected => held.rejected.iter().map(refused).collect(),
        };
    }
    let said = |language| {
        listing(lists.iter().flat_map(|list| {
            let lines = lines(held, *list, language);
            let several = lists.len() > 1;
            let named = move |line: String| texts::in_list(language, client_list(*list), &line);
            lines.into_iter().map(move |line| if several { named(line) } else { line })
        }))
    };
    PrintedResult { json, cells: vec![TableCell::said(said)] }
}

fn lines(held: &TrustSnapshot, list: ClientList, language: Language) -> Vec<String> {
    match list {
        ClientList::Trusted => held.trusted.iter().map(|listed| line(listed, language)).collect(),
        ClientList::Issuers => held.issuers.iter().map(|listed| line(listed, language)).collect(),
        ClientList::Rejected => held.rejected.iter().map(|rejected| refused_line(rejected, language)).collect(),
    }
}

fn entry(listed: &ListedCertificate) -> Value {
    json!({ "file_name": listed.file_name, "certificate": listed.summary, "added": listed.added })
}

fn line(listed: &ListedCertificate, language: Language) -> String {
    let summary = &listed.summary;
    let until = summary.not_after.format("%Y-%m-%d").to_string();
    texts::certificate_line(language, &summary.thumbprint, &summary.issued_to, &until)
}

fn refused(rejected: &RejectedClient) -> Value {
    json!({
        "certificate": rejected.summary,
        "status": rejected.status,
        "reason": rejected.reason,
        "cause": rejected.cause,
        "remedy": rejected.cause.as_ref().map(|cause| cause.flaw.remedy(Language::En)),
        "address": rejected.address,
        "count": rejected.count,
        "first_seen": rejected.first_seen,
        "last_seen": rejected.last_seen,
    })
}

fn refused_line(rejected: &RejectedClient, language: Language) -> String {
    let time = |at: &DateTime<Utc>| at.format("%Y-%m-%d %H:%M:%S").to_string();
    let (first, last) = (time(&rejected.first_seen), time(&rejected.last_seen));
    let times = match rejected.count {
        0 => TextKey::TrustMovedHere.text(language).to_owned(),
        count => crate::texts::refused_times(language, &rejected.address, count, &first, &last),
    };
    let why = format!("{} ({})", rejected.explain(language), rejected.status);
    texts::refused_line(language, &rejected.summary.thumbprint, &rejected.summary.issued_to, &why, &times)
}

/// A change of lists or CRLs: how many there are now, and who was disconnected.
pub const CHANGE: Presentation<TrustChange> = Presentation {
    header: &[
        TextKey::HeadingStatus,
        TextKey::HeadingRevision,
        TextKey::HeadingTrusted,
        TextKey::HeadingIssuers,
        TextKey::HeadingRejected,
        TextKey::HeadingCrls,
        TextKey::HeadingDisconnected,
    ],
    show: |TrustChange { lists, cut, undo: _ }, info| {
        let counts = [lists.trusted.len(), lists.issuers.len(), lists.rejected.len(), lists.crls.len()];
        let json = json!({
            "status": info.status,
            "revision": lists.revision,
            "trusted": counts[0],
            "issuers": counts[1],
            "rejected": counts[2],
            "crls": counts[3],
            "disconnected": cut,
        });
        let mut cells: Vec<TableCell> = vec![info.status.into(), lists.revision.to_string().into()];
        cells.extend(counts.map(|count| count.to_string().into()));
        let gone: Vec<String> = cut.iter().map(|cut| format!("{} ({})", cut.issued_to, cut.address)).collect();
        cells.push(if gone.is_empty() { "-".to_owned() } else { gone.join(", ") }.into());
        PrintedResult { json, cells }
    },
};

pub fn run(cli: &CommandContext, command: ClientsCommand) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    match command {
        ClientsCommand::List(ListArgs { list, select }) => {
            let presentation = match list {
                None => &ALL_LISTS,
                Some(ClientListArg::Trusted) => &TRUSTED,
                Some(ClientListArg::Rejected) => &REJECTED,
                Some(ClientListArg::Issuers) => &ISSUERS,
            };
            cli.batch(&configuration, &select.resolve(&configuration, cli.output.language())?, ListTrust, presentation)
        }
        ClientsCommand::Add { list, arguments } => {
            let (files, chosen) = arguments.resolve(&configuration, cli.output.language())?;
            let destination = match list {
                None => Destination::ByKind,
                Some(AddDestinationArg::Trusted) => Destination::Trusted,
                Some(AddDestinationArg::Issuers) => Destination::Issuers,
            };
            let files = read_trust_files(files.iter().map(Path::new), destination, cli.output.language())?;
            show_plan(cli, &files, destination, &chosen)?;
            let operation = AddTrust { files: files.into(), destination, based_on: None };
            cli.batch(&configuration, &chosen, operation, &CHANGE)
        }
        ClientsCommand::Remove(arguments) => {
            let (thumbprints, chosen) = arguments.resolve(&configuration, cli.output.language())?;
            let thumbprints = hexadecimal(&thumbprints, cli.output.language())?;
            let operation = RemoveClients { list: None, thumbprints, based_on: None };
            cli.batch(&configuration, &chosen, operation, &CHANGE)
        }
        ClientsCommand::Trust(arguments) => {
            let (thumbprints, chosen) = arguments.resolve(&configuration, cli.output.language())?;
            let (from, to, thumbprints) =
                (ClientList::Rejected, ClientList::Trusted, hexadecimal(&thumbprints, cli.output.language())?);
            let mut accept_notes = cli.yes;
            if !cli.output.is_json() {
                let reports = cli.reports(&configuration, &chosen, ListTrust, &REJECTED)?;
                let held = chosen.iter().zip(&reports);
                let held = held.filter_map(|(entry, report)| Some((entry, report.result.as_ref().ok()?)));
                show_move(cli, to, &thumbprints, &held.collect::<Vec<_>>())?;
                accept_notes = true;
            }
            let operation = MoveClients { from, to, thumbprints, accept_notes, based_on: None };
            cli.batch(&configuration, &chosen, operation, &CHANGE)
        }
    }
}

/// SHA-1 values as a person may have copied them: any case, with blanks or colons between the bytes. Each once.
pub fn hexadecimal(given: &[String], language: Language) -> Result<Vec<String>, Problem> {
    let mut all: Vec<String> = Vec::new();
    for text in given {
        let plain: String = text.chars().filter(|c| !matches!(c, ':' | ' ' | '-')).collect();
        if plain.len() != 40 || !plain.bytes().all(|b| b.is_ascii_hexdigit()) {
            return Err(Problem::with_detail(ErrorCode::NotInList, texts::digits_needed(language, text)));
        }
        let plain = plain.to_ascii_uppercase();
        if !all.contains(&plain) {
            all.push(plain);
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thumbprint_is_taken_as_other_tools_show_it() {
        let plain = "00112233445566778899AABBCCDDEEFF00112233".to_owned();
        let colons = "00:11:22:33:44:55:66:77:88:99:aa:bb:cc:dd:ee:ff:00:11:22:33".to_owned();
        assert_eq!(hexadecimal(&[plain.clone(), colons], Language::En).unwrap(), std::slice::from_ref(&plain));
        for wrong in ["", "0011", &format!("{plain}00"), &plain.replace('A', "G")] {
            assert_eq!(
                hexadecimal(&[wrong.to_owned()], Language::En).unwrap_err().code,
                ErrorCode::NotInList,
                "{wrong}"
            );
        }
    }
}
