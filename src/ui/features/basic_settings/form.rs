use std::collections::BTreeSet;

use crate::jobs::{self, BasicSettingsChange};
use crate::model::{
    ErrorCode, RevisionToken, SecurityPolicy, ServerPort, ServerSettings, StartupMode, UserTokenPolicy,
};
use crate::texts::TextKey;
use crate::ui::model::{Model, RowId};

/// The basic settings (manual 2.6.1).
#[derive(Debug)]
pub struct BasicSettingsForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    /// The settings of the one controller are being read.
    pub reading: bool,
    pub revision: Option<RevisionToken>,
    pub port: String,
    pub startup: StartupMode,
    pub policies: BTreeSet<SecurityPolicy>,
    pub tokens: BTreeSet<UserTokenPolicy>,
    pub server_log: bool,
    /// The log was on already: it may stay on without the password.
    pub log_was_on: bool,
    pub log_password: String,
    pub delete_log: bool,
    /// How many users the controller has, when known.
    pub users: Option<usize>,
    /// Ports of other functions of the controllers.
    pub used_ports: BTreeSet<u16>,
}

impl BasicSettingsForm {
    /// From the defaults; `fill` puts in what one controller has.
    pub fn new(rows: Vec<RowId>, model: &Model) -> Self {
        let used_ports = rows
            .iter()
            .filter_map(|id| model.rows.get(*id)?.info())
            .flat_map(|info| info.used_ports.iter().copied())
            .collect();
        let mut form = Self {
            names: model.rows.names(&rows),
            reading: rows.len() == 1,
            rows,
            revision: None,
            port: String::new(),
            startup: Default::default(),
            policies: BTreeSet::new(),
            tokens: BTreeSet::new(),
            server_log: false,
            log_was_on: false,
            log_password: String::new(),
            delete_log: false,
            users: None,
            used_ports,
        };
        form.fill(ServerSettings::default());
        form
    }

    pub fn fill(&mut self, settings: ServerSettings) {
        self.port = settings.port.to_string();
        self.startup = settings.startup;
        self.policies = settings.security_policies;
        self.tokens = settings.user_tokens;
        self.server_log = settings.server_log;
        self.log_was_on = settings.server_log;
    }

    pub fn port_error(&self) -> Option<TextKey> {
        match self.port.parse::<ServerPort>() {
            Err(_) => Some(TextKey::PortRule),
            Ok(port) if self.used_ports.contains(&port.get()) => Some(TextKey::PortUsed),
            Ok(_) => None,
        }
    }

    pub fn asks_log_password(&self) -> bool {
        self.server_log && !self.log_was_on
    }

    pub fn log_password_error(&self) -> Option<ErrorCode> {
        let wrong = self.asks_log_password()
            && !self.log_password.is_empty()
            && self.log_password != ServerSettings::LOG_PASSWORD;
        wrong.then_some(ErrorCode::LogPassword)
    }

    /// What Apply sends; `None` while something is missing or wrong.
    pub fn operation(&self) -> Option<jobs::SetBasicSettings> {
        let log_password = self.asks_log_password().then(|| self.log_password.clone());
        if log_password.as_deref().is_some_and(|p| p != ServerSettings::LOG_PASSWORD) || self.reading {
            return None;
        }
        // Another controller of several may be the one that uses the port; it says so itself.
        if self.rows.len() == 1 && self.port_error().is_some() {
            return None;
        }
        let settings = self.settings()?;
        Some(jobs::SetBasicSettings {
            change: BasicSettingsChange::all(settings, self.delete_log),
            based_on: self.revision,
            log_password,
        })
    }

    fn settings(&self) -> Option<ServerSettings> {
        let settings = ServerSettings {
            port: self.port.parse().ok()?,
            startup: self.startup,
            security_policies: self.policies.clone(),
            user_tokens: self.tokens.clone(),
            server_log: self.server_log,
        };
        settings.check().ok().map(|()| settings)
    }

    pub fn warns_no_users(&self) -> bool {
        self.settings().is_some_and(|s| s.warnings(self.users).contains(&crate::model::SettingsWarning::NoUsers))
    }
}
