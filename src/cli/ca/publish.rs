use std::path::{Path, PathBuf};

use chrono::Utc;
use clap::Args;
use serde_json::json;

use super::{PassphraseArgs, show};
use crate::cli::{Ending, Settled};
use crate::model::Problem;
use crate::pki::{Crl, MAX_CRL_DAYS};
use crate::workspace::write_atomic;

#[derive(Debug, Args)]
pub struct CrlArgs {
    /// Save the CRL here, as PEM if the name ends in .pem, else as DER; that of a root above the CA goes beside it, named
    /// root-…
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// How long it is good for, in days [default: as long as the one before]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=i64::from(MAX_CRL_DAYS)))]
    days: Option<u16>,
    #[command(flatten)]
    passphrase: PassphraseArgs,
}

pub fn run(settled: &Settled, args: &CrlArgs) -> Result<Ending, Problem> {
    let mut authority = args.passphrase.open(settled)?;
    authority.publish_crl(args.days, Utc::now())?;
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
        "saved": saved,
    });
    settled.output.finished(&published, &show::text(&overview));
    Ok(Ending::AllDone)
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
