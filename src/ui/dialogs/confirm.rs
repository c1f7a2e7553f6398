use egui::{Label, Ui};

use crate::jobs::Confirmation;
use crate::texts::{self, TextKey as T};
use crate::ui::model::{Model, Task};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Answer, Buttons, dialog, fine_print, list, note};
use crate::workspace::VaultState;

/// Says what an operation will do, and to which controllers.
pub fn show(ui: &Ui, task: &Task, names: &[String], confirmation: Confirmation, model: &Model) -> Answer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(task.act), None)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, task.title, names);
    dialog(ui, "confirm", &title, theme::DIALOG, buttons, |ui| {
        let mut remarks = texts::confirmation(confirmation);
        if let Some(remark) = task.remark {
            remarks.insert(0, remark);
        }
        let color = if remarks.is_empty() { palette(ui).accent } else { palette(ui).warning };
        if remarks.is_empty() {
            remarks.push(T::ConfirmDisturbsNobody);
        }
        note(ui, color, |ui| {
            for remark in remarks {
                ui.add(Label::new(text(remark)).wrap());
            }
        });
        ui.add_space(theme::SPACE);
        self::names(ui, names);
    })
}

/// Removes controllers from the list (manual 2.5.2).
pub fn delete(ui: &Ui, names: &[String], model: &Model) -> Answer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Delete), None)), close: Some(text(T::Cancel)) };
    dialog(ui, "delete", &texts::title_for(model.language, T::DeleteTitle, names), theme::DIALOG, buttons, |ui| {
        ui.add(Label::new(text(T::DeleteText)).wrap());
        if model.store.is_some_and(|store| matches!(store.vault, VaultState::Closed | VaultState::Declined)) {
            fine_print(ui, text(T::DeleteVaultClosed));
        }
        ui.add_space(theme::SPACE);
        self::names(ui, names);
    })
}

/// A list of controllers, scrolling when it is long.
pub fn names(ui: &mut Ui, names: &[String]) {
    list(ui, "names", names.len(), 10, |ui, index| {
        ui.add(Label::new(&names[index]).truncate());
    });
}
