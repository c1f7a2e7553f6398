use egui::{RichText, Ui};

use crate::model::{SecurityPolicy, StartupMode, UserTokenPolicy};
use crate::texts::{self, TextKey as T};
use crate::ui::features::basic_settings::BasicSettingsForm;
use crate::ui::model::{DialogAnswer, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, choices, dialog, form, labelled, mistake, note, small_note, text_field, word};

/// The basic settings of one controller, or the same for many (manual 2.6.1).
pub fn show(ui: &Ui, settings: &mut BasicSettingsForm, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let why = match settings.operation() {
        Some(_) => None,
        None if settings.reading => Some(T::Reading),
        None => Some(first_mistake(settings)),
    };
    let buttons = Buttons { submit: Some((text(T::Apply), why.map(text))), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::SettingsTitle, &settings.names);
    dialog(ui, "settings", &title, theme::DIALOG, buttons, |ui| {
        if settings.reading {
            ui.label(RichText::new(text(T::Reading)).color(palette(ui).weak));
            return;
        }
        if settings.rows.len() > 1 {
            note(ui, palette(ui).accent, |ui| drop(ui.add(egui::Label::new(text(T::SettingsMany)).wrap())));
            ui.add_space(theme::SPACE);
        }
        form(ui, "settings", |ui| fields(ui, settings, model));
    })
}

fn first_mistake(settings: &BasicSettingsForm) -> T {
    if let Some(error) = settings.port_error() {
        error
    } else if settings.policies.is_empty() {
        T::PolicyRule
    } else if settings.tokens.is_empty() {
        T::TokenRule
    } else {
        T::LogPasswordTip
    }
}

fn fields(ui: &mut Ui, settings: &mut BasicSettingsForm, model: &Model) {
    let text = |key: T| key.text(model.language);
    let warning = palette(ui).warning;
    labelled(ui, text(T::Port), |ui| {
        let response = text_field(ui, &mut settings.port, "4840");
        if let Some(error) = settings.port_error() {
            mistake(ui, text(error));
        }
        Some(response)
    });
    labelled(ui, text(T::StartupMode), |ui| {
        choices(ui, |ui| {
            for (mode, tip) in [(StartupMode::Auto, T::StartupAutoTip), (StartupMode::Manual, T::StartupManualTip)] {
                ui.radio_value(&mut settings.startup, mode, mode.as_str()).on_hover_text(text(tip));
            }
        });
        None
    });
    labelled(ui, text(T::SecurityPolicy), |ui| {
        ui.spacing_mut().interact_size.y = theme::DENSE_HEIGHT;
        for policy in SecurityPolicy::ALL {
            ui.horizontal(|ui| {
                toggle(ui, &mut settings.policies, policy, policy.as_str());
                if policy.is_weak() {
                    let why = if policy == SecurityPolicy::None { T::NotEncrypted } else { T::Deprecated };
                    word(ui, text(why), warning);
                }
            });
        }
        if settings.policies.is_empty() {
            mistake(ui, text(T::PolicyRule));
        }
        None
    });
    labelled(ui, text(T::TokenPolicy), |ui| {
        ui.spacing_mut().interact_size.y = theme::DENSE_HEIGHT;
        for (token, label) in
            [(UserTokenPolicy::Anonymous, T::TokenAnonymous), (UserTokenPolicy::UserName, T::TokenUserName)]
        {
            toggle(ui, &mut settings.tokens, token, text(label));
        }
        if settings.tokens.is_empty() {
            mistake(ui, text(T::TokenRule));
        }
        if settings.warns_no_users() {
            word(ui, text(T::NoUsersWarning), warning);
        }
        None
    });
    labelled(ui, text(T::ServerLog), |ui| {
        choices(ui, |ui| {
            ui.radio_value(&mut settings.server_log, false, text(T::Off));
            ui.radio_value(&mut settings.server_log, true, text(T::On));
            ui.add_space(theme::SPACE_LARGE);
            ui.checkbox(&mut settings.delete_log, text(T::DeleteLog));
        });
        if settings.server_log {
            word(ui, text(T::LogWarning), warning);
        }
        None
    });
    if settings.asks_log_password() {
        labelled(ui, text(T::LogPassword), |ui| {
            let response = text_field(ui, &mut settings.log_password, "");
            match settings.log_password_error() {
                Some(error) => mistake(ui, error.explain(model.language).message),
                None => small_note(ui, text(T::LogPasswordTip)),
            }
            Some(response)
        });
    }
}

fn toggle<V: Ord + Copy>(ui: &mut Ui, set: &mut std::collections::BTreeSet<V>, value: V, label: &str) {
    let mut on = set.contains(&value);
    if ui.checkbox(&mut on, label).changed() {
        if on {
            set.insert(value);
        } else {
            set.remove(&value);
        }
    }
}
