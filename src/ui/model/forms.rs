//! What the forms make of what was typed.

use std::collections::BTreeSet;

use secrecy::SecretString;

use super::{AddController, AddStage, AddUserForm, Model, RowId, SelfSignedForm, SettingsForm, Task, Typed};
use crate::jobs::{self, CsrFields, SelfSignedFields, SettingsChange};
use crate::model::{
    Address, ConnectionKind, ControllerName, ControllerSeries, Credential, ErrorCode, FileFormat, KeyLength, MAX_USERS,
    Problem, SecurityPolicy, ServerPort, ServerSettings, Subject, SubjectError, UserName, UserPassword, Validity,
    offered_key_lengths,
};
use crate::texts::TextKey;

impl AddController {
    pub fn new() -> Self {
        Self {
            name: String::new(),
            address: String::new(),
            password: Typed::default(),
            show_password: false,
            focus_password: false,
            series: ControllerSeries::Rc800,
            connection: ConnectionKind::default(),
            stage: AddStage::Form,
            problem: None,
            tried: false,
            identity: None,
        }
    }

    pub fn name_error(&self, model: &Model) -> Option<TextKey> {
        match self.name.parse::<ControllerName>() {
            Err(_) if self.name.is_empty() && !self.tried => None,
            Err(_) => Some(TextKey::NameRule),
            Ok(name) => model.rows.all().iter().any(|row| row.entry.name == name).then_some(TextKey::NameTaken),
        }
    }

    pub fn address_error(&self, model: &Model) -> Option<TextKey> {
        match self.address.parse::<Address>() {
            Err(_) if self.address.is_empty() && !self.tried => None,
            Err(_) => Some(TextKey::AddressRule),
            Ok(address) => {
                model.rows.all().iter().any(|row| row.entry.address == address).then_some(TextKey::AddressTaken)
            }
        }
    }

    /// Why the form cannot be sent yet.
    pub fn incomplete(&self, model: &Model) -> Option<TextKey> {
        if self.identity.is_some() {
            return None;
        }
        if self.name.trim().is_empty() {
            return Some(TextKey::NameRule);
        }
        if self.address.trim().is_empty() {
            return Some(TextKey::AddressRule);
        }
        self.name_error(model).or_else(|| self.address_error(model))
    }

    pub fn target(&self, model: &Model) -> Result<(ControllerName, Address), Problem> {
        let name: ControllerName = self.name.parse().map_err(|e| Problem::with_detail(ErrorCode::BadName, e))?;
        let address: Address = self.address.parse().map_err(|e| Problem::with_detail(ErrorCode::BadAddress, e))?;
        if self.identity.is_none() {
            model.configuration().check_new(&name, &address)?;
        }
        Ok((name, address))
    }

    /// Whether it can be added without being reached: that was tried, and nothing answered.
    pub fn may_be_unconfirmed(&self) -> bool {
        let unreached = self.problem.as_ref().is_some_and(|problem| problem.code.is_unreached());
        unreached && self.stage == AddStage::Form && self.identity.is_none()
    }

    pub fn secret(&self) -> SecretString {
        SecretString::from(self.password.0.clone())
    }
}

impl Default for AddController {
    fn default() -> Self {
        Self::new()
    }
}

impl SettingsForm {
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
    pub fn operation(&self) -> Option<jobs::SetSettings> {
        let log_password = self.asks_log_password().then(|| self.log_password.clone());
        if log_password.as_deref().is_some_and(|p| p != ServerSettings::LOG_PASSWORD) || self.reading {
            return None;
        }
        // Another controller of several may be the one that uses the port; it says so itself.
        if self.rows.len() == 1 && self.port_error().is_some() {
            return None;
        }
        let settings = self.settings()?;
        Some(jobs::SetSettings {
            change: SettingsChange::all(settings, self.delete_log),
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

impl AddUserForm {
    pub fn name_error(&self) -> Option<TextKey> {
        match self.name.parse::<UserName>() {
            Err(_) if self.name.is_empty() => None,
            Err(_) => Some(TextKey::UserRule),
            Ok(name) => self.existing.contains(&name).then_some(TextKey::UserExists),
        }
    }

    pub fn password_error(&self) -> Option<TextKey> {
        (!self.password.0.is_empty() && UserPassword::new(&self.password.0).is_err()).then_some(TextKey::UserRule)
    }

    pub fn operation(&self) -> Option<jobs::AddUser> {
        let name: UserName = self.name.parse().ok()?;
        let password = UserPassword::new(&self.password.0).ok()?;
        let fits = !self.existing.contains(&name) && self.existing.len() < MAX_USERS;
        fits.then_some(jobs::AddUser { credential: Credential { name, password }, based_on: self.revision })
    }
}

impl SelfSignedForm {
    pub fn new(rows: Vec<RowId>, request: Option<FileFormat>, model: &Model) -> Self {
        let one = (rows.len() == 1).then(|| model.rows.get(rows[0])).flatten();
        let common_name = one.and_then(|row| row.info()).map(|i| i.application_name.clone()).unwrap_or_default();
        let reading = rows.len() == 1;
        Self {
            names: model.rows.names(&rows),
            rows,
            reading,
            common_name,
            country: "",
            country_search: String::new(),
            state: String::new(),
            locality: String::new(),
            organisation: String::new(),
            key_length: KeyLength::Rsa2048,
            offered: if reading { vec![KeyLength::Rsa2048] } else { KeyLength::ALL.to_vec() },
            years: 5,
            request,
        }
    }

    pub fn is_single(&self) -> bool {
        self.rows.len() == 1
    }

    pub fn offer(&mut self, policies: &BTreeSet<SecurityPolicy>) {
        self.offered = offered_key_lengths(policies);
        if !self.offered.contains(&self.key_length) {
            self.key_length = KeyLength::Rsa2048;
        }
    }

    fn subject(&self) -> Subject {
        Subject {
            common_name: if self.is_single() { self.common_name.clone() } else { "each its own".to_owned() },
            country: self.country.to_owned(),
            state: self.state.clone(),
            locality: self.locality.clone(),
            organisation: self.organisation.clone(),
        }
    }

    /// Which field is wrong, by the name [`Subject::check`] gives it.
    pub fn error(&self, field: &str) -> Option<TextKey> {
        // One field at a time: the others must not hide its mistake.
        let empty = Subject {
            common_name: "x".into(),
            country: String::new(),
            state: String::new(),
            locality: String::new(),
            organisation: String::new(),
        };
        let own = self.subject();
        let subject = match field {
            "common name" => Subject { common_name: own.common_name, ..empty },
            "state" => Subject { state: own.state, ..empty },
            "locality" => Subject { locality: own.locality, ..empty },
            _ => Subject { organisation: own.organisation, ..empty },
        };
        match subject.check() {
            Ok(()) => None,
            Err(SubjectError::Empty(_)) => Some(TextKey::CommonNameRule),
            Err(SubjectError::TooLong(..)) => Some(TextKey::LengthRule),
            Err(_) => Some(TextKey::HalfWidthRule),
        }
    }

    /// What Apply does; `None` while something is wrong.
    pub fn task(&self, model: &Model) -> Option<Task> {
        let fields = self.fields()?;
        let (files, backup) = (model.workspace.certificate_files(), model.options.backup);
        let Some(format) = self.request else {
            let operation = jobs::SelfSigned { fields, backup: backup.then_some(files) };
            let task = Task::new(TextKey::SelfSignedTitle, operation);
            return Some(task.act(TextKey::ActSelfSigned).restarts_server());
        };
        let SelfSignedFields { common_name, country, state, locality, organisation, key_length, validity: _ } = fields;
        let fields = CsrFields { common_name, country, state, locality, organisation, key_length };
        let operation = jobs::CreateCsr { fields, format, files, backup };
        Some(Task::new(TextKey::CsrTitle, operation).act(TextKey::ActCreateCsr))
    }

    fn fields(&self) -> Option<SelfSignedFields> {
        if self.reading {
            return None;
        }
        self.subject().check().ok()?;
        Some(SelfSignedFields {
            common_name: self.is_single().then(|| self.common_name.clone()),
            country: self.country.to_owned(),
            state: self.state.clone(),
            locality: self.locality.clone(),
            organisation: self.organisation.clone(),
            key_length: self.key_length,
            validity: Validity::try_from(self.years).ok()?,
        })
    }
}
