use egui::{Label, Ui};

use crate::jobs::Confirmation;
use crate::texts::{self, TextKey as T};
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, RowId, Task};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, list, note};

/// Asks whether a task is to be done to controllers.
#[derive(Debug)]
pub struct ConfirmDialog {
    pub task: Task,
    pub rows: Vec<RowId>,
    pub names: Vec<String>,
    pub confirmation: Confirmation,
}

impl Dialog for ConfirmDialog {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        show(ui, &self.task, &self.names, self.confirmation, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.dialogs.pop_if(|form| form.is_done_by_confirming());
        model.start(self.task, self.rows, None)
    }
}

/// Says what an operation will do, and to which controllers.
fn show(ui: &Ui, task: &Task, names: &[String], confirmation: Confirmation, model: &Model) -> DialogAnswer {
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

/// A list of controllers, scrolling when it is long.
pub fn names(ui: &mut Ui, names: &[String]) {
    list(ui, "names", names.len(), 10, |ui, index| {
        ui.add(Label::new(&names[index]).truncate());
    });
}
