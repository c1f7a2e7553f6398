use std::collections::BTreeSet;

use crate::jobs::{self, CsrFields, SelfSignedFields};
use crate::model::{FileFormat, KeyLength, SecurityPolicy, Subject, SubjectError, Validity, offered_key_lengths};
use crate::texts::TextKey;
use crate::ui::model::{Model, RowId, Task};

/// A self-signed server certificate (manual 2.7.1.2), or the request for one that a CA signs (2.7.1.5).
#[derive(Debug)]
pub struct SelfSignedForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub reading: bool,
    /// Used for one controller only; several make their own.
    pub common_name: String,
    /// ISO code, or empty.
    pub country: &'static str,
    pub country_search: String,
    pub state: String,
    pub locality: String,
    pub organisation: String,
    pub key_length: KeyLength,
    pub offered: Vec<KeyLength>,
    /// Of a self-signed certificate.
    pub years: u8,
    /// It is a request, to be saved in this format.
    pub request: Option<FileFormat>,
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
