//! The switch, sending commands, and saving the log.

use super::form::RemoteForm;
use super::log::SaveExchanges;
use crate::jobs::RemoteControlRequest;
use crate::model::Problem;
use crate::remote::{Effect, Request};
use crate::ui::model::{BackendCommand, JobId, Model};

/// Asks whether commands that act may be sent over a connection.
#[derive(Debug)]
pub struct AllowActing {
    pub(super) watch: JobId,
    /// The name of the controller.
    pub name: String,
    /// Where it is reached.
    pub target: String,
}

impl Model {
    /// Asks before commands that act are allowed.
    pub(in crate::ui) fn ask_to_allow_remote(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.top::<RemoteForm>().filter(|form| form.is_live() && !form.may_act) else { return vec![] };
        if let (Some(watch), Some(used)) = (form.watch, &form.used) {
            let asked = AllowActing { watch, name: form.name.clone(), target: used.target.to_string() };
            self.open(asked);
        }
        vec![]
    }

    /// Allows commands that act, over the connection that was asked about.
    pub(in crate::ui) fn allow_remote_commands(&mut self, watch: JobId) {
        let form = self.dialog::<RemoteForm>();
        if let Some(form) = form.filter(|form| form.is_live() && form.watch == Some(watch)) {
            form.may_act = true;
        }
    }

    /// From now on monitoring only. A command that was sent is not called back.
    pub(in crate::ui) fn forbid_remote_commands(&mut self) -> Vec<BackendCommand> {
        if let Some(form) = self.dialog::<RemoteForm>() {
            form.may_act = false;
        }
        vec![]
    }

    /// Sends a command that acts, unless it cannot be sent now.
    pub(in crate::ui) fn act_remotely(&mut self, request: Request) -> Vec<BackendCommand> {
        let command = request.command();
        let Some(form) = self.dialog::<RemoteForm>() else { return vec![] };
        let (Some(job), None, Effect::Acts) = (form.watch, form.why_not(command), command.effect()) else {
            return vec![];
        };
        form.pending.push(command);
        form.outcome = None;
        vec![BackendCommand::AskRemote { job, request: RemoteControlRequest::Do(request) }]
    }

    /// Executes the command of SPEL+ that is typed.
    pub(in crate::ui) fn execute_remote(&mut self) -> Vec<BackendCommand> {
        let now = self.now;
        let Some(form) = self.dialog::<RemoteForm>().filter(|form| form.why_not_execute().is_none()) else {
            return vec![];
        };
        let Ok(spel) = form.execute.typed() else { return vec![] };
        form.execute.sent(&spel, now);
        self.act_remotely(Request::Execute { spel })
    }

    /// Proposes a file in the controller's folder of the workspace for the log.
    pub(in crate::ui) fn ask_where_to_save_exchanges(&mut self) -> Vec<BackendCommand> {
        let (zone, now) = (self.zone, self.now);
        let Some(form) = self.top::<RemoteForm>() else { return vec![] };
        let serial = self.rows.get(form.row).and_then(|row| row.info()).map(|info| info.serial.folder_name());
        let folder = self.workspace.root().join(serial.unwrap_or_default());
        let path = folder.join(format!("remote-log-{}.txt", now.format("%Y%m%dT%H%M%SZ"))).display().to_string();
        let text = form.log.written(zone);
        self.open(SaveExchanges { path, text });
        vec![]
    }

    pub(super) fn save_exchanges(&mut self, form: Box<SaveExchanges>) -> Vec<BackendCommand> {
        if form.incomplete().is_some() {
            self.put_back(form);
            return vec![];
        }
        let path = form.target(self.workspace.root());
        vec![BackendCommand::SaveText { path, text: form.text }]
    }

    /// A text was saved, or could not be.
    pub(in crate::ui) fn text_saved(&mut self, result: Result<std::path::PathBuf, Problem>) -> Vec<BackendCommand> {
        match result {
            Ok(path) => self.status = Some(crate::texts::text_saved(self.language, &path)),
            Err(problem) => self.show_problem(problem),
        }
        vec![]
    }
}
