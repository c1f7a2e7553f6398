//! The basic settings (manual 2.6.1).

mod form;
mod view;

use egui::{Key, Modifiers, Ui};

use crate::jobs;
use crate::texts::TextKey;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, Task, UiCommand};

pub use form::BasicSettingsForm;

impl UiCommand {
    /// Shows and changes the basic settings.
    pub const BASIC_SETTINGS: Self = Self::new(TextKey::BasicSettings, TextKey::BasicSettingsTip, Model::open_settings)
        .in_menu(TextKey::MenuServer)
        .key(Modifiers::COMMAND, Key::B)
        .for_controllers();
}

impl Dialog for BasicSettingsForm {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let planned = self.operation().map(|operation| (set_settings(operation), self.rows.clone()));
        model.ask(self, planned)
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.drop_job()
    }

    fn is_done_by_confirming(&self) -> bool {
        true
    }
}

impl Model {
    pub(in crate::ui) fn open_settings(&mut self, rows: Vec<RowId>) -> Vec<BackendCommand> {
        let form = BasicSettingsForm::new(rows.clone(), self);
        let reading = form.reading;
        self.open(form);
        if reading { self.start(read_settings(), rows, None) } else { vec![] }
    }
}

fn read_settings() -> Task {
    Task::with_results(TextKey::SettingsTitle, jobs::ReadBasicSettings, |model, _, result| {
        let (Ok(settings), Some(form)) = (result, model.dialog::<BasicSettingsForm>()) else { return vec![] };
        form.reading = false;
        form.revision = Some(settings.revision);
        form.fill(settings.value);
        let rows = form.rows.clone();
        model.start(count_users(), rows, None)
    })
    .for_dialog::<BasicSettingsForm>()
}

/// For a warning only.
fn count_users() -> Task {
    Task::with_results(TextKey::UsersTitle, jobs::ListUsers, |model, _, result| {
        if let (Ok(users), Some(form)) = (result, model.dialog::<BasicSettingsForm>()) {
            form.users = Some(users.value.len());
        }
        vec![]
    })
    .optional()
}

fn set_settings(operation: jobs::SetBasicSettings) -> Task {
    Task::new(TextKey::SettingsTitle, operation).act(TextKey::ActSettings).restarts_server()
}
