use std::collections::BTreeSet;

use super::{LogView, Purpose, RowId, Task, TransferForm};
use crate::jobs::Confirmation;
use crate::model::{ControllerSeries, KeyLength, Problem, SecurityPolicy, StartupMode, UserName, UserTokenPolicy};
use crate::pki::Fingerprint;

/// A dialog with whatever is typed into it.
#[derive(Debug)]
pub enum Dialog {
    AddController(AddController),
    Delete { rows: Vec<RowId>, names: Vec<String> },
    Password(PasswordForm),
    Confirm { task: Task, rows: Vec<RowId>, names: Vec<String>, confirmation: Confirmation },
    Processing(ProcessingView),
    Settings(SettingsForm),
    Users(UsersForm),
    AddUser(AddUserForm),
    SelfSigned(SelfSignedForm),
    Transfer(TransferForm),
    ServerLog(LogView),
    Backup { on: bool },
    Options,
    Error(Problem),
    About,
    Shortcuts,
}

impl Dialog {
    /// A form that may wait for what is in a controller. At most one is open.
    pub(super) fn is_form(&self) -> bool {
        matches!(self, Self::Settings(_) | Self::Users(_) | Self::SelfSigned(_) | Self::ServerLog(_))
    }
}

/// A new controller (manual 2.5.1).
#[derive(Debug)]
pub struct AddController {
    pub name: String,
    pub address: String,
    pub password: Typed,
    pub show_password: bool,
    pub series: ControllerSeries,
    pub stage: AddStage,
    /// Why the last attempt failed.
    pub problem: Option<Problem>,
    /// Apply was pressed once: mistakes are pointed out also in fields that are still empty.
    pub tried: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AddStage {
    Form,
    Probing,
    /// A person compares.
    Compare(Fingerprint),
    Enrolling(Fingerprint),
}

/// The password of controllers whose password is not known.
#[derive(Debug)]
pub struct PasswordForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub password: Typed,
    pub show_password: bool,
    /// The one used last was refused.
    pub wrong: bool,
    /// What to do once it is there.
    pub task: Task,
    pub purpose: Purpose,
}

/// What of the running job is looked at.
#[derive(Debug, Default)]
pub struct ProcessingView {
    /// Index of the controller whose failure is explained.
    pub selected: Option<usize>,
    /// The one the list has scrolled to.
    pub revealed: Option<usize>,
}

/// The basic settings (manual 2.6.1).
#[derive(Debug)]
pub struct SettingsForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    /// The settings of the one controller are being read.
    pub reading: bool,
    pub revision: Option<u64>,
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

/// The users of one controller (manual 2.6.2).
#[derive(Debug)]
pub struct UsersForm {
    pub row: RowId,
    pub name: String,
    pub reading: bool,
    pub revision: Option<u64>,
    pub users: Vec<UserName>,
    pub ticked: BTreeSet<UserName>,
}

/// One more user, for one controller or many.
#[derive(Debug)]
pub struct AddUserForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub revision: Option<u64>,
    /// Users the one controller has already.
    pub existing: Vec<UserName>,
    pub name: String,
    pub password: Typed,
    pub show_password: bool,
}

/// A self-signed server certificate (manual 2.7.1.2).
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
    pub years: u8,
}

/// A secret while it is typed: not shown by `Debug`, wiped when the dialog closes.
#[derive(Default)]
pub struct Typed(pub String);

impl std::fmt::Debug for Typed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Typed(…)")
    }
}

impl Drop for Typed {
    fn drop(&mut self) {
        zeroize::Zeroize::zeroize(&mut self.0);
    }
}
