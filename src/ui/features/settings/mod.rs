//! The basic settings (manual 2.6.1).

mod form;
mod view;

use egui::{Key, Modifiers, Ui};

use crate::jobs;
use crate::texts::TextKey;
use crate::ui::model::{Answer, Command, Dialog, Message, Model, Place, RowId, Task, UiCommand};

pub use form::SettingsForm;

impl UiCommand {
    /// Shows and changes the basic settings.
    pub const BASIC_SETTINGS: Self = Self::new(TextKey::BasicSettings, TextKey::BasicSettingsTip, Model::open_settings)
        .in_menu(TextKey::MenuServer)
        .key(Modifiers::COMMAND, Key::B)
        .for_controllers();
}

impl Dialog for SettingsForm {
    fn show(&mut self, ui: &Ui, _place: Place, model: &Model, _messages: &mut Vec<Message>) -> Answer {
        view::show(ui, self, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<Command> {
        let planned = self.operation().map(|operation| (set_settings(operation), self.rows.clone()));
        model.ask(self, planned)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<Command> {
        model.drop_job()
    }

    fn is_done_by_confirming(&self) -> bool {
        true
    }
}

impl Model {
    pub(in crate::ui) fn open_settings(&mut self, rows: Vec<RowId>) -> Vec<Command> {
        let form = SettingsForm::new(rows.clone(), self);
        let reading = form.reading;
        self.open(form);
        if reading { self.start(read_settings(), rows, None) } else { vec![] }
    }
}

fn read_settings() -> Task {
    Task::with_results(TextKey::SettingsTitle, jobs::ReadSettings, |model, _, result| {
        let (Ok(settings), Some(form)) = (result, model.dialog::<SettingsForm>()) else { return vec![] };
        form.reading = false;
        form.revision = Some(settings.revision);
        form.fill(settings.value);
        let rows = form.rows.clone();
        model.start(count_users(), rows, None)
    })
    .for_dialog::<SettingsForm>()
}

/// For a warning only.
fn count_users() -> Task {
    Task::with_results(TextKey::UsersTitle, jobs::ListUsers, |model, _, result| {
        if let (Ok(users), Some(form)) = (result, model.dialog::<SettingsForm>()) {
            form.users = Some(users.value.len());
        }
        vec![]
    })
    .optional()
}

fn set_settings(operation: jobs::SetSettings) -> Task {
    Task::new(TextKey::SettingsTitle, operation).act(TextKey::ActSettings).restarts_server()
}
