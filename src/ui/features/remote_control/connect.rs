//! Connecting, and what the watch reports.

use super::act::AllowActing;
use super::form::{RemoteForm, RemoteLink, message_language};
use super::section::RemoteSection;
use crate::jobs::{RemoteConnection, RemoteControlEvent, RemoteControlRequest};
use crate::model::{Cause, ErrorCode};
use crate::remote::client::{RemoteError, RemoteTarget};
use crate::remote::{Command, Reply, Request};
use crate::ui::model::{BackendCommand, JobId, Model, RowId, SecretInput};

/// The labels of a controller's I/O, in its folder of the workspace.
const LABELS_FILE: &str = "io-labels.csv";

impl Model {
    /// Opens the dialog, which does not connect by itself: a controller serves one client at a time.
    pub(in crate::ui) fn open_remote_control(&mut self, row: RowId) -> Vec<BackendCommand> {
        let name = self.rows.names(&[row]).pop().unwrap_or_default();
        let Some(found) = self.rows.get(row) else { return vec![] };
        let target = RemoteTarget::ethernet(found.entry.address.host()).map(|target| target.to_string());
        let mut form = RemoteForm::new(row, name, target.unwrap_or_default());
        let Some(info) = found.info() else {
            self.open(form);
            return vec![];
        };
        let path = self.workspace.root().join(info.serial.folder_name()).join(LABELS_FILE);
        form.io.labels_file.path = path.display().to_string();
        form.io.labels_file.optional = true;
        self.open(form);
        self.read_typed()
    }

    /// Connects with what is typed, for monitoring only.
    pub(in crate::ui) fn connect_remote(&mut self) -> Vec<BackendCommand> {
        let (job, language) = (self.next_job(), message_language(self.language));
        let Some(form) = self.dialog::<RemoteForm>() else { return vec![] };
        let (Ok((target, password)), Some(language)) = (form.typed_connection(), language) else { return vec![] };
        let mut commands: Vec<BackendCommand> =
            form.watch.replace(job).map(BackendCommand::Cancel).into_iter().collect();
        let is_other = form.used.as_ref().is_some_and(|used| used.target != target);
        let connection = RemoteConnection { target, password, language };
        form.password = SecretInput::default();
        form.edits_connection = false;
        form.used = Some(connection.clone());
        if is_other {
            form.forget();
        }
        form.link = RemoteLink::Connecting;
        form.asked.clear();
        self.remote_watch_ended();
        commands.push(BackendCommand::ControlRemotely { job, connection: Box::new(connection) });
        commands.extend(self.show_remote());
        commands
    }

    /// Ends the connection, so that another client can have it.
    pub(in crate::ui) fn disconnect_remote(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.dialog::<RemoteForm>() else { return vec![] };
        form.link = RemoteLink::Off;
        form.edits_connection = true;
        let watch = form.watch.take();
        self.remote_watch_ended();
        watch.map(BackendCommand::Cancel).into_iter().collect()
    }

    /// What acts has to be allowed again.
    fn stop_acting(&mut self) {
        self.close_all::<AllowActing>();
        if let Some(form) = self.dialog::<RemoteForm>() {
            form.may_act = false;
        }
    }

    /// The watch is over: no answer comes any more.
    fn remote_watch_ended(&mut self) {
        self.stop_acting();
        let Some(form) = self.dialog::<RemoteForm>() else { return };
        for command in std::mem::take(&mut form.pending) {
            let cause = Cause::finding("the connection was ended before the answer came");
            let cause = Box::new(RemoteError::ConnectionLost { command, cause });
            form.take_outcome(command, Err(RemoteError::OutcomeUnknown { command, cause }));
        }
    }

    /// Another tab, or something else to be read in it, was chosen.
    pub(in crate::ui) fn show_remote(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.dialog::<RemoteForm>() else { return vec![] };
        let wanted = form.wanted();
        match form.watch {
            Some(job) if form.asked != wanted => {
                form.asked.clone_from(&wanted);
                vec![BackendCommand::AskRemote { job, request: RemoteControlRequest::Show(wanted) }]
            }
            _ => vec![],
        }
    }

    /// The watch reports something.
    pub(in crate::ui) fn remote_seen(&mut self, job: JobId, event: RemoteControlEvent) -> Vec<BackendCommand> {
        let Some(form) = self.dialog::<RemoteForm>().filter(|form| form.watch == Some(job)) else { return vec![] };
        match event {
            RemoteControlEvent::Connected => {
                form.link = RemoteLink::Live;
                // It may have been restarted meanwhile.
                form.forget();
            }
            RemoteControlEvent::Lost(problem) => {
                form.link = RemoteLink::Lost(problem);
                // What became of a command is told on its own.
                self.stop_acting();
            }
            RemoteControlEvent::Ended(problem) => {
                form.edits_connection = true;
                form.watch = None;
                // A password that was refused is not used again.
                if problem.code == ErrorCode::RemoteWrongPassword {
                    form.used = None;
                }
                form.link = RemoteLink::Ended(problem);
                self.remote_watch_ended();
            }
            RemoteControlEvent::Identity(identity) => form.identity = Some(identity),
            RemoteControlEvent::Status { status, message } => {
                form.status = Some(status);
                form.message = message;
            }
            RemoteControlEvent::Values(values) => {
                values.into_iter().for_each(|(request, result)| form.take_value(&request, result));
            }
            RemoteControlEvent::Done { request, result } => {
                let command = request.command();
                form.pending.retain(|pending| *pending != command);
                if result.is_ok() {
                    form.io.was_set(&request);
                }
                form.take_outcome(command, result);
            }
            RemoteControlEvent::Exchanged(messages) => form.log.add(messages),
        }
        vec![]
    }

    /// Turns the tabs.
    pub(in crate::ui) fn turn_remote(&mut self, section: RemoteSection) -> Vec<BackendCommand> {
        if let Some(form) = self.dialog::<RemoteForm>() {
            form.section = section;
        }
        self.show_remote()
    }
}

impl RemoteForm {
    /// What was read belongs to another connection.
    fn forget(&mut self) {
        self.status = None;
        self.message = None;
        self.identity = None;
        self.current_robot = None;
        self.alarms = None;
        self.io.forget();
        self.variables.lines.iter_mut().for_each(|line| line.value = None);
    }

    fn take_value(&mut self, request: &Request, result: Result<Reply, RemoteError>) {
        match request {
            Request::GetCurRobot => {
                self.current_robot = Some(result.map(|reply| match reply {
                    Reply::Robot(robot) => robot,
                    _ => 0,
                }));
            }
            Request::GetAlm => {
                self.alarms = Some(result.map(|reply| match reply {
                    Reply::Alarms(alarms) => alarms,
                    _ => Vec::new(),
                }));
            }
            Request::GetVariable { .. } => self.variables.take_in(request, result),
            _ => self.io.take_in(request, result),
        }
    }

    pub(super) fn take_outcome(&mut self, command: Command, result: Result<Reply, RemoteError>) {
        if command == Command::Execute {
            self.execute.answered(result.clone());
        }
        self.outcome = Some((command, result));
    }
}
