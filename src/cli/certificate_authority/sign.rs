use std::collections::BTreeSet;
use std::net::IpAddr;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use super::PassphraseArgs;
use crate::cli::cert::FileFormatArg;
use crate::cli::output::json_path;
use crate::cli::{CommandContext, CommandOutcome};
use crate::model::{CertificateProfile, ErrorCode, FileFormat, Problem, Validity, clock};
use crate::pki::{Csr, IssueRequest, MAX_CERTIFICATE_FILE_BYTES, ServerNames};
use crate::texts::cli as texts;
use crate::workspace::authority::UnlockedAuthority;
use crate::workspace::{read_import_file, write_atomic};

#[derive(Debug, Args)]
pub struct SignArgs {
    /// Certificate signing requests
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// What the certificates are for
    #[arg(long, value_enum, default_value_t = ProfileArg::Server)]
    profile: ProfileArg,
    /// Also save each certificate in this folder, named as its request [default: only in CA/issued]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Format of the files in --out
    #[arg(long, value_enum, default_value_t = FileFormatArg::Der)]
    format: FileFormatArg,
    /// Validity in years, 1 to 10; it ends with the CA's at the latest
    #[arg(long, value_name = "N", default_value_t = 5)]
    years: u8,
    /// Sign again what was signed before; the former certificate stays valid
    #[arg(long)]
    renew: bool,
    /// Sign keys below 2048 bits, which only deprecated security policies take
    #[arg(long)]
    allow_short_keys: bool,
    /// Application URI instead of the one in the request, together with --host
    #[arg(long, requires = "host")]
    uri: Option<String>,
    /// Host name or IP address instead of those in the request; may be repeated
    #[arg(long, value_name = "HOST", requires = "uri")]
    host: Vec<String>,
    #[command(flatten)]
    passphrase: PassphraseArgs,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum ProfileArg {
    Server,
    Client,
}

impl SignArgs {
    fn request(&self) -> Result<IssueRequest, Problem> {
        let profile = match self.profile {
            ProfileArg::Server => CertificateProfile::Server,
            ProfileArg::Client => CertificateProfile::Client,
        };
        let names = self.uri.as_ref().map(|uri| {
            let (ips, dns): (Vec<&String>, _) = self.host.iter().partition(|host| host.parse::<IpAddr>().is_ok());
            ServerNames {
                application_uri: uri.clone(),
                ips: ips.into_iter().filter_map(|ip| ip.parse().ok()).collect(),
                dns: dns.into_iter().cloned().collect(),
            }
        });
        let validity =
            Validity::try_from(self.years).map_err(|e| Problem::with_detail(ErrorCode::BadCertificateRequest, e))?;
        Ok(IssueRequest { profile, validity, names, allow_short_keys: self.allow_short_keys })
    }

    /// Where the certificate for the request in `file` is saved.
    fn target(&self, file: &Path) -> Option<PathBuf> {
        let name = Path::new(file.file_stem()?).with_extension(FileFormat::from(self.format).extension());
        Some(self.out.as_ref()?.join(name))
    }
}

pub fn run(cli: &CommandContext, args: &SignArgs) -> Result<CommandOutcome, Problem> {
    let request = args.request()?;
    let targets: Vec<_> = args.files.iter().filter_map(|file| args.target(file)).collect();
    if targets.iter().collect::<BTreeSet<_>>().len() < targets.len() {
        return Err(Problem::with_detail(ErrorCode::SeveralFiles, texts::same_name_in_out(cli.output.language())));
    }
    let mut authority = args.passphrase.open(cli)?;
    let mut ending = CommandOutcome::AllDone;
    for file in &args.files {
        let result = sign(&mut authority, args, file, &request);
        cli.output.cli("file", &file.display().to_string(), &result);
        if result.is_err() {
            ending = CommandOutcome::SomeFailed;
        }
    }
    Ok(ending)
}

fn sign(
    authority: &mut UnlockedAuthority,
    args: &SignArgs,
    file: &Path,
    request: &IssueRequest,
) -> Result<(Value, String), Problem> {
    let csr = Csr::from_any(&read_import_file(file, MAX_CERTIFICATE_FILE_BYTES)?)?;
    let (certificate, kept) = authority.sign(&csr, request, args.renew, clock::now())?;
    let path = match args.target(file) {
        None => kept,
        Some(target) => {
            match args.format {
                FileFormatArg::Der => write_atomic(&target, certificate.der())?,
                FileFormatArg::Pem => write_atomic(&target, certificate.to_pem().as_bytes())?,
            }
            target
        }
    };
    let summary = certificate.summary();
    let text = format!(
        "{}: {} until {}\n    {}",
        summary.issued_to,
        summary.serial_number,
        summary.not_after.format("%Y-%m-%d"),
        path.display()
    );
    Ok((json!({ "certificate": summary, "saved": json_path(&path) }), text))
}
