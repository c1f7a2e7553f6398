use std::path::Path;

use egui::{Grid, Response, RichText, TextEdit, Ui, vec2};

use crate::model::Language;
use crate::texts::TextKey as T;
use crate::ui::model::{BrowseField, Message};
use crate::ui::theme::{self, palette};

/// A form: labels on the left, fields on the right. Each row is made by [`labelled`].
pub fn form(ui: &mut Ui, id: &str, rows: impl FnOnce(&mut Ui)) {
    Grid::new(id).num_columns(2).spacing(vec2(12.0, 10.0)).min_col_width(theme::LABEL_WIDTH).show(ui, rows);
}

/// One row of a form. The label names the field for screen readers.
pub fn labelled(ui: &mut Ui, label: &str, field: impl FnOnce(&mut Ui) -> Option<Response>) {
    let label = ui
        .with_layout(egui::Layout::left_to_right(egui::Align::TOP), |ui| {
            ui.add_space(0.0);
            ui.vertical(|ui| {
                ui.add_space(5.0);
                // The column is as wide as its widest label.
                ui.add(egui::Label::new(label).extend())
            })
            .inner
        })
        .inner;
    ui.vertical(|ui| {
        ui.set_width(ui.available_width());
        if let Some(response) = field(ui) {
            response.labelled_by(label.id);
        }
    });
    ui.end_row();
}

/// A text field over the whole width.
pub fn text_field(ui: &mut Ui, text: &mut String, hint: &str) -> Response {
    let width = ui.available_width();
    ui.add(TextEdit::singleline(text).hint_text(hint.to_owned()).desired_width(width).margin(theme::SEARCH_MARGIN))
}

/// A masked field with a button that shows what is typed. It has no undo: egui would keep former texts in clear, and
/// bring them back in the same dialog later.
pub fn secret_field(ui: &mut Ui, text: &mut String, shown: &mut bool, hint: &str, language: Language) -> Response {
    ui.horizontal(|ui| {
        let word = if *shown { T::Hide } else { T::Show }.text(language);
        let room = 76.0;
        let edit = TextEdit::singleline(text)
            .password(!*shown)
            .hint_text(hint.to_owned())
            .desired_width(ui.available_width() - room)
            .margin(theme::SEARCH_MARGIN);
        let response = ui.add(edit);
        if let Some(mut state) = TextEdit::load_state(ui.ctx(), response.id) {
            state.clear_undoer();
            state.store(ui.ctx(), response.id);
        }
        if ui.add(egui::Button::new(word).min_size(vec2(room - theme::SPACE, theme::BUTTON_HEIGHT))).clicked() {
            *shown = !*shown;
        }
        response
    })
    .inner
}

/// A folder's path in full, and buttons that copy it and show it in the desktop's file manager. `real`: it is that of
/// one controller.
pub fn path_line(ui: &mut Ui, folder: &Path, real: bool, language: Language, messages: &mut Vec<Message>) {
    let path = folder.display().to_string();
    let (size, center) = (vec2(ui.available_width(), theme::BUTTON_HEIGHT), egui::Align::Center);
    ui.allocate_ui_with_layout(size, egui::Layout::right_to_left(center), |ui| {
        if real {
            if ui.button(T::Copy.text(language)).clicked() {
                ui.ctx().copy_text(path.clone());
            }
            if ui.button(T::OpenFolder.text(language)).clicked() {
                messages.push(Message::OpenFolder(folder.to_owned()));
            }
        }
        ui.with_layout(egui::Layout::left_to_right(center), |ui| {
            let shown = RichText::new(path).size(theme::SMALL_TEXT).monospace();
            ui.add(egui::Label::new(shown).wrap().selectable(true));
        });
    });
}

/// A field for the path of a file, and a button that lets the desktop's dialog find it. Fills a form's row.
pub fn path_field(
    ui: &mut Ui,
    label: &str,
    path: &mut String,
    hint: &str,
    field: BrowseField,
    language: Language,
    messages: &mut Vec<Message>,
) {
    labelled(ui, label, |ui| {
        let response = ui.horizontal(|ui| {
            let room = 92.0;
            let edit = TextEdit::singleline(path)
                .hint_text(hint.to_owned())
                .desired_width(ui.available_width() - room)
                .margin(theme::SEARCH_MARGIN);
            let response = ui.add(edit);
            let button = egui::Button::new(T::Browse.text(language));
            if ui.add(button.min_size(vec2(room - theme::SPACE, theme::BUTTON_HEIGHT))).clicked() {
                messages.push(Message::Browse(field));
            }
            response
        });
        Some(response.inner)
    });
}

/// What is wrong with the field above.
pub fn mistake(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).size(theme::SMALL_TEXT).color(palette(ui).error));
}

/// An explanation under a field.
pub fn small_note(ui: &mut Ui, text: &str) {
    ui.add(egui::Label::new(RichText::new(text).size(theme::SMALL_TEXT).color(palette(ui).weak)).wrap());
}

/// Radio buttons or tick boxes side by side.
pub fn choices(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = theme::SPACE_LARGE;
        add(ui);
    });
}
