use std::sync::Arc;

use clap::Args;

use super::PassphraseArgs;
use crate::cli::cert::{IMPORTED, WarningsArgs};
use crate::cli::controller_selection::ControllerSelection;
use crate::cli::{CommandContext, CommandOutcome};
use crate::jobs::{CreateCsr, CsrFields, SignCsrs};
use crate::model::{ErrorCode, FileFormat, KeyLength, Problem, Validity};

#[derive(Debug, Args)]
pub struct SignControllersArgs {
    /// Validity in years, 1 to 10; it ends with the CA's at the latest
    #[arg(long, value_name = "N", default_value_t = 5)]
    years: u8,
    /// Have each controller make a new key, even where it holds a signing request
    #[arg(long)]
    new_key: bool,
    /// Sign again what was signed before; the former certificate stays valid
    #[arg(long)]
    renew: bool,
    /// Sign keys below 2048 bits, which only deprecated security policies take
    #[arg(long)]
    allow_short_keys: bool,
    /// For new requests: country, ISO 3166-1 alpha-2
    #[arg(long, value_name = "CC", default_value = "")]
    country: String,
    /// For new requests: state or province
    #[arg(long, default_value = "")]
    state: String,
    /// For new requests: city
    #[arg(long, default_value = "")]
    locality: String,
    /// For new requests: organisation or company
    #[arg(long, default_value = "")]
    organisation: String,
    /// For new requests: key length, 1024, 2048 or 4096, as the ticked security policies allow
    #[arg(long, value_name = "N", default_value_t = 2048)]
    bits: u16,
    #[command(flatten)]
    warnings: WarningsArgs,
    #[command(flatten)]
    passphrase: PassphraseArgs,
    #[command(flatten)]
    select: ControllerSelection,
}

pub fn run(cli: &CommandContext, args: SignControllersArgs) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    let chosen = args.select.resolve(&configuration, cli.output.language())?;
    let wrong = |e: &dyn std::fmt::Display| Problem::with_detail(ErrorCode::BadCertificateRequest, e);
    let fields = CsrFields {
        common_name: None,
        country: args.country.to_ascii_uppercase(),
        state: args.state,
        locality: args.locality,
        organisation: args.organisation,
        key_length: KeyLength::try_from(args.bits).map_err(|e| wrong(&e))?,
    };
    fields.request("x").subject.check().map_err(|e| wrong(&e))?;
    let request = CreateCsr {
        fields,
        format: FileFormat::Der,
        files: cli.workspace.certificate_files(),
        backup: configuration.options.backup,
    };
    let validity = Validity::try_from(args.years).map_err(|e| wrong(&e))?;
    let operation = SignCsrs {
        authority: Arc::new(args.passphrase.shared(cli)?),
        request,
        new_key: args.new_key,
        renew: args.renew,
        validity,
        allow_short_keys: args.allow_short_keys,
        accept_warnings: args.warnings.accept_warnings,
    };
    cli.batch(&configuration, &chosen, operation, &IMPORTED)
}
