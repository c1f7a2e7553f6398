//! What came of connecting to OPC UA servers as a client, and what to do about it.

mod view;

use std::collections::BTreeMap;

use egui::Ui;

use crate::jobs::{TrustConfigurator, Verify, VerifyReport};
use crate::model::{ErrorCode, Problem, UserCredential, UserName, UserPassword};
use crate::session::opcua_client::ConnectTimeouts;
use crate::texts::TextKey;
use crate::ui::model::{
    BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, SecretInput, Task, UiCommand,
};
use crate::ui::shell::processing::ProcessingDialog;

/// The reports of one or more controllers. Not to be seen before all of them are there.
#[derive(Debug)]
pub struct VerifyView {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub running: bool,
    /// By controller; a problem where it could not be asked.
    pub of: BTreeMap<RowId, Result<Box<VerifyReport>, Problem>>,
    /// Whose report is looked at.
    pub shown: Option<RowId>,
    /// The user of the next login; empty: none.
    pub user: String,
    pub password: SecretInput,
    pub show_password: bool,
}

impl VerifyView {
    /// The report that is looked at, or why there is none.
    pub fn report(&self) -> Option<&Result<Box<VerifyReport>, Problem>> {
        self.of.get(&self.shown?)
    }

    /// The controllers that do not trust this program.
    pub fn lacking_trust(&self) -> Vec<RowId> {
        let lacks =
            |found: &Result<Box<VerifyReport>, Problem>| found.as_ref().is_ok_and(|report| report.lacks_trust());
        self.of.iter().filter(|(_, found)| lacks(found)).map(|(row, _)| *row).collect()
    }

    /// Whether there is a login to ask for: one was left out, or something is typed already.
    pub fn asks_for_login(&self) -> bool {
        let lacks = |found: &Result<Box<VerifyReport>, Problem>| found.as_ref().is_ok_and(|r| r.lacks_password());
        !self.user.is_empty() || self.of.values().any(lacks)
    }

    /// Why it cannot be verified again.
    pub fn incomplete(&self) -> Option<TextKey> {
        self.login().err()
    }

    /// Who logs in.
    fn login(&self) -> Result<Option<UserCredential>, TextKey> {
        if self.user.is_empty() && self.password.0.is_empty() {
            return Ok(None);
        }
        let name = self.user.parse::<UserName>().map_err(|_| TextKey::UserRule)?;
        let password = UserPassword::new(&self.password.0).map_err(|_| TextKey::UserRule)?;
        Ok(Some(UserCredential { name, password }))
    }
}

impl UiCommand {
    /// Connects to the servers as a client.
    pub const VERIFY: Self =
        Self::new(TextKey::Verify, TextKey::VerifyTip, Model::verify).in_menu(TextKey::MenuTools).for_controllers();
}

impl Dialog for VerifyView {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.verify_again(self)
    }
}

impl Model {
    /// Connects to these controllers as a client, and shows the reports in the end.
    pub(in crate::ui) fn verify(&mut self, rows: Vec<RowId>) -> Vec<BackendCommand> {
        self.open(VerifyView {
            names: self.rows.names(&rows),
            rows: rows.clone(),
            running: true,
            of: BTreeMap::new(),
            shown: None,
            user: String::new(),
            password: SecretInput::default(),
            show_password: false,
        });
        let task = self.verification(None);
        self.start(task, rows, None)
    }

    fn verification(&self, login: Option<UserCredential>) -> Task {
        let identity = self.workspace.own_identity();
        let operation = Verify { identity, login, trust_first: false, timeouts: ConnectTimeouts::default() };
        Task::with_results(TextKey::VerifyTitle, operation, Self::verified).on_end(Self::verify_ended)
    }

    /// The main button of the dialog.
    fn verify_again(&mut self, mut view: Box<VerifyView>) -> Vec<BackendCommand> {
        let login = view.login().ok().filter(|_| !view.running);
        view.running |= login.is_some();
        let rows = view.rows.clone();
        self.put_back(view);
        match login {
            Some(login) => {
                let task = self.verification(login);
                self.start(task, rows, None)
            }
            None => vec![],
        }
    }

    /// What the ended job changed, looked at as a client would.
    pub(in crate::ui) fn verify_changed(&mut self) -> Vec<BackendCommand> {
        let rows = self.changed_servers();
        // A form that lies under it waits for what was changed.
        if rows.is_empty() || !self.is_only::<ProcessingDialog>() {
            return vec![];
        }
        self.end_processing();
        self.verify(rows)
    }

    /// Asks whether this program's certificate may be put into the trusted lists.
    pub(in crate::ui) fn trust_configurator(&mut self) -> Vec<BackendCommand> {
        match self.top::<VerifyView>() {
            Some(view) if !view.running => {
                let rows = view.lacking_trust();
                let operation = TrustConfigurator { identity: self.workspace.own_identity() };
                let task = Task::new(TextKey::TrustConfiguratorTitle, operation).act(TextKey::TrustTrust);
                let task = task.remark(TextKey::ConfirmTrustConfigurator).quiet();
                if rows.is_empty() { vec![] } else { self.plan(task, rows) }
            }
            _ => vec![],
        }
    }

    fn verifying(&mut self) -> Option<&mut VerifyView> {
        self.dialog::<VerifyView>()
    }

    /// One controller was verified, or could not be asked.
    fn verified(&mut self, row: RowId, result: Result<VerifyReport, Problem>) -> Vec<BackendCommand> {
        // The verification of a controller that was not begun has no result.
        let begun = !matches!(&result, Err(problem) if problem.code == ErrorCode::Cancelled);
        if let Some(view) = self.verifying().filter(|_| begun) {
            view.of.insert(row, result.map(Box::new));
        }
        vec![]
    }

    /// All were.
    fn verify_ended(&mut self) -> Vec<BackendCommand> {
        self.end_processing();
        let Some(view) = self.verifying() else { return vec![] };
        view.running = false;
        let worth_a_look = |row: &&RowId| match view.of.get(row) {
            Some(Ok(report)) => !report.all_works(),
            Some(Err(_)) => true,
            None => false,
        };
        let first =
            view.rows.iter().find(worth_a_look).or_else(|| view.rows.iter().find(|row| view.of.contains_key(row)));
        view.shown = view.shown.filter(|row| view.of.contains_key(row)).or(first.copied());
        match view.of.values().next() {
            None => self.drop_verify(),
            Some(Err(problem)) if view.rows.len() == 1 => {
                let problem = problem.clone();
                self.drop_verify();
                self.show_problem(problem);
            }
            Some(_) => {}
        }
        vec![]
    }

    fn drop_verify(&mut self) {
        self.close_all::<VerifyView>();
    }
}
