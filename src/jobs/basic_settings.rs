use std::collections::BTreeSet;

use async_trait::async_trait;

use super::{Confirmation, JobStep, NoOutput, Operation, OperationRun, ServerEffect};
use crate::model::{
    ErrorCode, Problem, RevisionToken, Revisioned, SecurityPolicy, ServerPort, ServerSettings, StartupMode,
    UserTokenPolicy,
};
use crate::session::SettingsUpdate;

/// Reads the basic settings.
#[derive(Debug, Clone, Copy)]
pub struct ReadBasicSettings;

#[async_trait]
impl Operation for ReadBasicSettings {
    type Output = Revisioned<ServerSettings>;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<Revisioned<ServerSettings>, Problem> {
        run.begin(JobStep::Read)?;
        run.session.settings().await
    }
}

/// The settings to be changed; what is `None` stays as it is in each controller.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct BasicSettingsChange {
    /// TCP port of the OPC UA server.
    pub port: Option<ServerPort>,
    /// Whether the server starts with the controller.
    pub startup: Option<StartupMode>,
    /// The security policies that clients may use.
    pub security_policies: Option<BTreeSet<SecurityPolicy>>,
    /// The ways in which users may log in.
    pub user_tokens: Option<BTreeSet<UserTokenPolicy>>,
    /// Whether the server log is written.
    pub server_log: Option<bool>,
    /// Deletes the server log, after it was switched off or before it is switched on.
    pub delete_log: bool,
}

impl BasicSettingsChange {
    /// Every setting, as a dialog applies them.
    pub fn all(settings: ServerSettings, delete_log: bool) -> Self {
        Self {
            port: Some(settings.port),
            startup: Some(settings.startup),
            security_policies: Some(settings.security_policies),
            user_tokens: Some(settings.user_tokens),
            server_log: Some(settings.server_log),
            delete_log,
        }
    }

    fn apply(&self, settings: &mut ServerSettings) {
        if let Some(port) = self.port {
            settings.port = port;
        }
        if let Some(startup) = self.startup {
            settings.startup = startup;
        }
        if let Some(policies) = &self.security_policies {
            settings.security_policies.clone_from(policies);
        }
        if let Some(tokens) = &self.user_tokens {
            settings.user_tokens.clone_from(tokens);
        }
        if let Some(server_log) = self.server_log {
            settings.server_log = server_log;
        }
    }
}

/// Changes the basic settings (manual 2.6.1).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SetBasicSettings {
    /// What is changed.
    pub change: BasicSettingsChange,
    /// The configuration that a dialog showed; `None` bases the change on the present one.
    pub based_on: Option<RevisionToken>,
    /// What was typed to allow switching the server log on.
    pub log_password: Option<String>,
}

#[async_trait]
impl Operation for SetBasicSettings {
    type Output = NoOutput;

    fn confirmation(&self) -> Option<Confirmation> {
        let BasicSettingsChange { port, security_policies, user_tokens, server_log, delete_log, startup: _ } =
            &self.change;
        Some(Confirmation {
            server: ServerEffect::Restarts,
            changes_endpoints: port.is_some() || security_policies.is_some() || user_tokens.is_some(),
            starts_log: *server_log == Some(true),
            deletes_log: *delete_log,
            ..Confirmation::default()
        })
    }

    fn check(&self, controller: &super::JobController) -> Result<(), Problem> {
        let empty = |set: Option<bool>| set == Some(true);
        if empty(self.change.security_policies.as_ref().map(BTreeSet::is_empty))
            || empty(self.change.user_tokens.as_ref().map(BTreeSet::is_empty))
        {
            return Err(ErrorCode::BadSettings.into());
        }
        if self.change.server_log == Some(true)
            && self.log_password.as_deref().is_some_and(|p| p != ServerSettings::LOG_PASSWORD)
        {
            return Err(ErrorCode::LogPassword.into());
        }
        match (&controller.known, self.change.port) {
            (Some(known), Some(port)) if known.used_ports.contains(&port.get()) => {
                Err(Problem::with_detail(ErrorCode::PortConflict, port))
            }
            _ => Ok(()),
        }
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<NoOutput, Problem> {
        run.begin(JobStep::Read)?;
        let current = run.session.settings().await?;
        let mut settings = current.value;
        self.change.apply(&mut settings);
        settings.check().map_err(|e| Problem::with_detail(ErrorCode::BadSettings, e))?;
        run.begin(JobStep::Apply)?;
        run.session
            .set_settings(
                self.based_on.unwrap_or(current.revision),
                SettingsUpdate {
                    settings,
                    delete_log: self.change.delete_log,
                    log_password: self.log_password.clone(),
                },
            )
            .await?;
        Ok(NoOutput)
    }
}
