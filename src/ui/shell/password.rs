use egui::{Label, Ui};
use secrecy::SecretString;

use crate::model::ErrorCode;
use crate::texts::TextKey as T;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, SecretInput, Task};
use crate::ui::shell::confirm;
use crate::ui::theme;
use crate::ui::widgets::{Buttons, dialog, form, labelled, mistake, secret_field, small_note};

/// The password of controllers whose password is not known.
#[derive(Debug)]
pub struct PasswordDialog {
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub password: SecretInput,
    pub show_password: bool,
    /// The one used last was refused.
    pub wrong: bool,
    /// What to do once it is there.
    pub task: Task,
}

impl Dialog for PasswordDialog {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        show(ui, self, place.focus, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let password = SecretString::from(self.password.0.as_str());
        model.start_again(self.task.clone(), self.rows.clone(), Some(password))
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.without_password(&self.task)
    }
}

fn show(ui: &Ui, ask: &mut PasswordDialog, focus: bool, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let submit = if ask.rows.len() == 1 { T::Ok } else { T::PasswordUse };
    let buttons = Buttons { submit: Some((text(submit), None)), close: Some(text(T::Cancel)) };
    dialog(ui, "password", text(T::PasswordTitle), theme::DIALOG, buttons, |ui| {
        ui.add(Label::new(text(T::PasswordText)).wrap());
        ui.add_space(theme::SPACE);
        confirm::names(ui, &ask.names);
        ui.add_space(theme::SPACE);
        form(ui, "password", |ui| {
            labelled(ui, text(T::Password), |ui| {
                let response = secret_field(
                    ui,
                    &mut ask.password.0,
                    &mut ask.show_password,
                    text(T::PasswordHint),
                    model.language,
                );
                if focus {
                    response.request_focus();
                }
                if ask.wrong {
                    mistake(ui, ErrorCode::WrongPassword.explain(model.language).message);
                }
                if model.store.is_some_and(|store| !store.keeps()) {
                    small_note(ui, text(T::PasswordNotKept));
                }
                Some(response)
            });
        });
    })
}
