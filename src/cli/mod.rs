//! The command line: the same jobs as the window, for scripts and for people without a display.
//!
//! One file a subcommand. Results go to standard output, logs and progress to standard error. Exit code 0: all done;
//! 1: some or all controllers failed; 2: the request itself was wrong and nothing was sent.

mod activation;
mod backup;
mod basic_settings;
mod batch;
mod cert;
mod certificate_authority;
mod client_certificates;
mod connection_passwords;
mod controller_selection;
mod controllers;
mod crl;
mod demo;
mod fins;
mod help;
mod licences;
mod output;
mod passwords;
mod pki;
mod record;
mod remote;
mod remote_answers;
mod secret_file;
mod server_control;
mod server_log;
mod settings_transfer;
mod start_failure;
mod table;
mod table_cell;
mod trust_files;
mod usage_error;
mod user_login;
mod users;
mod value_error;
mod vault;
mod verify;
mod virtual_cell;
mod virtual_fleet;
mod virtual_fleet_host;
mod virtual_problem;
mod virtual_switch;
mod window;

use std::cell::OnceCell;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use clap::{CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

use crate::model::{Language, Problem};
use crate::platform::console;
use crate::workspace::{Passwords, Workspace};
use output::Printer;

/// Configures the OPC UA servers inside robot controllers.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 100, arg_required_else_help = false)]
pub struct Cli {
    /// Folder with the list of controllers and everything made for them [default: EpsonRC80/OPCUA in the home folder,
    /// C:\EpsonRC80\OPCUA on Windows]
    #[arg(long, value_name = "DIR", global = true)]
    workspace: Option<PathBuf>,

    /// Language of messages [default: the system's]
    #[arg(long, value_name = "LANG", global = true, ignore_case = true, value_parser = languages())]
    lang: Option<Language>,

    /// One line of JSON per controller on standard output
    #[arg(long, global = true)]
    json: bool,

    /// Do not ask before anything is stopped, replaced or deleted; required where there is no terminal
    #[arg(long, global = true)]
    yes: bool,

    /// File with the connection password of the chosen controllers, "-" for standard input; without it the password is
    /// taken from the operating system's keyring, or from the vault of the workspace
    #[arg(
        long,
        value_name = "FILE",
        global = true,
        env = "OPCUA_CONFIGURATOR_CONNECTION_PASSWORD_FILE",
        hide_env_values = true
    )]
    connection_password_file: Option<PathBuf>,

    /// CSV file with the columns Name,Password: the connection password of each controller; what is not in it is looked
    /// for as if there was no list
    #[arg(
        long,
        value_name = "FILE.csv",
        global = true,
        env = "OPCUA_CONFIGURATOR_CONNECTION_PASSWORD_LIST",
        hide_env_values = true
    )]
    connection_password_list: Option<PathBuf>,

    /// File with the passphrase of the vault for connection passwords, "-" for standard input
    #[arg(
        long,
        value_name = "FILE",
        global = true,
        env = "OPCUA_CONFIGURATOR_VAULT_PASSPHRASE_FILE",
        hide_env_values = true
    )]
    vault_passphrase_file: Option<PathBuf>,

    /// More messages on standard error; twice for still more
    #[arg(short, long, action = clap::ArgAction::Count, global = true)]
    verbose: u8,

    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Open the window over virtual controllers in this process, in a temporary workspace
    Demo(demo::DemoArgs),
    /// Run virtual controllers without a window until Ctrl-C; one line of JSON each when it is ready
    Virtual(virtual_fleet::VirtualArgs),
    /// List, add, import, trust and remove controllers
    #[command(subcommand)]
    Controllers(controllers::ControllersCommand),
    /// Read and show the information of controllers
    Info(controller_selection::ControllerSelection),
    /// Start OPC UA servers
    Start(controller_selection::ControllerSelection),
    /// Stop OPC UA servers
    Stop(controller_selection::ControllerSelection),
    /// Show or change the basic settings of OPC UA servers
    #[command(subcommand)]
    Settings(basic_settings::SettingsCommand),
    /// List, add and remove the users of OPC UA servers
    #[command(subcommand)]
    Users(users::UsersCommand),
    /// Activate legacy controllers by their keys
    Activate(activation::ActivateArgs),
    /// Make, request, import, select and export server certificates
    #[command(subcommand)]
    Cert(cert::CertCommand),
    /// Look into certificate files, and check certificates without a controller
    #[command(subcommand)]
    Pki(pki::PkiCommand),
    /// The small CA of the workspace: create it, sign with it, revoke, publish its CRL, back it up
    #[command(subcommand)]
    Ca(certificate_authority::CaCommand),
    /// List, add, trust and remove the certificates of clients and authorities
    #[command(subcommand)]
    Clients(client_certificates::ClientsCommand),
    /// List, add and remove certificate revocation lists
    #[command(subcommand)]
    Crl(crl::CrlCommand),
    /// Show or delete the log of OPC UA servers
    #[command(subcommand)]
    Log(server_log::LogCommand),
    /// Save settings, users and keys of legacy controllers in the workspace
    ExportSettings(settings_transfer::TransferArgs),
    /// Put exported settings, users and keys back into the controllers they came from
    ImportSettings(settings_transfer::TransferArgs),
    /// Connect to OPC UA servers as a client through every offered endpoint and token; say what works and why not
    Verify(verify::VerifyArgs),
    /// Record force sensor and motion log data of controllers; show and convert recordings
    #[command(subcommand)]
    Record(record::RecordCommand),
    /// PLCs over FINS: read and write their memory, run a simulated PLC, bridge a PLC and a robot
    #[command(subcommand)]
    Fins(fins::FinsCommand),
    /// Send remote commands to a controller, over remote Ethernet or a serial line
    #[command(subcommand)]
    Remote(remote::RemoteCommand),
    /// Switch the backup of what is made on or off
    #[command(subcommand)]
    Backup(backup::BackupCommand),
    /// Connection passwords sealed in the workspace, for a computer without a keyring
    #[command(subcommand)]
    Vault(vault::VaultCommand),
    /// Show the licences of everything linked into this program
    Licences(licences::LicencesArgs),
    /// Print a completion script for a shell
    Completions { shell: clap_complete::Shell },
}

/// The values of `--lang`.
fn languages() -> impl clap::builder::TypedValueParser<Value = Language> {
    use clap::builder::{PossibleValuesParser, TypedValueParser as _};
    PossibleValuesParser::new(Language::ALL.map(Language::code)).try_map(|code| {
        parse_language(&code).ok_or(value_error::ValueError::NoneOf(Language::ALL.map(Language::code).to_vec()))
    })
}

fn parse_language(code: &str) -> Option<Language> {
    Language::ALL.into_iter().find(|language| language.code().eq_ignore_ascii_case(code))
}

/// What every subcommand needs to know.
struct CommandContext {
    workspace: Workspace,
    output: Printer,
    yes: bool,
    connection_password_file: Option<PathBuf>,
    connection_password_list: Option<PathBuf>,
    vault_passphrase_file: Option<PathBuf>,
    /// Made when they are first needed.
    passwords: OnceCell<Arc<dyn Passwords>>,
}

/// How a command ended; a [`Problem`] instead means that the request was wrong and nothing was sent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum CommandOutcome {
    AllDone,
    SomeFailed,
}

/// Runs the program: the window without a subcommand, else the subcommand.
pub fn main() -> ExitCode {
    console::attach();
    start_failure::show_panics();
    let language = language_of(std::env::args_os()).unwrap_or_else(system_language);
    let parsed = help::localised(Cli::command(), language).try_get_matches();
    let cli = parsed.and_then(|matches| Cli::from_arg_matches(&matches)).unwrap_or_else(|error| {
        let text = usage_error::explain(&error, language);
        start_failure::show_usage(&text, language);
        if !error.use_stderr() || help::is_of_clap(language) {
            error.exit();
        }
        output::say(text.trim_end());
        std::process::exit(error.exit_code())
    });
    init_log(cli.verbose);
    let output = Printer::new(cli.json, language);
    let root = cli.workspace.clone();
    let context = CommandContext {
        workspace: Workspace::new(root.unwrap_or_else(Workspace::default_root)),
        output,
        yes: cli.yes,
        connection_password_file: cli.connection_password_file,
        connection_password_list: cli.connection_password_list,
        vault_passphrase_file: cli.vault_passphrase_file,
        passwords: OnceCell::new(),
    };
    let is_window = !cli.json && matches!(cli.command, None | Some(Command::Demo(_)));
    let ending = match cli.command {
        None => window::run(&context, cli.lang),
        Some(Command::Demo(args)) => demo::run(&context, &args, cli.lang),
        Some(Command::Virtual(args)) => virtual_fleet::run(&args),
        Some(Command::Activate(args)) => activation::run(&context, &args),
        Some(Command::Controllers(command)) => controllers::run(&context, command),
        Some(Command::Info(select)) => server_control::info(&context, &select),
        Some(Command::Start(select)) => server_control::start(&context, &select),
        Some(Command::Stop(select)) => server_control::stop(&context, &select),
        Some(Command::Settings(command)) => basic_settings::run(&context, command),
        Some(Command::Users(command)) => users::run(&context, command),
        Some(Command::Cert(command)) => cert::run(&context, command),
        Some(Command::Pki(command)) => pki::run(&context, command),
        Some(Command::Ca(command)) => certificate_authority::run(&context, command),
        Some(Command::Clients(command)) => client_certificates::run(&context, command),
        Some(Command::Crl(command)) => crl::run(&context, command),
        Some(Command::Log(command)) => server_log::run(&context, command),
        Some(Command::ExportSettings(args)) => settings_transfer::export(&context, &args),
        Some(Command::ImportSettings(args)) => settings_transfer::import(&context, &args),
        Some(Command::Verify(args)) => verify::run(&context, &args),
        Some(Command::Record(command)) => record::run(&context, command),
        Some(Command::Fins(command)) => fins::run(&context, command),
        Some(Command::Remote(command)) => remote::run(&context, command),
        Some(Command::Backup(command)) => backup::run(&context, command),
        Some(Command::Vault(command)) => vault::run(&context, command),
        Some(Command::Licences(args)) => licences::run(&context, &args),
        Some(Command::Completions { shell }) => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "opcua-configurator", &mut script);
            output.text(&String::from_utf8_lossy(&script));
            Ok(CommandOutcome::AllDone)
        }
    };
    match ending {
        Ok(CommandOutcome::AllDone) => ExitCode::SUCCESS,
        Ok(CommandOutcome::SomeFailed) => ExitCode::from(1),
        Err(problem) => {
            context.output.request_wrong(&problem);
            start_failure::show(&problem, language, is_window);
            ExitCode::from(2)
        }
    }
}

/// The language that was asked for: needed before the arguments are parsed, for the help.
fn language_of(arguments: impl IntoIterator<Item = std::ffi::OsString>) -> Option<Language> {
    let mut arguments = arguments.into_iter().map(|argument| argument.to_string_lossy().into_owned());
    let value = arguments.find_map(|argument| match argument.as_str() {
        "--lang" => Some(None),
        _ => argument.strip_prefix("--lang=").map(|value| Some(value.to_owned())),
    })?;
    parse_language(&value.or_else(|| arguments.next())?)
}

fn system_language() -> Language {
    sys_locale::get_locale().map_or(Language::En, |locale| Language::from_locale(&locale))
}

/// `RUST_LOG` wins over `-v`. Logs never hold secrets: the types that carry them do not show them.
fn init_log(verbose: u8) {
    use std::io::IsTerminal as _;

    use tracing_subscriber::EnvFilter;
    let default = match verbose {
        // What the OPC UA library calls an error is a peer that refuses or hangs up; the caller reports it.
        0 => "error,opcua_client=off,opcua_core=off,opcua_crypto=off",
        1 => "warn,opcua_configurator=info",
        2 => "info,opcua_configurator=debug",
        _ => "debug",
    };
    let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new(default));
    tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(std::io::stderr)
        .with_ansi(std::io::stderr().is_terminal())
        .init();
}

/// Reads a file that is given on the command line, up to one byte more than `limit`.
fn read_bounded(path: &Path, limit: usize) -> Result<Vec<u8>, Problem> {
    use std::io::Read as _;
    let read = || -> std::io::Result<Vec<u8>> {
        let file = std::fs::File::open(path)?;
        let length = file.metadata()?.len().min(limit as u64) + 1;
        // Capacity for all of it at once: a vector that grows leaves copies of passwords in memory.
        let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or_default());
        file.take(limit as u64 + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    read()
        .map_err(|e| Problem::with_detail(crate::model::ErrorCode::FileUnreadable, format!("{}: {e}", path.display())))
}

/// The runtime commands run their jobs on.
fn runtime() -> Result<tokio::runtime::Runtime, Problem> {
    tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()
        .map_err(|e| Problem::with_detail(crate::model::ErrorCode::Internal, e))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_well_formed_in_every_language() {
        for language in Language::ALL {
            help::localised(Cli::command(), language).debug_assert();
        }
    }

    #[test]
    fn the_language_is_known_before_the_arguments_are_parsed() {
        let of = |arguments: &[&str]| language_of(arguments.iter().map(Into::into));
        assert_eq!(of(&["program", "--lang", "zh", "info"]), Some(Language::Zh));
        assert_eq!(of(&["program", "info", "--lang=zh", "--help"]), Some(Language::Zh));
        assert_eq!(of(&["program", "--lang", "JA"]), Some(Language::Ja));
        for none in [&["program", "info"][..], &["program", "--lang"], &["program", "--lang", "xx"]] {
            assert_eq!(of(none), None, "{none:?}");
        }
    }
}
