use egui::{Button, ComboBox, Frame, Label, RichText, Stroke, Ui};

use crate::model::ControllerSeries;
use crate::pki::Fingerprint;
use crate::texts::{self, TextKey as T};
use crate::ui::features::add_controller::{AddControllerForm, AddStage};
use crate::ui::model::{DialogAnswer, Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form, labelled, mistake, note, secret_field, small_note, text_field};

/// Register a controller (manual 2.5.1): its fields, then whether it is the right one.
pub fn show(
    ui: &Ui,
    form: &mut AddControllerForm,
    focus: bool,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    if form.identity.is_some() {
        return confirm_identity(ui, form, focus, model, messages);
    }
    let (title, submit) = match form.stage {
        AddStage::Form | AddStage::Probing => (T::AddControllerTitle, T::Apply),
        AddStage::Compare(_) | AddStage::Enrolling(_) => (T::FingerprintTitle, T::FingerprintMatches),
    };
    let waiting = matches!(form.stage, AddStage::Probing | AddStage::Enrolling(_));
    let submit = if waiting { T::Processing } else { submit };
    let why = if waiting { Some(T::Processing) } else { form.incomplete(model) };
    let buttons = Buttons { submit: Some((text(submit), why.map(text))), close: Some(text(T::Cancel)) };
    dialog(ui, "add controller", text(title), theme::DIALOG, buttons, |ui| match form.stage {
        AddStage::Form | AddStage::Probing => {
            ui.add_enabled_ui(!waiting, |ui| fields(ui, form, focus, model, messages));
        }
        AddStage::Compare(fingerprint) | AddStage::Enrolling(fingerprint) => compare(ui, form, fingerprint, model),
    })
}

/// The same for a controller that is in the list already.
fn confirm_identity(
    ui: &Ui,
    form: &mut AddControllerForm,
    focus: bool,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let submit = match form.stage {
        AddStage::Form => (text(T::Retry), None),
        AddStage::Probing | AddStage::Enrolling(_) => (text(T::Processing), Some(text(T::Processing))),
        AddStage::Compare(_) => (text(T::FingerprintConfirm), None),
    };
    let buttons = Buttons { submit: Some(submit), close: Some(text(T::Cancel)) };
    dialog(ui, "confirm identity", text(T::FingerprintTitle), theme::DIALOG, buttons, |ui| {
        if let Some(identity) = form.identity.as_ref().filter(|identity| identity.all() > 1) {
            ui.horizontal(|ui| {
                small_note(ui, &texts::nth_of(model.language, identity.nth, identity.all()));
                if ui.button(text(T::Skip)).clicked() {
                    messages.push(Message::act(Model::skip_identity));
                }
            });
            ui.add_space(theme::SPACE);
        }
        match form.stage {
            AddStage::Form => {
                ui.label(RichText::new(format!("{} · {}", form.name, form.address)).strong());
                ui.add_space(theme::SPACE);
                failure(ui, form, model);
            }
            AddStage::Probing => {
                ui.label(RichText::new(format!("{} · {}", form.name, form.address)).strong());
                ui.add_space(theme::SPACE);
                ui.label(RichText::new(text(T::LookingForController)).color(palette(ui).weak));
            }
            AddStage::Compare(fingerprint) | AddStage::Enrolling(fingerprint) => {
                compare(ui, form, fingerprint, model);
                ui.add_space(theme::SPACE_LARGE);
                let waiting = form.stage == AddStage::Enrolling(fingerprint);
                ui.add_enabled_ui(!waiting, |ui| {
                    let focus = std::mem::take(&mut form.focus_password) || focus;
                    self::form(ui, "password", |ui| password(ui, form, focus, model));
                });
            }
        }
    })
}

fn failure(ui: &mut Ui, add: &AddControllerForm, model: &Model) {
    if let Some(problem) = &add.problem {
        let explained = problem.code.explain(model.language);
        note(ui, palette(ui).error, |ui| {
            ui.label(RichText::new(explained.message).strong());
            ui.label(explained.remedy);
        });
        ui.add_space(theme::SPACE);
    }
}

fn password(ui: &mut Ui, add: &mut AddControllerForm, focus: bool, model: &Model) {
    let text = |key: T| key.text(model.language);
    labelled(ui, text(T::Password), |ui| {
        let hint = text(T::PasswordHint);
        let response = secret_field(ui, &mut add.password.0, &mut add.show_password, hint, model.language);
        if focus {
            response.request_focus();
        }
        Some(response)
    });
}

fn fields(ui: &mut Ui, add: &mut AddControllerForm, focus: bool, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    failure(ui, add, model);
    if add.may_be_unconfirmed() {
        let why = add.incomplete(model).map(text);
        let response = ui.add_enabled(why.is_none(), Button::new(text(T::AddUnconfirmed)));
        if response.on_disabled_hover_text(why.unwrap_or_default()).clicked() {
            messages.push(Message::act(Model::add_unconfirmed));
        }
        small_note(ui, text(T::AddUnconfirmedTip));
        ui.add_space(theme::SPACE);
    }
    let (name_error, address_error) = (add.name_error(model), add.address_error(model));
    form(ui, "controller", |ui| {
        labelled(ui, text(T::ColumnName), |ui| {
            let response = text_field(ui, &mut add.name, "");
            if focus {
                response.request_focus();
            }
            if let Some(error) = name_error {
                mistake(ui, text(error));
            }
            Some(response)
        });
        labelled(ui, text(T::ColumnAddress), |ui| {
            let response = text_field(ui, &mut add.address, text(T::AddressHint));
            if let Some(error) = address_error {
                mistake(ui, text(error));
            }
            Some(response)
        });
        password(ui, add, false, model);
        labelled(ui, text(T::ColumnType), |ui| {
            let list = ComboBox::from_id_salt("series").selected_text(add.series.as_str()).show_ui(ui, |ui| {
                for series in ControllerSeries::ALL {
                    ui.selectable_value(&mut add.series, series, series.as_str());
                }
            });
            Some(list.response)
        });
    });
}

fn compare(ui: &mut Ui, add: &AddControllerForm, fingerprint: Fingerprint, model: &Model) {
    let text = |key: T| key.text(model.language);
    let palette = palette(ui);
    ui.label(RichText::new(format!("{} · {}", add.name.trim(), add.address.trim())).strong());
    ui.add_space(theme::SPACE);
    let explained = if add.identity.is_some() { T::FingerprintLater } else { T::FingerprintText };
    ui.add(Label::new(text(explained)).wrap());
    ui.add_space(theme::SPACE_LARGE);
    ui.label(RichText::new(text(T::FingerprintLabel)).size(theme::SMALL_TEXT).color(palette.weak));
    Frame::new()
        .fill(palette.stripe)
        .stroke(Stroke::new(1.0, palette.line))
        .corner_radius(8)
        .inner_margin(theme::CARD_MARGIN)
        .show(ui, |ui| {
            ui.set_width(ui.available_width());
            // Four short lines are easier to compare than one long one.
            let grouped = fingerprint.grouped();
            let lines: Vec<String> =
                grouped.split(':').collect::<Vec<_>>().chunks(8).map(|line| line.join(" ")).collect();
            ui.add(Label::new(RichText::new(lines.join("\n")).monospace().size(15.0)).selectable(true));
        });
}
