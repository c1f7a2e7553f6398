use egui::{Align, Button, Color32, Grid, Label, Layout, RichText, ScrollArea, Ui, vec2};

use super::plot::{self, Keys};
use crate::model::{ErrorCode, Problem};
use crate::recorder::RecordingPhase;
use crate::texts::{self, TextKey as T};
use crate::ui::features::recorder::form::{ControllerRecording, RecorderForm, RecordingState};
use crate::ui::model::{DialogAnswer, DialogPlace, Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, chip, dialog, note, path_line, small_note, word};

/// The recordings with their states, and the values of one of them.
pub fn show(
    ui: &Ui,
    form: &mut RecorderForm,
    place: DialogPlace,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let active = form.active();
    let is_ending = form.recordings.iter().any(|recording| recording.state == RecordingState::Ending);
    let submit = match active {
        0 => (text(T::RecorderAgain), None),
        _ => (text(T::RecorderStop), is_ending.then(|| text(T::RecorderFinishing))),
    };
    let buttons = Buttons { submit: Some(submit), close: Some(text(T::Close)) };
    let title = texts::title_for(model.language, T::RecorderTitle, &form.names);
    let room = ui.ctx().content_rect().size();
    dialog(ui, "recordings", &title, room.x - theme::TRUST_ROOM.x, buttons, |ui| {
        let top = ui.cursor().top();
        table(ui, form, model, messages);
        recovered(ui, form, model);
        trouble(ui, form, model, messages);
        if active > 0 {
            small_note(ui, text(T::RecorderGoesOn));
        }
        ui.add_space(theme::SPACE);
        values(ui, form, top, room.y, place, model, messages);
    })
}

/// One line a controller.
fn table(ui: &mut Ui, form: &mut RecorderForm, model: &Model, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    let heading = |ui: &mut Ui, key: T, tip: T| {
        let text = RichText::new(key.text(model.language)).size(theme::HEADER_TEXT).color(palette.weak);
        ui.label(text).on_hover_text(tip.text(model.language));
    };
    let height = theme::LIST_ROW * 6.5;
    let is_alone = form.recordings.len() == 1;
    let mut selected = form.selected;
    ScrollArea::both().id_salt("recordings").max_height(height).auto_shrink([false, true]).show(ui, |ui| {
        ui.spacing_mut().interact_size.y = theme::DENSE_HEIGHT;
        let spacing = vec2(theme::SPACE_LARGE * 1.5, 2.0);
        Grid::new("recordings").num_columns(8).spacing(spacing).striped(true).show(ui, |ui| {
            heading(ui, T::RecordingController, T::RecorderChooseTip);
            heading(ui, T::RecorderState, T::RecorderStateTip);
            heading(ui, T::RecordingRows, T::RecorderRowsTip);
            heading(ui, T::RecordingMissing, T::RecorderMissingTip);
            heading(ui, T::RecorderWarnings, T::RecorderWarningsTip);
            heading(ui, T::RecorderSize, T::RecorderSizeTip);
            ui.label("");
            ui.end_row();
            for (index, recording) in form.recordings.iter().enumerate() {
                if is_alone {
                    ui.label(&recording.name);
                } else if ui.selectable_label(selected == index, &recording.name).clicked() {
                    selected = index;
                }
                line(ui, recording, model, messages);
                ui.end_row();
            }
        });
    });
    form.selected = selected;
}

fn line(ui: &mut Ui, recording: &ControllerRecording, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let (palette, progress) = (palette(ui), &recording.progress);
    let (said, color) = state(&recording.state, model, palette);
    let size = vec2(theme::RECORDING_STATE, theme::CHIP_HEIGHT);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_width(size.x);
        chip(ui, &said, color).on_hover_text(said);
    });
    let number = |ui: &mut Ui, number: String, color: Color32| {
        ui.label(RichText::new(number).color(color));
    };
    number(ui, progress.rows.to_string(), palette.text);
    let missing = texts::recording_missing(model.language, progress.missing, progress.gaps);
    number(ui, missing, if progress.gaps > 0 { palette.warning } else { palette.weak });
    let warnings = progress.warnings + progress.undecodable;
    number(ui, warnings.to_string(), if warnings > 0 { palette.warning } else { palette.weak });
    let size = recording.file.as_ref().map_or("–".to_owned(), |_| texts::file_size(progress.file_bytes));
    number(ui, size, palette.text);
    ui.horizontal(|ui| {
        let row = recording.row;
        if recording.state.is_active() && recording.state != RecordingState::Ending {
            if ui.button(text(T::RecorderStopOne)).on_hover_text(text(T::RecorderStopTip)).clicked() {
                messages.push(Message::act(move |model| model.end_recording(row)));
            }
        } else if let Some(recorded) = &recording.recorded {
            let file = recorded.file.clone();
            if ui.button(text(T::RecorderShow)).on_hover_text(text(T::OpenRecordingTip)).clicked() {
                messages.push(Message::act(move |model| model.open_recording(Some(file))));
            }
        }
    });
}

fn state(state: &RecordingState, model: &Model, palette: &theme::Palette) -> (String, Color32) {
    let text = |key: T| key.text(model.language).to_owned();
    match state {
        RecordingState::Finding => (text(T::RecorderFinding), palette.accent),
        RecordingState::At(RecordingPhase::Connecting) => (text(T::LiveConnecting), palette.accent),
        RecordingState::At(RecordingPhase::Waiting) => (text(T::RecorderWaiting), palette.accent),
        RecordingState::At(RecordingPhase::Running) => (text(T::RecorderRunning), palette.ok),
        RecordingState::At(RecordingPhase::Reconnecting { .. }) => (text(T::RecorderReconnecting), palette.warning),
        RecordingState::At(RecordingPhase::Finishing) | RecordingState::Ending => {
            (text(T::RecorderFinishing), palette.accent)
        }
        RecordingState::Ended(reason) => (texts::recording_end(model.language, *reason), palette.off),
        RecordingState::Failed(problem) => (problem.code.explain(model.language).message.to_owned(), palette.error),
    }
}

/// Recordings that a former program left unfinished.
fn recovered(ui: &mut Ui, form: &RecorderForm, model: &Model) {
    for recovered in &form.recovered {
        match recovered {
            Ok(recorded) => {
                let said = texts::recording_recovered(model.language, &recorded.file, recorded.sidecar.rows);
                small_note(ui, &said);
            }
            Err(problem) => drop(word(ui, problem.code.explain(model.language).message, palette(ui).warning)),
        }
    }
}

/// What is wrong with the recording that is shown, and what helps.
fn trouble(ui: &mut Ui, form: &RecorderForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let palette = palette(ui);
    let Some(shown) = form.shown() else { return };
    match &shown.state {
        RecordingState::Failed(problem) => {
            ui.add_space(theme::SPACE);
            note(ui, palette.error, |ui| {
                explained(ui, problem.code, problem.detail.as_deref(), model);
                ui.horizontal(|ui| {
                    let is_refused = |problem: &Problem| problem.code == ErrorCode::ConfiguratorNotTrusted;
                    if is_refused(problem) && ui.button(text(T::VerifyTrust)).clicked() {
                        messages.push(Message::act(Model::trust_for_recordings));
                    }
                    let retry = ui.add_enabled(model.job.is_none(), Button::new(text(T::Retry)));
                    if retry.on_hover_text(text(T::RecorderRetryTip)).clicked() {
                        messages.push(Message::act(Model::retry_recordings));
                    }
                });
            });
        }
        RecordingState::At(RecordingPhase::Reconnecting { code, detail }) => {
            ui.add_space(theme::SPACE);
            note(ui, palette.warning, |ui| explained(ui, *code, Some(detail.as_str()), model));
        }
        _ => {}
    }
    if let Some(file) = &shown.file
        && let Some(folder) = file.parent()
    {
        ui.add_space(theme::SPACE);
        ui.add(Label::new(RichText::new(file.file_name().unwrap_or_default().to_string_lossy()).strong()).truncate());
        path_line(ui, folder, true, model.language, messages);
    }
}

fn explained(ui: &mut Ui, code: ErrorCode, detail: Option<&str>, model: &Model) {
    let explained = code.explain(model.language);
    ui.add(Label::new(RichText::new(explained.message).strong()).wrap());
    ui.add(Label::new(explained.cause).wrap());
    ui.add(Label::new(explained.remedy).wrap());
    if let Some(detail) = detail {
        small_note(ui, detail);
    }
}

/// The plots take what is left of the window.
fn values(
    ui: &mut Ui,
    form: &mut RecorderForm,
    top: f32,
    room: f32,
    place: DialogPlace,
    model: &Model,
    messages: &mut Vec<Message>,
) {
    let (Some(settings), Some(shown)) = (form.settings, form.recordings.get(form.selected)) else { return };
    let above = ui.cursor().top() - top;
    let height = (room - theme::DIALOG_MARGIN - above).max(theme::LIVE_MIN_HEIGHT);
    let keys = if place.on_top { Keys::Read } else { Keys::Ignore };
    let is_running = shown.state.is_recording();
    ui.with_layout(Layout::top_down(Align::Min), |ui| {
        let values = [&shown.values];
        if plot::show(ui, &mut form.plot, settings.source(), &values, is_running, height, keys, model) {
            messages.push(Message::act(Model::recorder_plot_changed));
        }
    });
}
