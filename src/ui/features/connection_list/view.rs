use egui::{ComboBox, Label, RichText, Ui};

use crate::model::ControllerSeries;
use crate::texts::{self, TextKey as T};
use crate::ui::features::connection_list::ConnectionListForm;
use crate::ui::model::{DialogAnswer, Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, cell, dialog, file_field, form, labelled, list, list_title, small_note};

/// Lines of a list before it scrolls.
const MOST: usize = 7;

/// Controllers from a connection list (manual 2.5.3).
pub fn show(
    ui: &Ui,
    connections: &mut ConnectionListForm,
    focus: bool,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    let language = model.language;
    let text = |key: T| key.text(language);
    let submit = if connections.reads_file() { T::ReadFile } else { T::Import };
    let why = connections.incomplete().map(text);
    let buttons = Buttons { submit: Some((text(submit), why)), close: Some(text(T::Cancel)) };
    dialog(ui, "connection list", text(T::ConnectionListTitle), theme::DIALOG_WIDE, buttons, |ui| {
        file_field(ui, &mut connections.file, focus, model, messages);
        if connections.reads_file() {
            ui.add_space(theme::SPACE);
            small_note(ui, text(T::ConnectionListText));
            return;
        }
        let palette = palette(ui);
        let (ticked, all) = (connections.ticked(), connections.new.len());
        if all == 0 {
            ui.add_space(theme::SPACE);
            ui.label(RichText::new(text(T::NothingToImport)).color(palette.weak));
        } else {
            ui.add_space(theme::SPACE);
            ui.horizontal(|ui| {
                let mut every = ticked == all;
                let said = texts::to_import(language, ticked, all);
                let tick = egui::Checkbox::new(&mut every, said).indeterminate(ticked > 0 && ticked < all);
                if ui.add(tick).clicked() {
                    connections.new.iter_mut().for_each(|found| found.ticked = every);
                }
            });
            list(ui, "new", all, MOST, |ui, index| {
                let found = &mut connections.new[index];
                ui.push_id(index, |ui| {
                    ui.scope(|ui| {
                        ui.set_width(250.0);
                        let tick = egui::Checkbox::new(&mut found.ticked, found.connection.name.as_str());
                        ui.add(tick);
                    });
                    let address = found.connection.address.to_string();
                    cell(ui, 240.0, RichText::new(address).monospace());
                    let line = texts::line(language, found.line);
                    cell(ui, f32::INFINITY, RichText::new(line).color(palette.weak));
                });
            });
            ui.add_space(theme::SPACE);
            form(ui, "series", |ui| {
                labelled(ui, text(T::ColumnType), |ui| {
                    let series = &mut connections.series;
                    let box_ = ComboBox::from_id_salt("series").selected_text(series.as_str());
                    let shown = box_.show_ui(ui, |ui| {
                        for each in ControllerSeries::ALL {
                            ui.selectable_value(series, each, each.as_str());
                        }
                    });
                    small_note(ui, text(T::SeriesGuess));
                    Some(shown.response)
                });
            });
        }
        if !connections.left_out.is_empty() {
            list_title(ui, text(T::LinesLeftOut));
            list(ui, "left out", connections.left_out.len(), MOST, |ui, index| {
                let left = &connections.left_out[index];
                let color = if left.why.problem(left.line).is_some() { palette.error } else { palette.weak };
                cell(ui, 70.0, RichText::new(texts::line(language, left.line)).color(palette.weak));
                cell(ui, 160.0, RichText::new(&left.name));
                cell(ui, f32::INFINITY, RichText::new(texts::skipped(language, &left.why)).color(color));
            });
        }
        ui.add_space(theme::SPACE);
        ui.add(Label::new(RichText::new(text(T::ImportText)).size(theme::SMALL_TEXT).color(palette.weak)).wrap());
    })
}
