use std::collections::BTreeSet;

use super::trust::{AddTrustForm, DeleteTrust, DetailsView, MoveTrust, TrustForm};
use super::{
    ActivationForm, AuthorityAction, AuthorityForm, AuthorityView, CaSignedForm, ConnectionListForm, DropForm,
    ExportForm, FileForm, ImportReview, KeysForm, LicencesView, LogView, RestoreForm, RowId, SaveLogForm, Task,
    TransferForm, TypeSelectForm, UserSpecifiedForm, VaultForm, VerifyView,
};
use crate::jobs::Confirmation;
use crate::model::{
    ConnectionKind, ControllerSeries, FileFormat, KeyLength, Problem, RevisionToken, SecurityPolicy, StartupMode,
    UserName, UserTokenPolicy,
};
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
    Activation(ActivationForm),
    Verify(VerifyView),
    ConnectionList(ConnectionListForm),
    TypeSelect(TypeSelectForm),
    ExportSelfSigned(ExportForm),
    CaSigned(CaSignedForm),
    UserSpecified(UserSpecifiedForm),
    Restore(RestoreForm),
    ImportReview(ImportReview),
    Transfer(TransferForm),
    ServerLog(LogView),
    SaveLog(SaveLogForm),
    Trust(Box<TrustForm>),
    AddTrust(AddTrustForm),
    DeleteTrust(DeleteTrust),
    MoveTrust(MoveTrust),
    TrustDetails(Box<DetailsView>),
    Drop(DropForm),
    Authority(AuthorityView),
    AuthorityForm(AuthorityForm),
    Vault(VaultForm),
    Backup { on: bool },
    Options,
    Error(Problem),
    Licences(LicencesView),
    About,
    Shortcuts,
}

impl Dialog {
    /// A form whose work is done once what it asks for was agreed to.
    pub(super) const fn is_done_by_confirming(&self) -> bool {
        matches!(
            self,
            Self::Settings(_)
                | Self::AddUser(_)
                | Self::SelfSigned(_)
                | Self::TypeSelect(_)
                | Self::ExportSelfSigned(_)
                | Self::Activation(_)
                | Self::Transfer(_)
                | Self::AddTrust(_)
        )
    }

    /// A dialog whose job ends with it.
    pub(super) fn has_a_job(&self) -> bool {
        self.is_form() || matches!(self, Self::CaSigned(_) | Self::UserSpecified(_) | Self::Restore(_))
    }

    /// A form that may wait for what is in a controller. At most one is open.
    pub(super) fn is_form(&self) -> bool {
        matches!(
            self,
            Self::Settings(_) | Self::Users(_) | Self::SelfSigned(_) | Self::TypeSelect(_) | Self::ServerLog(_)
        )
    }

    /// The file it asks for, if it does.
    pub(super) fn file(&mut self) -> Option<&mut FileForm> {
        match self {
            Self::Activation(ActivationForm { keys: KeysForm::File { file, .. }, .. }) => Some(file),
            Self::ConnectionList(form) => Some(&mut form.file),
            Self::AuthorityForm(AuthorityForm { action: AuthorityAction::SignFile(form), .. }) => Some(&mut form.file),
            _ => None,
        }
    }
}

/// A new controller (manual 2.5.1).
#[derive(Debug)]
pub struct AddController {
    pub name: String,
    pub address: String,
    pub password: Typed,
    pub show_password: bool,
    /// The field for the password has just appeared and takes the keyboard.
    pub focus_password: bool,
    pub series: ControllerSeries,
    pub connection: ConnectionKind,
    pub stage: AddStage,
    /// Why the last attempt failed.
    pub problem: Option<Problem>,
    /// Apply was pressed once: mistakes are pointed out also in fields that are still empty.
    pub tried: bool,
    /// The controller is in the list already, without a fingerprint.
    pub identity: Option<Identity>,
}

/// Controllers of the list whose identity is confirmed, one after the other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Identity {
    pub row: RowId,
    /// Whose turn comes next, in order.
    pub next: Vec<RowId>,
    /// Counted from 1.
    pub nth: usize,
    /// Those to read information of in the end.
    pub then_read: Vec<RowId>,
}

impl Identity {
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
}

/// What of the running job is looked at.
#[derive(Debug, Default)]
pub struct ProcessingView {
    /// Index of the controller whose failure is explained.
    pub selected: Option<usize>,
    /// The one the list has scrolled to.
    pub revealed: Option<usize>,
    /// It lies over a form, which goes on when it is closed.
    pub over_form: bool,
}

/// The basic settings (manual 2.6.1).
#[derive(Debug)]
pub struct SettingsForm {
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

/// The users of one controller (manual 2.6.2).
#[derive(Debug)]
pub struct UsersForm {
    pub row: RowId,
    pub name: String,
    pub reading: bool,
    pub revision: Option<RevisionToken>,
    pub users: Vec<UserName>,
    pub ticked: BTreeSet<UserName>,
}

/// One more user, for one controller or many.
#[derive(Debug)]
pub struct AddUserForm {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub revision: Option<RevisionToken>,
    /// Users the one controller has already.
    pub existing: Vec<UserName>,
    pub name: String,
    pub password: Typed,
    pub show_password: bool,
}

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
