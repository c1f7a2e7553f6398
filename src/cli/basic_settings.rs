use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::Subcommand;
use secrecy::ExposeSecret as _;
use serde_json::json;

use super::batch::{Presentation, PrintedResult, STATE};
use super::controller_selection::ControllerSelection;
use super::passwords::ask_secret;
use super::secret_file::read_secret;
use super::value_error::ValueError;
use super::{CommandContext, CommandOutcome};
use crate::jobs::{BasicSettingsChange, ReadBasicSettings, SetBasicSettings};
use crate::model::{
    ErrorCode, Language, PortError, Problem, Revisioned, SecurityPolicy, ServerPort, ServerSettings, StartupMode,
    UserTokenPolicy,
};
use crate::texts::TextKey;

#[derive(Debug, Subcommand)]
pub enum SettingsCommand {
    /// Show the basic settings
    Show(ControllerSelection),
    /// Change the basic settings; what is not given stays as it is
    Set {
        /// TCP port of the OPC UA server, 1024 to 65535
        #[arg(long, value_name = "N")]
        port: Option<String>,
        /// Who starts the server: auto (the controller, when switched on) or manual
        #[arg(long, value_name = "MODE")]
        startup: Option<String>,
        /// Security policies, separated by commas: None, Basic128Rsa15, Basic256, Basic256Sha256,
        /// Aes128Sha256RsaOaep, Aes256Sha256RsaPss
        #[arg(long, value_name = "A,B", value_delimiter = ',')]
        policies: Option<Vec<String>>,
        /// User tokens, separated by commas: anonymous, username
        #[arg(long, value_name = "A,B", value_delimiter = ',')]
        tokens: Option<Vec<String>>,
        /// Write a server log: on or off. Switching it on needs the password 199532, which keeps it from being switched on
        /// by mistake. In normal use the log stays off; the server stops when it is full
        #[arg(long, value_name = "on|off", value_parser = on_off)]
        server_log: Option<bool>,
        /// File with the password for switching the server log on (199532), "-" for standard input [default: asked for on
        /// the terminal]
        #[arg(long, value_name = "FILE")]
        log_password_file: Option<PathBuf>,
        /// Delete the server log in the controller
        #[arg(long)]
        delete_log: bool,
        #[command(flatten)]
        select: ControllerSelection,
    },
}

/// The value of a switch.
pub fn on_off(text: &str) -> Result<bool, ValueError> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err(ValueError::NeitherOnNorOff),
    }
}

/// What the manual makes a person type before the server log is switched on (2.6.1). A wrong one is refused before
/// anything is sent.
fn log_password(file: Option<&Path>, language: Language) -> Result<String, Problem> {
    let given = match file {
        Some(file) => read_secret(file)?,
        None => ask_secret(TextKey::CliAskLogPassword.text(language))?.ok_or(ErrorCode::LogPassword)?,
    };
    let given = given.expose_secret();
    if given != ServerSettings::LOG_PASSWORD {
        return Err(ErrorCode::LogPassword.into());
    }
    Ok(given.to_owned())
}

const SETTINGS: Presentation<Revisioned<ServerSettings>> = Presentation {
    header: &[
        TextKey::HeadingPort,
        TextKey::HeadingStartup,
        TextKey::HeadingPolicies,
        TextKey::HeadingTokens,
        TextKey::HeadingLog,
    ],
    show: |settings, _| {
        let ServerSettings { port, startup, security_policies, user_tokens, server_log } = &settings.value;
        let join = |words: Vec<&str>| words.join(",");
        PrintedResult {
            json: json!(settings.value),
            cells: vec![
                port.to_string().into(),
                startup.as_str().to_owned().into(),
                join(security_policies.iter().map(|p| p.as_str()).collect()).into(),
                join(user_tokens.iter().map(|t| t.as_str()).collect()).into(),
                if *server_log { TextKey::On } else { TextKey::Off }.into(),
            ],
        }
    },
};

pub fn run(cli: &CommandContext, command: SettingsCommand) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    match command {
        SettingsCommand::Show(select) => cli.batch(
            &configuration,
            &select.resolve(&configuration, cli.output.language())?,
            ReadBasicSettings,
            &SETTINGS,
        ),
        SettingsCommand::Set { port, startup, policies, tokens, server_log, log_password_file, delete_log, select } => {
            let wrong = |e: &dyn std::fmt::Display| Problem::with_detail(ErrorCode::BadSettings, e);
            let change = BasicSettingsChange {
                port: port
                    .map(|p| p.parse::<ServerPort>())
                    .transpose()
                    .map_err(|e: PortError| Problem::with_detail(ErrorCode::BadPort, e))?,
                startup: startup.map(|s| s.parse::<StartupMode>()).transpose().map_err(|e| wrong(&e))?,
                security_policies: policies
                    .map(|list| list.iter().map(|p| p.parse()).collect::<Result<BTreeSet<SecurityPolicy>, _>>())
                    .transpose()
                    .map_err(|e| wrong(&e))?,
                user_tokens: tokens
                    .map(|list| list.iter().map(|t| t.parse()).collect::<Result<BTreeSet<UserTokenPolicy>, _>>())
                    .transpose()
                    .map_err(|e| wrong(&e))?,
                server_log,
                delete_log,
            };
            if change == BasicSettingsChange::default() {
                return Err(ErrorCode::NothingToChange.into());
            }
            let log_password = match server_log {
                Some(true) => Some(log_password(log_password_file.as_deref(), cli.output.language())?),
                _ => None,
            };
            let operation = SetBasicSettings { change, based_on: None, log_password };
            cli.batch(&configuration, &select.resolve(&configuration, cli.output.language())?, operation, &STATE)
        }
    }
}
