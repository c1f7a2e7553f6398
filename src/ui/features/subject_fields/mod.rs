//! What a self-signed server certificate (manual 2.7.1.2) and a CSR (manual 2.7.1.5) are asked for: the subject and the
//! key length. Not a command of its own: `self_signed` and `create_csr` show these fields.

mod view;

use std::collections::BTreeSet;

use crate::jobs::{self, CsrFields};
use crate::model::{KeyLength, SecurityPolicy, Subject, SubjectError, offered_key_lengths};
use crate::texts::TextKey;
use crate::ui::model::{BackendCommand, Dialog, Model, RowId, Task};

pub use view::show;

/// The subject and the key length of one certificate, or of one for each of several controllers.
#[derive(Debug)]
pub struct SubjectFields {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    /// The policies, which decide what key lengths are offered, are being read.
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
}

/// A dialog with these fields.
pub trait SubjectForm: Dialog {
    fn subject_fields(&mut self) -> &mut SubjectFields;
}

impl SubjectFields {
    /// Empty fields for a certificate of these controllers.
    pub fn new(rows: Vec<RowId>, model: &Model) -> Self {
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
        }
    }

    /// It is for one controller.
    pub fn is_single(&self) -> bool {
        self.rows.len() == 1
    }

    /// Offers the key lengths that these policies allow.
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

    /// What is asked for; `None` while something is wrong or missing.
    pub fn request(&self) -> Option<CsrFields> {
        if self.reading {
            return None;
        }
        self.subject().check().ok()?;
        Some(CsrFields {
            common_name: self.is_single().then(|| self.common_name.clone()),
            country: self.country.to_owned(),
            state: self.state.clone(),
            locality: self.locality.clone(),
            organisation: self.organisation.clone(),
            key_length: self.key_length,
        })
    }

    /// Why there is no request.
    pub fn why_not(&self) -> Option<TextKey> {
        if self.reading {
            return Some(TextKey::Reading);
        }
        ["common name", "state", "locality", "organisation"].iter().find_map(|field| self.error(field))
    }
}

impl Model {
    /// Opens a dialog with empty fields for these controllers. Of a single one, the policies are read first.
    pub(in crate::ui) fn open_subject_form<F: SubjectForm>(
        &mut self,
        rows: Vec<RowId>,
        form: impl FnOnce(SubjectFields) -> F,
    ) -> Vec<BackendCommand> {
        let subject = SubjectFields::new(rows.clone(), self);
        let reading = subject.reading;
        self.open(form(subject));
        if reading { self.start(read_policies::<F>(), rows, None) } else { vec![] }
    }
}

/// Reads which policies the controller has on, for a form that waits for them.
fn read_policies<F: SubjectForm>() -> Task {
    Task::with_results(TextKey::SettingsTitle, jobs::ReadBasicSettings, |model, row, result| {
        let name = model.rows.get(row).and_then(|row| row.info()).map(|info| info.application_name.clone());
        if let (Ok(settings), Some(form)) = (result, model.dialog::<F>()) {
            let fields = form.subject_fields();
            fields.reading = false;
            fields.offer(&settings.value.security_policies);
            if let Some(name) = name.filter(|_| fields.common_name.is_empty()) {
                fields.common_name = name;
            }
        }
        vec![]
    })
    .for_dialog::<F>()
}
