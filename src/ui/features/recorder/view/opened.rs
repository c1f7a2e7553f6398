use egui::{Label, RichText, Ui};

use super::plot::{self, Keys};
use super::summary;
use crate::texts::{self, TextKey as T};
use crate::ui::features::recorder::opened::RecordingView;
use crate::ui::model::{BrowseField, BrowseFor, DialogAnswer, DialogPlace, Message, Model};
use crate::ui::picker::FileKind;
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, form, note, path_field, small_note};

const FILE: BrowseField = BrowseField {
    kind: FileKind::Recording,
    asks_for: BrowseFor::File,
    text: |model| model.dialog::<RecordingView>().map(|view| &mut view.path),
};

/// A recording that is complete: its file, what it holds, and its values.
pub fn show(
    ui: &Ui,
    view: &mut RecordingView,
    place: DialogPlace,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let submit = Some((text(T::OpenRecordingNow), view.incomplete().map(text)));
    let buttons = Buttons { submit, close: Some(text(T::Close)) };
    let name = view.opened.as_ref().map(|opened| opened.header.controller.clone());
    let title = texts::title_for(model.language, T::OpenRecordingTitle, name.as_slice());
    let room = ui.ctx().content_rect().size();
    let width = if view.opened.is_some() { room.x - theme::TRUST_ROOM.x } else { theme::DIALOG_WIDE };
    dialog(ui, "recording", &title, width, buttons, |ui| {
        let top = ui.cursor().top();
        form(ui, "recording file", |ui| {
            let label = text(T::RecordingFile);
            path_field(ui, label, &mut view.path, text(T::FileHint), FILE, model.language, messages);
        });
        if view.opened.is_none() && view.problem.is_none() {
            small_note(ui, text(T::OpenRecordingText));
        }
        trouble(ui, view, model);
        let is_reading = view.is_reading();
        if is_reading {
            ui.label(RichText::new(text(T::Reading)).color(palette(ui).weak));
        }
        let RecordingView { opened: Some(opened), plot: shown, .. } = view else { return };
        if let Some(sidecar) = &opened.sidecar {
            ui.add_space(theme::SPACE);
            summary::show(ui, sidecar, model);
        }
        ui.add_space(theme::SPACE);
        let above = ui.cursor().top() - top;
        let height = (room.y - theme::DIALOG_MARGIN - above).max(theme::LIVE_MIN_HEIGHT);
        let keys = if place.on_top { Keys::Read } else { Keys::Ignore };
        let values: Vec<_> = opened.values.iter().map(|loaded| &loaded.values).collect();
        let source = opened.header.settings.source();
        if plot::show(ui, shown, source, &values, false, height, keys, model) {
            messages.push(Message::act(Model::recording_plot_changed));
        }
        if is_reading {
            // The values are drawn while they are read.
            ui.ctx().request_repaint_after(plot::REFRESH);
        }
    })
}

/// Why the file cannot be shown, or not whole.
fn trouble(ui: &mut Ui, view: &RecordingView, model: &Model) {
    let Some(problem) = &view.problem else { return };
    let explained = problem.code.explain(model.language);
    ui.add_space(theme::SPACE);
    note(ui, palette(ui).error, |ui| {
        ui.add(Label::new(RichText::new(explained.message).strong()).wrap());
        ui.add(Label::new(explained.cause).wrap());
        ui.add(Label::new(explained.remedy).wrap());
        if let Some(detail) = &problem.detail {
            small_note(ui, detail);
        }
    });
}
