//! Where connection passwords are kept: the keyring, or the vault of the workspace.

mod view;

use egui::Ui;
use secrecy::SecretString;

use crate::model::{ErrorCode, Problem};
use crate::texts::TextKey;
use crate::ui::model::{
    BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, SecretInput, Task, VaultWork,
};
use crate::workspace::{MIN_PASSPHRASE_CHARS, PasswordPlace, StoreStatus, VaultState};

pub use view::options;

/// What can be asked for in the options and the status bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VaultRequest {
    /// Keep passwords there from now on. A vault that is not there yet is created.
    Use(PasswordPlace),
    /// Ask for the passphrase and open the vault.
    Open,
    /// Close the vault.
    Close,
    /// Ask for a new passphrase.
    ChangePassphrase,
    /// Do something about the password that could not be kept.
    NotKept,
}

/// Asks for the passphrase of the vault.
#[derive(Debug)]
pub struct VaultForm {
    pub action: VaultAction,
    /// The present one; for a new vault, the one that is chosen.
    pub passphrase: SecretInput,
    /// The one it is changed to.
    pub new: SecretInput,
    /// The chosen one once more.
    pub again: SecretInput,
    pub show: bool,
    /// It is being done, and cannot be cancelled.
    pub working: bool,
    /// Why the last attempt failed.
    pub problem: Option<Problem>,
    /// The job that lacks the passwords.
    waiting: Option<Waiting>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VaultAction {
    Create,
    Open,
    ChangePassphrase,
}

#[derive(Debug)]
struct Waiting {
    rows: Vec<RowId>,
    task: Task,
}

impl VaultForm {
    fn new(action: VaultAction, waiting: Option<Waiting>) -> Self {
        Self {
            action,
            passphrase: SecretInput::default(),
            new: SecretInput::default(),
            again: SecretInput::default(),
            show: false,
            working: false,
            problem: None,
            waiting,
        }
    }

    /// The passphrase that is chosen here, if one is.
    fn chosen(&self) -> Option<&SecretInput> {
        match self.action {
            VaultAction::Create => Some(&self.passphrase),
            VaultAction::ChangePassphrase => Some(&self.new),
            VaultAction::Open => None,
        }
    }

    pub fn chosen_error(&self) -> Option<TextKey> {
        let short = |typed: &SecretInput| (1..MIN_PASSPHRASE_CHARS).contains(&typed.0.chars().count());
        self.chosen().is_some_and(short).then_some(TextKey::CaPassphraseRule)
    }

    pub fn again_error(&self) -> Option<TextKey> {
        let differs = |typed: &SecretInput| !self.again.0.is_empty() && typed.0 != self.again.0;
        self.chosen().is_some_and(differs).then_some(TextKey::CaPassphrasesDiffer)
    }

    /// Why it cannot be sent yet.
    pub fn incomplete(&self) -> Option<TextKey> {
        if self.working {
            return Some(TextKey::CaWorking);
        }
        if self.passphrase.0.is_empty() {
            return Some(TextKey::VaultPassphraseNeeded);
        }
        let chosen = self.chosen()?;
        if chosen.0.chars().count() < MIN_PASSPHRASE_CHARS {
            return Some(TextKey::CaPassphraseRule);
        }
        (chosen.0 != self.again.0).then_some(TextKey::CaPassphrasesDiffer)
    }
}

impl Dialog for VaultForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, place.focus, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.submit_vault(self)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.close_vault(self)
    }
}

impl Model {
    /// What the vault is like; [`VaultState::None`] also where none is offered.
    fn vault(&self) -> VaultState {
        self.store.map_or(VaultState::None, |store| store.vault)
    }

    /// Does what was asked for in the options or the status bar.
    pub fn vault_request(&mut self, request: VaultRequest) -> Vec<BackendCommand> {
        match (request, self.vault()) {
            (VaultRequest::Use(PasswordPlace::Vault), VaultState::None) => self.ask_vault(VaultAction::Create, None),
            (VaultRequest::Use(place), _) => {
                self.options.passwords = place;
                let mut commands = self.save();
                commands.push(BackendCommand::Vault(VaultWork::Use(place)));
                return commands;
            }
            (VaultRequest::Open, _) => self.ask_vault(VaultAction::Open, None),
            (VaultRequest::Close, _) => return vec![BackendCommand::Vault(VaultWork::Close)],
            (VaultRequest::ChangePassphrase, _) => self.ask_vault(VaultAction::ChangePassphrase, None),
            (VaultRequest::NotKept, vault) => match (&self.not_kept, vault) {
                (None, _) => {}
                (Some(problem), VaultState::None)
                    if matches!(problem.code, ErrorCode::KeyringUnavailable | ErrorCode::VaultMissing) =>
                {
                    self.ask_vault(VaultAction::Create, None);
                }
                (Some(problem), _) if problem.code == ErrorCode::VaultLocked => {
                    self.ask_vault(VaultAction::Open, None);
                }
                (Some(problem), _) => self.show_problem(problem.clone()),
            },
        }
        vec![]
    }

    fn ask_vault(&mut self, action: VaultAction, waiting: Option<Waiting>) {
        self.open(VaultForm::new(action, waiting));
    }

    /// The ended job found the vault closed: its passphrase is asked for, and then the job goes on.
    pub(in crate::ui) fn ask_vault_for(&mut self, rows: Vec<RowId>, task: Task) {
        self.ask_vault(VaultAction::Open, Some(Waiting { rows, task }));
    }

    /// A password works, but is known only until the program ends. That is said in the status bar: a dialog would lie
    /// over what the engineer asked for.
    pub(in crate::ui) fn password_not_kept(&mut self, problem: Problem) {
        self.not_kept = Some(problem);
    }

    /// As [`Model::password_not_kept`] for a controller that was just added. A vault that was not asked for in this run
    /// yet is now.
    pub(in crate::ui) fn first_password_not_kept(&mut self, problem: Problem) {
        if problem.code == ErrorCode::VaultLocked && self.vault() == VaultState::Closed {
            self.ask_vault(VaultAction::Open, None);
        }
        self.password_not_kept(problem);
    }

    pub(in crate::ui) fn store_changed(&mut self, store: StoreStatus) {
        self.store = Some(store);
        if store.keeps() {
            self.not_kept = None;
        }
    }

    fn submit_vault(&mut self, mut form: Box<VaultForm>) -> Vec<BackendCommand> {
        let mut commands = Vec::new();
        if form.incomplete().is_none() {
            let secret = |typed: &SecretInput| SecretString::from(typed.0.as_str());
            let passphrase = secret(&form.passphrase);
            let work = match form.action {
                VaultAction::Create => {
                    let known = self.rows.all().iter().filter_map(|row| row.entry.fingerprint);
                    VaultWork::Create { passphrase, controllers: known.collect() }
                }
                VaultAction::Open => VaultWork::Open { passphrase },
                VaultAction::ChangePassphrase => VaultWork::ChangePassphrase { passphrase, new: secret(&form.new) },
            };
            (form.working, form.problem) = (true, None);
            commands.push(BackendCommand::Vault(work));
        }
        self.put_back(form);
        commands
    }

    /// The work of the dialog has ended.
    pub(in crate::ui) fn vault_done(&mut self, result: Result<(), Problem>) -> Vec<BackendCommand> {
        if let Err(problem) = result {
            if let Some(form) = self.dialog::<VaultForm>().filter(|form| form.working) {
                (form.working, form.problem) = (false, Some(problem));
            }
            return vec![];
        }
        let Some(form) = self.take_out::<VaultForm>(|form| form.working) else { return vec![] };
        self.not_kept = None;
        let done = match form.action {
            VaultAction::Create => TextKey::VaultCreated,
            VaultAction::Open => TextKey::VaultOpened,
            VaultAction::ChangePassphrase => TextKey::VaultPassphraseChanged,
        };
        self.status = Some(done.text(self.language).to_owned());
        let mut commands = Vec::new();
        if form.action == VaultAction::Create {
            self.options.passwords = PasswordPlace::Vault;
            commands = self.save();
        }
        if let Some(Waiting { rows, task }) = form.waiting {
            commands.extend(self.start_again(task, rows, None));
        }
        commands
    }

    /// Cancel: from now on passwords are asked for instead.
    fn close_vault(&mut self, form: Box<VaultForm>) -> Vec<BackendCommand> {
        if form.working {
            self.put_back(form);
            return vec![];
        }
        if form.action != VaultAction::Open {
            return vec![];
        }
        if form.waiting.is_some() {
            self.ask_connection_passwords();
        }
        vec![BackendCommand::Vault(VaultWork::Decline)]
    }
}
