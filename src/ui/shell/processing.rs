use std::path::{Path, PathBuf};

use egui::{Align, Frame, Label, Layout, ProgressBar, RichText, ScrollArea, Sense, Stroke, Ui, vec2};

use super::error;
use crate::texts::{self, TextKey as T};
use crate::ui::model::{
    BackendCommand, CancelState, Dialog, DialogAnswer, DialogPlace, Job, JobRow, Message, Model, RowState,
};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, chip, dialog, note, path_line};

/// What of the running job is looked at.
#[derive(Debug, Default)]
pub struct ProcessingDialog {
    /// Index of the controller whose failure is explained.
    pub selected: Option<usize>,
    /// The one the list has scrolled to.
    pub revealed: Option<usize>,
    /// It lies over a form, which goes on when it is closed.
    pub over_form: bool,
}

impl Dialog for ProcessingDialog {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        show(ui, self, model, messages)
    }

    /// While the job runs: asks, then stops it. Afterwards: closes.
    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let Some(job) = &mut model.job else {
            model.end_processing();
            return vec![];
        };
        if job.summary.is_some() {
            let on_closed = job.task.closed_hook();
            model.end_processing();
            return on_closed.map(|hook| hook(model)).unwrap_or_default();
        }
        let commands = match job.cancel {
            CancelState::No => {
                job.cancel = CancelState::Asking;
                vec![]
            }
            CancelState::Asking => {
                job.cancel = CancelState::Sent;
                vec![BackendCommand::Cancel(job.id)]
            }
            CancelState::Sent => vec![],
        };
        model.put_back(self);
        commands
    }

    /// Enter never stops a running job.
    fn enter_submits(&self, model: &Model) -> bool {
        model.job.as_ref().is_none_or(|job| job.summary.is_some())
    }
}

/// Each controller's progress and result; at the end the sum of it.
fn show(ui: &Ui, view: &mut ProcessingDialog, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let Some(job) = &model.job else { return DialogAnswer::Close };
    let ended = job.summary.is_some();
    let state = match job.summary {
        None => T::Processing,
        Some(summary) if summary.not_started > 0 => T::Stopped,
        Some(_) => T::Completed,
    };
    let title = format!("{} – {}", text(job.task.title), text(state));
    let buttons = if ended {
        Buttons { submit: Some((text(T::Close), None)), close: None }
    } else {
        Buttons { submit: None, close: (job.cancel == CancelState::No).then(|| text(T::Cancel)) }
    };
    dialog(ui, "processing", &title, theme::DIALOG_WIDE, buttons, |ui| {
        bar(ui, job, model);
        cancelling(ui, job, model, messages);
        list(ui, view, job, model);
        if ended {
            saved(ui, job, model, messages);
            if let Some(footer) = job.task.footer {
                footer(ui, job, model, messages);
            }
        }
        if let Some(problem) = view.selected.and_then(|at| job.rows.get(at)).and_then(|row| row.state.problem()) {
            ui.add_space(theme::SPACE);
            note(ui, palette(ui).error, |ui| {
                ui.label(RichText::new(problem.code.explain(model.language).message).strong());
                ui.add_space(theme::SPACE);
                error::explanation(ui, problem, model.language);
            });
        }
        if ended && !view.over_form && !model.changed_servers().is_empty() {
            ui.add_space(theme::SPACE);
            if ui.button(text(T::Verify)).on_hover_text(text(T::VerifyTip)).clicked() {
                messages.push(Message::VerifyChanged);
            }
        }
        if ended && !job.without_password().is_empty() {
            ui.add_space(theme::SPACE);
            if ui.button(text(T::EnterPassword)).clicked() {
                messages.push(Message::EnterPasswords);
            }
        }
    })
}

fn bar(ui: &mut Ui, job: &Job, model: &Model) {
    let palette = palette(ui);
    let done = job.finished as f32 / job.rows.len().max(1) as f32;
    // The bar's track is the background otherwise, which cannot be seen on a dialog.
    ui.scope(|ui| {
        ui.visuals_mut().extreme_bg_color = palette.line;
        let fill = if job.failed == job.rows.len() { palette.error } else { palette.accent };
        ui.add(ProgressBar::new(done).fill(fill).desired_height(6.0).corner_radius(3));
    });
    let said = match job.summary {
        Some(summary) => texts::summary(model.language, summary),
        None => format!("{} / {}", job.finished, job.rows.len()),
    };
    ui.label(RichText::new(said).color(palette.weak));
    ui.add_space(theme::SPACE);
}

/// The folders of what was saved, and of what had to make room for it.
fn saved(ui: &mut Ui, job: &Job, model: &Model, messages: &mut Vec<Message>) {
    let written: Vec<&Path> = job.rows.iter().filter_map(|row| row.written.as_deref()).collect();
    folder_of(ui, T::SavedIn, &written, model, messages);
    let used: Vec<&Path> = job.rows.iter().filter_map(|row| row.used.as_deref()).collect();
    folder_of(ui, T::ImportedFrom, &used, model, messages);
    let moved: Vec<&Path> = job.rows.iter().flat_map(|row| &row.moved_aside).map(PathBuf::as_path).collect();
    folder_of(ui, T::MovedAside, &moved, model, messages);
}

/// The folder that holds all these files: their own, or the nearest above.
fn folder_of(ui: &mut Ui, said: T, files: &[&Path], model: &Model, messages: &mut Vec<Message>) {
    let Some(first) = files.first().and_then(|file| file.parent()) else { return };
    let holds_all = |folder: &&Path| files.iter().all(|file| file.starts_with(folder));
    let folder = first.ancestors().find(holds_all).unwrap_or(model.workspace.root());
    ui.add_space(theme::SPACE);
    ui.label(RichText::new(said.text(model.language)).size(theme::SMALL_TEXT).color(palette(ui).weak));
    path_line(ui, folder, true, model.language, messages);
}

fn cancelling(ui: &mut Ui, job: &Job, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    match job.cancel {
        CancelState::Asking if job.summary.is_none() => {
            note(ui, palette(ui).warning, |ui| {
                ui.horizontal(|ui| {
                    ui.label(text(T::CancelAsk));
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        if ui.button(text(T::CancelYes)).clicked() {
                            messages.push(Message::Close);
                        }
                        if ui.button(text(T::CancelNo)).clicked() {
                            messages.push(Message::KeepGoing);
                        }
                    });
                });
            });
            ui.add_space(theme::SPACE);
        }
        CancelState::Sent if job.summary.is_none() => {
            ui.label(text(T::Stopping));
            ui.add_space(theme::SPACE);
        }
        _ => {}
    }
}

fn list(ui: &mut Ui, view: &mut ProcessingDialog, job: &Job, model: &Model) {
    let line = palette(ui).line;
    let height = (theme::LIST_ROW * job.rows.len() as f32).clamp(theme::LIST_ROW, theme::LIST_HEIGHT);
    Frame::new().stroke(Stroke::new(1.0, line)).corner_radius(8).inner_margin(theme::CARD_MARGIN).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 0.0;
        let mut area = ScrollArea::vertical()
            .id_salt("rows")
            .max_height(height)
            // Else it takes one row less whenever it lies in the dialog's own scroll area.
            .min_scrolled_height(height)
            .auto_shrink([false, true]);
        if view.selected != view.revealed
            && let Some(selected) = view.selected
        {
            area = area.vertical_scroll_offset((theme::LIST_ROW * (selected as f32 + 0.5) - height / 2.0).max(0.0));
            view.revealed = view.selected;
        }
        area.show_rows(ui, theme::LIST_ROW, job.rows.len(), |ui, range| {
            for index in range {
                row(ui, view, index, &job.rows[index], model);
            }
        });
    });
}

fn row(ui: &mut Ui, view: &mut ProcessingDialog, index: usize, row: &JobRow, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    let (key, color) = match &row.state {
        RowState::Waiting => (T::StateWaiting, palette.off),
        RowState::Step(step) => (texts::step(*step), palette.accent),
        RowState::Done => (T::StateDone, palette.ok),
        RowState::Failed(_) => (T::StateFailed, palette.error),
        RowState::NotStarted => (T::StateNotStarted, palette.off),
    };
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), theme::LIST_ROW), Sense::click());
    if view.selected == Some(index) && row.state.problem().is_some() {
        ui.painter().rect_filled(rect, 4.0, palette.error.gamma_multiply(0.09));
    }
    let mut ui = ui.new_child(
        egui::UiBuilder::new().max_rect(rect.shrink2(vec2(4.0, 0.0))).layout(Layout::left_to_right(Align::Center)),
    );
    let third = rect.width() * 0.33;
    let cell = |ui: &mut Ui, width: f32, add: &mut dyn FnMut(&mut Ui)| {
        ui.allocate_ui_with_layout(vec2(width, theme::LIST_ROW), Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(width);
            add(ui);
        });
    };
    cell(&mut ui, third, &mut |ui| drop(ui.add(Label::new(&row.name).truncate())));
    cell(&mut ui, 120.0, &mut |ui| drop(chip(ui, key.text(language), color)));
    if let Some(problem) = row.state.problem() {
        ui.add(Label::new(RichText::new(problem.code.explain(language).message).color(palette.error)).truncate());
    } else if let Some(file) = row.written.as_ref().or(row.used.as_ref()) {
        let shown = file.strip_prefix(model.workspace.root()).unwrap_or(file).display().to_string();
        ui.add(Label::new(RichText::new(shown).size(theme::SMALL_TEXT).color(palette.weak)).truncate());
    }
    if response.clicked() && row.state.problem().is_some() {
        view.selected = Some(index);
    }
}
