//! Taking controllers out of the list (manual 2.5.2).

use egui::{Key, Label, Modifiers, Ui};

use crate::texts::{self, TextKey as T};
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, UiCommand};
use crate::ui::shell::confirm;
use crate::ui::theme;
use crate::ui::widgets::{Buttons, dialog, small_note};
use crate::workspace::VaultState;

/// Asks whether controllers are to be taken out of the list.
#[derive(Debug)]
pub struct DeleteControllersDialog {
    rows: Vec<RowId>,
    /// The names of the controllers.
    pub names: Vec<String>,
}

impl DeleteControllersDialog {
    /// Asks about these rows.
    pub fn new(rows: Vec<RowId>, model: &Model) -> Self {
        Self { names: model.rows.names(&rows), rows }
    }
}

impl UiCommand {
    /// Takes controllers out of the list.
    pub const DELETE_CONTROLLERS: Self = Self::new(T::DeleteControllers, T::DeleteControllersTip, |model, rows| {
        model.open(DeleteControllersDialog::new(rows, model));
        vec![]
    })
    .in_menu(T::MenuController)
    .key(Modifiers::NONE, Key::Delete)
    .for_controllers();
}

impl Dialog for DeleteControllersDialog {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        delete(ui, &self.names, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.delete(&self.rows)
    }
}

impl Model {
    fn delete(&mut self, rows: &[RowId]) -> Vec<BackendCommand> {
        let gone = self.rows.remove(rows);
        self.status = Some(texts::deleted(self.language, gone.len()));
        let forget = gone.iter().filter_map(|entry| entry.fingerprint).collect();
        let mut commands = self.save();
        commands.push(BackendCommand::Forget(forget));
        commands
    }
}

/// Removes controllers from the list (manual 2.5.2).
fn delete(ui: &Ui, names: &[String], model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Delete), None)), close: Some(text(T::Cancel)) };
    dialog(ui, "delete", &texts::title_for(model.language, T::DeleteTitle, names), theme::DIALOG, buttons, |ui| {
        ui.add(Label::new(text(T::DeleteText)).wrap());
        if model.store.is_some_and(|store| matches!(store.vault, VaultState::Closed | VaultState::Declined)) {
            small_note(ui, text(T::DeleteVaultClosed));
        }
        ui.add_space(theme::SPACE);
        confirm::names(ui, names);
    })
}
