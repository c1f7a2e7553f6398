use egui::{Button, Frame, Label, RichText, ScrollArea, Stroke, TextStyle, TextWrapMode, Ui, vec2};

use crate::texts::{self, TextKey as T};
use crate::ui::features::remote_control::{LogForm, RemoteForm, SaveExchanges};
use crate::ui::model::{BrowseField, BrowseFor, DialogAnswer, Message, Model};
use crate::ui::picker::FileKind;
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form as fields, path_field, small_note};

const LOG_FILE: BrowseField = BrowseField {
    kind: FileKind::Text,
    asks_for: BrowseFor::NewFile(T::RemoteSaveTitle),
    text: |model| model.dialog::<SaveExchanges>().map(|form| &mut form.path),
};

/// What went over the line. Only the lines in sight are laid out.
pub fn show(ui: &mut Ui, form: &mut RemoteForm, height: f32, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    tools(ui, form, model, messages);
    ui.add_space(theme::SPACE);
    let palette = palette(ui);
    let log = &form.log;
    let shown: Vec<_> = log.shown().collect();
    let frame = Frame::new().fill(palette.stripe).stroke(Stroke::new(1.0, palette.line)).corner_radius(8);
    frame.inner_margin(theme::CARD_MARGIN).show(ui, |ui| {
        let height = (height - theme::LOG_TOOLS).max(theme::LIST_ROW);
        ui.set_min_size(vec2(ui.available_width(), height));
        if shown.is_empty() {
            return drop(ui.label(RichText::new(text(T::RemoteLogEmpty)).color(palette.weak)));
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        let font = TextStyle::Monospace.resolve(ui.style());
        let row = ui.fonts_mut(|fonts| fonts.row_height(&font));
        let area = ScrollArea::both().id_salt("exchanges").max_height(height).min_scrolled_height(height);
        area.auto_shrink(false).stick_to_bottom(true).show_rows(ui, row, shown.len(), |ui, range| {
            for exchange in shown.get(range).unwrap_or_default() {
                let color = if exchange.is_polling { palette.weak } else { palette.text };
                let line = RichText::new(log.line(exchange, model.zone)).monospace().color(color);
                ui.add(Label::new(line).wrap_mode(TextWrapMode::Extend).selectable(true));
            }
        });
    });
    let (count, dropped) = log.size();
    small_note(ui, &texts::remote_log_size(model.language, shown.len(), count, dropped));
}

fn tools(ui: &mut Ui, form: &mut RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    ui.horizontal_wrapped(|ui| {
        ui.selectable_value(&mut form.log.form, LogForm::Text, text(T::RemoteLogText));
        ui.selectable_value(&mut form.log.form, LogForm::Hex, text(T::RemoteHexadecimal));
        ui.checkbox(&mut form.log.with_polling, text(T::RemoteLogPolling)).on_hover_text(text(T::RemoteLogPollingTip));
        let is_empty = form.log.shown().next().is_none();
        let clicked = |ui: &mut Ui, label: T| {
            let button = ui.add_enabled(!is_empty, Button::new(text(label)));
            button.on_disabled_hover_text(text(T::RemoteLogEmpty)).clicked()
        };
        if clicked(ui, T::Copy) {
            ui.copy_text(form.log.written(model.zone));
        }
        if clicked(ui, T::SaveLog) {
            messages.push(Message::act(Model::ask_where_to_save_exchanges));
        }
        if clicked(ui, T::RemoteLogClear) {
            form.log.clear();
        }
    });
}

/// Where the log is to be saved.
pub fn save(ui: &Ui, save: &mut SaveExchanges, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Save), save.incomplete().map(text))), close: Some(text(T::Cancel)) };
    dialog(ui, "save exchanges", text(T::RemoteSaveTitle), theme::DIALOG, buttons, |ui| {
        ui.add(Label::new(text(T::RemoteSaveText)).wrap());
        ui.add_space(theme::SPACE);
        fields(ui, "save exchanges", |ui| {
            let (label, hint) = (text(T::FileLabel), text(T::FileHint));
            path_field(ui, label, &mut save.path, hint, LOG_FILE, model.language, messages);
        });
    })
}
