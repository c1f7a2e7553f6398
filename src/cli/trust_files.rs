//! Files with certificates and CRLs on the command line: read, and shown where they go before anything is sent.

use std::io::{IsTerminal as _, Write as _};
use std::path::Path;

use super::output::say;
use super::table::table;
use super::{CommandContext, read_bounded};
use crate::jobs::{
    Destination, ItemContent, PlannedAction, TargetList, TrustFile, TrustNote, TrustPlan, TrustSnapshot,
};
use crate::model::{
    Capabilities, ClientList, ErrorCode, Feature, Language, ListLimits, MissingReason, Problem, clock, with_sources,
};
use crate::pki::{MAX_BUNDLE_BYTES, read_bundle};
use crate::session;
use crate::texts::{TextKey, cli as texts};
use crate::workspace::ControllerEntry;

/// Reads them all; one that is no good, or has no CRL where CRLs are asked for, makes the request wrong.
pub fn read_trust_files<'a>(
    paths: impl Iterator<Item = &'a Path>,
    destination: Destination,
    language: Language,
) -> Result<Vec<TrustFile>, Problem> {
    let crls_only = destination == Destination::Crls;
    let code = if crls_only { ErrorCode::BadCrl } else { ErrorCode::BadCertificate };
    paths
        .map(|path| {
            let bad = |why: String| Problem::with_detail(code, format!("{}: {why}", path.display()));
            let bytes = read_bounded(path, MAX_BUNDLE_BYTES)?;
            let bundle = read_bundle(&bytes).map_err(|error| bad(with_sources(&error)))?;
            if crls_only && bundle.crls.is_empty() {
                return Err(bad(texts::only_certificates(language)));
            }
            let file_name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
            Ok(TrustFile { file_name, bundle })
        })
        .collect()
}

/// Says what goes where, and asks if there is anything a person should think about.
///
/// One plan for the chosen controllers with an issuers list and one for those without; what the controllers already
/// hold is found out later.
pub fn show_plan(
    cli: &CommandContext,
    files: &[TrustFile],
    destination: Destination,
    chosen: &[ControllerEntry],
) -> Result<(), Problem> {
    let now = clock::now();
    let mut unclear = false;
    let language = cli.output.language();
    let without = Capabilities::all().without(&[Feature::IssuersList], MissingReason::FirmwareTooOld);
    for (capabilities, limits) in [(Capabilities::all(), ListLimits::LARGEST), (without, ListLimits::WITHOUT_ISSUERS)] {
        let has_issuers_list = capabilities.offers(Feature::IssuersList);
        let concerned = chosen.iter().any(|entry| {
            // A controller that was never read may have one or not.
            entry.last.as_ref().is_none_or(|last| {
                session::capabilities(entry.connection, Some(&last.info)).offers(Feature::IssuersList)
                    == has_issuers_list
            })
        });
        if !concerned {
            continue;
        }
        let plan = TrustPlan::new(files, destination, &capabilities, limits, now, None);
        unclear |= plan.needs_a_look();
        if plan.needs_a_look() && !cli.output.is_json() {
            let headings = [TextKey::HeadingFile, TextKey::HeadingWhat, TextKey::HeadingGoesTo, TextKey::HeadingNote];
            let plan = table(&headings.map(|heading| heading.text(language)), &rows(&plan, language));
            say(&texts::over_plan(language, texts::controllers_with(has_issuers_list), &plan));
        }
    }
    if unclear { agreed(cli) } else { Ok(()) }
}

/// Whether the printed plan is agreed to: with `--yes`, or by a person at the terminal.
fn agreed(cli: &CommandContext) -> Result<(), Problem> {
    if cli.yes {
        return Ok(());
    }
    if !std::io::stdin().is_terminal() {
        return Err(ErrorCode::NotConfirmed.into());
    }
    eprint!("{} ", TextKey::CliGoOn.text(cli.output.language()));
    let mut answer = String::new();
    let read = std::io::stderr().flush().and_then(|()| std::io::stdin().read_line(&mut answer));
    match (read, answer.trim()) {
        (Ok(_), "y" | "Y" | "yes") => Ok(()),
        _ => Err(ErrorCode::Cancelled.into()),
    }
}

/// Says what there is to think about before these certificates are moved into a list, and asks if there is anything.
pub fn show_move(
    cli: &CommandContext,
    to: ClientList,
    thumbprints: &[String],
    held: &[(&ControllerEntry, &TrustSnapshot)],
) -> Result<(), Problem> {
    let mut rows = Vec::new();
    for (entry, lists) in held {
        for (thumbprint, notes) in lists.notes_of_move(to, thumbprints) {
            rows.push(vec![entry.name.to_string(), thumbprint, words(&notes, cli.output.language())]);
        }
    }
    if rows.is_empty() {
        return Ok(());
    }
    let headings = [TextKey::HeadingName, TextKey::HeadingCertificates, TextKey::HeadingNote];
    say(&table(&headings.map(|heading| heading.text(cli.output.language())), &rows));
    agreed(cli)
}

fn rows(plan: &TrustPlan, language: Language) -> Vec<Vec<String>> {
    plan.items
        .iter()
        .map(|item| {
            let what = match &item.content {
                ItemContent::Certificate { summary, authority: true, .. } => {
                    texts::authority(language, &summary.issued_to)
                }
                ItemContent::Certificate { summary, .. } => texts::application(language, &summary.issued_to),
                ItemContent::Crl { summary, .. } => texts::crl_of(language, &summary.issuer),
            };
            let (to, note) = match &item.action {
                PlannedAction::Send { to, notes } => (target(*to).text(language), words(notes, language)),
                PlannedAction::Skipped(reason) => ("-", crate::texts::skipped_thing(*reason).text(language).to_owned()),
                PlannedAction::Refused(problem) => ("-", problem.in_one_line(language)),
            };
            vec![item.file_name.clone(), what, to.to_owned(), note]
        })
        .collect()
}

const fn target(target: TargetList) -> TextKey {
    match target {
        TargetList::Trusted => TextKey::HeadingTrusted,
        TargetList::Issuers => TextKey::HeadingIssuers,
        TargetList::Crls => TextKey::HeadingCrls,
    }
}

fn words(notes: &[TrustNote], language: Language) -> String {
    notes.iter().map(|note| note.text(language)).collect::<Vec<_>>().join("; ")
}
