use std::collections::BTreeSet;

use clap::Subcommand;
use serde_json::json;

use super::batch::{Presentation, STATE, Shown};
use super::select::Select;
use super::{Ending, Settled};
use crate::jobs::{Outcome, ReadSettings, SetSettings, SettingsChange};
use crate::model::{
    ErrorCode, PortError, Problem, SecurityPolicy, ServerPort, ServerSettings, StartupMode, UserTokenPolicy,
};

#[derive(Debug, Subcommand)]
pub enum SettingsCommand {
    /// Show the basic settings
    Show(Select),
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
        /// Write a server log: on or off. In normal use it stays off; it stops the server when it is full
        #[arg(long, value_name = "on|off", value_parser = on_off)]
        server_log: Option<bool>,
        /// Delete the server log in the controller
        #[arg(long)]
        delete_log: bool,
        #[command(flatten)]
        select: Select,
    },
}

fn on_off(text: &str) -> Result<bool, String> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        other => Err(format!("\"{other}\" is neither on nor off")),
    }
}

const SETTINGS: Presentation = Presentation {
    header: &["PORT", "STARTUP", "POLICIES", "TOKENS", "LOG"],
    show: |outcome, _| {
        let Outcome::Settings(settings) = outcome else {
            return Shown { json: json!(null), cells: Vec::new() };
        };
        let ServerSettings { port, startup, security_policies, user_tokens, server_log } = &settings.value;
        let join = |words: Vec<&str>| words.join(",");
        Shown {
            json: json!(settings.value),
            cells: vec![
                port.to_string(),
                startup.as_str().to_owned(),
                join(security_policies.iter().map(|p| p.as_str()).collect()),
                join(user_tokens.iter().map(|t| t.as_str()).collect()),
                if *server_log { "On" } else { "Off" }.to_owned(),
            ],
        }
    },
};

pub fn run(settled: &Settled, command: SettingsCommand) -> Result<Ending, Problem> {
    let configuration = settled.configuration()?;
    match command {
        SettingsCommand::Show(select) => {
            settled.batch(&configuration, &select.resolve(&configuration)?, ReadSettings, &SETTINGS)
        }
        SettingsCommand::Set { port, startup, policies, tokens, server_log, delete_log, select } => {
            let wrong = |e: &dyn std::fmt::Display| Problem::with_detail(ErrorCode::BadSettings, e);
            let change = SettingsChange {
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
            if change == SettingsChange::default() {
                return Err(Problem::with_detail(ErrorCode::BadSettings, "nothing to change was given"));
            }
            // The password guards a tick box against a careless click; an option is typed on purpose.
            let log_password = (server_log == Some(true)).then(|| ServerSettings::LOG_PASSWORD.to_owned());
            let operation = SetSettings { change, based_on: None, log_password };
            settled.batch(&configuration, &select.resolve(&configuration)?, operation, &STATE)
        }
    }
}
