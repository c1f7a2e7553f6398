use clap::Args;

use super::{PassphraseArgs, show};
use crate::cli::passwords::ca_passphrase;
use crate::cli::{CommandContext, CommandOutcome};
use crate::model::{AuthorityRequest, AuthorityValidity, ErrorCode, KeyLength, Problem, Subject, clock};
use crate::pki::MAX_CRL_DAYS;
use crate::workspace::authority::{DEFAULT_CRL_DAYS, NewAuthority};
use crate::workspace::check_passphrase;

#[derive(Debug, Args)]
pub struct InitArgs {
    /// Common name of the CA
    #[arg(long, value_name = "CN")]
    cn: String,
    /// Country, ISO 3166-1 alpha-2
    #[arg(long, value_name = "CC", default_value = "")]
    country: String,
    /// State or province
    #[arg(long, default_value = "")]
    state: String,
    /// City
    #[arg(long, default_value = "")]
    locality: String,
    /// Organisation or company
    #[arg(long, default_value = "")]
    organisation: String,
    /// Key length: 2048 or 4096
    #[arg(long, value_name = "N", default_value_t = 4096)]
    bits: u16,
    /// Validity in years, 1 to 30
    #[arg(long, value_name = "N", default_value_t = AuthorityValidity::default().years())]
    years: u8,
    /// Make a root and an intermediate CA below it, which signs, so that the root's key (CA/root.key) can be kept
    /// elsewhere
    #[arg(long)]
    intermediate: bool,
    /// Common name of the intermediate CA [default: CN and " intermediate"]
    #[arg(long, value_name = "CN", requires = "intermediate")]
    intermediate_cn: Option<String>,
    /// Validity of the intermediate CA in years; it ends with the root's at the latest
    #[arg(long, value_name = "N", default_value_t = 10, requires = "intermediate")]
    intermediate_years: u8,
    /// How long a CRL is good for, in days
    #[arg(long, value_name = "N", default_value_t = DEFAULT_CRL_DAYS,
        value_parser = clap::value_parser!(u16).range(1..=i64::from(MAX_CRL_DAYS)))]
    crl_days: u16,
    #[command(flatten)]
    passphrase: PassphraseArgs,
}

impl InitArgs {
    fn request(&self, common_name: String, years: u8) -> Result<AuthorityRequest, Problem> {
        let wrong = |e: &dyn std::fmt::Display| Problem::with_detail(ErrorCode::BadCertificateRequest, e);
        let subject = Subject {
            common_name,
            country: self.country.to_ascii_uppercase(),
            state: self.state.clone(),
            locality: self.locality.clone(),
            organisation: self.organisation.clone(),
        };
        subject.check().map_err(|e| wrong(&e))?;
        let key_length = KeyLength::try_from(self.bits).map_err(|_| crate::pki::PkiError::AuthorityKey(self.bits))?;
        if key_length == KeyLength::Rsa1024 {
            return Err(crate::pki::PkiError::AuthorityKey(self.bits).into());
        }
        let validity = AuthorityValidity::try_from(years).map_err(|e| wrong(&e))?;
        Ok(AuthorityRequest { subject, key_length, validity })
    }
}

pub fn run(cli: &CommandContext, args: InitArgs) -> Result<CommandOutcome, Problem> {
    let intermediate = args
        .intermediate
        .then(|| {
            let default = || format!("{} intermediate", args.cn);
            args.request(args.intermediate_cn.clone().unwrap_or_else(default), args.intermediate_years)
        })
        .transpose()?;
    let new = NewAuthority { root: args.request(args.cn.clone(), args.years)?, intermediate, crl_days: args.crl_days };
    let files = cli.workspace.authority();
    files.check_absent()?;
    let passphrase = ca_passphrase(args.passphrase.passphrase_file.as_deref(), true, cli.output.language())?;
    check_passphrase(&passphrase)?;
    let overview = files.create(&new, &passphrase, clock::now())?.overview()?;
    cli.output.finished(&show::json(&overview), &show::text(&overview, cli.output.language()));
    Ok(CommandOutcome::AllDone)
}
