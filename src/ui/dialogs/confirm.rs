use egui::{Frame, Label, ScrollArea, Stroke, Ui};

use crate::jobs::Confirmation;
use crate::ui::model::{Model, Task};
use crate::ui::texts::{self, TextKey as T};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Answer, Buttons, dialog, note};

/// Says what an operation will do, and to which controllers.
pub fn show(ui: &Ui, task: &Task, names: &[String], confirmation: Confirmation, model: &Model) -> Answer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Ok), None)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, task.title(), names);
    dialog(ui, "confirm", &title, theme::DIALOG, buttons, |ui| {
        let Confirmation {
            stops_server,
            replaces_certificate,
            overwrites_backup,
            deletes_log,
            invalidates_ca_signed,
            overwrites_files,
            replaces_settings,
        } = confirmation;
        let stops = if matches!(task, Task::Stop) { T::ConfirmStop } else { T::ConfirmStops };
        let remarks = [
            (stops_server, stops),
            (replaces_certificate, T::ConfirmReplaces),
            (overwrites_backup, T::ConfirmBackup),
            (deletes_log, T::ConfirmDeletesLog),
            (invalidates_ca_signed, T::ConfirmInvalidatesCaSigned),
            (overwrites_files, T::ConfirmOverwrites),
            (replaces_settings, T::ConfirmReplacesSettings),
        ];
        note(ui, palette(ui).warning, |ui| {
            for (_, remark) in remarks.into_iter().filter(|(applies, _)| *applies) {
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
        ui.add_space(theme::SPACE);
        self::names(ui, names);
    })
}

/// A list of controllers, scrolling when it is long.
pub fn names(ui: &mut Ui, names: &[String]) {
    let line = palette(ui).line;
    Frame::new().stroke(Stroke::new(1.0, line)).corner_radius(8).inner_margin(theme::CARD_MARGIN).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 0.0;
        let height = theme::LIST_ROW * names.len().min(10) as f32;
        ScrollArea::vertical().id_salt("names").max_height(height).auto_shrink([false, true]).show_rows(
            ui,
            theme::LIST_ROW,
            names.len(),
            |ui, range| {
                for name in &names[range] {
                    ui.allocate_ui_with_layout(
                        egui::vec2(ui.available_width(), theme::LIST_ROW),
                        egui::Layout::left_to_right(egui::Align::Center),
                        |ui| {
                            ui.set_min_height(theme::LIST_ROW);
                            ui.add(Label::new(name).truncate());
                        },
                    );
                }
            },
        );
    });
}
