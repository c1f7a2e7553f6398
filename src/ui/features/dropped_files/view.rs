use egui::{Label, RichText, Ui};

use crate::texts::{self, TextKey as T};
use crate::ui::drops;
use crate::ui::model::{DialogAnswer, DropForm, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, list_title, note, small_note};

/// Files were dropped: what they are, and which dialog shall take them, or why none does.
pub fn show(ui: &Ui, form: &mut DropForm, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = if form.offers() {
        Buttons { submit: Some((text(T::DropOpen), form.incomplete().map(text))), close: Some(text(T::Cancel)) }
    } else {
        Buttons { submit: Some((text(T::Close), None)), close: None }
    };
    dialog(ui, "drop", text(T::DropTitle), theme::DIALOG, buttons, |ui| {
        if let Some(blocked) = form.blocked {
            note(ui, palette(ui).error, |ui| drop(ui.add(Label::new(text(blocked)).wrap())));
            return;
        }
        drops::files(ui, &form.files, model);
        for problem in form.files.iter().filter_map(|file| file.found.as_ref().err()).take(1) {
            let explained = problem.code.explain(model.language);
            note(ui, palette(ui).error, |ui| {
                ui.add(Label::new(explained.cause).wrap());
                ui.add(Label::new(explained.remedy).wrap());
                if let Some(detail) = &problem.detail {
                    small_note(ui, detail);
                }
            });
        }
        choices(ui, form, model);
    })
}

fn choices(ui: &mut Ui, form: &mut DropForm, model: &Model) {
    if form.choices.is_empty() {
        return;
    }
    list_title(ui, T::DropChoose.text(model.language));
    for (at, choice) in form.choices.iter().enumerate() {
        ui.add_enabled_ui(choice.why.is_none(), |ui| {
            ui.radio_value(&mut form.selected, Some(at), choice.title.text(model.language));
        });
        match choice.why {
            Some(why) => {
                let said = RichText::new(why.text(model.language)).size(theme::SMALL_TEXT).color(palette(ui).warning);
                ui.add(Label::new(said).wrap());
            }
            None => small_note(ui, choice.command.tooltip().text(model.language)),
        }
        // Which of them, when not all.
        if choice.files.len() < form.files.len() {
            let names: Vec<String> = choice.files.iter().map(|at| form.files[*at].name()).collect();
            small_note(ui, &texts::only_these(model.language, &names));
        }
    }
}
