//! The lists of one controller (manual 2.7.3).

mod add;
mod cell;
mod delete;
mod details;
mod keys;
mod line;
mod move_anyway;
mod pane;
mod strip;

use egui::{Align, Id, Label, Layout, RichText, TextEdit, Ui, vec2};

use crate::model::DisconnectedClient;
use crate::texts::{self, TextKey as T};
use crate::ui::features::client_certificates::{Freshness, PaneKind, ShownLists, TrustAction, TrustForm};
use crate::ui::model::{DialogAnswer, Job, Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, chip, dialog, note};

pub use add::show as add;
pub use delete::show as delete;
pub use details::show as details;
pub use keys::UNDO;
pub use move_anyway::show as move_anyway;

/// Trusted, rejected and issuers side by side, or the CRLs. In a narrow window one list at a time.
pub fn show(ui: &Ui, form: &mut TrustForm, on_top: bool, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    if on_top {
        keys::read(ui.ctx(), form, messages);
    }
    let buttons = Buttons { submit: None, close: Some(text(T::Close)) };
    let title = if form.shows == ShownLists::Crls { T::CrlTitle } else { T::TrustTitle };
    let title = texts::title_for(model.language, title, std::slice::from_ref(&form.name));
    let room = ui.ctx().content_rect().size();
    dialog(ui, "trust", &title, room.x - theme::TRUST_ROOM.x, buttons, |ui| {
        if form.held.is_none() {
            ui.label(RichText::new(text(T::Reading)).color(palette(ui).weak));
            return;
        }
        let top = ui.cursor().top();
        let height = room.y - theme::TRUST_ROOM.y;
        tools(ui, form, model, messages);
        remarks(ui, form, model);
        let strip_height = if room.y < theme::TRUST_LOW_WINDOW { strip::LOW } else { strip::HIGH };
        let used = ui.cursor().top() - top + strip_height + theme::SPACE;
        lists(ui, form, (height - used).max(theme::TRUST_MIN_HEIGHT), model, messages);
        strip::show(ui, form, strip_height, model, messages);
    })
}

pub(super) fn filter_id() -> Id {
    Id::unique("trust filter")
}

fn tools(ui: &mut Ui, form: &mut TrustForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    ui.horizontal(|ui| {
        let width = theme::SEARCH_WIDTH.min(ui.available_width() * 0.4);
        let filter = TextEdit::singleline(&mut form.filter)
            .id(filter_id())
            .hint_text(text(T::TrustFilter))
            .desired_width(width)
            .margin(theme::SEARCH_MARGIN);
        if ui.add(filter).accessible_name(text(T::TrustFilter)).changed() {
            form.find();
        }
        let why = match form.undoable() {
            0 => Some(T::TrustUndoNothing),
            _ => form.busy.then_some(T::TrustBusy),
        };
        let undo = ui.add_enabled(why.is_none(), egui::Button::new(text(T::TrustUndo)));
        let undo = undo.on_disabled_hover_text(why.map_or("", text));
        if undo.on_hover_text(ui.ctx().format_shortcut(&keys::UNDO)).clicked() {
            messages.push(act(TrustAction::Undo));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| link(ui, form, model, messages));
    });
    ui.add_space(theme::SPACE);
}

/// Whether the lists are up to date.
fn link(ui: &mut Ui, form: &TrustForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let palette = palette(ui);
    let explained = |problem: &crate::model::Problem| problem.code.explain(model.language).message;
    match &form.link {
        _ if form.busy => drop(chip(ui, text(T::TrustBusy), palette.accent)),
        Freshness::Reading => drop(chip(ui, text(T::Reading), palette.accent)),
        Freshness::Live => drop(chip(ui, text(T::TrustLive), palette.ok).on_hover_text(text(T::TrustLiveTip))),
        Freshness::Lost(problem) => {
            drop(chip(ui, text(T::TrustLost), palette.warning).on_hover_text(explained(problem)))
        }
        Freshness::Ended(problem) => {
            if ui.button(text(T::Retry)).clicked() {
                messages.push(act(TrustAction::Reconnect));
            }
            chip(ui, text(T::TrustEnded), palette.error).on_hover_text(explained(problem));
        }
    }
}

/// What the last change did, and what is wrong with the whole of it.
fn remarks(ui: &mut Ui, form: &TrustForm, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    if let Some(done) = &form.done {
        let color = if form.cut.is_empty() { palette.ok } else { palette.warning };
        note(ui, color, |ui| {
            let said = done.text(language);
            ui.add(Label::new(RichText::new(said).strong()).wrap());
            cut(ui, &form.cut, model);
        });
        ui.add_space(theme::SPACE);
    }
    if let Some(ahead) = form.clock_off {
        note(ui, palette.warning, |ui| drop(ui.add(Label::new(texts::clock_off(language, ahead)).wrap())));
        ui.add_space(theme::SPACE);
    }
    if form.shows == ShownLists::Crls && !form.without_crl.is_empty() {
        note(ui, palette.warning, |ui| {
            let said = texts::without_crl(language, &form.without_crl);
            ui.add(Label::new(RichText::new(&said).strong()).truncate()).on_hover_text(&said);
            ui.add(Label::new(T::CrlWithoutText.text(language)).wrap());
        });
        ui.add_space(theme::SPACE);
    }
}

/// How many are named of those that were disconnected.
const MOST_CUT: usize = 3;

/// Whose connections were ended.
pub(super) fn cut(ui: &mut Ui, clients: &[crate::model::DisconnectedClient], model: &Model) {
    let language = model.language;
    if clients.is_empty() {
        ui.label(RichText::new(T::TrustCutNone.text(language)).size(theme::SMALL_TEXT));
        return;
    }
    ui.label(RichText::new(T::TrustCutTitle.text(language)).size(theme::SMALL_TEXT).strong());
    for client in clients.iter().take(MOST_CUT) {
        let said = texts::cut(language, &client.issued_to, &client.address, client.status);
        ui.add(Label::new(RichText::new(&said).size(theme::SMALL_TEXT)).truncate()).on_hover_text(said);
    }
    if clients.len() > MOST_CUT {
        let rest: Vec<String> = clients[MOST_CUT..]
            .iter()
            .map(|client| texts::cut(language, &client.issued_to, &client.address, client.status))
            .collect();
        let more = texts::and_more(language, rest.len());
        ui.label(RichText::new(more).size(theme::SMALL_TEXT)).on_hover_text(rest.join("\n"));
    }
}

fn lists(ui: &mut Ui, form: &mut TrustForm, height: f32, model: &Model, messages: &mut Vec<Message>) {
    let count = form.panes.len();
    let width = ui.available_width();
    if count > 1 && width < theme::TRUST_SIDE_BY_SIDE {
        pane::show(ui, form, form.focus, vec2(width, height), true, model, messages);
        return;
    }
    let shares: f32 = form.panes.iter().map(|pane| share(pane.kind)).sum();
    let room = width - theme::SPACE * (count - 1) as f32;
    ui.horizontal_top(|ui| {
        for index in 0..count {
            let width = (room * share(form.panes[index].kind) / shares).floor();
            pane::show(ui, form, index, vec2(width, height), false, model, messages);
        }
    });
}

/// Of the width. Why a client was refused takes the most words.
const fn share(kind: PaneKind) -> f32 {
    match kind {
        PaneKind::Rejected => 1.3,
        PaneKind::Trusted => 1.1,
        PaneKind::Issuers | PaneKind::Crls => 1.0,
    }
}

/// What the buttons of a list ask for.
pub(super) const fn moves(kind: PaneKind) -> Option<(PaneKind, T, T)> {
    match kind {
        PaneKind::Rejected => Some((PaneKind::Trusted, T::TrustTrust, T::TrustTrustTip)),
        PaneKind::Trusted => Some((PaneKind::Rejected, T::TrustReject, T::TrustRejectTip)),
        PaneKind::Issuers | PaneKind::Crls => None,
    }
}

/// Who was disconnected by a change of whom the controllers trust, and the way back.
pub fn changed(ui: &mut Ui, job: &Job, model: &Model, messages: &mut Vec<Message>) {
    let clients: Vec<DisconnectedClient> = job.rows.iter().flat_map(|row| row.cut.iter().cloned()).collect();
    if !clients.is_empty() {
        ui.add_space(theme::SPACE);
        note(ui, palette(ui).warning, |ui| cut(ui, &clients, model));
    }
    if job.rows.iter().any(|row| row.undo.is_some()) {
        ui.add_space(theme::SPACE);
        if ui.button(T::TrustUndo.text(model.language)).clicked() {
            messages.push(Message::act(Model::undo_job));
        }
    }
}

/// An action of these dialogs.
fn act(action: TrustAction) -> Message {
    Message::act(move |model| model.trust_action(action))
}
