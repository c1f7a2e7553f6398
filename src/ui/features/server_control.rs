//! Reading information, starting and stopping servers; the virtual controllers of the welcome page.

use egui::{Key, Modifiers};

use crate::jobs;
use crate::model::Problem;
use crate::texts::TextKey as T;
use crate::ui::model::{BackendCommand, Model, Task, UiCommand};
use crate::workspace::ControllerEntry;

/// Reads all information of controllers.
pub fn get_info() -> Task {
    Task::new(T::GetInfo, jobs::GetInfo).act(T::GetInfo).quiet()
}

pub fn start_server() -> Task {
    Task::new(T::Start, jobs::StartServer).act(T::Start).quiet().restarts_server()
}

pub fn stop_server() -> Task {
    Task::new(T::Stop, jobs::StopServer).act(T::Stop)
}

impl UiCommand {
    /// Starts the OPC UA servers.
    pub const START: Self =
        Self::new(T::Start, T::StartTip, |model, rows| model.plan(start_server(), rows)).for_controllers();

    /// Stops the OPC UA servers.
    pub const STOP: Self =
        Self::new(T::Stop, T::StopTip, |model, rows| model.plan(stop_server(), rows)).for_controllers();

    /// Reads all information.
    pub const GET_INFO: Self =
        Self::new(T::GetInfo, T::GetInfoTip, Model::get_info).key(Modifiers::NONE, Key::F5).for_controllers();
}

impl Model {
    pub(in crate::ui) fn virtual_started(
        &mut self,
        result: Result<Vec<ControllerEntry>, Problem>,
    ) -> Vec<BackendCommand> {
        self.virtual_starting = false;
        let entries = match result {
            Ok(entries) => entries,
            Err(problem) => {
                self.show_problem(problem);
                return vec![];
            }
        };
        let now = self.now;
        let mut added = Vec::new();
        for entry in entries {
            if self.configuration().check_new(&entry.name, &entry.address).is_ok() {
                added.push(self.rows.add(entry, now));
            }
        }
        for row in &added {
            self.rows.tick(*row);
        }
        let mut commands = self.save();
        if !added.is_empty() {
            commands.extend(self.plan(get_info(), added));
        }
        commands
    }
}
