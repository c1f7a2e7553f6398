//! The dialog: who is logged in, the tabs, and one tab.

mod consumables;
mod edit;
mod io;
mod keys;
mod login;
mod nodes;
mod plot;
mod robot;
mod safety;
mod status;
mod value;
mod variables;

use egui::{Align, Layout, RichText, ScrollArea, Ui};

use super::form::{LiveConnection, LiveForm};
use super::section::LiveSection;
use crate::jobs::LivePoint;
use crate::texts::{self, TextKey as T};
use crate::ui::model::{DialogAnswer, Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, chip, dialog, note, small_note};

pub use edit::show as edit;
use value::ValueCells;

/// As wide as the window allows.
pub fn show(ui: &Ui, form: &mut LiveForm, on_top: bool, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    if on_top {
        keys::read(ui.ctx(), form, messages);
    }
    let buttons = Buttons { submit: None, close: Some(text(T::Close)) };
    let title = texts::title_for(model.language, T::LiveTitle, std::slice::from_ref(&form.name));
    let room = ui.ctx().content_rect().size();
    dialog(ui, "live values", &title, room.x - theme::TRUST_ROOM.x, buttons, |ui| {
        head(ui, form, model, messages);
        login::show(ui, form, model, messages);
        if form.layout.is_none() {
            return;
        }
        let height = (room.y - theme::LIVE_ROOM).max(theme::LIVE_MIN_HEIGHT);
        match form.section {
            LiveSection::Nodes => nodes::show(ui, form, height, model, messages),
            LiveSection::Plot => plot::show(ui, form, height, model, messages),
            section => {
                let area = ScrollArea::vertical().id_salt(("live", section.title().text(model.language)));
                area.max_height(height).min_scrolled_height(height).auto_shrink(false).show(ui, |ui| {
                    let cells = ValueCells { form, model };
                    let is_empty = match section {
                        LiveSection::Robot => robot::show(ui, &cells, messages),
                        LiveSection::Safety => safety::show(ui, &cells, messages),
                        LiveSection::Io => io::show(ui, &cells, messages),
                        LiveSection::Variables => variables::show(ui, &cells, messages),
                        LiveSection::Consumables => consumables::show(ui, &cells, messages),
                        _ => status::show(ui, &cells, messages),
                    };
                    if is_empty {
                        small_note(ui, text(T::LiveEmpty));
                    }
                });
            }
        }
    })
}

/// The tabs, and whether the values are those of now. A number can be dropped on the tab of the plot.
fn head(ui: &mut Ui, form: &mut LiveForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
        link(ui, form, model);
        let user = form.logged_in().map(|name| texts::live_logged_in(model.language, name.as_str()));
        let user = user.unwrap_or_else(|| text(T::LiveAnonymous).to_owned());
        let button = ui.selectable_label(form.asks_for_login, RichText::new(user).size(theme::SMALL_TEXT));
        if button.on_hover_text(text(T::LiveLogin)).clicked() {
            form.asks_for_login = !form.asks_for_login;
        }
        ui.with_layout(Layout::left_to_right(Align::Min).with_main_wrap(true), |ui| {
            for section in LiveSection::ALL {
                let is_open = form.section == section;
                let is_target =
                    section == LiveSection::Plot && egui::DragAndDrop::has_payload_of_type::<LivePoint>(ui.ctx());
                let title = RichText::new(text(section.title()));
                let title = if is_target { title.color(palette(ui).accent).strong() } else { title };
                let tab = ui.add_enabled(form.layout.is_some(), egui::Button::selectable(is_open, title));
                if section == LiveSection::Plot
                    && let Some(point) = tab.dnd_release_payload::<LivePoint>()
                {
                    messages.push(Message::act(move |model| model.live_plot(LivePoint::clone(&point))));
                }
                let tip = if section == LiveSection::Plot { T::LiveDropHere } else { T::LiveSectionKeys };
                if tab.on_hover_text(text(tip)).clicked() {
                    form.section = section;
                    messages.push(Message::act(Model::live_section_changed));
                }
            }
        });
    });
    ui.add_space(theme::SPACE);
    if form.layout.as_ref().is_some_and(|layout| layout.is_cut) && form.section != LiveSection::Nodes {
        note(ui, palette(ui).warning, |ui| small_note(ui, text(T::LiveCut)));
        ui.add_space(theme::SPACE);
    }
}

fn link(ui: &mut Ui, form: &LiveForm, model: &Model) {
    let text = |key: T| key.text(model.language);
    let palette = palette(ui);
    let explained = |problem: &crate::model::Problem| problem.code.explain(model.language).message;
    match &form.link {
        LiveConnection::Connecting => drop(chip(ui, text(T::LiveConnecting), palette.accent)),
        LiveConnection::Live => drop(chip(ui, text(T::TrustLive), palette.ok).on_hover_text(text(T::LiveLiveTip))),
        LiveConnection::Lost(problem) => {
            drop(chip(ui, text(T::TrustLost), palette.warning).on_hover_text(explained(problem)))
        }
        LiveConnection::Ended(problem) => {
            drop(chip(ui, text(T::TrustEnded), palette.error).on_hover_text(explained(problem)))
        }
    }
}
