//! Connecting, asking for values, and what is reported.

use super::browser::BrowserMove;
use super::edit::EditValue;
use super::form::{LiveConnection, LiveForm};
use super::section::LiveSection;
use crate::jobs::{self, JobController, LiveEvent, LiveLogin, LivePoint, LiveRequest, TrustConfigurator};
use crate::model::ErrorCode;
use crate::model::opcua::{NodeId, Quality, Value};
use crate::texts::TextKey as T;
use crate::ui::model::{BackendCommand, JobId, Model, RowId, SecretInput, Task};

/// Reads the controller's information, so that a missing password is asked for, then begins the watch.
fn connect() -> Task {
    let task = Task::with_results(T::LiveTitle, jobs::GetInfo, |model, _, result| match result {
        Ok(_) => model.watch_values(),
        Err(_) => vec![],
    });
    task.for_dialog::<LiveForm>().on_end(Model::live_asked).without_password(Model::live_without_password)
}

impl Model {
    /// Opens the dialog and connects without a user name.
    pub(in crate::ui) fn open_live_values(&mut self, row: RowId) -> Vec<BackendCommand> {
        let name = self.rows.names(&[row]).pop().unwrap_or_default();
        self.open(LiveForm::new(row, name));
        self.start(connect(), vec![row], None)
    }

    /// Connects again, as the user that is typed.
    pub(in crate::ui) fn reconnect_live(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.dialog::<LiveForm>() else { return vec![] };
        let Ok(login) = form.typed_login() else { return vec![] };
        form.login = login;
        form.password = SecretInput::default();
        self.connect_live_again()
    }

    /// Connects again, as the same user.
    fn connect_live_again(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.dialog::<LiveForm>() else { return vec![] };
        form.link = LiveConnection::Connecting;
        form.asks_for_login = false;
        let row = form.row;
        let mut commands: Vec<BackendCommand> = form.watch.take().map(BackendCommand::Cancel).into_iter().collect();
        commands.extend(self.drop_job());
        commands.extend(self.start(connect(), vec![row], None));
        commands
    }

    /// The controller answers: from now on its OPC UA server is watched.
    fn watch_values(&mut self) -> Vec<BackendCommand> {
        let (job, identity) = (self.next_job(), self.workspace.own_identity());
        let Some(form) = self.dialog::<LiveForm>() else { return vec![] };
        let before = form.watch.replace(job);
        form.asked.clear();
        let (row, user) = (form.row, form.login.clone());
        let Some(controller) = self.rows.get(row).map(|row| JobController::from(&row.entry)) else { return vec![] };
        let mut commands: Vec<BackendCommand> = before.map(BackendCommand::Cancel).into_iter().collect();
        let login = Box::new(LiveLogin { identity, user });
        commands.push(BackendCommand::WatchValues { job, controller: Box::new(controller), login });
        commands
    }

    /// The controller was asked; if that failed, the dialog says why.
    fn live_asked(&mut self) -> Vec<BackendCommand> {
        let job = self.job.take();
        let problem = job.and_then(|job| job.rows.into_iter().find_map(|row| row.state.problem().cloned()));
        if let (Some(form), Some(problem)) = (self.dialog::<LiveForm>(), problem) {
            form.link = LiveConnection::Ended(problem);
        }
        vec![]
    }

    fn live_without_password(&mut self) -> Vec<BackendCommand> {
        self.job = None;
        if let Some(form) = self.dialog::<LiveForm>() {
            form.link = LiveConnection::Ended(ErrorCode::PasswordMissing.into());
        }
        vec![]
    }

    /// The dialog was closed.
    pub(in crate::ui) fn close_live_values(&mut self, form: &LiveForm) -> Vec<BackendCommand> {
        let mut commands = self.drop_job();
        commands.extend(form.watch.map(BackendCommand::Cancel));
        commands
    }

    /// The watch reports something.
    pub(in crate::ui) fn live_seen(&mut self, job: JobId, event: LiveEvent) -> Vec<BackendCommand> {
        let now = self.now;
        let Some(form) = self.dialog::<LiveForm>().filter(|form| form.watch == Some(job)) else { return vec![] };
        match event {
            LiveEvent::Values(values) => {
                for (node, value) in values {
                    form.plot.push(&node, &value, now);
                    form.take_in(node, value);
                }
                vec![]
            }
            LiveEvent::Connected(layout) => {
                if form.layout.as_ref().is_some_and(|before| **before != *layout) {
                    // The same node id may be another node now.
                    form.forget_values();
                    form.browser = Default::default();
                    form.plot.clear();
                }
                form.io_group = form.io_group.min(layout.io.len().saturating_sub(1));
                form.layout = Some(layout);
                form.link = LiveConnection::Live;
                form.browser.forget_reading();
                let selected = form.browser.selected().filter(|_| form.browser.details.is_none());
                let ask = selected.map(|node| LiveRequest::Inspect(node.node.clone()));
                let mut commands: Vec<BackendCommand> = ask.map(|ask| ask_values(job, ask)).into_iter().collect();
                commands.extend(self.live_section_changed());
                commands
            }
            LiveEvent::Lost(problem) => {
                form.plot.interrupt();
                form.link = LiveConnection::Lost(problem);
                self.live_write_lost();
                vec![]
            }
            LiveEvent::Ended(problem) => {
                form.plot.interrupt();
                form.asks_for_login |= problem.code == ErrorCode::OpcUaLoginRefused;
                form.link = LiveConnection::Ended(problem);
                form.watch = None;
                self.live_write_lost();
                vec![]
            }
            LiveEvent::Children { of, children } => {
                form.browser.fill(&of, children);
                vec![]
            }
            LiveEvent::Inspected { node, details } => {
                if form.browser.selected().is_some_and(|selected| selected.node == node) {
                    form.browser.details = Some(details);
                }
                self.show_wanted()
            }
            LiveEvent::Written { node, quality } => {
                self.live_written(&node, quality);
                vec![]
            }
        }
    }

    /// Another tab, or another group of signals, was chosen.
    pub(in crate::ui) fn live_section_changed(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.dialog::<LiveForm>() else { return vec![] };
        if form.section == LiveSection::Nodes && form.is_live() && form.browser.is_unread() {
            let mut commands = self.live_fold(0, true);
            commands.extend(self.show_wanted());
            return commands;
        }
        self.show_wanted()
    }

    /// Asks the watch for the values that are needed, if they are others than before.
    fn show_wanted(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.dialog::<LiveForm>() else { return vec![] };
        let wanted = form.wanted();
        match form.watch {
            Some(job) if form.asked != wanted => {
                form.asked.clone_from(&wanted);
                vec![ask_values(job, LiveRequest::Show(wanted))]
            }
            _ => vec![],
        }
    }

    /// Unfolds or folds the node on a line of the tree.
    pub(in crate::ui) fn live_fold(&mut self, line: usize, unfold: bool) -> Vec<BackendCommand> {
        let unfolded = self.dialog::<LiveForm>().and_then(|form| form.browser.fold(line, unfold));
        unfolded.map(|node| self.live_moved(BrowserMove::Unfolded(node))).unwrap_or_default()
    }

    /// Selects the node on a line of the tree.
    pub(in crate::ui) fn live_select(&mut self, line: usize) -> Vec<BackendCommand> {
        let selected = self.dialog::<LiveForm>().and_then(|form| form.browser.select(line));
        selected.map(|node| self.live_moved(BrowserMove::Selected(node))).unwrap_or_default()
    }

    /// The arrow keys moved in the tree.
    pub(in crate::ui) fn live_moved(&mut self, moved: BrowserMove) -> Vec<BackendCommand> {
        let Some(job) = self.dialog::<LiveForm>().and_then(|form| form.watch) else { return vec![] };
        let request = match moved {
            BrowserMove::Selected(node) => LiveRequest::Inspect(node),
            BrowserMove::Unfolded(node) => LiveRequest::Children(node),
        };
        let mut commands = vec![ask_values(job, request)];
        commands.extend(self.show_wanted());
        commands
    }

    /// Adds a variable to the plot.
    pub(in crate::ui) fn live_plot(&mut self, point: LivePoint) -> Vec<BackendCommand> {
        let now = self.now;
        if let Some(form) = self.dialog::<LiveForm>() {
            let node = point.node.clone();
            form.plot.add(point);
            // The value is reported again only when it changes.
            if let Some(value) = form.value(&node).cloned() {
                form.plot.push(
                    &node,
                    &crate::model::opcua::DataValue { source_time: None, server_time: None, ..value },
                    now,
                );
            }
        }
        self.show_wanted()
    }

    /// Removes a variable from the plot; `None`: all.
    pub(in crate::ui) fn live_unplot(&mut self, node: Option<&NodeId>) -> Vec<BackendCommand> {
        if let Some(form) = self.dialog::<LiveForm>() {
            match node {
                Some(node) => form.plot.remove(node),
                None => form.plot.clear(),
            }
        }
        self.show_wanted()
    }

    /// Asks whether this program's certificate may be put into the trusted list, then connects again.
    pub(in crate::ui) fn trust_for_live_values(&mut self) -> Vec<BackendCommand> {
        let Some(row) = self.top::<LiveForm>().map(|form| form.row) else { return vec![] };
        let operation = TrustConfigurator { identity: self.workspace.own_identity() };
        let task = Task::with_results(T::TrustConfiguratorTitle, operation, |_, _, _| vec![]);
        let task = task.act(T::TrustTrust).remark(T::ConfirmTrustConfigurator).on_end(|model| {
            let failed = model.job.as_ref().is_some_and(|job| job.first_problem().is_some());
            if failed {
                return vec![];
            }
            model.end_processing();
            model.connect_live_again()
        });
        self.plan(task, vec![row])
    }

    /// Opens the dialog that writes a value into the selected node.
    pub(in crate::ui) fn edit_live_value(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.top::<LiveForm>() else { return vec![] };
        let (Some(node), Some(Ok(details)), Some(watch)) = (form.browser.selected(), &form.browser.details, form.watch)
        else {
            return vec![];
        };
        let before = form.value(&node.node).map(|value| value.value.clone()).unwrap_or_default();
        let edit = EditValue {
            watch,
            node: node.node.clone(),
            name: node.name.clone(),
            data_type: details.data_type.clone().unwrap_or_default(),
            text: if before == Value::Null { String::new() } else { before.to_string() },
            before,
            is_writing: false,
            refusal: None,
        };
        self.open(edit);
        vec![]
    }

    /// Writes what is typed.
    pub(in crate::ui) fn write_live_value(&mut self, mut edit: Box<EditValue>) -> Vec<BackendCommand> {
        let value = edit.typed().filter(|_| !edit.is_writing);
        let command = value.map(|value| {
            edit.is_writing = true;
            edit.refusal = None;
            ask_values(edit.watch, LiveRequest::Write { node: edit.node.clone(), value })
        });
        self.put_back(edit);
        command.into_iter().collect()
    }

    fn live_written(&mut self, node: &NodeId, quality: Result<Quality, crate::model::Problem>) {
        let is_good = quality.as_ref().is_ok_and(|quality| !quality.is_bad());
        let is_it = |edit: &EditValue| edit.node == *node && edit.is_writing;
        match self.dialog::<EditValue>().filter(|edit| is_it(edit)) {
            Some(_) if is_good => {
                self.close_all::<EditValue>();
                self.status = Some(T::LiveWritten.text(self.language).to_owned());
            }
            Some(edit) => {
                edit.is_writing = false;
                edit.refusal = Some(quality);
            }
            None => {}
        }
    }

    /// Whether a write under way was done is not known.
    fn live_write_lost(&mut self) {
        if let Some(edit) = self.dialog::<EditValue>().filter(|edit| edit.is_writing) {
            edit.is_writing = false;
            edit.refusal = Some(Err(ErrorCode::AnswerLost.into()));
        }
    }
}

fn ask_values(job: JobId, request: LiveRequest) -> BackendCommand {
    BackendCommand::AskValues { job, request }
}
