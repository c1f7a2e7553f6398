//! The users of OPC UA servers (manual 2.6.2).

mod form;
mod view;

use std::collections::BTreeSet;

use egui::{Key, Modifiers, Ui};

use crate::jobs::{self, RemoveUsers};
use crate::texts::TextKey;
use crate::ui::model::{
    BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, SecretInput, Task, UiCommand,
};

pub use form::{AddUserForm, UsersForm};

impl UiCommand {
    /// Lists, adds and deletes users.
    pub const USERS: Self = Self::new(TextKey::Users, TextKey::UsersTip, Model::open_users)
        .in_menu(TextKey::MenuServer)
        .key(Modifiers::COMMAND, Key::U)
        .for_controllers();
}

impl Dialog for UsersForm {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::list(ui, self, model, messages)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.drop_job()
    }
}

impl Dialog for AddUserForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::add(ui, self, place.focus, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let planned = self.operation().map(|operation| (add_user(operation), self.rows.clone()));
        model.ask(self, planned)
    }

    fn is_done_by_confirming(&self) -> bool {
        true
    }
}

impl Model {
    pub(in crate::ui) fn open_users(&mut self, rows: Vec<RowId>) -> Vec<BackendCommand> {
        match rows[..] {
            [row] => {
                let name = self.rows.names(&rows).pop().unwrap_or_default();
                self.open(UsersForm {
                    row,
                    name,
                    reading: true,
                    revision: None,
                    users: Vec::new(),
                    ticked: BTreeSet::new(),
                });
                self.start(list_users(), rows, None)
            }
            _ => {
                self.push_add_user(rows, None, Vec::new());
                vec![]
            }
        }
    }

    fn push_add_user(
        &mut self,
        rows: Vec<RowId>,
        revision: Option<crate::model::RevisionToken>,
        existing: Vec<crate::model::UserName>,
    ) {
        self.open(AddUserForm {
            names: self.rows.names(&rows),
            rows,
            revision,
            existing,
            name: String::new(),
            password: SecretInput::default(),
            show_password: false,
        });
    }

    pub(in crate::ui) fn new_user(&mut self) -> Vec<BackendCommand> {
        if let Some(form) = self.top::<UsersForm>() {
            let (rows, revision, users) = (vec![form.row], form.revision, form.users.clone());
            self.push_add_user(rows, revision, users);
        }
        vec![]
    }

    pub(in crate::ui) fn delete_users(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.top::<UsersForm>() else { return vec![] };
        if form.ticked.is_empty() {
            return vec![];
        }
        let names = form.ticked.iter().cloned().collect();
        let remove = RemoveUsers { names, based_on: form.revision };
        let task = Task::new(TextKey::DeleteUsers, remove).act(TextKey::DeleteUsers).restarts_server();
        let task = task.on_closed(Model::reload_users);
        let row = form.row;
        self.plan(task, vec![row])
    }

    fn reload_users(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.dialog::<UsersForm>() else { return vec![] };
        form.reading = true;
        form.ticked.clear();
        let row = form.row;
        self.start(list_users(), vec![row], None)
    }
}

fn list_users() -> Task {
    Task::with_results(TextKey::UsersTitle, jobs::ListUsers, |model, _, result| {
        if let (Ok(users), Some(form)) = (result, model.dialog::<UsersForm>()) {
            form.reading = false;
            form.revision = Some(users.revision);
            form.users = users.value;
        }
        vec![]
    })
    .for_dialog::<UsersForm>()
}

fn add_user(operation: jobs::AddUser) -> Task {
    let task = Task::new(TextKey::AddUserTitle, operation).act(TextKey::AddUserTitle).restarts_server();
    task.on_closed(Model::reload_users)
}
