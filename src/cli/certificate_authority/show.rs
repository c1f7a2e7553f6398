use std::path::Path;

use chrono::{DateTime, Utc};
use serde_json::{Value, json};

use crate::cli::output::json_path;
use crate::cli::table::table;
use crate::cli::{CommandContext, CommandOutcome};
use crate::model::{Language, Problem, clock};
use crate::pki::{CrlFlaw, crl_date_flaw, validity_flaw};
use crate::texts::TextKey;
use crate::workspace::authority::{AuthorityOverview, IssuedCertificate, PublishedAuthority};

pub fn run(cli: &CommandContext) -> Result<CommandOutcome, Problem> {
    let overview = cli.workspace.authority().overview()?;
    cli.output.finished(&json(&overview), &text(&overview, cli.output.language()));
    Ok(CommandOutcome::AllDone)
}

pub fn json(overview: &AuthorityOverview) -> Value {
    let now = clock::now();
    let authority = |name: &str, ca: &PublishedAuthority| {
        json!({
            "certificate": ca.summary,
            "file": json_path(&overview.folder.join(format!("{name}.der"))),
            "valid": validity_flaw(&ca.certificate, now).is_none(),
            "crl": crl(&overview.folder, name, ca),
        })
    };
    json!({
        "folder": json_path(&overview.folder),
        "ca": authority("ca", &overview.signing),
        "root": overview.root.as_ref().map(|root| authority("root", root)),
        "issued": overview.issued.iter().map(|issued| entry(issued, now)).collect::<Vec<_>>(),
    })
}

/// The CRL of a CA, as JSON.
pub fn crl(folder: &Path, name: &str, ca: &PublishedAuthority) -> Value {
    let mut json = json!(ca.crl.summary());
    json["file"] = json_path(&folder.join(format!("{name}.crl")));
    let is_expired = matches!(crl_date_flaw(&ca.crl, clock::now()), Some(CrlFlaw::NoEnd | CrlFlaw::Expired { .. }));
    json["expired"] = json!(is_expired);
    json
}

fn entry(issued: &IssuedCertificate, now: DateTime<Utc>) -> Value {
    let mut json = json!(issued);
    json["status"] = json!(issued.state(now));
    json
}

pub fn text(overview: &AuthorityOverview, language: Language) -> String {
    let now = clock::now();
    let date = |at: DateTime<Utc>| at.format("%Y-%m-%d").to_string();
    let authorities: Vec<Vec<String>> = std::iter::once(&overview.signing)
        .chain(&overview.root)
        .map(|ca| {
            let next = ca.crl.next_update();
            vec![
                ca.summary.issued_to.clone(),
                ca.summary.issued_by.clone(),
                date(ca.summary.not_after),
                ca.summary.key_bits.to_string(),
                ca.crl.summary().entries.to_string(),
                ca.crl_number.to_string(),
                next.map(date).unwrap_or_default(),
            ]
        })
        .collect();
    let header = [
        TextKey::HeadingCa,
        TextKey::HeadingIssuedBy,
        TextKey::HeadingExpiry,
        TextKey::HeadingBits,
        TextKey::HeadingRevoked,
        TextKey::HeadingCrlNumber,
        TextKey::HeadingNextCrlBy,
    ]
    .map(|heading| heading.text(language));
    let mut text = format!("{}\n\n{}", overview.folder.display(), table(&header, &authorities));
    if !overview.issued.is_empty() {
        let rows: Vec<Vec<String>> = overview
            .issued
            .iter()
            .map(|issued| {
                let state = match issued.revoked {
                    Some(revocation) => format!("revoked ({})", revocation.reason.as_str()),
                    None => issued.state(now).as_str().to_owned(),
                };
                vec![
                    issued.serial_number.clone(),
                    issued.issued_to.clone(),
                    issued.profile.as_str().to_owned(),
                    state,
                    date(issued.not_after),
                    issued.controller.as_ref().map(|c| c.name.to_string()).unwrap_or_default(),
                ]
            })
            .collect();
        text.push('\n');
        let header = [
            TextKey::HeadingSerial,
            TextKey::HeadingIssuedTo,
            TextKey::HeadingProfile,
            TextKey::HeadingStatus,
            TextKey::HeadingExpiry,
            TextKey::HeadingController,
        ]
        .map(|heading| heading.text(language));
        text.push_str(&table(&header, &rows));
    }
    text
}
