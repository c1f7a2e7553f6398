//! The small CA of the workspace.
//!
//! Nothing here needs the window or a controller but `sign-controllers` and `crl --push`.

mod init;
mod publish;
mod show;
mod sign;
mod sign_controllers;

use std::path::PathBuf;

use clap::{Args, Subcommand};
use serde_json::json;

use super::output::json_path;
use super::passwords::ca_passphrase;
use super::value_error::ValueError;
use super::{CommandContext, CommandOutcome};
use crate::jobs::SharedAuthority;
use crate::model::{Problem, clock};
use crate::pki::{REVOCATION_REASONS, RevocationReason};
use crate::texts::cli as texts;
use crate::workspace::authority::UnlockedAuthority;

#[derive(Debug, Subcommand)]
pub enum CaCommand {
    /// Create the CA of this workspace
    Init(init::InitArgs),
    /// Sign certificate signing requests from files, DER or PEM
    Sign(sign::SignArgs),
    /// Sign what controllers ask for, and import the certificates: the signing request a controller holds, or a new
    /// one where there is none. Can be repeated
    SignControllers(sign_controllers::SignControllersArgs),
    /// Revoke certificates and publish a CRL that says so; this cannot be taken back
    Revoke(RevokeArgs),
    /// Publish a new CRL, and give it to controllers
    Crl(publish::CrlArgs),
    /// Show the CA, its CRL and what it has issued; needs no passphrase
    Show,
    /// Save the whole CA in one file, sealed with its passphrase
    Backup {
        /// Where to save it
        #[arg(long, value_name = "FILE")]
        out: PathBuf,
        #[command(flatten)]
        passphrase: PassphraseArgs,
    },
    /// Put a backup back into a workspace without a CA
    Restore {
        /// What `ca backup` saved
        file: PathBuf,
        #[command(flatten)]
        passphrase: PassphraseArgs,
    },
}

#[derive(Debug, Args)]
pub struct PassphraseArgs {
    /// File with the passphrase of the CA, "-" for standard input [default: asked for on the terminal]
    #[arg(long, value_name = "FILE")]
    passphrase_file: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct RevokeArgs {
    /// Whole serial numbers in hexadecimal, as `ca show` lists them
    #[arg(value_name = "SERIAL", required = true)]
    serials: Vec<String>,
    /// Why (RFC 5280): unspecified, keyCompromise, cACompromise, affiliationChanged, superseded, cessationOfOperation or
    /// privilegeWithdrawn
    #[arg(long, value_name = "R", value_parser = parse_reason)]
    reason: RevocationReason,
    #[command(flatten)]
    passphrase: PassphraseArgs,
}

/// Also with hyphens and in any case: `key-compromise`.
fn parse_reason(text: &str) -> Result<RevocationReason, ValueError> {
    let wanted = text.replace('-', "");
    let found = REVOCATION_REASONS.into_iter().find(|reason| reason.as_str().eq_ignore_ascii_case(&wanted));
    found.ok_or_else(|| ValueError::NoneOf(REVOCATION_REASONS.map(RevocationReason::as_str).to_vec()))
}

impl PassphraseArgs {
    /// The same for a job. A wrong passphrase is found out now, before any controller is asked.
    fn shared(&self, cli: &CommandContext) -> Result<SharedAuthority, Problem> {
        let files = cli.workspace.authority();
        files.overview()?;
        let passphrase = ca_passphrase(self.passphrase_file.as_deref(), false, cli.output.language())?;
        files.open(&passphrase)?;
        Ok(SharedAuthority::new(files, passphrase))
    }

    /// Takes the CA up. Asks only where there is a CA.
    fn open(&self, cli: &CommandContext) -> Result<UnlockedAuthority, Problem> {
        let files = cli.workspace.authority();
        files.overview()?;
        let passphrase = ca_passphrase(self.passphrase_file.as_deref(), false, cli.output.language())?;
        Ok(files.open(&passphrase)?)
    }
}

pub fn run(cli: &CommandContext, command: CaCommand) -> Result<CommandOutcome, Problem> {
    match command {
        CaCommand::Init(args) => init::run(cli, args),
        CaCommand::Sign(args) => sign::run(cli, &args),
        CaCommand::SignControllers(args) => sign_controllers::run(cli, args),
        CaCommand::Revoke(args) => revoke(cli, &args),
        CaCommand::Crl(args) => publish::run(cli, &args),
        CaCommand::Show => show::run(cli),
        CaCommand::Backup { out, passphrase } => {
            passphrase.open(cli)?.back_up(&out, clock::now())?;
            cli.output.finished(&json!({ "backup": json_path(&out) }), &out.display().to_string());
            Ok(CommandOutcome::AllDone)
        }
        CaCommand::Restore { file, passphrase } => {
            let files = cli.workspace.authority();
            files.check_absent()?;
            let passphrase = ca_passphrase(passphrase.passphrase_file.as_deref(), false, cli.output.language())?;
            let overview = files.restore(&file, &passphrase)?;
            cli.output.finished(&show::json(&overview), &show::text(&overview, cli.output.language()));
            Ok(CommandOutcome::AllDone)
        }
    }
}

fn revoke(cli: &CommandContext, args: &RevokeArgs) -> Result<CommandOutcome, Problem> {
    let mut authority = args.passphrase.open(cli)?;
    authority.revoke(&args.serials, args.reason, clock::now())?;
    let overview = authority.overview()?;
    let crl = show::crl(&overview.folder, "ca", &overview.signing);
    cli.output.finished(
        &json!({ "revoked": args.serials, "reason": args.reason, "crl": crl }),
        &texts::revoked(cli.output.language(), &args.serials),
    );
    Ok(CommandOutcome::AllDone)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_are_read_as_rfc_5280_writes_them_and_with_hyphens() {
        for (text, reason) in [
            ("keyCompromise", RevocationReason::KeyCompromise),
            ("key-compromise", RevocationReason::KeyCompromise),
            ("CACompromise", RevocationReason::CaCompromise),
            ("superseded", RevocationReason::Superseded),
        ] {
            assert_eq!(parse_reason(text), Ok(reason));
        }
        for other in ["", "certificateHold", "removeFromCRL", "7"] {
            assert!(parse_reason(other).unwrap_err().to_string().starts_with("known are "));
        }
    }
}
