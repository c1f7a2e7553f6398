//! The dialog: the connection, the lamps, the switch, the tabs, and one tab.

mod alarms;
mod button;
mod connection;
mod control;
mod execute;
mod io;
mod keys;
mod lamps;
mod line;
mod log;
mod switch;
mod variables;

use egui::{Button, RichText, ScrollArea, Ui};

use super::form::RemoteForm;
use super::section::RemoteSection;
use crate::texts::{self, TextKey as T};
use crate::ui::model::{DialogAnswer, DialogPlace, Message, Model};
use crate::ui::theme;
use crate::ui::widgets::{Buttons, dialog};

pub use log::save;
pub use switch::allow;

/// As wide as the window allows.
pub fn show(
    ui: &Ui,
    form: &mut RemoteForm,
    place: DialogPlace,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    if place.on_top {
        keys::read(ui.ctx(), form, messages);
    }
    let buttons = Buttons { submit: None, close: Some(text(T::Close)) };
    let title = texts::title_for(model.language, T::RemoteControlTitle, std::slice::from_ref(&form.name));
    let room = ui.ctx().content_rect().size();
    dialog(ui, "remote control", &title, room.x - theme::TRUST_ROOM.x, buttons, |ui| {
        connection::show(ui, form, place.focus, model, messages);
        if form.status.is_none() && form.log.size().0 == 0 {
            return;
        }
        lamps::show(ui, form, model);
        switch::show(ui, form, model, messages);
        ui.add_space(theme::SPACE);
        tabs(ui, form, model, messages);
        ui.add_space(theme::SPACE);
        let height = (room.y - theme::REMOTE_ROOM).max(theme::LIVE_MIN_HEIGHT);
        if form.section == RemoteSection::Log {
            return log::show(ui, form, height, model, messages);
        }
        let area = ScrollArea::vertical().id_salt(("remote", form.section.title().text(model.language)));
        area.max_height(height).min_scrolled_height(height).auto_shrink(false).show(ui, |ui| match form.section {
            RemoteSection::Control => control::show(ui, form, model, messages),
            RemoteSection::Io => io::show(ui, form, model, messages),
            RemoteSection::Variables => variables::show(ui, form, model, messages),
            RemoteSection::Execute => execute::show(ui, form, model, messages),
            RemoteSection::Alarms | RemoteSection::Log => alarms::show(ui, form, model, messages),
        });
    })
}

fn tabs(ui: &mut Ui, form: &RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    ui.horizontal_wrapped(|ui| {
        for section in RemoteSection::ALL {
            let title = RichText::new(section.title().text(model.language));
            let tab = ui.add(Button::selectable(form.section == section, title));
            if tab.on_hover_text(T::LiveSectionKeys.text(model.language)).clicked() {
                messages.push(Message::act(move |model| model.turn_remote(section)));
            }
        }
    });
}
