use std::io::IsTerminal as _;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use super::{PassphraseArgs, show};
use crate::cli::client_certificates::CHANGE;
use crate::cli::controller_selection::ControllerSelection;
use crate::cli::output::json_paths;
use crate::cli::{CommandContext, CommandOutcome};
use crate::jobs::PushAuthority;
use crate::model::{ErrorCode, Problem, clock};
use crate::pki::{Crl, MAX_CRL_DAYS};
use crate::texts::cli as texts;
use crate::workspace::write_atomic;

#[derive(Debug, Args)]
pub struct CrlArgs {
    /// Save the CRL here, as PEM if the name ends in .pem, else as DER; that of a root above the CA goes beside it,
    /// named root-…
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// How long it is good for, in days [default: as long as the one before]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=i64::from(MAX_CRL_DAYS)))]
    days: Option<u16>,
    /// Give it to these controllers, and the certificate of the CA to their issuers list
    #[arg(long, value_name = "CONTROLLER", num_args = 0..)]
    push: Option<Vec<String>>,
    /// With --push: every controller in the list
    #[arg(long, requires = "push")]
    all: bool,
    /// With --push: the certificate of the CA goes into the trusted list; every client is let in that has a certificate
    /// from it
    #[arg(long, requires = "push")]
    trust: bool,
    #[command(flatten)]
    passphrase: PassphraseArgs,
}

pub fn run(cli: &CommandContext, args: &CrlArgs) -> Result<CommandOutcome, Problem> {
    // Mistakes in the choice of controllers are found before anything is published.
    let configuration = cli.configuration()?;
    let chosen = match &args.push {
        None => Vec::new(),
        Some(names) if names.is_empty() && !args.all => {
            return Err(Problem::with_detail(ErrorCode::UnknownController, texts::push_to_none(cli.output.language())));
        }
        Some(names) => {
            ControllerSelection::new(names.clone(), args.all).resolve(&configuration, cli.output.language())?
        }
    };
    if args.push.is_some() && !cli.yes && !std::io::stdin().is_terminal() {
        return Err(ErrorCode::NotConfirmed.into());
    }
    let mut authority = args.passphrase.open(cli)?;
    authority.publish_crl(args.days, clock::now())?;
    let overview = authority.overview()?;
    drop(authority);
    let mut saved = Vec::new();
    if let Some(out) = &args.out {
        save(out, &overview.signing.crl)?;
        saved.push(out.clone());
        if let Some(root) = &overview.root {
            let name = out.file_name().unwrap_or_default().to_string_lossy();
            let beside = out.with_file_name(format!("root-{name}"));
            save(&beside, &root.crl)?;
            saved.push(beside);
        }
    }
    let published = json!({
        "crl": show::crl(&overview.folder, "ca", &overview.signing),
        "root_crl": overview.root.as_ref().map(|root| show::crl(&overview.folder, "root", root)),
        "saved": json_paths(&saved),
    });
    cli.output.finished(&published, &show::text(&overview, cli.output.language()));
    if chosen.is_empty() {
        return Ok(CommandOutcome::AllDone);
    }
    cli.batch(&configuration, &chosen, PushAuthority::new(&overview, args.trust), &CHANGE)
}

fn save(path: &Path, crl: &Crl) -> Result<(), Problem> {
    let pem = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("pem"));
    if pem {
        write_atomic(path, crl.to_pem().as_bytes())?
    } else {
        write_atomic(path, crl.der())?
    }
    Ok(())
}
