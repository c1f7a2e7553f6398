use egui::{Button, RichText, TextEdit, Ui, vec2};

use crate::texts::TextKey as T;
use crate::ui::model::{FileForm, Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{form, labelled, note};

/// A file to be read: its path to be typed, or chosen with the desktop's dialog.
pub fn file_field(ui: &mut Ui, file: &mut FileForm, focus: bool, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    form(ui, "file", |ui| {
        labelled(ui, text(T::FileLabel), |ui| {
            let response = ui.horizontal(|ui| {
                let room = 92.0;
                let edit = TextEdit::singleline(&mut file.path)
                    .hint_text(text(T::FileHint))
                    .desired_width(ui.available_width() - room)
                    .margin(theme::SEARCH_MARGIN);
                let response = ui.add_enabled(file.reading.is_none(), edit);
                if focus {
                    response.request_focus();
                }
                let button = Button::new(text(T::ChooseFile)).min_size(vec2(room - theme::SPACE, theme::BUTTON_HEIGHT));
                if ui.add_enabled(file.picking.is_none() && file.reading.is_none(), button).clicked() {
                    messages.push(Message::ChooseFile);
                }
                response
            });
            Some(response.inner)
        });
    });
    if let Some(problem) = &file.problem {
        let explained = problem.code.explain(model.language);
        ui.add_space(theme::SPACE);
        note(ui, palette(ui).error, |ui| {
            ui.label(RichText::new(explained.message).strong());
            ui.label(explained.remedy);
            if let Some(detail) = &problem.detail {
                ui.add(egui::Label::new(RichText::new(detail).size(theme::SMALL_TEXT).monospace()).wrap());
            }
        });
    }
}
