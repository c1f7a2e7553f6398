use egui::{Button, Frame, Label, RichText, ScrollArea, Stroke, TextEdit, TextStyle, TextWrapMode, Ui, vec2};

use crate::texts::{self, TextKey as T};
use crate::ui::features::server_log::{LogView, SaveLogForm};
use crate::ui::model::{BrowseField, BrowseFor, DialogAnswer, Message, Model};
use crate::ui::picker::FileKind;
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form, path_field, small_note};

const LOG_FILE: BrowseField = BrowseField {
    kind: FileKind::Text,
    asks_for: BrowseFor::NewFile(T::SaveLogTitle),
    text: |model| model.dialog::<SaveLogForm>().map(|form| &mut form.path),
};

/// The end of the server log of one controller. Only the lines in sight are laid out.
pub fn show(ui: &Ui, log: &mut LogView, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: None, close: Some(text(T::Close)) };
    let title = texts::title_for(model.language, T::ServerLog, std::slice::from_ref(&log.name));
    dialog(ui, "server log", &title, theme::DIALOG_LOG, buttons, |ui| {
        if !log.is_read() {
            ui.label(RichText::new(text(T::Reading)).color(palette(ui).weak));
            return;
        }
        tools(ui, log, model, messages);
        ui.add_space(theme::SPACE);
        lines(ui, log, model);
        let (size, here) = log.size();
        let found = (log.shown() < log.lines()).then(|| log.shown());
        let said = texts::log_size(model.language, size, here, log.lines(), found);
        small_note(ui, if log.reading { text(T::Reading) } else { &said });
    })
}

/// Where the log is to be saved.
pub fn save(ui: &Ui, save: &mut SaveLogForm, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Save), save.incomplete().map(text))), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::SaveLogTitle, std::slice::from_ref(&save.name));
    dialog(ui, "save log", &title, theme::DIALOG, buttons, |ui| {
        ui.add(Label::new(text(T::SaveLogText)).wrap());
        ui.add_space(theme::SPACE);
        form(ui, "save log", |ui| {
            let (label, hint) = (text(T::FileLabel), text(T::FileHint));
            path_field(ui, label, &mut save.path, hint, LOG_FILE, model.language, messages);
        });
    })
}

fn tools(ui: &mut Ui, log: &mut LogView, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    ui.horizontal(|ui| {
        let filter = TextEdit::singleline(&mut log.filter)
            .hint_text(text(T::LogFilter))
            .desired_width(theme::SEARCH_WIDTH)
            .margin(theme::SEARCH_MARGIN);
        let filter = ui.add(filter).accessible_name(text(T::LogFilter));
        if filter.changed() {
            log.find();
        }
        let reading = log.reading.then_some(T::Reading);
        let empty = (log.size().0 == 0).then_some(T::LogEmpty);
        let clicked = |ui: &mut Ui, label: T, why: Option<T>| {
            let button = ui.add_enabled(why.is_none(), Button::new(text(label)));
            button.on_disabled_hover_text(why.map_or("", text)).clicked()
        };
        if clicked(ui, T::Refresh, reading) {
            messages.push(Message::act(Model::refresh_log));
        }
        if clicked(ui, T::Copy, nothing_shown(log)) {
            ui.copy_text(log.copied());
        }
        if clicked(ui, T::SaveLog, reading.or(empty)) {
            messages.push(Message::act(Model::ask_where_to_save_log));
        }
        if clicked(ui, T::DeleteLogButton, reading.or(empty)) {
            messages.push(Message::act(Model::delete_log));
        }
    });
}

/// Why no line is shown.
fn nothing_shown(log: &LogView) -> Option<T> {
    let key = if log.lines() == 0 { T::LogEmpty } else { T::LogNothingFound };
    (log.shown() == 0).then_some(key)
}

fn lines(ui: &mut Ui, log: &LogView, model: &Model) {
    let palette = palette(ui);
    let height = (ui.ctx().content_rect().height() - theme::LOG_MARGIN).clamp(theme::LIST_ROW, theme::LOG_HEIGHT);
    let frame = Frame::new().fill(palette.stripe).stroke(Stroke::new(1.0, palette.line)).corner_radius(8);
    frame.inner_margin(theme::CARD_MARGIN).show(ui, |ui| {
        ui.set_min_size(vec2(ui.available_width(), height));
        if let Some(key) = nothing_shown(log) {
            ui.add(Label::new(RichText::new(key.text(model.language)).color(palette.weak)).wrap());
            return;
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        let font = TextStyle::Monospace.resolve(ui.style());
        let (row, glyph) = ui.fonts_mut(|fonts| (fonts.row_height(&font), fonts.glyph_width(&font, '0')));
        // All lines count, also those not in sight: else the width would change while it scrolls.
        let width = glyph * log.longest() as f32;
        ScrollArea::both()
            .id_salt("lines")
            .max_height(height)
            .min_scrolled_height(height)
            .auto_shrink(false)
            .stick_to_bottom(true)
            .show_rows(ui, row, log.shown(), |ui, range| {
                ui.set_min_width(width);
                for at in range {
                    let line = RichText::new(log.line(at)).monospace();
                    ui.add(Label::new(line).wrap_mode(TextWrapMode::Extend).selectable(true));
                }
            });
    });
}
