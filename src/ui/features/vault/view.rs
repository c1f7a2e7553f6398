use egui::{Button, Label, RichText, Ui};

use crate::texts::{self, TextKey as T};
use crate::ui::features::vault::{VaultAction, VaultForm, VaultRequest};
use crate::ui::model::{DialogAnswer, Message, Model, SecretInput};
use crate::ui::shell::error;
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, choices, dialog, form, labelled, mistake, note, secret_field, small_note};
use crate::workspace::{PasswordPlace, StoreStatus, VaultState};

/// Asks for the passphrase of the vault.
pub fn show(ui: &Ui, asked: &mut VaultForm, focus: bool, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let (title, what, submit) = match asked.action {
        VaultAction::Create => (T::VaultCreateTitle, T::VaultCreateText, T::VaultCreateNow),
        VaultAction::Open => (T::VaultOpenTitle, T::VaultOpenText, T::VaultOpenNow),
        VaultAction::ChangePassphrase => (T::VaultChangeTitle, T::VaultChangeText, T::VaultChangeNow),
    };
    let buttons = Buttons { submit: Some((text(submit), asked.incomplete().map(text))), close: Some(text(T::Cancel)) };
    dialog(ui, "vault", text(title), theme::DIALOG, buttons, |ui| {
        ui.add(Label::new(text(what)).wrap());
        ui.add_space(theme::SPACE_LARGE);
        ui.add_enabled_ui(!asked.working, |ui| form(ui, "vault", |ui| fields(ui, asked, focus, model)));
        if asked.working {
            ui.add_space(theme::SPACE);
            ui.label(RichText::new(text(T::CaWorking)).color(palette(ui).weak));
        }
        if let Some(problem) = &asked.problem {
            ui.add_space(theme::SPACE);
            note(ui, palette(ui).error, |ui| {
                ui.label(RichText::new(problem.code.explain(model.language).message).strong());
                ui.add_space(theme::SPACE);
                error::explanation(ui, problem, model.language);
            });
        }
    })
}

fn fields(ui: &mut Ui, asked: &mut VaultForm, focus: bool, model: &Model) {
    let (chosen_error, again_error) = (asked.chosen_error(), asked.again_error());
    let VaultForm { action, passphrase, new, again, show, .. } = asked;
    let mut field = |ui: &mut Ui, label: T, typed: &mut SecretInput, focus: bool, wrong: Option<T>| {
        labelled(ui, label.text(model.language), |ui| {
            let response = secret_field(ui, &mut typed.0, show, "", model.language);
            if focus {
                response.request_focus();
            }
            if let Some(wrong) = wrong {
                mistake(ui, wrong.text(model.language));
            }
            Some(response)
        });
    };
    let of_first = chosen_error.filter(|_| *action == VaultAction::Create);
    field(ui, T::Passphrase, passphrase, focus, of_first);
    if *action == VaultAction::ChangePassphrase {
        field(ui, T::VaultNewPassphrase, new, false, chosen_error);
    }
    if *action != VaultAction::Open {
        field(ui, T::CaPassphraseAgain, again, false, again_error);
    }
}

/// The rows of the options dialog: where passwords are kept, and what can be done with the vault.
pub fn options(ui: &mut Ui, store: &StoreStatus, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    labelled(ui, text(T::PasswordsLabel), |ui| {
        choices(ui, |ui| {
            for (place, key) in
                [(PasswordPlace::Keyring, T::PasswordsKeyring), (PasswordPlace::Vault, T::PasswordsVault)]
            {
                if ui.radio(model.options.passwords == place, text(key)).clicked() {
                    messages.push(Message::act(move |model| model.vault_request(VaultRequest::Use(place))));
                }
            }
        });
        small_note(ui, &texts::vault_state(model.language, store));
        let offered: &[(VaultRequest, T)] = match store.vault {
            VaultState::None => &[],
            VaultState::Closed | VaultState::Declined => &[(VaultRequest::Open, T::VaultOpen)],
            VaultState::Open { .. } => {
                &[(VaultRequest::ChangePassphrase, T::VaultChange), (VaultRequest::Close, T::VaultClose)]
            }
        };
        ui.horizontal(|ui| {
            for (request, key) in offered {
                if ui.add(Button::new(text(*key))).clicked() {
                    let request = *request;
                    messages.push(Message::act(move |model| model.vault_request(request)));
                }
            }
        });
        None
    });
}
