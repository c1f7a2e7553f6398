use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use serde_json::{Value, json};

use super::batch::{Presentation, PrintedResult, STATE};
use super::controller_selection::{ControllerSelection, ItemsThenControllers};
use super::output::{json_path, json_paths};
use super::secret_file::read_secret;
use super::table_cell::TableCell;
use super::{CommandContext, CommandOutcome};
use crate::jobs::{
    BackupRestored, CaSignedSource, CertificateExported, CertificateImported, CertificateMade, CheckBackup,
    CheckCaSigned, CheckUserSpecified, CreateCsr, CsrFields, CsrSaved, ExportSelfSigned, ImportCaSigned,
    ImportUserSpecified, RestoreBackup, SelectCertificateType, SelfSigned, SelfSignedFields, UserSpecifiedFiles,
};
use crate::model::{
    CertificateSummary, CertificateType, ErrorCode, FileFormat, KeyLength, Language, Problem, Validity,
};
use crate::pki::{CertificateFinding, Severity};
use crate::texts::{TextKey, cli as texts};
use crate::workspace::{BackupKind, Configuration, ControllerEntry, KeyBackupSource};

#[derive(Debug, Subcommand)]
pub enum CertCommand {
    /// Make and install a self-signed server certificate
    SelfSigned(SelfSignedArgs),
    /// Make a key and its signing request, saved as Cert/CSR/3_csr in the controller's folder of the workspace
    Csr(CsrArgs),
    /// Import what a CA issued for the signing request
    ImportCa {
        /// The certificate, for one controller only [default: the only .der in the controller's Cert/CASigned]
        #[arg(long)]
        file: Option<PathBuf>,
        #[command(flatten)]
        warnings: WarningsArgs,
        #[command(flatten)]
        select: ControllerSelection,
    },
    /// Import key and certificate made with another tool into one controller with firmware below 8.0.0: FILE.pfx
    /// CONTROLLER, or CERTIFICATE KEYFILE CONTROLLER
    ImportUser {
        /// File with the password of the .pfx or of the key, "-" for standard input
        #[arg(long, value_name = "FILE")]
        password_file: Option<PathBuf>,
        #[command(flatten)]
        warnings: WarningsArgs,
        #[command(flatten)]
        arguments: ItemsThenControllers,
    },
    /// Select which of the certificates held the server uses
    #[command(name = "select")]
    SelectType {
        #[arg(value_name = "TYPE")]
        kind: CertificateTypeArg,
        #[command(flatten)]
        select: ControllerSelection,
    },
    /// Put a backup of a key back into controllers with firmware below 8.0.0, as what it was made as
    Restore {
        /// What it is a backup of: a self-signed certificate with its key (Cert/SelfSigned/1_key.pfx), or a signing
        /// request with its key and the certificate from the CA (Cert/CASigned/3_key.pfx)
        #[arg(value_name = "TYPE")]
        kind: BackupKindArg,
        /// This key file instead, such as one that was moved into a folder named after its date; for one controller
        #[arg(long)]
        file: Option<PathBuf>,
        /// File with the password of the key file, "-" for standard input [default: the connection password]
        #[arg(long, value_name = "FILE")]
        password_file: Option<PathBuf>,
        #[command(flatten)]
        warnings: WarningsArgs,
        #[command(flatten)]
        select: ControllerSelection,
    },
    /// Save the self-signed certificate as Cert/SelfSigned/1_cert in the controller's folder of the workspace
    Export {
        #[arg(long, value_enum, default_value_t = FileFormatArg::Der)]
        format: FileFormatArg,
        #[command(flatten)]
        select: ControllerSelection,
    },
}

/// Agreement to import a certificate that is not as it should be. `--yes` does not include it.
#[derive(Debug, Clone, Copy, Args)]
pub struct WarningsArgs {
    /// Import although clients may complain about the certificate; what they will say is listed
    #[arg(long)]
    pub accept_warnings: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum CertificateTypeArg {
    SelfSigned,
    User,
    Ca,
}

impl From<CertificateTypeArg> for CertificateType {
    fn from(kind: CertificateTypeArg) -> Self {
        match kind {
            CertificateTypeArg::SelfSigned => Self::SelfSigned,
            CertificateTypeArg::User => Self::UserSpecified,
            CertificateTypeArg::Ca => Self::CaSigned,
        }
    }
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum BackupKindArg {
    SelfSigned,
    Ca,
}

impl From<BackupKindArg> for BackupKind {
    fn from(kind: BackupKindArg) -> Self {
        match kind {
            BackupKindArg::SelfSigned => Self::SelfSigned,
            BackupKindArg::Ca => Self::CaSigned,
        }
    }
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum FileFormatArg {
    Der,
    Pem,
}

impl From<FileFormatArg> for FileFormat {
    fn from(format: FileFormatArg) -> Self {
        match format {
            FileFormatArg::Der => Self::Der,
            FileFormatArg::Pem => Self::Pem,
        }
    }
}

/// What a certificate or a request for one is to say.
#[derive(Debug, Args)]
struct SubjectArgs {
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
}

#[derive(Debug, Args)]
pub struct CsrArgs {
    #[command(flatten)]
    subject: SubjectArgs,
    /// Format of the file
    #[arg(long, value_enum, default_value_t = FileFormatArg::Der)]
    format: FileFormatArg,
    #[command(flatten)]
    select: ControllerSelection,
}

#[derive(Debug, Args)]
pub struct SelfSignedArgs {
    #[command(flatten)]
    subject: SubjectArgs,
    /// Validity in years, 1 to 10
    #[arg(long, value_name = "N", default_value_t = 5)]
    years: u8,
    #[command(flatten)]
    select: ControllerSelection,
}

const CERTIFICATE: Presentation<CertificateMade> = Presentation {
    header: &[TextKey::HeadingStatus, TextKey::HeadingCommonName, TextKey::HeadingExpiry, TextKey::HeadingThumbprint],
    show: |CertificateMade { summary, saved }, info| {
        let moved_aside = saved.as_ref().map_or(&[][..], |saved| &saved.moved_aside);
        PrintedResult {
            json: json!({
                "status": info.status,
                "certificate": summary,
                "saved": saved.as_ref().map(|s| json!({
                    "certificate": json_path(&s.certificate),
                    "key": s.key.as_deref().map(json_path),
                })),
                "moved_aside": json_paths(moved_aside),
            }),
            cells: vec![
                info.status.into(),
                summary.issued_to.clone().into(),
                summary.not_after.format("%Y-%m-%d").to_string().into(),
                summary.thumbprint.clone().into(),
            ],
        }
    },
};

const CSR: Presentation<CsrSaved> = Presentation {
    header: &[TextKey::HeadingStatus, TextKey::HeadingCommonName, TextKey::HeadingFile],
    show: |CsrSaved { common_name, saved }, info| PrintedResult {
        json: json!({
            "status": info.status,
            "common_name": common_name,
            "saved": { "csr": json_path(&saved.csr), "key": saved.key.as_deref().map(json_path) },
            "moved_aside": json_paths(&saved.moved_aside),
        }),
        cells: vec![info.status.into(), common_name.clone().into(), saved.csr.display().to_string().into()],
    },
};

pub const IMPORTED: Presentation<CertificateImported> = Presentation {
    header: &[
        TextKey::HeadingStatus,
        TextKey::HeadingIssuedTo,
        TextKey::HeadingIssuedBy,
        TextKey::HeadingExpiry,
        TextKey::HeadingThumbprint,
        TextKey::HeadingWarnings,
    ],
    show: |CertificateImported { summary, findings, moved_aside }, info| PrintedResult {
        json: json!({
            "status": info.status,
            "certificate": summary,
            "findings": findings.iter().map(finding).collect::<Vec<_>>(),
            "moved_aside": json_paths(moved_aside),
        }),
        cells: vec![
            info.status.into(),
            summary.issued_to.clone().into(),
            summary.issued_by.clone().into(),
            summary.not_after.format("%Y-%m-%d").to_string().into(),
            summary.thumbprint.clone().into(),
            findings.iter().map(|finding| finding.status().as_str()).collect::<Vec<_>>().join(" ").into(),
        ],
    },
};

const EXPORTED: Presentation<CertificateExported> = Presentation {
    header: &[TextKey::HeadingExpiry, TextKey::HeadingThumbprint, TextKey::HeadingFile],
    show: |CertificateExported { summary, saved }, _| PrintedResult {
        json: json!({
            "certificate": summary,
            "file": json_path(&saved.file),
            "moved_aside": json_paths(&saved.moved_aside),
        }),
        cells: vec![
            summary.not_after.format("%Y-%m-%d").to_string().into(),
            summary.thumbprint.clone().into(),
            saved.file.display().to_string().into(),
        ],
    },
};

const RESTORED: Presentation<BackupRestored> = Presentation {
    header: &[
        TextKey::HeadingStatus,
        TextKey::HeadingIssuedTo,
        TextKey::HeadingExpiry,
        TextKey::HeadingThumbprint,
        TextKey::HeadingWarnings,
    ],
    show: |BackupRestored { summary, findings }, info| {
        let cell = |of: fn(&CertificateSummary) -> String| TableCell::from(summary.as_ref().map_or("-".to_owned(), of));
        PrintedResult {
            json: json!({
                "status": info.status,
                "certificate": summary,
                "findings": findings.iter().map(finding).collect::<Vec<_>>(),
            }),
            cells: vec![
                info.status.into(),
                cell(|summary| summary.issued_to.clone()),
                cell(|summary| summary.not_after.format("%Y-%m-%d").to_string()),
                cell(|summary| summary.thumbprint.clone()),
                findings.iter().map(|finding| finding.status().as_str()).collect::<Vec<_>>().join(" ").into(),
            ],
        }
    },
};

fn finding(finding: &CertificateFinding) -> Value {
    json!({
        "severity": match finding.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
        },
        "status": finding.status(),
        "cause": finding.flaw,
        "message": finding.explain(Language::En),
    })
}

pub fn run(cli: &CommandContext, command: CertCommand) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    match command {
        CertCommand::SelfSigned(args) => self_signed(cli, &configuration, args),
        CertCommand::Csr(args) => csr(cli, &configuration, args),
        CertCommand::ImportCa { file, warnings, select } => {
            let chosen = select.resolve(&configuration, cli.output.language())?;
            let source = match file {
                None => CaSignedSource::Folder(cli.workspace.certificate_files()),
                Some(file) => {
                    one_only(&chosen)?;
                    // Read once before anything is sent, so that a wrong file is a wrong request.
                    let source = CaSignedSource::File(file);
                    source.read_chosen()?;
                    source
                }
            };
            let check = CheckCaSigned(source.clone());
            let import = |accept_warnings| ImportCaSigned { source, accept_warnings };
            cli.import(&configuration, &chosen, check, import, warnings.accept_warnings, &IMPORTED)
        }
        CertCommand::ImportUser { password_file, warnings, arguments } => {
            let (files, chosen) = arguments.resolve(&configuration, cli.output.language())?;
            one_only(&chosen)?;
            let files = match files.as_slice() {
                [pfx] => UserSpecifiedFiles::Pfx(pfx.into()),
                [certificate, key] => UserSpecifiedFiles::Pair { certificate: certificate.into(), key: key.into() },
                _ => return Err(Problem::with_detail(ErrorCode::SeveralFiles, files.join(", "))),
            };
            let password = password_file.as_deref().map(read_secret).transpose()?;
            files.read(password.as_ref())?;
            let check = CheckUserSpecified { files: files.clone(), password: password.clone() };
            let import = |accept_warnings| ImportUserSpecified { files, password, accept_warnings };
            cli.import(&configuration, &chosen, check, import, warnings.accept_warnings, &IMPORTED)
        }
        CertCommand::SelectType { kind, select } => {
            let chosen = select.resolve(&configuration, cli.output.language())?;
            cli.batch(&configuration, &chosen, SelectCertificateType(kind.into()), &STATE)
        }
        CertCommand::Restore { kind, file, password_file, warnings, select } => {
            let chosen = select.resolve(&configuration, cli.output.language())?;
            if file.is_some() {
                one_only(&chosen)?;
            }
            let password = password_file.as_deref().map(read_secret).transpose()?;
            let source = KeyBackupSource { files: cli.workspace.certificate_files(), kind: kind.into(), chosen: file };
            let check = CheckBackup { source: source.clone(), password: password.clone() };
            let restore = |accept_warnings| RestoreBackup { source, password, accept_warnings };
            cli.import(&configuration, &chosen, check, restore, warnings.accept_warnings, &RESTORED)
        }
        CertCommand::Export { format, select } => {
            let chosen = select.resolve(&configuration, cli.output.language())?;
            let files = cli.workspace.certificate_files();
            cli.batch(&configuration, &chosen, ExportSelfSigned { format: format.into(), files }, &EXPORTED)
        }
    }
}

fn one_only(chosen: &[ControllerEntry]) -> Result<(), Problem> {
    if chosen.len() > 1 { Err(ErrorCode::OneControllerOnly.into()) } else { Ok(()) }
}

fn csr(cli: &CommandContext, configuration: &Configuration, args: CsrArgs) -> Result<CommandOutcome, Problem> {
    let chosen = args.select.resolve(configuration, cli.output.language())?;
    let wrong = |e: &dyn std::fmt::Display| Problem::with_detail(ErrorCode::BadCertificateRequest, e);
    if args.subject.cn.is_some() && chosen.len() > 1 {
        return Err(wrong(&texts::common_name_of_one(cli.output.language())));
    }
    let fields = CsrFields {
        common_name: args.subject.cn,
        country: args.subject.country.to_ascii_uppercase(),
        state: args.subject.state,
        locality: args.subject.locality,
        organisation: args.subject.organisation,
        key_length: KeyLength::try_from(args.subject.bits).map_err(|e| wrong(&e))?,
    };
    fields.request("x").subject.check().map_err(|e| wrong(&e))?;
    let operation = CreateCsr {
        fields,
        format: args.format.into(),
        files: cli.workspace.certificate_files(),
        backup: configuration.options.backup,
    };
    cli.batch(configuration, &chosen, operation, &CSR)
}

fn self_signed(
    cli: &CommandContext,
    configuration: &Configuration,
    args: SelfSignedArgs,
) -> Result<CommandOutcome, Problem> {
    let chosen = args.select.resolve(configuration, cli.output.language())?;
    let wrong = |e: &dyn std::fmt::Display| Problem::with_detail(ErrorCode::BadCertificateRequest, e);
    if args.subject.cn.is_some() && chosen.len() > 1 {
        return Err(wrong(&texts::common_name_of_one(cli.output.language())));
    }
    let fields = SelfSignedFields {
        common_name: args.subject.cn,
        country: args.subject.country.to_ascii_uppercase(),
        state: args.subject.state,
        locality: args.subject.locality,
        organisation: args.subject.organisation,
        key_length: KeyLength::try_from(args.subject.bits).map_err(|e| wrong(&e))?,
        validity: Validity::try_from(args.years).map_err(|e| wrong(&e))?,
    };
    fields.request("x").subject.check().map_err(|e| wrong(&e))?;
    let backup = configuration.options.backup.then(|| cli.workspace.certificate_files());
    cli.batch(configuration, &chosen, SelfSigned { fields, backup }, &CERTIFICATE)
}
