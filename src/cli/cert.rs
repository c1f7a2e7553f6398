use clap::{Args, Subcommand};
use serde_json::json;

use super::batch::{Presentation, Shown};
use super::select::Select;
use super::{Ending, Settled};
use crate::jobs::{Outcome, SelfSigned, SelfSignedFields};
use crate::model::{ErrorCode, KeyLength, Problem, Validity};

#[derive(Debug, Subcommand)]
pub enum CertCommand {
    /// Make and install a self-signed server certificate
    SelfSigned(SelfSignedArgs),
}

#[derive(Debug, Args)]
pub struct SelfSignedArgs {
    /// Common name, for one controller only [default: the controller's own, EpsonRC.<serial>.<address>]
    #[arg(long, value_name = "CN")]
    cn: Option<String>,
    /// Country, ISO 3166-1 alpha-2
    #[arg(long, value_name = "CC")]
    country: String,
    /// State or province
    #[arg(long)]
    state: String,
    /// City
    #[arg(long)]
    locality: String,
    /// Organisation or company
    #[arg(long)]
    organisation: String,
    /// Key length: 1024, 2048 or 4096, as the ticked security policies allow
    #[arg(long, value_name = "N", default_value_t = 2048)]
    bits: u16,
    /// Validity in years, 1 to 10
    #[arg(long, value_name = "N", default_value_t = 5)]
    years: u8,
    #[command(flatten)]
    select: Select,
}

const CERTIFICATE: Presentation = Presentation {
    header: &["STATUS", "COMMON NAME", "EXPIRY", "THUMBPRINT"],
    show: |outcome, info| {
        let Outcome::Certificate { summary, saved } = outcome else {
            return Shown { json: json!(null), cells: Vec::new() };
        };
        Shown {
            json: json!({
                "status": info.status,
                "certificate": summary,
                "saved": saved.as_ref().map(|s| json!({ "certificate": s.certificate, "key": s.key })),
            }),
            cells: vec![
                info.status.as_str().to_owned(),
                summary.issued_to.clone(),
                summary.not_after.format("%Y-%m-%d").to_string(),
                summary.thumbprint.clone(),
            ],
        }
    },
};

pub fn run(settled: &Settled, command: CertCommand) -> Result<Ending, Problem> {
    let CertCommand::SelfSigned(args) = command;
    let configuration = settled.configuration()?;
    let chosen = args.select.resolve(&configuration)?;
    let wrong = |e: &dyn std::fmt::Display| Problem::with_detail(ErrorCode::BadCertificateRequest, e);
    if args.cn.is_some() && chosen.len() > 1 {
        return Err(wrong(&"a common name can be given for one controller only"));
    }
    let fields = SelfSignedFields {
        common_name: args.cn,
        country: args.country.to_ascii_uppercase(),
        state: args.state,
        locality: args.locality,
        organisation: args.organisation,
        key_length: KeyLength::try_from(args.bits).map_err(|e| wrong(&e))?,
        validity: Validity::try_from(args.years).map_err(|e| wrong(&e))?,
    };
    fields.request("x").subject.check().map_err(|e| wrong(&e))?;
    let backup = configuration.options.backup.then(|| settled.workspace.certificate_files());
    settled.batch(&configuration, &chosen, SelfSigned { fields, backup }, &CERTIFICATE)
}
