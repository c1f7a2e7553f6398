use std::path::{Path, PathBuf};

use chrono::{DateTime, Utc};
use clap::{Args, Subcommand, ValueEnum};
use serde_json::json;

use super::output::{json_path, say};
use super::secret_file::read_secret;
use super::value_error::ValueError;
use super::{CommandContext, CommandOutcome, read_bounded};
use crate::model::{ErrorCode, Language, Problem, SecurityPolicy, clock};
use crate::pki::{
    self, Bundle, Certificate, CertificateRejection, MAX_BUNDLE_BYTES, PeerRole, PkiError, PresentedCertificate,
    TrustLists, TrustPolicy, read_bundle,
};
use crate::texts::cli as texts;

#[derive(Debug, Subcommand)]
pub enum PkiCommand {
    /// Show everything public inside a file as JSON: certificates, chains, revocation lists, signing requests, keys,
    /// PKCS#7 and PKCS#12
    Show {
        file: PathBuf,
        /// File with the password of the .pfx or of the key, "-" for standard input
        #[arg(long, value_name = "FILE")]
        password_file: Option<PathBuf>,
    },
    /// Check a certificate as an OPC UA application does, and print the OPC UA status: Good, BadCertificateRevoked, …;
    /// exit code 0 for Good, 1 for anything else
    Verify(PkiVerifyArgs),
}

#[derive(Debug, Args)]
pub struct PkiVerifyArgs {
    /// Certificates that are trusted, of applications and of CAs
    #[arg(long, value_name = "DIR")]
    trusted: Option<PathBuf>,
    /// Certificates of CAs that only complete chains
    #[arg(long, value_name = "DIR")]
    issuers: Option<PathBuf>,
    /// Revocation lists
    #[arg(long, value_name = "DIR")]
    crls: Option<PathBuf>,
    /// The time to check for, such as 2026-01-31T12:00:00Z [default: now]
    #[arg(long, value_name = "RFC3339", value_parser = parse_time)]
    at: Option<DateTime<Utc>>,
    /// The ApplicationUri the application announces [default: not checked]
    #[arg(long)]
    uri: Option<String>,
    /// The address or host name the application is reached by [default: not checked]
    #[arg(long, value_name = "H")]
    host: Option<String>,
    /// The security policy it is to be used with [default: what all but the deprecated ones want]
    #[arg(long, value_name = "P", value_parser = parse_policy)]
    policy: Option<SecurityPolicy>,
    /// What the application is [default: server with --host, else either]
    #[arg(long, value_enum)]
    role: Option<RoleArg>,
    /// Accept what no revocation list is at hand for
    #[arg(long)]
    allow_unknown_revocation: bool,
    /// The certificate, or its chain with the certificate first
    #[arg(value_name = "CERT")]
    certificate: PathBuf,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum RoleArg {
    Client,
    Server,
    Either,
}

impl From<RoleArg> for PeerRole {
    fn from(role: RoleArg) -> Self {
        match role {
            RoleArg::Client => Self::Client,
            RoleArg::Server => Self::Server,
            RoleArg::Either => Self::Either,
        }
    }
}

fn parse_time(text: &str) -> Result<DateTime<Utc>, ValueError> {
    DateTime::parse_from_rfc3339(text).map(Into::into).map_err(ValueError::Time)
}

fn parse_policy(text: &str) -> Result<SecurityPolicy, ValueError> {
    // The error of the model says no more.
    text.parse().map_err(|_| ValueError::NoneOf(SecurityPolicy::ALL.map(SecurityPolicy::as_str).to_vec()))
}

pub fn run(cli: &CommandContext, command: PkiCommand) -> Result<CommandOutcome, Problem> {
    match command {
        PkiCommand::Show { file, password_file } => show(cli, &file, password_file.as_deref()),
        PkiCommand::Verify(args) => verify(cli, &args),
    }
}

fn show(cli: &CommandContext, file: &Path, password_file: Option<&Path>) -> Result<CommandOutcome, Problem> {
    let password = password_file.map(read_secret).transpose()?;
    let password = password.as_ref().map(secrecy::ExposeSecret::expose_secret);
    let bytes = read_bounded(file, MAX_BUNDLE_BYTES)?;
    let contents = pki::describe(&bytes, password).map_err(|error| of_file(file, error))?;
    let contents = json!({ "file": json_path(file), "contents": contents });
    cli.output.text(&if cli.output.is_json() { contents.to_string() } else { format!("{contents:#}") });
    Ok(CommandOutcome::AllDone)
}

fn verify(cli: &CommandContext, args: &PkiVerifyArgs) -> Result<CommandOutcome, Problem> {
    let language = cli.output.language();
    let mut trusted = folder(args.trusted.as_deref(), language)?;
    let mut issuers = folder(args.issuers.as_deref(), language)?;
    let crls = folder(args.crls.as_deref(), language)?;
    if let Some(stray) = crls.certificates.first() {
        let detail = texts::certificate_among_lists(language, stray.subject());
        return Err(Problem::with_detail(ErrorCode::FileFormat, detail));
    }
    // Some tools keep the revocation lists of a CA beside its certificate.
    let lists = [crls.crls, std::mem::take(&mut trusted.crls), std::mem::take(&mut issuers.crls)].concat();
    let lists = TrustLists::new(trusted.certificates, issuers.certificates, lists);
    let policy = TrustPolicy { allow_unknown_revocation: args.allow_unknown_revocation, ..TrustPolicy::default() };

    let bytes = read_bounded(&args.certificate, MAX_BUNDLE_BYTES)?;
    let sent = match read_bundle(&bytes) {
        Ok(sent) => sent,
        Err(error) if is_wrong_file(&error) => return Err(of_file(&args.certificate, error)),
        Err(error) => return Ok(rejected(cli, &unreadable(&args.certificate, &error))),
    };
    let Some((certificate, chain)) = sent.certificates.split_first() else {
        return Err(of_file(&args.certificate, PkiError::NoCertificate));
    };
    let default_role = if args.host.is_some() { PeerRole::Server } else { PeerRole::Either };
    let presented = PresentedCertificate {
        certificate,
        chain,
        role: args.role.map_or(default_role, PeerRole::from),
        now: args.at.unwrap_or_else(clock::now),
        application_uri: args.uri.as_deref(),
        host: args.host.as_deref(),
        security_policy: args.policy,
    };
    match lists.validate(&presented, &policy) {
        Ok(chain) => {
            if cli.output.is_json() {
                let chain: Vec<String> = chain.iter().map(Certificate::thumbprint_sha1).collect();
                cli.output.text(&json!({ "status": "Good", "chain": chain }).to_string());
            } else {
                cli.output.text("Good");
            }
            Ok(CommandOutcome::AllDone)
        }
        Err(rejection) => Ok(rejected(cli, &rejection)),
    }
}

fn rejected(cli: &CommandContext, rejection: &CertificateRejection) -> CommandOutcome {
    let (status, language) = (rejection.status(), cli.output.language());
    let CertificateRejection { flaw, subject, depth } = rejection;
    if cli.output.is_json() {
        let line = json!({
            "status": status,
            "subject": subject,
            "depth": depth,
            "reason": rejection.reason(),
            "cause": rejection.cause(),
            "remedy": flaw.remedy(Language::En),
        });
        cli.output.text(&line.to_string());
    } else {
        cli.output.text(status.as_str());
    }
    say(&format!("{subject}: {}\n    {}", flaw.reason(language), flaw.remedy(language)));
    CommandOutcome::SomeFailed
}

/// What was shown is no certificate: step 1 of OPC 10000-4 §6.1.3.
fn unreadable(file: &Path, error: &PkiError) -> CertificateRejection {
    CertificateRejection::unreadable(error, &file.display().to_string())
}

/// Whether the file is something else than a certificate, rather than a damaged one.
fn is_wrong_file(error: &PkiError) -> bool {
    matches!(
        error,
        PkiError::PrivateKeyInside | PkiError::NoCertificate | PkiError::OtherContent { .. } | PkiError::Text(_)
    )
}

/// Everything in the files of a folder and of the folders in it; one that cannot be read is an error.
fn folder(path: Option<&Path>, language: Language) -> Result<Bundle, Problem> {
    let mut bundle = Bundle::default();
    if let Some(path) = path {
        let mut left = MAX_FILES;
        collect(path, (MAX_DEPTH, language), &mut left, &mut bundle)?;
    }
    Ok(bundle)
}

fn collect(
    path: &Path,
    (depth, language): (usize, Language),
    left: &mut usize,
    bundle: &mut Bundle,
) -> Result<(), Problem> {
    let unreadable =
        |e: std::io::Error| Problem::with_detail(ErrorCode::FileUnreadable, format!("{}: {e}", path.display()));
    let too_much = || {
        let detail = texts::too_many_files(language, path.display(), MAX_FILES);
        Problem::with_detail(ErrorCode::FileUnreadable, detail)
    };
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if metadata.is_dir() {
        let depth = depth.checked_sub(1).ok_or_else(too_much)?;
        let entries = std::fs::read_dir(path).map_err(unreadable)?;
        let entries: Result<Vec<PathBuf>, _> = entries.map(|entry| entry.map(|entry| entry.path())).collect();
        let mut entries = entries.map_err(unreadable)?;
        entries.sort();
        return entries.iter().try_for_each(|entry| collect(entry, (depth, language), left, bundle));
    }
    if !metadata.is_file() {
        return Err(unreadable(std::io::ErrorKind::InvalidInput.into()));
    }
    *left = left.checked_sub(1).ok_or_else(too_much)?;
    let read = read_bundle(&read_bounded(path, MAX_BUNDLE_BYTES)?).map_err(|error| of_file(path, error))?;
    bundle.certificates.extend(read.certificates);
    bundle.crls.extend(read.crls);
    Ok(())
}

fn of_file(file: &Path, error: PkiError) -> Problem {
    let mut problem = Problem::from(error);
    let detail = problem.detail.unwrap_or_default();
    problem.detail = Some(format!("{}: {detail}", file.display()));
    problem
}

/// In one folder and all folders in it.
const MAX_FILES: usize = 10_000;
/// Of folders in folders.
const MAX_DEPTH: usize = 4;
