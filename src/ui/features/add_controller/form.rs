use secrecy::SecretString;

use crate::model::{Address, ConnectionKind, ControllerName, ControllerSeries, ErrorCode, Problem};
use crate::pki::Fingerprint;
use crate::texts::TextKey;
use crate::ui::model::{Model, RowId, SecretInput};

/// A new controller (manual 2.5.1).
#[derive(Debug)]
pub struct AddControllerForm {
    /// The name, as it is typed.
    pub name: String,
    /// The address, as it is typed.
    pub address: String,
    /// The connection password, as it is typed.
    pub password: SecretInput,
    /// Whether the password is shown.
    pub show_password: bool,
    /// The field for the password has just appeared and takes the keyboard.
    pub focus_password: bool,
    /// The chosen series.
    pub series: ControllerSeries,
    /// The chosen protocol.
    pub connection: ConnectionKind,
    /// How far adding is.
    pub stage: AddStage,
    /// Why the last attempt failed.
    pub problem: Option<Problem>,
    /// Apply was pressed once: mistakes are pointed out also in fields that are still empty.
    pub tried: bool,
    /// The controller is in the list already, without a fingerprint.
    pub identity: Option<ConfirmIdentityForm>,
}

/// Controllers of the list whose identity is confirmed, one after the other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConfirmIdentityForm {
    pub row: RowId,
    /// Whose turn comes next, in order.
    pub next: Vec<RowId>,
    /// Counted from 1.
    pub nth: usize,
    /// Those to read information of in the end.
    pub then_read: Vec<RowId>,
}

impl ConfirmIdentityForm {
    pub fn all(&self) -> usize {
        self.nth + self.next.len()
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AddStage {
    Form,
    Probing,
    /// A person compares.
    Compare(Fingerprint),
    Enrolling(Fingerprint),
}

impl AddControllerForm {
    /// An empty form.
    pub fn new() -> Self {
        Self {
            name: String::new(),
            address: String::new(),
            password: SecretInput::default(),
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

    /// What is wrong with the name, if anything is.
    pub fn name_error(&self, model: &Model) -> Option<TextKey> {
        match self.name.parse::<ControllerName>() {
            Err(_) if self.name.is_empty() && !self.tried => None,
            Err(_) => Some(TextKey::NameRule),
            Ok(name) => model.rows.all().iter().any(|row| row.entry.name == name).then_some(TextKey::NameTaken),
        }
    }

    /// What is wrong with the address, if anything is.
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

    /// The name and address, or the first mistake.
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

    /// Whether a controller is being asked.
    pub fn is_waiting(&self) -> bool {
        matches!(self.stage, AddStage::Probing | AddStage::Enrolling(_))
    }

    /// The password that was typed.
    pub fn secret(&self) -> SecretString {
        SecretString::from(self.password.0.clone())
    }
}

impl Default for AddControllerForm {
    fn default() -> Self {
        Self::new()
    }
}
