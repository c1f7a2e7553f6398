use egui::{Button, Frame, RichText, Stroke, Ui};

use crate::model::MAX_USERS;
use crate::texts::{self, TextKey as T};
use crate::ui::features::users::{AddUserForm, UsersForm};
use crate::ui::model::{DialogAnswer, Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form, labelled, mistake, note, secret_field, small_note, text_field};

/// The users of one controller (manual 2.6.2).
pub fn list(ui: &Ui, users: &mut UsersForm, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: None, close: Some(text(T::Close)) };
    let title = texts::title_for(model.language, T::UsersTitle, std::slice::from_ref(&users.name));
    dialog(ui, "users", &title, theme::DIALOG, buttons, |ui| {
        let palette = palette(ui);
        if users.reading {
            ui.label(RichText::new(text(T::Reading)).color(palette.weak));
            return;
        }
        Frame::new().stroke(Stroke::new(1.0, palette.line)).corner_radius(8).inner_margin(theme::CARD_MARGIN).show(
            ui,
            |ui| {
                ui.set_width(ui.available_width());
                if users.users.is_empty() {
                    ui.label(RichText::new(text(T::UsersNone)).color(palette.weak));
                }
                for user in &users.users {
                    let mut on = users.ticked.contains(user);
                    if ui.checkbox(&mut on, user.as_str()).changed() {
                        if on {
                            users.ticked.insert(user.clone());
                        } else {
                            users.ticked.remove(user);
                        }
                    }
                }
            },
        );
        small_note(ui, &texts::user_count(model.language, users.users.len(), MAX_USERS));
        ui.add_space(theme::SPACE);
        ui.horizontal(|ui| {
            let add = ui.add_enabled(users.users.len() < MAX_USERS, Button::new(text(T::AddUser)));
            if add.on_disabled_hover_text(text(T::UsersFull)).clicked() {
                messages.push(Message::act(Model::new_user));
            }
            let delete = ui.add_enabled(!users.ticked.is_empty(), Button::new(text(T::Delete)));
            if delete.on_disabled_hover_text(text(T::TickUser)).clicked() {
                messages.push(Message::act(Model::delete_users));
            }
        });
    })
}

/// One more user, for one controller or many.
pub fn add(ui: &Ui, user: &mut AddUserForm, focus: bool, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let why = user.operation().is_none().then(|| text(T::UserRule));
    let buttons = Buttons { submit: Some((text(T::Add), why)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::AddUserTitle, &user.names);
    dialog(ui, "add user", &title, theme::DIALOG, buttons, |ui| {
        if user.rows.len() > 1 {
            note(ui, palette(ui).accent, |ui| drop(ui.label(text(T::AddUserMany))));
            ui.add_space(theme::SPACE);
        }
        form(ui, "user", |ui| {
            labelled(ui, text(T::UserName), |ui| {
                let response = text_field(ui, &mut user.name, "");
                if focus {
                    response.request_focus();
                }
                match user.name_error() {
                    Some(error) => mistake(ui, text(error)),
                    None => small_note(ui, text(T::UserRule)),
                }
                Some(response)
            });
            labelled(ui, text(T::UserPassword), |ui| {
                let response = secret_field(ui, &mut user.password.0, &mut user.show_password, "", model.language);
                match user.password_error() {
                    Some(error) => mistake(ui, text(error)),
                    None => small_note(ui, text(T::UserRule)),
                }
                Some(response)
            });
        });
    })
}
