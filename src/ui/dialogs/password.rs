use egui::{Label, Ui};

use super::confirm;
use crate::model::ErrorCode;
use crate::texts::TextKey as T;
use crate::ui::model::{Model, PasswordForm};
use crate::ui::theme;
use crate::ui::widgets::{Answer, Buttons, dialog, fine_print, form, labelled, mistake, secret_field};

/// Ask for the connection password of controllers whose password is not known.
pub fn show(ui: &Ui, ask: &mut PasswordForm, focus: bool, model: &Model) -> Answer {
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
                    fine_print(ui, text(T::PasswordNotKept));
                }
                Some(response)
            });
        });
    })
}
